#include "restriction.hpp"

#include <algorithm>

namespace hg::ref {

namespace {

/// Where one element finds its nodes and its orientation.
class Element {
 public:
  Element(const CeedElementMap &map, CeedInt e) : map_(map), step_(map.block_size), comp_stride_(map.comp_stride) {
    const CeedSize block = e / map.block_size, in_block = e % map.block_size;
    if (map.type == CEED_RESTRICTION_POINTS) {
      nodes_ = map.offsets + map.offsets[e];
      scale_ = map.num_comp;
    } else if (map.type == CEED_RESTRICTION_STRIDED) {
      start_ = static_cast<CeedSize>(e) * map.strides[2];
      comp_stride_ = map.strides[1];
    } else {
      nodes_ = map.offsets + block * map.elem_size * map.block_size + in_block;
      if (map.num_bands > 0) bands_ = map.bands + block * map.elem_size * map.num_bands * map.block_size + in_block;
    }
  }

  /// Place in the L-vector of component c of node n.
  CeedSize entry(CeedInt n, CeedInt c) const {
    const CeedSize node = nodes_ != nullptr ? static_cast<CeedSize>(nodes_[static_cast<CeedSize>(n) * step_]) * scale_
                                            : start_ + static_cast<CeedSize>(n) * map_.strides[0];
    return node + static_cast<CeedSize>(c) * comp_stride_;
  }

  /// Calls f(m, T_e(n,m)) for the nodes m in the bands of T_e.
  template <typename F>
  void for_row(CeedInt n, F &&f) const {
    const CeedSize num_bands = map_.num_bands;
    for (CeedInt k = 0; k < num_bands; k++) {
      const CeedInt m = n + k - map_.num_bands / 2;
      if (m >= 0 && m < map_.elem_size) f(m, bands_[(n * num_bands + k) * step_]);
    }
  }

 private:
  const CeedElementMap &map_;
  CeedInt step_;  ///< between entries of the element in a table
  CeedSize comp_stride_;
  CeedSize start_ = 0;
  CeedInt scale_ = 1;
  const CeedInt *nodes_ = nullptr;  ///< NULL: strided
  const CeedInt8 *bands_ = nullptr;
};

/// Calls f(i, n, c) for component c of each node n of an element, the value i of its array.
template <typename F>
void for_each_value(CeedInt num_comp, CeedInt nodes, CeedInt stride, F &&f) {
  CeedSize i = 0;
  for (CeedInt c = 0; c < num_comp; c++) {
    for (CeedInt n = 0; n < nodes; n++, i += stride) f(i, n, c);
  }
}

}  // namespace

void ElementMap::gather(CeedInt e, const CeedScalar *l, CeedScalar *values, CeedInt stride) const {
  const Element element(*map_, e);
  if (map_->num_bands == 0) {
    for_each_value(map_->num_comp, num_nodes(e), stride,
                   [&](CeedSize i, CeedInt n, CeedInt c) { values[i] = l[element.entry(n, c)]; });
    return;
  }
  for_each_value(map_->num_comp, num_nodes(e), stride, [&](CeedSize i, CeedInt n, CeedInt c) {
    values[i] = 0;
    element.for_row(n, [&](CeedInt m, CeedScalar t) { values[i] += t * l[element.entry(m, c)]; });
  });
}

void ElementMap::scatter_add(CeedInt e, const CeedScalar *values, CeedScalar *l, CeedInt stride) const {
  const Element element(*map_, e);
  if (map_->num_bands == 0) {
    for_each_value(map_->num_comp, num_nodes(e), stride,
                   [&](CeedSize i, CeedInt n, CeedInt c) { l[element.entry(n, c)] += values[i]; });
    return;
  }
  for_each_value(map_->num_comp, num_nodes(e), stride, [&](CeedSize i, CeedInt n, CeedInt c) {
    element.for_row(n, [&](CeedInt m, CeedScalar t) { l[element.entry(m, c)] += t * values[i]; });
  });
}

namespace {

/// Calls f(input array, output array). The output's entries that f does not write keep their values.
template <typename F>
int with_arrays(CeedTransposeMode t_mode, CeedVector u, CeedVector ru, F &&f) {
  const CeedScalar *input = nullptr;
  CeedScalar *output = nullptr;
  CeedCallBackend(CeedVectorGetArrayRead(u, CEED_MEM_HOST, &input));
  int code = t_mode == CEED_TRANSPOSE ? CeedVectorGetArray(ru, CEED_MEM_HOST, &output)
                                      : CeedVectorGetArrayWrite(ru, CEED_MEM_HOST, &output);
  if (code == CEED_ERROR_SUCCESS) {
    f(input, output);
    code = CeedVectorRestoreArray(ru, &output);
  }
  CeedCallBackend(CeedVectorRestoreArrayRead(u, &input));
  CeedCallBackend(code);
  return CEED_ERROR_SUCCESS;
}

int apply(CeedElemRestriction rstr, CeedInt first_block, CeedInt num_block, CeedTransposeMode t_mode, CeedVector u,
          CeedVector ru) {
  ElementMap map;
  CeedCallBackend(ElementMap::create(rstr, &map));
  const CeedInt B = map.facts().block_size, num_elem = map.facts().num_elem;
  return with_arrays(t_mode, u, ru, [&](const CeedScalar *input, CeedScalar *output) {
    for (CeedInt block = first_block; block < first_block + num_block; block++) {
      const CeedSize start = map.first_entry(block) - map.first_entry(first_block);
      for (CeedInt j = 0; j < B; j++) {
        const CeedInt e = block * B + j;
        if (t_mode == CEED_NOTRANSPOSE) {
          map.gather(std::min(e, num_elem - 1), input, output + start + j, B);
        } else if (e < num_elem) {
          map.scatter_add(e, input + start + j, output, B);
        }
      }
    }
  });
}

}  // namespace

void fill_restriction_ops(CeedElemRestrictionOps &ops) {
  ops = {};
  ops.apply = apply;
}

}  // namespace hg::ref
