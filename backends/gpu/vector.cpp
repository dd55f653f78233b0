/// Vectors with an array on the host and one on the device, of which each is made when it is wanted. Arithmetic is done
/// on the device.
#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

#include "../host/access.hpp"
#include "../host/memory.hpp"
#include "device.hpp"
#include "tables.hpp"
#include "text/jobs.hpp"

namespace hg::gpu {

using host::chk, host::wall;

namespace {

/// An array in one memory: lent by the user, or owned.
template <typename Owned>
struct Place {
  Owned owned;
  CeedScalar *borrowed = nullptr;
  bool is_current = false;  ///< has the vector's values
};

struct Vector {
  Device &device;
  CeedSize length;
  Place<host::Array> host;
  Place<Buffer> on_device;
  std::recursive_mutex
      mutex;  ///< a vector that is only read may be shared, and a copy is made by whoever wants it first

  std::size_t num_bytes() const { return static_cast<std::size_t>(length) * sizeof(CeedScalar); }
  bool has_values() const { return host.is_current || on_device.is_current; }

  CeedScalar *allocate(CeedMemType mem_type) {
    if (mem_type == CEED_MEM_DEVICE) {
      if (on_device.borrowed != nullptr) return on_device.borrowed;
      if (!on_device.owned) on_device.owned = device.allocate(num_bytes());
      return on_device.owned.as<CeedScalar>();
    }
    if (host.borrowed != nullptr) return host.borrowed;
    if (!host.owned) host.owned = host::allocate_array(static_cast<std::size_t>(length));
    if (!host.owned) throw std::bad_alloc();
    return host.owned.get();
  }
  bool &is_current(CeedMemType mem_type) {
    return mem_type == CEED_MEM_DEVICE ? on_device.is_current : host.is_current;
  }

