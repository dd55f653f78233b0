// Operators at points of the elements' own, as blocks of threads work on groups of cells. Before this come
//   sides.hpp, and
//   cells, threads    most cells, and threads, of a block
// In shared memory are the coefficients of the group's cells; then for each point, a thread for each of them, the basis
// functions of its coordinates and what its QFunction gives; then each thread sums what the points of a cell give to a
// line of its nodes.

namespace hg::gpu {

/// Numbers for each point or cell are in shared memory one point or cell after another, in pairs, an odd number of
/// them: threads at neighbouring points, and at neighbouring numbers, are in different banks, and two numbers come at
/// once.
HG_DEVICE constexpr int odd_pairs(int size) {
  return 2 * ((size + 1) / 2 | 1);
}

/// Nodes of a cell: P in each of dim directions, lines along the first one after another, components fastest.
template <int dim, int P, int num_comp>
struct Cell {
  static constexpr int lines = dim == 3 ? P * P : dim == 2 ? P : 1;
  static constexpr int count = lines * P, components = num_comp;
  static constexpr int line = (P * num_comp + 1) / 2 * 2, size = odd_pairs(lines * line);
};

/// Functions of a basis in each direction at one point, and their derivatives: Σ_k coefficients[k*P + n] T_k(x).
template <int dim, int P>
struct Functions {
  CeedScalar value[dim][P], derivative[dim][P];

