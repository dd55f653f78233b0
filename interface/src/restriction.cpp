// The life of element restrictions, and applying them.
#include "restriction.hpp"

#include <algorithm>
#include <cstdlib>

#include "vector.hpp"

namespace {

/// Never destroyed: programs may still hold the sentinel when they end.
union Sentinel {
  Sentinel() : object() { object.is_sentinel = true; }
  ~Sentinel() {}
  CeedElemRestriction_private object;
};
Sentinel none;

void require_length(const CeedElemRestriction_private &r, const char *what, const CeedVector_private &vec,
                    CeedSize needed, hg::Where where = hg::Where::current()) {
  hg::require(
      vec.length >= needed, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text(
            "%s has %td entries; expected at least %td for a CeedElemRestriction with an L-vector of %td and an "
            "E-vector of %td entries",
            what, vec.length, needed, r.l_size, r.e_size);
      },
      where);
}

/// R or R^T of some blocks, which have e_size entries in the E-vector.
void apply_blocks(CeedElemRestriction_private &r, CeedInt first_block, CeedInt num_block, CeedSize e_size,
                  CeedTransposeMode t_mode, CeedVector u, CeedVector ru, hg::Where where = hg::Where::current()) {
  auto &in = hg::deref_vector(u, "Input CeedVector", where);
  auto &out = hg::deref_vector(ru, "Output CeedVector", where);
  hg::require_transpose_mode(t_mode, "CeedElemRestriction", where);
  const bool is_transpose = t_mode == CEED_TRANSPOSE;
  require_length(r, "Input CeedVector", in, is_transpose ? e_size : r.l_size, where);
  require_length(r, "Output CeedVector", out, is_transpose ? r.l_size : e_size, where);
  hg::require(u != ru, CEED_ERROR_INCOMPATIBLE,
              "CeedElemRestriction: input and output are the same vector; expected two", where);
  hg::require_readable(in, where);
  hg::require_writable(out, where);
  hg::require_values(in, "Input CeedVector", where);
  if (is_transpose) hg::require_values(out, "Output CeedVector", where);
  if (e_size > 0) hg::check(r.ops().apply(&r, first_block, num_block, t_mode, u, ru));
}

/// Another restriction that reads the tables of `r`; show_to_backend() is to follow.
hg::Ref<CeedElemRestriction_private> copy_of(CeedElemRestriction_private &r) {
  auto copy = hg::Ref<CeedElemRestriction_private>::adopt(new CeedElemRestriction_private);
  static_cast<CeedElementMap &>(*copy) = r;
  copy->ceed = r.ceed;
  copy->num_points = r.num_points;
  copy->has_backend_strides = r.has_backend_strides;
  copy->base = r.base ? r.base : hg::Ref(&r);
  return copy;
}

void drop_orientation(CeedElemRestriction_private &r) {
  if (r.num_bands == 0) return;
  r.type = CEED_RESTRICTION_STANDARD;
  r.num_bands = 0;
  r.bands = nullptr;
}

}  // namespace

namespace hg {

void show_to_backend(CeedElemRestriction_private &r) {
  const auto create = r.ops().create;
  if (create != nullptr) check(create(&r));
  r.is_known_to_backend = true;
}

}  // namespace hg

const CeedElemRestriction CEED_ELEMRESTRICTION_NONE = &none.object;
const CeedInt CEED_STRIDES_BACKEND[3] = {0, 0, 0};

CeedElemRestriction_private::~CeedElemRestriction_private() {
  if (is_known_to_backend && ops().destroy != nullptr) ops().destroy(this);
}

void CeedElemRestriction_private::check_destroyable() const {
  hg::require(num_readers == 0, CEED_ERROR_ACCESS,
              "Cannot destroy CeedElemRestriction, a process has read access to the offset data");
}

