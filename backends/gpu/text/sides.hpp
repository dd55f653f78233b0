// What operators at quadrature points and at points of their own share.

namespace hg::gpu {

/// Component `comp` of node n of an element in the L-vector.
HG_DEVICE CeedSize place_of(const Side &side, CeedSize elem, int elem_size, int n, int comp) {
  const CeedSize node = side.offsets != nullptr ? static_cast<CeedSize>(side.offsets[elem * elem_size + n])
                                                : n * side.node_stride + elem * side.elem_stride;
  return node + comp * side.comp_stride;
}

}  // namespace hg::gpu
