// Assembly, K[(r,m),(c,n)] = Σ_q Σ_(l,k) B_l(q,m) D(q)[value(l) + r, value(k) + c] B_k(q,n): k runs over the rows of
// the trial functions, values and derivatives that the active inputs take, l over those of the test functions. A block
// has the matrices D of its points in shared memory, one lane for each; workers take tiles of K and sum over the lanes
// of an element. Before this come sides.hpp, and cells.hpp with StepLanes and PointFunctions for what is at points.

namespace hg::gpu {

/// Pairs of numbers, one for each row: its kind, which a tile of functions knows, and the active value of its component
/// 0.
template <int... numbers>
struct Rows {
  static constexpr int count = sizeof...(numbers) / 2;
  HG_DEVICE static constexpr int number(int i) {
    const int all[] = {numbers...};
    return all[i];
  }
  HG_DEVICE static constexpr int kind(int k) { return number(2 * k); }
  HG_DEVICE static constexpr int value(int k) { return number(2 * k + 1); }
};

/// The matrix of a lane: column i is the QFunction's result for the unit value i.
template <int num_in, int num_out>
struct Matrices {
  static constexpr int size = num_in * num_out | 1;  // lanes that follow each other are in different banks
  SharedArray values;

  HG_DEVICE void write_column(int lane, int i, const CeedScalar *column) const {
    HG_UNROLL for (int o = 0; o < num_out; o++) values[lane * size + i * num_out + o] = column[o];
  }
  HG_DEVICE CeedScalar read(int lane, int i, int o) const { return values[lane * size + i * num_out + o]; }
};

/// The lanes of an element of the block, one after another; all threads of the block work on all elements.
template <int num_qpts>
struct QuadratureLanes {
  HG_DEVICE int begin(int elem) const { return elem * num_qpts; }
  HG_DEVICE int end(int elem) const { return (elem + 1) * num_qpts; }
  HG_DEVICE static int worker() { return thread(); }
  HG_DEVICE static int num_workers() { return threads; }
};

/// Functions of one direction, and their derivatives, at Q quadrature points in each direction.
template <int P, int Q>
struct QuadratureFunctions {
  const CeedScalar *interp, *grad;

  HG_DEVICE Pair operator()(int lane, int d, int n) const {
    const int place = (d == 0 ? lane : d == 1 ? lane / Q : lane / (Q * Q)) % Q * P + n;
    return {interp[place], grad[place]};
  }
};

/// `length` functions of a tensor product that follow each other along the first direction. Kinds of rows: 0 for
/// values, 1 + d for derivatives along direction d.
template <typename OneDirection, int dim, int P, int length>
struct ProductTile {
  static constexpr int count = dim == 3 ? P * P * P : dim == 2 ? P * P : P, size = length;
  const OneDirection &functions;
  int x, y, z;

  HG_DEVICE ProductTile(const OneDirection &functions, int tile)
      : functions(functions), x(tile * length % P), y(tile * length / P % P), z(tile * length / (P * P)) {}
  template <typename Rows>
  HG_DEVICE void read(int lane, CeedScalar (*values)[length]) const {
    Pair along_y = {1, 0}, along_z = {1, 0};
    if (dim > 1) along_y = functions(lane, 1, y);
    if (dim > 2) along_z = functions(lane, 2, z);
    HG_UNROLL for (int i = 0; i < length; i++) {
      const Pair along_x = functions(lane, 0, x + i);
      HG_UNROLL for (int k = 0; k < Rows::count; k++) {
        const int kind = Rows::kind(k);
        values[k][i] = (kind == 1 ? along_x.second : along_x.first) * (kind == 2 ? along_y.second : along_y.first) *
                       (kind == 3 ? along_z.second : along_z.first);
      }
    }
  }
};
/// The same of num_nodes functions that are no products, at num_qpts points, in tables. Kind: where the row's table is.
template <int num_nodes, int num_qpts, int length>
struct TableTile {
  static constexpr int count = num_nodes, size = length;
  const CeedScalar *const &tables;
  int first;

