// Operators at points of the elements' own. `cell_lanes` threads of a warp that follow each other take one cell, and in
// a step `slots` points each. Before this come sides.hpp, and
//   threads, warp  threads of a block, and of a warp
//   cell_lanes     threads of a cell
//   slots          points of a thread in a step
//   most_planes    planes of nodes that are taken by instructions of their own
// In shared memory are the coefficients of the cells. A thread has the basis functions at its points in registers, and
// what its QFunction gives them; what the points of a cell give to its nodes is summed by exchange in the warp, which
// leaves each lane with its share of the nodes. No thread waits for more than its warp.

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

/// Planes of nodes are taken by instructions of their own where there are few. More would not fit into the 32 KB that a
/// processor has near, and be compiled for long (a vector's derivatives at p = 8 for 50 s instead of 1.5).
HG_DEVICE constexpr int planes_at_once(int P) {
  return P <= most_planes ? P : 1;
}

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

/// The functions along the third direction, of all slots. They are apart so that a plane's number need not be known
/// when they are read, and the others can still be in registers.
template <int dim, int P>
struct OfPlanes {
  CeedScalar value[slots][P], derivative[slots][P];

  HG_DEVICE explicit OfPlanes(const Functions<dim, P> *at) {
    constexpr int last = dim - 1;
    HG_UNROLL for (int s = 0; s < slots; s++) {
      HG_UNROLL for (int z = 0; z < P; z++) {
        value[s][z] = at[s].value[last][z];
        derivative[s][z] = at[s].derivative[last][z];
      }
    }
  }
};

/// A thread's cell. Lanes without one, or beyond its points, go along with the others of the warp.
struct CellLanes {
  CeedInt cell = 0, first = 0, count = 0;  ///< its points
  CeedInt num_steps = 0;                 ///< that the warp takes

  HG_DEVICE CellLanes(const OperatorFacts &facts) {
    const CeedInt *const starts = facts.points.offsets;
    const CeedSize own = block() * (threads / cell_lanes) + thread() / cell_lanes,
                   of_warp = own / (warp / cell_lanes) * (warp / cell_lanes);
    if (of_warp >= facts.num_cells) return;
    const CeedInt most = facts.cells[of_warp];
    num_steps = (starts[most + 1] - starts[most] + cell_lanes * slots - 1) / (cell_lanes * slots);
    if (own >= facts.num_cells) return;
    cell = facts.cells[own];
    first = starts[cell];
    count = starts[cell + 1] - first;
  }
  HG_DEVICE static int lane() { return thread() % cell_lanes; }
  /// The point of a slot; -1 where there is none.
  HG_DEVICE CeedInt point(CeedInt step, int slot) const {
    const auto i = (static_cast<unsigned>(step) * slots + slot) * cell_lanes + lane();
    return i < static_cast<unsigned>(count) ? first + static_cast<CeedInt>(i) : -1;
  }
  HG_DEVICE static bool has(CeedInt point) { return point >= 0; }
};

/// The lanes of a block that have points of a cell in this step, one each, for what all lanes of the cell take part in.
struct StepLanes {
  int first, count;

  HG_DEVICE StepLanes(const CellLanes &at, CeedInt step) : first(thread() / cell_lanes * cell_lanes) {
    const CeedInt left = at.count - step * cell_lanes;
    count = left < cell_lanes ? left : cell_lanes;
  }
  HG_DEVICE int begin(int) const { return first; }
  HG_DEVICE int end(int) const { return first + count; }
  HG_DEVICE static int worker() { return CellLanes::lane(); }
  HG_DEVICE static int num_workers() { return cell_lanes; }
};