  /// T_(k+1) = 2 x T_k - T_(k-1)
  template <int num_coefficients>
  HG_DEVICE void evaluate(const CeedScalar *coefficients, const CeedScalar *x) {
    HG_UNROLL for (int d = 0; d < dim; d++) {
      CeedScalar t = 1, dt = 0, t_last = 0, dt_last = 0;
      HG_UNROLL for (int n = 0; n < P; n++) value[d][n] = derivative[d][n] = 0;
      HG_UNROLL for (int k = 0; k < num_coefficients; k++) {
        HG_UNROLL for (int n = 0; n < P; n++) {
          value[d][n] += coefficients[k * P + n] * t;
          derivative[d][n] += coefficients[k * P + n] * dt;
        }
        const CeedScalar two = k == 0 ? 1 : 2;  // T_1 = x T_0
        const CeedScalar t_next = two * x[d] * t - t_last, dt_next = two * (t + x[d] * dt) - dt_last;
        t_last = t;
        t = t_next;
        dt_last = dt;
        dt = dt_next;
      }
    }
  }
  HG_DEVICE void write(SharedArray array, int lane) const {
    HG_UNROLL for (int d = 0; d < dim; d++) {
      HG_UNROLL for (int n = 0; n < P; n++) {
        write_pair(array, lane * odd_pairs(2 * dim * P) + (d * P + n) * 2, {value[d][n], derivative[d][n]});
      }
    }
  }
};

/// The nodes of the cells from `first` on, `of_cell` numbers apart.
template <typename Cell, int of_cell>
HG_DEVICE void read_cells(const Side &side, CeedSize first, int count, SharedArray nodes) {
  HG_ROLLED for (int i = thread(); i < count * Cell::lines * Cell::line; i += threads) {
    const int cell = i / (Cell::lines * Cell::line), rest = i % (Cell::lines * Cell::line);
    const int in_line = rest % Cell::line,
              n = rest / Cell::line * (Cell::count / Cell::lines) + in_line / Cell::components;
    CeedScalar value = 0;  // what fills up a line
    if (in_line < Cell::count / Cell::lines * Cell::components) {
      value = side.values[place_of(side, first + cell, Cell::count, n, in_line % Cell::components)];
    }
    nodes[cell * of_cell + rest] = value;
  }
}

/// Values, and derivatives (direction by direction), of all components at one point; either may be left out. About
/// P^3 + P^2 + P products for values, twice that with derivatives, for each component.
template <int dim, int P, int num_comp, bool with_values, bool with_derivatives>
HG_DEVICE void evaluate_point(const Functions<dim, P> &at, SharedArray nodes, CeedScalar *values,
                              CeedScalar *derivatives) {
  using Nodes = Cell<dim, P, num_comp>;
  constexpr int P_y = dim > 1 ? P : 1, P_z = dim > 2 ? P : 1, nc = num_comp, last = dim - 1, second = dim > 1;
  CeedScalar sums[4][nc];  // values, and derivatives along x, y and z
  HG_UNROLL for (int c = 0; c < nc; c++) sums[0][c] = sums[1][c] = sums[2][c] = sums[3][c] = 0;
  HG_UNROLL for (int z = 0; z < P_z; z++) {
    CeedScalar plane[3][nc];
    HG_UNROLL for (int c = 0; c < nc; c++) plane[0][c] = plane[1][c] = plane[2][c] = 0;
    HG_UNROLL for (int y = 0; y < P_y; y++) {
      CeedScalar u[Nodes::line];
      HG_UNROLL for (int i = 0; i < Nodes::line; i += 2) {
        const Pair two = read_pair(nodes, (z * P_y + y) * Nodes::line + i);
        u[i] = two.first;
        u[i + 1] = two.second;
      }
      HG_UNROLL for (int c = 0; c < nc; c++) {
        CeedScalar value = 0, slope = 0;
        HG_UNROLL for (int x = 0; x < P; x++) {
          value += at.value[0][x] * u[x * nc + c];
          if (with_derivatives) slope += at.derivative[0][x] * u[x * nc + c];
        }
        plane[0][c] += dim > 1 ? at.value[second][y] * value : value;
        if (with_derivatives) plane[1][c] += dim > 1 ? at.value[second][y] * slope : slope;
        if (with_derivatives && dim > 1) plane[2][c] += at.derivative[second][y] * value;
      }
    }
    HG_UNROLL for (int c = 0; c < nc; c++) {
      HG_UNROLL for (int g = 0; g < 3; g++) {
        if (g > 0 && (!with_derivatives || g > dim)) continue;
        sums[g][c] += dim > 2 ? at.value[last][z] * plane[g][c] : plane[g][c];
      }
      if (with_derivatives && dim > 2) sums[3][c] += at.derivative[last][z] * plane[0][c];
    }
  }
  HG_UNROLL for (int c = 0; c < nc; c++) {
    if (with_values) values[c] = sums[0][c];
    HG_UNROLL for (int g = 0; g < dim; g++) {
      if (with_derivatives) derivatives[g * nc + c] = sums[1 + g][c];
    }
  }
}

/// What is stored at points, component fastest.
template <int num_comp>
HG_DEVICE void read_point(const Side &side, CeedSize point, CeedScalar *values) {
  const CeedScalar *from = side.values + static_cast<CeedSize>(side.offsets[point]) * num_comp;
  HG_UNROLL for (int c = 0; c < num_comp; c++) values[c] = from[c];
}
template <int num_comp>
HG_DEVICE void write_point(const Side &side, CeedSize point, const CeedScalar *values) {
  CeedScalar *to = side.values + static_cast<CeedSize>(side.offsets[point]) * num_comp;
  HG_UNROLL for (int c = 0; c < num_comp; c++) {
    if (side.access == Side::set) {
      to[c] = values[c];
    } else if (side.access == Side::add_own) {
      to[c] += values[c];
    } else {
      atomic_add(&to[c], values[c]);
    }
  }
}

/// What a QFunction gives for a point, to shared memory; and back.
template <int size>
HG_DEVICE void write_flux(const CeedScalar *values, SharedArray array, int lane) {
  HG_UNROLL for (int i = 0; i < size; i += 2) {
    write_pair(array, lane * odd_pairs(size) + i, {values[i], i + 1 < size ? values[i + 1] : 0});
  }
}
template <int size>
HG_DEVICE void read_flux(SharedArray array, int lane, CeedScalar *values) {
  HG_UNROLL for (int i = 0; i < size; i += 2) {
    const Pair two = read_pair(array, lane * odd_pairs(size) + i);
    values[i] = two.first;
    if (i + 1 < size) values[i + 1] = two.second;
  }
}

/// The lanes of a cell: those of its points, starts[cell] to starts[cell + 1], that are among the `threads` points from
/// `first` on.
struct PointLanes {
  const CeedInt *starts;
  CeedInt first;