int CeedElemRestrictionCreateUnsignedCopy(CeedElemRestriction rstr, CeedElemRestriction *rstr_unsigned) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    hg::deref_restriction(rstr);
    hg::require_argument(rstr_unsigned, "rstr_unsigned (where the handle goes)");
    auto copy = copy_of(*rstr);
    if (copy->num_bands == 3) {
      const CeedSize size = copy->table_size(3 * static_cast<CeedSize>(copy->elem_size));
      auto bands = std::make_unique<CeedInt8[]>(static_cast<std::size_t>(size));
      std::transform(copy->bands, copy->bands + size, bands.get(), [](int entry) { return CeedInt8(std::abs(entry)); });
      copy->own_bands.keep(std::move(bands));
      copy->bands = copy->own_bands.data();
    } else {
      drop_orientation(*copy);
    }
    hg::show_to_backend(*copy);
    *rstr_unsigned = copy.release();
  });
}

int CeedElemRestrictionCreateUnorientedCopy(CeedElemRestriction rstr, CeedElemRestriction *rstr_unoriented) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    hg::deref_restriction(rstr);
    hg::require_argument(rstr_unoriented, "rstr_unoriented (where the handle goes)");
    auto copy = copy_of(*rstr);
    drop_orientation(*copy);
    hg::show_to_backend(*copy);
    *rstr_unoriented = copy.release();
  });
}

int CeedElemRestrictionReferenceCopy(CeedElemRestriction rstr, CeedElemRestriction *rstr_copy) {
  return hg::guard(hg::ceed_of(rstr), [&] { hg::reference_copy(rstr, rstr_copy); });
}

int CeedElemRestrictionReference(CeedElemRestriction rstr) {
  return hg::guard(hg::ceed_of(rstr), [&] { hg::reference(&hg::deref(rstr, "CeedElemRestriction")); });
}

int CeedElemRestrictionDestroy(CeedElemRestriction *rstr) {
  return hg::guard(rstr != nullptr ? hg::ceed_of(*rstr) : nullptr, [&] { hg::destroy(rstr); });
}

int CeedElemRestrictionCreateVector(CeedElemRestriction rstr, CeedVector *lvec, CeedVector *evec) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    CeedVector l = nullptr;
    if (lvec != nullptr) {
      hg::check(CeedVectorCreate(r.ceed.get(), r.l_size, &l));
      *lvec = l;
    }
    if (evec != nullptr) {
      const int code = CeedVectorCreate(r.ceed.get(), r.e_size, evec);
      if (code != CEED_ERROR_SUCCESS && lvec != nullptr) CeedVectorDestroy(lvec);
      hg::check(code);
    }
  });
}

int CeedElemRestrictionApply(CeedElemRestriction rstr, CeedTransposeMode t_mode, CeedVector u, CeedVector ru,
                             CeedRequest *) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    apply_blocks(r, 0, r.num_block(), r.e_size, t_mode, u, ru);
  });
}

int CeedElemRestrictionApplyBlock(CeedElemRestriction rstr, CeedInt block, CeedTransposeMode t_mode, CeedVector u,
                                  CeedVector ru, CeedRequest *) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    hg::require(block >= 0 && block < r.num_block(), CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedElemRestrictionApplyBlock: block is %" CeedInt_FMT "; expected one in [0, %" CeedInt_FMT ")",
                      block, r.num_block());
    });
    const CeedSize nodes = r.is_points() ? r.num_nodes(block) : static_cast<CeedSize>(r.block_size) * r.elem_size;
    apply_blocks(r, block, 1, nodes * r.num_comp, t_mode, u, ru);
  });
}

int CeedElemRestrictionApplyAtPointsInElement(CeedElemRestriction rstr, CeedInt elem, CeedTransposeMode t_mode,
                                              CeedVector u, CeedVector ru, CeedRequest *) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    hg::require(r.is_points(), CEED_ERROR_INCOMPATIBLE,
                "CeedElemRestrictionApplyAtPointsInElement: the CeedElemRestriction is not one at points");
    hg::require(elem >= 0 && elem < r.num_elem, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedElemRestrictionApplyAtPointsInElement: element is %" CeedInt_FMT
                      "; expected one in [0, %" CeedInt_FMT ")",
                      elem, r.num_elem);
    });
    apply_blocks(r, elem, 1, static_cast<CeedSize>(r.num_nodes(elem)) * r.num_comp, t_mode, u, ru);
  });
}