/// The nodes of a cell, by its lanes.
template <typename Cell>
HG_DEVICE void read_cell(const Side &side, const CellLanes &at, SharedArray nodes) {
  if (at.count == 0) return;
  for (int i = CellLanes::lane(); i < Cell::lines * Cell::line; i += cell_lanes) {
    const int in_line = i % Cell::line, n = i / Cell::line * (Cell::count / Cell::lines) + in_line / Cell::components;
    CeedScalar value = 0;  // what fills up a line
    if (in_line < Cell::count / Cell::lines * Cell::components) {
      value = side.values[place_of(side, at.cell, Cell::count, n, in_line % Cell::components)];
    }
    nodes[i] = value;
  }
}

/// Values, and derivatives (direction by direction), of all components at a thread's points; either may be left out.
/// About P^3 + P^2 + P products for values, twice that with derivatives, for each component and point; the nodes are
/// read once for all points.
template <int dim, int P, int num_comp, bool with_values, bool with_derivatives>
HG_DEVICE void evaluate_points(const Functions<dim, P> *at, SharedArray nodes, CeedScalar (*values)[num_comp],
                               CeedScalar (*derivatives)[dim * num_comp]) {
  using Nodes = Cell<dim, P, num_comp>;
  constexpr int P_y = dim > 1 ? P : 1, P_z = dim > 2 ? P : 1, nc = num_comp, second = dim > 1;
  CeedScalar sums[slots][4][nc];  // values, and derivatives along x, y and z
  HG_UNROLL for (int s = 0; s < slots; s++) {
    HG_UNROLL for (int c = 0; c < nc; c++) sums[s][0][c] = sums[s][1][c] = sums[s][2][c] = sums[s][3][c] = 0;
  }
  const OfPlanes<dim, P> of_planes(at);
  HG_UNROLL_BY(planes_at_once(P_z)) for (int z = 0; z < P_z; z++) {
    CeedScalar plane[slots][3][nc];
    HG_UNROLL for (int s = 0; s < slots; s++) {
      HG_UNROLL for (int c = 0; c < nc; c++) plane[s][0][c] = plane[s][1][c] = plane[s][2][c] = 0;
    }
    HG_UNROLL for (int y = 0; y < P_y; y++) {
      CeedScalar u[Nodes::line];
      HG_UNROLL for (int i = 0; i < Nodes::line; i += 2) {
        const Pair two = read_pair(nodes, (z * P_y + y) * Nodes::line + i);
        u[i] = two.first;
        u[i + 1] = two.second;
      }
      HG_UNROLL for (int s = 0; s < slots; s++) {
        HG_UNROLL for (int c = 0; c < nc; c++) {
          CeedScalar value = 0, slope = 0;
          HG_UNROLL for (int x = 0; x < P; x++) {
            value += at[s].value[0][x] * u[x * nc + c];
            if (with_derivatives) slope += at[s].derivative[0][x] * u[x * nc + c];
          }
          plane[s][0][c] += dim > 1 ? at[s].value[second][y] * value : value;
          if (with_derivatives) plane[s][1][c] += dim > 1 ? at[s].value[second][y] * slope : slope;
          if (with_derivatives && dim > 1) plane[s][2][c] += at[s].derivative[second][y] * value;
        }
      }
    }
    HG_UNROLL for (int s = 0; s < slots; s++) {
      HG_UNROLL for (int c = 0; c < nc; c++) {
        HG_UNROLL for (int g = 0; g < 3; g++) {
          if (g > 0 && (!with_derivatives || g > dim)) continue;
          sums[s][g][c] += dim > 2 ? of_planes.value[s][z] * plane[s][g][c] : plane[s][g][c];
        }
        if (with_derivatives && dim > 2) sums[s][3][c] += of_planes.derivative[s][z] * plane[s][0][c];
      }
    }
  }
  HG_UNROLL for (int s = 0; s < slots; s++) {
    HG_UNROLL for (int c = 0; c < nc; c++) {
      if (with_values) values[s][c] = sums[s][0][c];
      HG_UNROLL for (int g = 0; g < dim; g++) {
        if (with_derivatives) derivatives[s][g * nc + c] = sums[s][1 + g][c];
      }
    }
  }
}

