/// Restrictions and bases: the parent's, with tables that must stay as they are.
#include <algorithm>

#include "state.hpp"

namespace hg::memcheck {

namespace {

/// FNV-1a over bytes.
std::uint64_t hash(std::uint64_t seed, const void *data, std::size_t size) {
  const auto *bytes = static_cast<const unsigned char *>(data);
  for (std::size_t i = 0; i < size; i++) seed = (seed ^ bytes[i]) * 0x100000001b3u;
  return seed;
}

std::uint64_t hash_of(const CeedElementMap &map) {
  std::uint64_t value = 0xcbf29ce484222325u;
  const CeedSize padded = (static_cast<CeedSize>(map.num_elem) + map.block_size - 1) / map.block_size * map.block_size;
  if (map.offsets != nullptr) {
    const bool is_points = map.type == CEED_RESTRICTION_POINTS;
    const CeedSize count = is_points ? map.offsets[map.num_elem] : padded * map.elem_size;
    value = hash(value, map.offsets, static_cast<std::size_t>(std::max<CeedSize>(count, 0)) * sizeof *map.offsets);
  }
  if (map.bands != nullptr) {
    value =
        hash(value, map.bands, static_cast<std::size_t>(padded * map.elem_size * map.num_bands) * sizeof *map.bands);
  }
  return value;
}

int create(CeedElemRestriction rstr) {
  if (parent().restriction.create != nullptr) CeedCallBackend(parent().restriction.create(rstr));
  const CeedElementMap *map = nullptr;
  CeedCallBackend(CeedElemRestrictionGetElementMap(rstr, &map));
  State &state = state_of(CeedElemRestrictionReturnCeed(rstr));
  const std::lock_guard lock(state.mutex);
  state.restrictions[rstr] = hash_of(*map);
  return CEED_ERROR_SUCCESS;
}

/// Offsets that were lent may be gone by now, so they are not looked at again.
int destroy(CeedElemRestriction rstr) {
  State &state = state_of(CeedElemRestrictionReturnCeed(rstr));
  {
    const std::lock_guard lock(state.mutex);
    state.restrictions.erase(rstr);
  }
  if (parent().restriction.destroy != nullptr) return parent().restriction.destroy(rstr);
  return CEED_ERROR_SUCCESS;
}

int apply(CeedElemRestriction rstr, CeedInt first_block, CeedInt num_block, CeedTransposeMode t_mode, CeedVector u,
          CeedVector ru) {
  CeedCallBackend(check_restriction(rstr));
  const InParent in_parent;
  return parent().restriction.apply(rstr, first_block, num_block, t_mode, u, ru);
}

int apply_basis(CeedBasis basis, CeedInt num_elem, CeedTransposeMode t_mode, CeedEvalMode eval_mode, CeedVector u,
                CeedVector v, bool add) {
  const InParent in_parent;
  return parent().basis.apply(basis, num_elem, t_mode, eval_mode, u, v, add);
}

int apply_basis_at_points(CeedBasis basis, CeedInt num_elem, const CeedInt *num_points, CeedTransposeMode t_mode,
                          CeedEvalMode eval_mode, CeedVector x_ref, CeedVector u, CeedVector v, bool add) {
  const InParent in_parent;
  return parent().basis.apply_at_points(basis, num_elem, num_points, t_mode, eval_mode, x_ref, u, v, add);
}

}  // namespace

int check_restriction(CeedElemRestriction rstr) {
  if (rstr == CEED_ELEMRESTRICTION_NONE) return CEED_ERROR_SUCCESS;
  const CeedElementMap *map = nullptr;
  CeedCallBackend(CeedElemRestrictionGetElementMap(rstr, &map));
  State &state = state_of(CeedElemRestrictionReturnCeed(rstr));
  bool is_as_made = true;
  {
    const std::lock_guard lock(state.mutex);
    const auto made = state.restrictions.find(rstr);
    is_as_made = made == state.restrictions.end() || made->second == hash_of(*map);
  }
  CeedCheck(is_as_made, CeedElemRestrictionReturnCeed(rstr), CEED_ERROR_BACKEND,
            "CeedElemRestriction offsets or orientations changed since it was created; they may be read only");
  return CEED_ERROR_SUCCESS;
}

void fill_restriction_ops(CeedElemRestrictionOps &ops) {
  ops.create = create;
  ops.destroy = destroy;
  ops.apply = apply;
}

void fill_basis_ops(CeedBasisOps &ops) {
  ops.apply = apply_basis;
  ops.apply_at_points = apply_basis_at_points;
}

}  // namespace hg::memcheck