  HG_DEVICE int begin(int cell) const { return starts[cell] > first ? starts[cell] - first : 0; }
  HG_DEVICE int end(int cell) const {
    const CeedInt end = starts[cell + 1] - first;
    return end < threads ? end : threads;
  }
};
/// What Functions::write() has left for the points: function n of direction d, and its derivative.
template <int dim, int P>
struct PointFunctions {
  SharedArray functions;

  HG_DEVICE Pair operator()(int lane, int d, int n) const {
    return read_pair(functions, lane * odd_pairs(2 * dim * P) + (d * P + n) * 2);
  }
};

/// Adds to the nodes of the cells from `first` on what points give: B^T values + G^T derivatives. A line of nodes along
/// the last direction for each thread; for each point 2P + 3 products of each component and as many numbers from shared
/// memory, most of them for all threads of a cell.
template <int dim, int P, int num_comp, bool with_values, bool with_derivatives>
HG_DEVICE void integrate_cells(const Side &side, CeedSize first, int count, const PointLanes &lanes,
                               const PointFunctions<dim, P> &functions, SharedArray values, SharedArray derivatives) {
  using Nodes = Cell<dim, P, num_comp>;
  constexpr int nc = num_comp, last = dim - 1;
  HG_ROLLED for (int i = thread(); i < count * Nodes::lines; i += threads) {
    const int cell = i / Nodes::lines, line = i % Nodes::lines, x = line % P, y = line / P;
    const int begin = lanes.begin(cell), end = lanes.end(cell);
    if (begin >= end) continue;
    CeedScalar sums[P][nc];
    HG_UNROLL for (int n = 0; n < P; n++) {
      HG_UNROLL for (int c = 0; c < nc; c++) sums[n][c] = 0;
    }
    HG_ROLLED for (int lane = begin; lane < end; lane++) {
      CeedScalar value[nc], slope[dim * nc];
      if (with_values) read_flux<nc>(values, lane, value);
      if (with_derivatives) read_flux<dim * nc>(derivatives, lane, slope);
      // Products over the directions but the last one, of values and of each derivative.
      CeedScalar plain = 1, along_x = 1, along_y = 1;
      if (dim > 1) {
        const Pair f = functions(lane, 0, x);
        plain = f.first;
        along_x = f.second;
      }
      if (dim > 2) {
        const Pair f = functions(lane, 1, y);
        along_y = plain * f.second;
        plain *= f.first;
        along_x *= f.first;
      }
      CeedScalar times_value[nc], times_slope[nc];
      HG_UNROLL for (int c = 0; c < nc; c++) {
        times_value[c] = with_values ? plain * value[c] : 0;
        if (with_derivatives && dim > 1) times_value[c] += along_x * slope[c];
        if (with_derivatives && dim > 2) times_value[c] += along_y * slope[nc + c];
        times_slope[c] = with_derivatives ? plain * slope[last * nc + c] : 0;
      }
      HG_UNROLL for (int n = 0; n < P; n++) {
        const Pair f = functions(lane, last, n);
        HG_UNROLL for (int c = 0; c < nc; c++) {
          if (with_values || dim > 1) sums[n][c] += f.first * times_value[c];
          if (with_derivatives) sums[n][c] += f.second * times_slope[c];
        }
      }
    }
    HG_UNROLL for (int n = 0; n < P; n++) {
      const CeedSize place = place_of(side, first + cell, Nodes::count, n * Nodes::lines + line, 0);
      HG_UNROLL for (int c = 0; c < nc; c++) {
        atomic_add(&side.values[place + c * side.comp_stride], sums[n][c]);
      }
    }
  }
}

}  // namespace hg::gpu
