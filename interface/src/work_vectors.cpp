// Vectors for scratch work that a Ceed keeps between uses.
#include <algorithm>

#include "vector.hpp"

namespace {

using Lock = std::lock_guard<std::mutex>;

}  // namespace

namespace hg {

void destroy_work_vectors(Ceed_private &ceed) noexcept {
  // While its vectors go, they count on the Ceed again: it must not be destroyed a second time with the last of them.
  ceed.ref_count.store(1);
  for (const WorkVector &work : ceed.work_vectors) {
    guard(&ceed, [&] {
      work.vec->ceed = Ref<Ceed_private>(&ceed);
      dereference(work.vec);
    });
  }
}

}  // namespace hg

int CeedGetWorkVector(Ceed ceed, CeedSize len, CeedVector *vec) {
  return hg::guard(ceed, [&] {
    hg::deref(ceed, "Ceed");
    hg::require(vec != nullptr, CEED_ERROR_INCOMPLETE, "Work vector: vec is NULL; expected where the handle goes");
    hg::require(len >= 0, CEED_ERROR_DIMENSION,
                [&] { return hg::text("Work vector: len is %" CeedSize_FMT "; expected zero or more", len); });
    {
      const Lock lock(ceed->work_mutex);
      hg::WorkVector *best = nullptr;  // the shortest that is long enough
      for (hg::WorkVector &work : ceed->work_vectors) {
        if (!work.is_idle || work.length < len) continue;
        if (best == nullptr || work.length < best->length) best = &work;
      }
      if (best != nullptr) {
        best->is_idle = false;
        best->vec->ceed = hg::Ref<Ceed_private>(ceed);
        hg::reference(best->vec);
        *vec = best->vec;
        return;
      }
    }
    CeedVector created = nullptr;
    hg::check(CeedVectorCreate(ceed, len, &created));
    auto owned = hg::Ref<CeedVector_private>::adopt(created);
    const Lock lock(ceed->work_mutex);
    ceed->work_vectors.push_back({created, len, false});
    hg::reference(created);
    *vec = owned.release();
  });
}

int CeedRestoreWorkVector(Ceed ceed, CeedVector *vec) {
  return hg::guard(ceed, [&] {
    hg::deref(ceed, "Ceed");
    hg::require(vec != nullptr, CEED_ERROR_INCOMPLETE, "Work vector: vec is NULL; expected the address of a handle");
    hg::deref(*vec, "Work vector");
    hg::Ref<Ceed_private> released;  // goes after the lock: it may be the last reference
    const Lock lock(ceed->work_mutex);
    const auto found = std::find_if(ceed->work_vectors.begin(), ceed->work_vectors.end(),
                                    [&](const hg::WorkVector &work) { return work.vec == *vec && !work.is_idle; });
    hg::require(found != ceed->work_vectors.end(), CEED_ERROR_MAJOR,
                "Work vector: this vector was not handed out by CeedGetWorkVector() of this Ceed, or was given back");
    hg::require_writable(**vec);
    const int num_others = (*vec)->ref_count.load() - 2;  // beside the Ceed's own and the one given back
    hg::require(num_others == 0, CEED_ERROR_ACCESS, [&] {
      return hg::text("Work vector: %d other references are held; expected none when it is given back", num_others);
    });
    released = std::move((*vec)->ceed);
    hg::dereference(*vec);
    found->is_idle = true;
    *vec = nullptr;
  });
}

int CeedClearWorkVectors(Ceed ceed, CeedSize min_len) {
  return hg::guard(ceed, [&] {
    hg::deref(ceed, "Ceed");
    std::vector<hg::WorkVector> cleared;
    {
      const Lock lock(ceed->work_mutex);
      auto &all = ceed->work_vectors;
      const auto keep = [&](const hg::WorkVector &work) { return !work.is_idle || work.length >= min_len; };
      const auto middle = std::stable_partition(all.begin(), all.end(), keep);
      cleared.assign(middle, all.end());
      all.erase(middle, all.end());
    }
    for (const hg::WorkVector &work : cleared) {
      work.vec->ceed = hg::Ref<Ceed_private>(ceed);
      hg::dereference(work.vec);
    }
  });
}

int CeedGetWorkVectorMemoryUsage(Ceed ceed, CeedScalar *usage_mb) {
  return hg::guard(ceed, [&] {
    hg::deref(ceed, "Ceed");
    hg::require(usage_mb != nullptr, CEED_ERROR_INCOMPLETE, "Work vector: usage_mb is NULL; expected a number's place");
    const Lock lock(ceed->work_mutex);
    CeedSize entries = 0;
    for (const hg::WorkVector &work : ceed->work_vectors) entries += work.length;
    *usage_mb = static_cast<CeedScalar>(entries) * sizeof(CeedScalar) * 1e-6;
  });
}
