#include "restriction.hpp"

namespace hg::ref {

int ElementMap::create(CeedElemRestriction rstr, ElementMap *map) {
  *map = {};
  bool is_strided = false;
  CeedCallBackend(CeedElemRestrictionGetNumElements(rstr, &map->num_elem_));
  CeedCallBackend(CeedElemRestrictionGetElementSize(rstr, &map->elem_size_));
  CeedCallBackend(CeedElemRestrictionGetNumComponents(rstr, &map->num_comp_));
  CeedCallBackend(CeedElemRestrictionIsStrided(rstr, &is_strided));
  CeedCallBackend(CeedElemRestrictionIsAtPoints(rstr, &map->is_points_));
  if (is_strided) {
    CeedInt strides[3];
    CeedCallBackend(CeedElemRestrictionGetLLayout(rstr, strides));
    map->node_stride_ = strides[0];
    map->comp_stride_ = strides[1];
    map->elem_stride_ = strides[2];
    return CEED_ERROR_SUCCESS;
  }
  CeedCallBackend(CeedElemRestrictionGetCompStride(rstr, &map->comp_stride_));
  // The offsets stay where they are for the life of the restriction, so their address outlives the access.
  const CeedInt *offsets = nullptr;
  CeedCallBackend(CeedElemRestrictionGetOffsets(rstr, CEED_MEM_HOST, &offsets));
  map->offsets_ = offsets;
  CeedCallBackend(CeedElemRestrictionRestoreOffsets(rstr, &offsets));
  return CEED_ERROR_SUCCESS;
}

void ElementMap::gather(CeedInt e, const CeedScalar *l, CeedScalar *values) const {
  const CeedInt nodes = num_nodes(e);
  for (CeedInt c = 0; c < num_comp_; c++) {
    for (CeedInt n = 0; n < nodes; n++) values[static_cast<CeedSize>(c) * nodes + n] = l[entry(e, n, c)];
  }
}

void ElementMap::scatter_add(CeedInt e, const CeedScalar *values, CeedScalar *l) const {
  const CeedInt nodes = num_nodes(e);
  for (CeedInt c = 0; c < num_comp_; c++) {
    for (CeedInt n = 0; n < nodes; n++) l[entry(e, n, c)] += values[static_cast<CeedSize>(c) * nodes + n];
  }
}

namespace {

/// Calls f(input array, output array). The output's entries that f does not write keep their values.
template <typename F>
int with_arrays(CeedTransposeMode t_mode, CeedVector u, CeedVector ru, F &&f) {
  const CeedScalar *input = nullptr;
  CeedScalar *output = nullptr;
  CeedCallBackend(CeedVectorGetArrayRead(u, CEED_MEM_HOST, &input));
  const int code = t_mode == CEED_TRANSPOSE ? CeedVectorGetArray(ru, CEED_MEM_HOST, &output)
                                            : CeedVectorGetArrayWrite(ru, CEED_MEM_HOST, &output);
  if (code == CEED_ERROR_SUCCESS) {
    f(input, output);
    CeedCallBackend(CeedVectorRestoreArray(ru, &output));
  }
  CeedCallBackend(CeedVectorRestoreArrayRead(u, &input));
  CeedCallBackend(code);
  return CEED_ERROR_SUCCESS;
}

int apply(CeedElemRestriction rstr, CeedTransposeMode t_mode, CeedVector u, CeedVector ru) {
  ElementMap map;
  CeedCallBackend(ElementMap::create(rstr, &map));
  return with_arrays(t_mode, u, ru, [&](const CeedScalar *input, CeedScalar *output) {
    for (CeedInt e = 0; e < map.num_elem(); e++) {
      if (t_mode == CEED_TRANSPOSE) {
        map.scatter_add(e, input + map.first_entry(e), output);
      } else {
        map.gather(e, input, output + map.first_entry(e));
      }
    }
  });
}

int apply_at_points_in_element(CeedElemRestriction rstr, CeedInt elem, CeedTransposeMode t_mode, CeedVector u,
                               CeedVector ru) {
  ElementMap map;
  CeedCallBackend(ElementMap::create(rstr, &map));
  return with_arrays(t_mode, u, ru, [&](const CeedScalar *input, CeedScalar *output) {
    if (t_mode == CEED_TRANSPOSE) {
      map.scatter_add(elem, input, output);
    } else {
      map.gather(elem, input, output);
    }
  });
}

}  // namespace

void fill_restriction_ops(CeedElemRestrictionOps &ops) {
  ops = {};
  ops.apply = apply;
  ops.apply_at_points_in_element = apply_at_points_in_element;
}

}  // namespace hg::ref