/// The number of a point, its place in all L-vectors; -1 where there is none.
HG_DEVICE CeedInt number_of(const OperatorFacts &facts, CeedInt point) {
  return CellLanes::has(point) ? facts.points.offsets[point] : -1;
}

/// What is stored at points, component fastest.
template <int num_comp>
HG_DEVICE void read_point(const Side &side, CeedInt number, CeedScalar *values) {
  const CeedScalar *from = side.values + static_cast<CeedSize>(number) * num_comp;
  HG_UNROLL for (int c = 0; c < num_comp; c++) values[c] = from[c];
}
template <int num_comp>
HG_DEVICE void write_point(const Side &side, CeedInt number, const CeedScalar *values) {
  CeedScalar *to = side.values + static_cast<CeedSize>(number) * num_comp;
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

/// A thread's point; anywhere where it has none.
template <int dim>
HG_DEVICE void read_coordinates(const Side &side, CeedInt number, CeedScalar *x) {
  HG_UNROLL for (int d = 0; d < dim; d++) x[d] = 0;
  if (CellLanes::has(number)) read_point<dim>(side, number, x);
}

/// A lane's share of N numbers, of which each lane of a group has a part to be summed: halves are exchanged, then
/// quarters, ...
template <int N, int group>
struct Share {
  static constexpr int half = (N + 1) / 2;
  using Rest = Share<half, group / 2>;
  static constexpr int size = Rest::size;

  HG_DEVICE static bool is_upper() { return (thread() & group / 2) != 0; }
  /// The first `size` values become those of the share; (N - size) numbers are exchanged, or a few more.
  HG_DEVICE static void sum(CeedScalar *values) {
    CeedScalar other[half];
    HG_UNROLL for (int i = 0; i < half; i++) {
      const CeedScalar upper = half + i < N ? values[half + i] : 0;
      other[i] = is_upper() ? values[i] : upper;
      values[i] = is_upper() ? upper : values[i];
    }
    exchange<half>(other, group / 2);
    HG_UNROLL for (int i = 0; i < half; i++) values[i] += other[i];
    Rest::sum(values);
  }
  /// Which numbers these are: `count` from `first` on.
  HG_DEVICE static void find(int &first, int &count) {
    if (is_upper()) first += half;
    const int upper = count > half ? count - half : 0;
    count = is_upper() ? upper : count - upper;
    Rest::find(first, count);
  }
};
template <int N>
struct Share<N, 1> {
  static constexpr int size = N;
  HG_DEVICE static void sum(CeedScalar *) {}
  HG_DEVICE static void find(int &, int &) {}
};

/// Sums over the points of a cell, B^T values + G^T derivatives at its nodes: of so many lines of nodes at a time, a
/// share for each lane, over all steps; in registers, or in shared memory, in a column for each thread.
template <int dim, int P, int num_comp, int lines, bool is_in_shared>
struct CellSums {
  using Nodes = Cell<dim, P, num_comp>;
  static constexpr int nc = num_comp, P_y = dim > 1 ? P : 1, P_z = dim > 2 ? P : 1, last = dim - 1, second = dim > 1;
  static constexpr int parts = P_y / lines, size = lines * P * nc;  ///< of a plane, and numbers of a part
  using OfLane = Share<size, cell_lanes>;
  static constexpr int count = P_z * parts * OfLane::size;

  CeedScalar own[is_in_shared ? 1 : count];
  SharedArray columns;

  HG_DEVICE explicit CellSums(SharedArray columns) : columns(columns) {
    HG_UNROLL for (int i = 0; i < count; i++) {
      if (is_in_shared) {
        columns[i * threads + thread()] = 0;
      } else {
        own[i] = 0;
      }
    }
  }
  /// About as many products as evaluate_points() has. Points that are not there have zeros.
  template <bool with_values, bool with_derivatives>
  HG_DEVICE void add(const Functions<dim, P> *at, const CeedScalar (*values)[nc],
                     const CeedScalar (*derivatives)[dim * nc]) {
    const OfPlanes<dim, P> of_planes(at);
    HG_UNROLL_BY(planes_at_once(P_z)) for (int z = 0; z < P_z; z++) {
      Plane plane[slots];
      HG_UNROLL for (int s = 0; s < slots; s++) {
        const CeedScalar f = dim > 2 ? of_planes.value[s][z] : 1, df = dim > 2 ? of_planes.derivative[s][z] : 0;
        HG_UNROLL for (int c = 0; c < nc; c++) {
          plane[s].value[c] = with_values ? f * values[s][c] : 0;
          if (with_derivatives && dim > 2) plane[s].value[c] += df * derivatives[s][last * nc + c];
          plane[s].along_x[c] = with_derivatives ? f * derivatives[s][c] : 0;
          plane[s].along_y[c] = with_derivatives && dim > 1 ? f * derivatives[s][second * nc + c] : 0;
        }
      }
      HG_UNROLL for (int part = 0; part < parts; part++) {
        CeedScalar all[size];
        HG_UNROLL for (int i = 0; i < size; i++) all[i] = 0;
        HG_UNROLL for (int s = 0; s < slots; s++) {
          HG_UNROLL for (int line = 0; line < lines; line++) {
            add_line<with_values, with_derivatives>(at[s], plane[s], part * lines + line, all + line * P * nc);
          }
        }
        OfLane::sum(all);
        HG_UNROLL for (int i = 0; i < OfLane::size; i++) {
          const int n = (z * parts + part) * OfLane::size + i;
          if (is_in_shared) {
            columns[n * threads + thread()] += all[i];
          } else {
            own[n] += all[i];
          }
        }
      }
    }
  }
  /// After all steps: to the L-vector.
  HG_DEVICE void add_to(const Side &side, const CellLanes &cell) const {
    if (cell.count == 0) return;
    int first = 0, num = size;
    OfLane::find(first, num);
    HG_UNROLL for (int i = 0; i < OfLane::size; i++) {
      if (i >= num) continue;
      const int c = (first + i) % nc, n = (first + i) / nc;
      HG_UNROLL_BY(planes_at_once(P_z) == P_z ? P_z * parts : 1) for (int part = 0; part < P_z * parts; part++) {
        const int at = part * OfLane::size + i;
        const CeedScalar sum = is_in_shared ? CeedScalar(columns[at * threads + thread()]) : own[is_in_shared ? 0 : at];
        atomic_add(&side.values[place_of(side, cell.cell, Nodes::count, part * lines * P + n, c)], sum);
      }
    }
  }

 private:
  /// What functions along x, or their derivatives, and derivatives along y are multiplied with in a plane of nodes.
  struct Plane {
    CeedScalar value[nc], along_x[nc], along_y[nc];
  };
  template <bool with_values, bool with_derivatives>
  HG_DEVICE static void add_line(const Functions<dim, P> &at, const Plane &plane, int y, CeedScalar *line) {
    const CeedScalar f = dim > 1 ? at.value[second][y] : 1, df = dim > 1 ? at.derivative[second][y] : 0;
    HG_UNROLL for (int c = 0; c < nc; c++) {
      CeedScalar value = with_values || dim > 2 ? f * plane.value[c] : 0;
      if (with_derivatives && dim > 1) value += df * plane.along_y[c];
      const CeedScalar slope = with_derivatives ? f * plane.along_x[c] : 0;
      HG_UNROLL for (int x = 0; x < P; x++) {
        if (with_values || dim > 1) line[x * nc + c] += at.value[0][x] * value;
        if (with_derivatives) line[x * nc + c] += at.derivative[0][x] * slope;
      }
    }
  }
};

/// What Functions::write() has left for a block's lanes: function n of direction d, and its derivative.
template <int dim, int P>
struct PointFunctions {
  SharedArray functions;

  HG_DEVICE Pair operator()(int lane, int d, int n) const {
    return read_pair(functions, lane * odd_pairs(2 * dim * P) + (d * P + n) * 2);
  }
};

}  // namespace hg::gpu