  HG_DEVICE TableTile(const CeedScalar *const &tables, int tile) : tables(tables), first(tile * length) {}
  template <typename Rows>
  HG_DEVICE void read(int lane, CeedScalar (*values)[length]) const {
    HG_UNROLL for (int k = 0; k < Rows::count; k++) {
      HG_UNROLL for (int i = 0; i < length; i++) {
        values[k][i] = tables[Rows::kind(k) + lane % num_qpts * num_nodes + first + i];
      }
    }
  }
};

/// sums[m][n] for the tiles of components r and c, over lanes. For each lane LKN flops for D B and LMN for the rest,
/// twice; L rows of M test functions, K rows of N trial functions.
template <typename TestRows, typename TrialRows, typename Matrices, typename Test, typename Trial>
HG_DEVICE void sum_tile(const Matrices &matrices, const Test &test, const Trial &trial, int r, int c, int begin,
                        int end, CeedScalar (*sums)[Trial::size]) {
  HG_UNROLL for (int m = 0; m < Test::size; m++) {
    HG_UNROLL for (int n = 0; n < Trial::size; n++) sums[m][n] = 0;
  }
  HG_ROLLED for (int lane = begin; lane < end; lane++) {
    CeedScalar tests[TestRows::count][Test::size], trials[TrialRows::count][Trial::size];
    test.template read<TestRows>(lane, tests);
    trial.template read<TrialRows>(lane, trials);
    HG_UNROLL for (int l = 0; l < TestRows::count; l++) {
      CeedScalar flux[Trial::size];
      HG_UNROLL for (int n = 0; n < Trial::size; n++) flux[n] = 0;
      HG_UNROLL for (int k = 0; k < TrialRows::count; k++) {
        const CeedScalar d = matrices.read(lane, TrialRows::value(k) + c, TestRows::value(l) + r);
        HG_UNROLL for (int n = 0; n < Trial::size; n++) flux[n] += d * trials[k][n];
      }
      HG_UNROLL for (int m = 0; m < Test::size; m++) {
        HG_UNROLL for (int n = 0; n < Trial::size; n++) sums[m][n] += tests[l][m] * flux[n];
      }
    }
  }
}

/// Element matrices, rows (component, node) of test functions and columns (component, node) of trial functions, one
/// after another from `entries` on: added, by one thread for each entry.
template <typename TestRows, typename TrialRows, typename Test, typename Trial, int test_comps, int trial_comps,
          typename Lanes, typename Matrices, typename TestFunctions, typename TrialFunctions>
HG_DEVICE void add_matrices(CeedScalar *entries, int count, const Lanes &lanes, const Matrices &matrices,
                            const TestFunctions &test_functions, const TrialFunctions &trial_functions) {
  constexpr int trial_tiles = Trial::count / Trial::size, test_tiles = Test::count / Test::size;
  constexpr int columns = trial_tiles * trial_comps, of_element = columns * test_tiles * test_comps;
  constexpr CeedSize row = trial_comps * Trial::count, size = row * test_comps * Test::count;
  HG_ROLLED for (int i = lanes.worker(); i < count * of_element; i += lanes.num_workers()) {
    const int n = i % trial_tiles, c = i / trial_tiles % trial_comps, m = i / columns % test_tiles;
    const int r = i / (columns * test_tiles) % test_comps, elem = i / of_element;
    const int begin = lanes.begin(elem), end = lanes.end(elem);
    if (begin >= end) continue;
    CeedScalar sums[Test::size][Trial::size];
    sum_tile<TestRows, TrialRows>(matrices, Test(test_functions, m), Trial(trial_functions, n), r, c, begin, end, sums);
    CeedScalar *to =
        entries + elem * size + (r * Test::count + m * Test::size) * row + c * Trial::count + n * Trial::size;
    HG_UNROLL for (int j = 0; j < Test::size; j++) {
      HG_UNROLL for (int k = 0; k < Trial::size; k++) to[j * row + k] += sums[j][k];
    }
  }
}

/// Their diagonals, or the blocks of their nodes, added to what the L-vector `side` is for them. Tiles have one
/// function.
template <bool is_block, typename TestRows, typename TrialRows, typename Test, typename Trial, int num_comp,
          typename Lanes, typename Matrices, typename TestFunctions, typename TrialFunctions>
HG_DEVICE void add_diagonals(const Side &side, CeedSize first, int count, const Lanes &lanes, const Matrices &matrices,
                             const TestFunctions &test_functions, const TrialFunctions &trial_functions) {
  constexpr int rows = is_block ? num_comp : 1, of_element = Test::count * num_comp * rows;
  HG_ROLLED for (int i = lanes.worker(); i < count * of_element; i += lanes.num_workers()) {
    const int n = i % Test::count, c = i / Test::count % num_comp, elem = i / of_element;
    const int r = is_block ? i / (Test::count * num_comp) % rows : c;
    const int begin = lanes.begin(elem), end = lanes.end(elem);
    if (begin >= end) continue;
    CeedScalar sum[1][1];
    sum_tile<TestRows, TrialRows>(matrices, Test(test_functions, n), Trial(trial_functions, n), r, c, begin, end, sum);
    const CeedSize node = place_of(side, first + elem, Test::count, n, 0), stride = side.comp_stride;
    CeedSize place = node + c * stride;
    if (is_block && num_comp > 1) {
      // Components next to each other: each entry of the L-vector has its row of the block. Else nodes come in stacks,
      // component after component.
      const CeedSize block =
          stride == 1 ? node * num_comp : (node / (stride * num_comp) * stride + node % stride) * num_comp * num_comp;
      place = block + r * num_comp + c;
    }
    atomic_add(&side.values[place], sum[0][0]);
  }
}

/// Column i of the matrices in memory: (point, component, element), the point fastest; or at points one after another.
template <int num_in, int num_out, int num_qpts>
HG_DEVICE void write_column(const CeedScalar *column, CeedScalar *entries, CeedSize elem, int q, int i) {
  HG_UNROLL for (int o = 0; o < num_out; o++) {
    entries[(elem * num_in * num_out + i * num_out + o) * num_qpts + q] = column[o];
  }
}
template <int num_in, int num_out>
HG_DEVICE void write_column(const CeedScalar *column, CeedScalar *entries, CeedSize point, int i) {
  HG_UNROLL for (int o = 0; o < num_out; o++) entries[(point * num_in + i) * num_out + o] = column[o];
}

}  // namespace hg::gpu