  /// The array in a memory, with the vector's values.
  CeedScalar *read(CeedMemType mem_type) {
    const std::scoped_lock one_thread(mutex);
    CeedScalar *array = allocate(mem_type);
    if (is_current(mem_type) || !has_values()) return array;
    if (mem_type == CEED_MEM_DEVICE) {
      device.driver().copy_to_device(array, allocate(CEED_MEM_HOST), num_bytes());
    } else {
      device.driver().copy_to_host(array, allocate(CEED_MEM_DEVICE), num_bytes());
    }
    is_current(mem_type) = true;
    return array;
  }
  /// The array in a memory, which alone will have the values.
  CeedScalar *write(CeedMemType mem_type, bool is_read) {
    const std::scoped_lock one_thread(mutex);
    CeedScalar *array = is_read ? read(mem_type) : allocate(mem_type);
    host.is_current = mem_type == CEED_MEM_HOST;
    on_device.is_current = mem_type == CEED_MEM_DEVICE;
    return array;
  }
};

Vector &vector_of(CeedVector vec) {
  Vector *vector = nullptr;
  chk(CeedVectorGetData(vec, &vector));
  return *vector;
}

/// Runs f(vector) for a function of a table.
template <typename F>
int with(CeedVector vec, F &&f) {
  return wall(CeedVectorReturnCeed(vec), [&] { f(vector_of(vec)); });
}

int create(CeedVector vec) {
  return wall(CeedVectorReturnCeed(vec), [&] {
    CeedSize length = 0;
    chk(CeedVectorGetLength(vec, &length));
    std::unique_ptr<Vector> vector(new Vector{Device::of(CeedVectorReturnCeed(vec)), length, {}, {}, {}});
    chk(CeedVectorSetData(vec, vector.get()));
    vector.release();
  });
}

int destroy(CeedVector vec) {
  Vector *vector = nullptr;
  CeedCallBackend(CeedVectorGetData(vec, &vector));
  delete vector;
  return CEED_ERROR_SUCCESS;
}

/// The array of `place` is now `values`, which are lent, or given away.
template <typename Owned, typename Adopt>
void replace(Place<Owned> &place, CeedScalar *current, CeedScalar *values, bool is_lent, Adopt &&adopt) {
  const bool is_own = place.owned && place.borrowed == nullptr && current == values;
  place.borrowed = is_lent ? values : nullptr;
  if (is_lent && is_own) {
    place.owned.release();
  } else if (is_lent) {
    place.owned = Owned();
  } else if (!is_own) {
    place.owned = adopt(values);
  }
}

int set_array(CeedVector vec, CeedMemType mem_type, CeedCopyMode copy_mode, CeedScalar *values) {
  return with(vec, [&](Vector &v) {
    const bool is_device = mem_type == CEED_MEM_DEVICE;
    if (copy_mode == CEED_COPY_VALUES) {
      CeedScalar *array = v.allocate(mem_type);
      if (values != array && is_device) v.device.driver().copy(array, values, v.num_bytes());
      if (values != array && !is_device) std::copy_n(values, v.length, array);
    } else if (is_device) {
      replace(v.on_device, v.on_device.owned.as<CeedScalar>(), values, copy_mode == CEED_USE_POINTER,
              [&](CeedScalar *array) { return v.device.adopt(array, v.num_bytes()); });
    } else {
      replace(v.host, v.host.owned.get(), values, copy_mode == CEED_USE_POINTER,
              [](CeedScalar *array) { return host::Array(array); });
    }
    v.host.is_current = !is_device;
    v.on_device.is_current = is_device;
  });
}

int take_array(CeedVector vec, CeedMemType mem_type, CeedScalar **values) {
  return with(vec, [&](Vector &v) {
    CeedScalar *&borrowed = mem_type == CEED_MEM_DEVICE ? v.on_device.borrowed : v.host.borrowed;
    if (borrowed != nullptr) v.read(mem_type);
    *values = std::exchange(borrowed, nullptr);
    v.host.is_current = v.on_device.is_current = false;
  });
}

int sync_array(CeedVector vec, CeedMemType mem_type) {
  return with(vec, [&](Vector &v) { v.read(mem_type); });
}

int get_array(CeedVector vec, CeedMemType mem_type, CeedScalar **values) {
  return with(vec, [&](Vector &v) { *values = v.write(mem_type, true); });
}

int get_array_read(CeedVector vec, CeedMemType mem_type, const CeedScalar **values) {
  return with(vec, [&](Vector &v) { *values = v.read(mem_type); });
}

int get_array_write(CeedVector vec, CeedMemType mem_type, CeedScalar **values) {
  return with(vec, [&](Vector &v) { *values = v.write(mem_type, false); });
}

int has_valid_array(CeedVector vec, bool *has_valid_array) {
  return with(vec, [&](const Vector &v) { *has_valid_array = v.has_values(); });
}

int has_borrowed_array(CeedVector vec, CeedMemType mem_type, bool *has_borrowed_array) {
  return with(vec, [&](const Vector &v) {
    *has_borrowed_array = (mem_type == CEED_MEM_DEVICE ? v.on_device.borrowed : v.host.borrowed) != nullptr;
  });
}

int set_value(CeedVector vec, CeedScalar value) {
  return with(vec, [&](Vector &v) {
    CeedScalar *w = v.write(CEED_MEM_DEVICE, false);
    v.device.run("hg_set_value", v.length, VectorJob{.length = v.length, .a = value, .w = w});
  });
}

/// Entries of a range.
CeedSize count(CeedSize start, CeedSize stop, CeedSize step) {
  return (stop - start + step - 1) / step;
}

int set_value_strided(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step, CeedScalar value) {
  return with(vec, [&](Vector &v) {
    const VectorJob job{.length = count(start, stop, step),
                        .start = start,
                        .step = step,
                        .a = value,
                        .w = v.write(CEED_MEM_DEVICE, true)};
    v.device.run("hg_set_value", job.length, job);
  });
}

int copy(CeedVector vec, CeedVector vec_copy) {
  return with(vec_copy, [&](Vector &to) {
    const CeedScalar *x = vector_of(vec).read(CEED_MEM_DEVICE);
    to.device.driver().copy(to.write(CEED_MEM_DEVICE, false), x, to.num_bytes());
  });
}

int copy_strided(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step, CeedVector vec_copy) {
  return with(vec_copy, [&](Vector &to) {
    const CeedScalar *x = vector_of(vec).read(CEED_MEM_DEVICE);
    const VectorJob job{
        .length = count(start, stop, step), .start = start, .step = step, .x = x, .w = to.write(CEED_MEM_DEVICE, true)};
    to.device.run("hg_copy", job.length, job);
  });
}

int scale(CeedVector x, CeedScalar alpha) {
  return with(x, [&](Vector &v) {
    v.device.run("hg_scale", v.length, VectorJob{.length = v.length, .a = alpha, .w = v.write(CEED_MEM_DEVICE, true)});
  });
}

int axpby(CeedVector y, CeedScalar alpha, CeedScalar beta, CeedVector x) {
  return with(y, [&](Vector &v) {
    const CeedScalar *from = vector_of(x).read(CEED_MEM_DEVICE);
    v.device.run("hg_axpby", v.length,
                 VectorJob{.length = v.length, .a = alpha, .b = beta, .x = from, .w = v.write(CEED_MEM_DEVICE, true)});
  });
}

int axpy(CeedVector y, CeedScalar alpha, CeedVector x) {
  return axpby(y, alpha, 1, x);
}

int pointwise_mult(CeedVector w, CeedVector x, CeedVector y) {
  return with(w, [&](Vector &v) {
    const CeedScalar *left = vector_of(x).read(CEED_MEM_DEVICE), *right = vector_of(y).read(CEED_MEM_DEVICE);
    const VectorJob job{.length = v.length, .x = left, .y = right, .w = v.write(CEED_MEM_DEVICE, false)};
    v.device.run("hg_pointwise_mult", v.length, job);
  });
}

int reciprocal(CeedVector vec) {
  return with(vec, [&](Vector &v) {
    v.device.run("hg_reciprocal", v.length,
                 VectorJob{.length = v.length, .a = CEED_EPSILON, .w = v.write(CEED_MEM_DEVICE, true)});
  });
}

int filter(CeedVector x, CeedScalar threshold) {
  return with(x, [&](Vector &v) {
    v.device.run("hg_filter", v.length,
                 VectorJob{.length = v.length, .a = threshold, .w = v.write(CEED_MEM_DEVICE, true)});
  });
}

int norm(CeedVector vec, CeedNormType type, CeedScalar *norm) {
  return with(vec, [&](Vector &v) {
    constexpr CeedSize most_blocks = 1024, of_block = CeedSize{4} * usual_threads;
    const CeedSize num_blocks = std::min(most_blocks, (v.length + of_block - 1) / of_block);
    const Buffer norms = v.device.allocate(num_blocks * sizeof(CeedScalar));
    const NormJob job{.length = v.length, .type = type, .x = v.read(CEED_MEM_DEVICE), .norms = norms.as<CeedScalar>()};
    v.device.run("hg_norm",
                 Launch{.num_blocks = static_cast<std::uint64_t>(num_blocks),
                        .num_threads = usual_threads,
                        .shared_bytes = usual_threads * sizeof(CeedScalar),
                        .has_barriers = true},
                 job);
    std::vector<CeedScalar> of_blocks(num_blocks);
    v.device.driver().copy_to_host(of_blocks.data(), norms.as<void>(), norms.num_bytes());
    CeedScalar total = 0;
    for (const CeedScalar x : of_blocks) {
      total = type != CEED_NORM_MAX ? total + x : std::isnan(total) || x <= total ? total : x;
    }
    *norm = type == CEED_NORM_2 ? std::sqrt(total) : total;
  });
}

}  // namespace

void fill_vector_ops(CeedVectorOps &ops) {
  ops = {.create = create,
         .destroy = destroy,
         .set_array = set_array,
         .take_array = take_array,
         .sync_array = sync_array,
         .get_array = get_array,
         .get_array_read = get_array_read,
         .get_array_write = get_array_write,
         .has_valid_array = has_valid_array,
         .has_borrowed_array = has_borrowed_array,
         .restore_array = nullptr,
         .restore_array_read = nullptr,
         .set_value = set_value,
         .norm = norm,
         .scale = scale,
         .axpy = axpy,
         .axpby = axpby,
         .pointwise_mult = pointwise_mult,
         .reciprocal = reciprocal,
         .filter = filter,
         .copy = copy,
         .copy_strided = copy_strided,
         .set_value_strided = set_value_strided};
}

}  // namespace hg::gpu
