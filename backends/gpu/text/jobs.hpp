/// What kernels get: each has one struct as its argument. Pointers are to memory on the device.
#ifndef HG_GPU_JOBS
#define HG_GPU_JOBS
#ifndef HG_GPU_TEXT  // read by the host, too
#include <ceed/types.h>
#endif

namespace hg::gpu {

/// Entries start + i*step, i = 0 ... length - 1, of vectors.
struct VectorJob {
  CeedSize length = 0, start = 0, step = 1;
  CeedScalar a = 0, b = 0;
  const CeedScalar *x = nullptr, *y = nullptr;
  CeedScalar *w = nullptr;
};

/// Block b puts the norm of its part of x in norms[b].
struct NormJob {
  CeedSize length;
  CeedInt type;  ///< CeedNormType
  const CeedScalar *x;
  CeedScalar *norms;
};

/// Node i of all elements, one element after another. Component c of it is entry place[i] + c*comp_stride of the
/// L-vector and entry[i] + c*step[i] of the E-vector.
struct RestrictionJob {
  CeedSize num_nodes = 0;
  CeedInt num_comp = 0, comp_stride = 0;
  const CeedSize *place = nullptr, *entry = nullptr;
  const CeedInt *step = nullptr;
  CeedInt elem_size = 0, num_bands = 0;  ///< orientation of an element, see CeedElementMap
  const CeedInt8 *bands = nullptr;       ///< num_bands for each node
  /// nodes[rows[r]] ... nodes[rows[r+1] - 1] have one place, the r-th.
  const CeedSize *rows = nullptr, *nodes = nullptr;
  CeedSize num_rows = 0;
  CeedInt comp = 0;  ///< that is scattered
  const CeedScalar *u = nullptr;
  CeedScalar *v = nullptr;
};

/// Points of elements: `num_qpts` in each; or, where there are `starts`, those from starts[e] on, of element
/// elem[point].
struct PointsOfElements {
  CeedSize num_points = 0;
  CeedInt num_qpts = 0;
  const CeedSize *starts = nullptr;
  const CeedInt *elem = nullptr;
};

/// Values and derivatives: number g of component c at point q of an element is Σ_n v_n Π_d T_(g,d)(q_d, n_d), where T
/// is a Q by P matrix: `interp`, or `derivative` for d = g; or the row of a point in `table`, see PointTableJob. Where
/// there is one direction, for bases that are no tensor products, matrix g follows matrix g-1.
struct BasisJob {
  PointsOfElements points;
  CeedInt num_elem = 0, num_comp = 0, num_values = 0, num_directions = 0, P = 0, Q = 0, num_nodes = 0;
  bool is_tensor = false, is_derivative = false, add = false;
  const CeedScalar *interp = nullptr, *derivative = nullptr, *table = nullptr;
  const CeedScalar *u = nullptr;
  CeedScalar *v = nullptr;
};

/// Basis functions of one direction at points: table[((point*dim + d)*2 + k)*P + n] is function n (k = 0) or its
/// derivative (k = 1) at coordinate d of a point, Σ_j coefficients[j*P + n] T_j(x_d).
struct PointTableJob {
  PointsOfElements points;
  CeedInt dim, P, num_coefficients;
  const CeedScalar *coefficients, *x_ref;
  CeedScalar *table;
};

/// Field i of a QFunction, inputs[i] and outputs[i], has its values element by element, component by component, the
/// point fastest.
struct QFunctionJob {
  PointsOfElements points;
  const CeedScalar *const *inputs;
  CeedScalar *const *outputs;
  void *context;
  int *failed;  ///< what the function returned, where that was not 0; NULL: it returns nothing else
};

/// A field of `size` values at each of `count` points from `first` on, and its copy for a kernel of the user's: value c
/// of the i-th of them is entry c*count + i.
struct LayoutJob {
  PointsOfElements points;
  CeedSize first = 0, count = 0;
  CeedInt size = 0;
  bool is_to_user = true;
  const CeedScalar *from = nullptr;
  CeedScalar *to = nullptr;
};

/// An L-vector and the way to it: offsets of nodes, as restrictions have them, or else strides. At points the numbers
/// of points, with the starts of the elements before them: those of the coordinates, for all that is stored at points.
struct Side {
  enum Access : CeedSize {
    add_shared,  ///< other threads may add to the same entries
    add_own,     ///< nobody else does
    set,         ///< nobody else does, and there are no values yet
  };
  CeedScalar *values = nullptr;
  const CeedInt *offsets = nullptr;
  CeedSize node_stride = 0, comp_stride = 0, elem_stride = 0;
  Access access = add_shared;
};

/// What a whole operator gets, beside its sides and the numbers that are told with each call.
struct OperatorFacts {
  CeedSize num_elem = 0;
  const CeedScalar *tables = nullptr;  ///< numbers that are too many to be told with each call
  void *context = nullptr;
  int *failed = nullptr;            ///< see QFunctionJob
  Side points{};                    ///< at points: coordinates
  const CeedInt *cells = nullptr;   ///< at points: those that have any; the first of a warp has most steps
  CeedSize num_cells = 0;           ///< of them
  CeedScalar *entries = nullptr;    ///< assembly: what is written
};
template <int num_sources, int num_sinks, int num_numbers>
struct OperatorJob {
  OperatorFacts facts;
  Side sources[num_sources];
  Side sinks[num_sinks];
  CeedScalar numbers[num_numbers];
};

}  // namespace hg::gpu
#endif
