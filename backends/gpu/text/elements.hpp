// Operators at quadrature points, as blocks of threads work on `elems` elements each. Before this come sides.hpp and
//   elems, threads    elements and threads of a block
// All arrays are in shared memory, element by element, and are filled by one phase and read by a later one; between two
// phases there is a barrier. In a phase each thread takes lines, points or nodes of any element.

namespace hg::gpu {

/// n0 x n1 x n2 numbers for each component, the first index fastest. Rows are padded to odd lengths, so that threads
/// whose rows follow each other begin in different banks of memory.
template <int n0, int n1, int n2, int num_comp>
struct Shape {
  static constexpr int row = n0 | 1, plane = row * n1, comp = plane * n2, size = comp * num_comp;
  static constexpr int count = n0 * n1 * n2, components = num_comp;
  static constexpr int length(int d) { return d == 0 ? n0 : d == 1 ? n1 : n2; }
  static constexpr int step(int d) { return d == 0 ? 1 : d == 1 ? row : plane; }
  /// Number n of a component.
  HG_DEVICE static constexpr int place(int n) { return row == n0 ? n : n % n0 + row * (n / n0); }
};

/// out (+)= B in along direction d, B of M rows and N columns, or of N rows and M columns where its transpose is meant.
/// A line for each thread, 2MN flops and N + M numbers from and to shared memory.
template <int d, bool is_transpose, bool add, typename In, typename Out>
HG_DEVICE void contract(const CeedScalar *B, int count, SharedArray in, SharedArray out) {
  constexpr int N = In::length(d), M = Out::length(d), first = d == 0 ? 1 : 0, second = d == 2 ? 1 : 2;
  constexpr int n_first = In::length(first), n_second = In::length(second), lines = n_first * n_second;
  constexpr int of_element = lines * In::components;
  HG_ROLLED for (int i = thread(); i < count * of_element; i += threads) {
    const int i_first = i % n_first, i_second = i / n_first % n_second, comp = i / lines % In::components;
    const int elem = i / of_element;
    const int from = elem * In::size + comp * In::comp + i_first * In::step(first) + i_second * In::step(second);
    const int to = elem * Out::size + comp * Out::comp + i_first * Out::step(first) + i_second * Out::step(second);
    CeedScalar line[N];
    HG_UNROLL for (int n = 0; n < N; n++) line[n] = in[from + n * In::step(d)];
    HG_UNROLL for (int m = 0; m < M; m++) {
      CeedScalar sum = 0;
      HG_UNROLL for (int n = 0; n < N; n++) sum += B[is_transpose ? n * M + m : m * N + n] * line[n];
      if (add) {
        out[to + m * Out::step(d)] += sum;
      } else {
        out[to + m * Out::step(d)] = sum;
      }
    }
  }
}

/// out (+)= B in for a matrix that is no product, a number of a component for each thread.
template <bool is_transpose, bool add, typename In, typename Out>
HG_DEVICE void multiply(const CeedScalar *B, int count, SharedArray in, SharedArray out) {
  constexpr int N = In::count, M = Out::count, of_element = M * In::components;
  HG_ROLLED for (int i = thread(); i < count * of_element; i += threads) {
    const int m = i % M, comp = i / M % In::components, elem = i / of_element;
    const int from = elem * In::size + comp * In::comp, to = elem * Out::size + comp * Out::comp + Out::place(m);
    CeedScalar sum = 0;
    for (int n = 0; n < N; n++) sum += B[is_transpose ? n * M + m : m * N + n] * in[from + In::place(n)];
    if (add) {
      out[to] += sum;
    } else {
      out[to] = sum;
    }
  }
}

/// Calls visit(entry of the L-vector, place in shared memory) for the nodes of the elements from `first` on.
/// `comp_first`: threads that follow each other take components of one node.
template <bool comp_first, typename Nodes, typename Visit>
HG_DEVICE void for_nodes(const Side &side, CeedSize first, int count, Visit &&visit) {
  constexpr int nc = Nodes::components, of_element = Nodes::count * nc;
  HG_ROLLED for (int i = thread(); i < count * of_element; i += threads) {
    const int elem = i / of_element, rest = i % of_element;
    const int n = comp_first ? rest / nc : rest % Nodes::count, comp = comp_first ? rest % nc : rest / Nodes::count;
    visit(side.values[place_of(side, first + elem, Nodes::count, n, comp)],
          elem * Nodes::size + comp * Nodes::comp + Nodes::place(n));
  }
}
/// Gathers them.
template <bool comp_first, typename Nodes>
HG_DEVICE void read_nodes(const Side &side, CeedSize first, int count, SharedArray nodes) {
  for_nodes<comp_first, Nodes>(side, first, count, [&](const CeedScalar &entry, int place) { nodes[place] = entry; });
}
/// Adds them to the L-vector.
template <bool comp_first, typename Nodes>
HG_DEVICE void add_nodes(const Side &side, CeedSize first, int count, SharedArray nodes) {
  for_nodes<comp_first, Nodes>(side, first, count,
                               [&](CeedScalar &entry, int place) { atomic_add(&entry, nodes[place]); });
}

/// sum += array
template <typename Nodes>
HG_DEVICE void add_array(int count, SharedArray array, SharedArray sum) {
  HG_ROLLED for (int i = thread(); i < count * Nodes::size; i += threads) {
    const int rest = i % Nodes::row;
    if (rest < Nodes::length(0)) sum[i] += array[i];
  }
}

/// Values of a field at point q of an element of the block: `num_values` arrays, each with all components.
template <int num_values, typename Points>
HG_DEVICE void read_values(SharedArray array, int elem, int q, CeedScalar *values) {
  HG_UNROLL for (int g = 0; g < num_values; g++) {
    HG_UNROLL for (int comp = 0; comp < Points::components; comp++) {
      values[g * Points::components + comp] =
          array[(g * elems + elem) * Points::size + comp * Points::comp + Points::place(q)];
    }
  }
}
template <int num_values, typename Points>
HG_DEVICE void write_values(const CeedScalar *values, int elem, int q, SharedArray array) {
  HG_UNROLL for (int g = 0; g < num_values; g++) {
    HG_UNROLL for (int comp = 0; comp < Points::components; comp++) {
      array[(g * elems + elem) * Points::size + comp * Points::comp + Points::place(q)] =
          values[g * Points::components + comp];
    }
  }
}

/// What a thread does for a column of an element's points along z: derivatives along it, and their transpose, need no
/// array of their own. Place m of component c is line[c*Q + m].
template <typename Points>
HG_DEVICE void read_column(SharedArray array, int elem, int xy, CeedScalar *line) {
  constexpr int Q = Points::length(2);
  HG_UNROLL for (int c = 0; c < Points::components; c++) {
    HG_UNROLL for (int m = 0; m < Q; m++) {
      line[c * Q + m] = array[elem * Points::size + c * Points::comp + Points::place(xy) + m * Points::plane];
    }
  }
}
template <typename Points>
HG_DEVICE void write_column(const CeedScalar *line, int elem, int xy, SharedArray array) {
  constexpr int Q = Points::length(2);
  HG_UNROLL for (int c = 0; c < Points::components; c++) {
    HG_UNROLL for (int m = 0; m < Q; m++) {
      array[elem * Points::size + c * Points::comp + Points::place(xy) + m * Points::plane] = line[c * Q + m];
    }
  }
}
/// Derivatives at point z of the column; D: of its Q points' functions at these.
template <int Q, int num_comp>
HG_DEVICE void derive_column(const CeedScalar *D, const CeedScalar *line, int z, CeedScalar *derivative) {
  HG_UNROLL for (int c = 0; c < num_comp; c++) {
    derivative[c] = 0;
    HG_UNROLL for (int m = 0; m < Q; m++) derivative[c] += D[z * Q + m] * line[c * Q + m];
  }
}
/// The same back, from point z to all of the column.
template <int Q, int num_comp>
HG_DEVICE void integrate_column(const CeedScalar *D, const CeedScalar *flux, int z, CeedScalar *line) {
  HG_UNROLL for (int c = 0; c < num_comp; c++) {
    HG_UNROLL for (int m = 0; m < Q; m++) line[c * Q + m] += D[z * Q + m] * flux[c];
  }
}

/// What is stored at the points: (point, component, element), the point fastest.
template <int num_comp, int num_qpts>
HG_DEVICE void read_stored(const Side &side, CeedSize elem, int q, CeedScalar *values) {
  HG_UNROLL for (int c = 0; c < num_comp; c++) values[c] = side.values[(elem * num_comp + c) * num_qpts + q];
}
template <int num_comp, int num_qpts>
HG_DEVICE void add_stored(const Side &side, CeedSize elem, int q, const CeedScalar *values) {
  HG_UNROLL for (int c = 0; c < num_comp; c++) side.values[(elem * num_comp + c) * num_qpts + q] += values[c];
}
/// The same where it lies otherwise; entries may be shared.
template <int num_comp, int num_qpts>
HG_DEVICE void read_scattered(const Side &side, CeedSize elem, int q, CeedScalar *values) {
  HG_UNROLL for (int c = 0; c < num_comp; c++) values[c] = side.values[place_of(side, elem, num_qpts, q, c)];
}
template <int num_comp, int num_qpts>
HG_DEVICE void add_scattered(const Side &side, CeedSize elem, int q, const CeedScalar *values) {
  HG_UNROLL for (int c = 0; c < num_comp; c++) {
    atomic_add(&side.values[place_of(side, elem, num_qpts, q, c)], values[c]);
  }
}

/// Asks for what is stored for the elements of the block, which is wanted only after they were evaluated.
template <int of_element>
HG_DEVICE void ask_for(const Side &side, CeedSize first, int count) {
  constexpr int line = 128 / sizeof(CeedScalar);
  for (int i = thread() * line; i < count * of_element; i += threads * line) {
    prefetch(side.values + first * of_element + i);
  }
}

}  // namespace hg::gpu
