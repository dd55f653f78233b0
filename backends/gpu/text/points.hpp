// What kernels share.

namespace hg::gpu {

/// The larger one; a NaN is larger than all numbers.
HG_DEVICE CeedScalar larger(CeedScalar a, CeedScalar b) {
  return a != a ? a : b <= a ? a : b;
}

/// A point's element, and the places of its values.
struct PointOfElement {
  CeedInt elem;
  CeedSize first;  ///< point of the element
  CeedInt count;   ///< points of the element
  CeedInt q;       ///< this one among them

  HG_DEVICE PointOfElement(const PointsOfElements &points, CeedSize point) {
    if (points.starts != nullptr) {
      elem = points.elem[point];
      first = points.starts[elem];
      count = static_cast<CeedInt>(points.starts[elem + 1] - first);
    } else {
      elem = static_cast<CeedInt>(point / points.num_qpts);
      first = static_cast<CeedSize>(elem) * points.num_qpts;
      count = points.num_qpts;
    }
    q = static_cast<CeedInt>(point - first);
  }
  /// Value i of a field that has `size` of them at each point.
  HG_DEVICE CeedSize place(CeedInt size, CeedInt i) const {
    return first * size + static_cast<CeedSize>(i) * count + q;
  }
};

}  // namespace hg::gpu
