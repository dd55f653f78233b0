/// @file
/// Entries of element matrices from the assembled QFunction.
#pragma once

#include <ceed/plugin.h>

#include <array>
#include <memory>
#include <vector>

#include "block_basis.hpp"
#include "element_assembly.hpp"
#include "fields.hpp"
#include "kernels.hpp"

namespace hg::host {

/// K[(r,m),(c,n)] = Σ_q Σ_(l,k) B_l(q,m) D(q)[(l,r),(k,c)] B_k(q,n) for W elements side by side, r and c components,
/// l and k the values and derivatives that the outputs take of test functions m, and the inputs of trial functions n.
/// For each pair (r,c) D_lk is a number at each point, and K the sum over l and k of what the transposed table of
/// products B_l B_k makes of it. Products of tensor-product functions are products of functions of one direction: the
/// sum goes direction by direction, and those (l,k) whose further factors are the same are added up on the way. A
/// diagonal takes the products of each function with itself, a matrix those of all pairs.
///
/// At points of their own the products are polynomials as well, of N = K_trial + K_test - 1 Chebyshev coefficients in
/// each direction. The moments Σ_q D_lk(q) T_i(x_q) T_j(y_q) T_k(z_q) then stand where else the values at N^3
/// quadrature points are.
///
/// Floor of a pair (r,c) of Poisson's problem, N points and P nodes in each of 3 directions, multiplications with
/// additions: matrix 9 P^2 N^3 + 9 P^4 N^2 + 4 P^6 N, diagonal 6 P N^3 + 6 P^2 N^2 + 3 P^3 N; the moments of a point
/// N^3 for each (l,k).
class ElementMatrices final : public ElementAssembly {
 public:
  /// NULL where this coupling is not taken: its functions are turned (oriented restrictions), its nodes are points, its
  /// bases do not go together or their tables are too large.
  static std::unique_ptr<ElementAssembly> make(const Kernels &kernels, const CeedProgram &program, CeedInt source,
                                               CeedInt sink, CeedAssembleKind kind);
  std::size_t num_bytes() const override;
  void compute(const CeedProgram &program, CeedInt first_elem, CeedInt num_elem, const CeedScalar *qfunction,
               CeedScalar *entries) override;

 private:
  /// P functions of one direction at N points, point after point.
  struct Table {
    CeedBasis basis;
    CeedEvalMode mode;
    CeedInt value;  ///< which of the mode's values; 0 for tensor products
    CeedInt P;
    std::vector<CeedScalar> values;
  };
  /// A value or derivative of all functions of a side.
  struct Row {
    CeedInt first_value;            ///< see CeedProgramField
    std::array<CeedInt, 3> tables;  ///< of each direction
  };
  struct Side {
    CeedInt num_comp = 0, num_nodes = 0;
    std::vector<Row> rows;
  };
  /// Numbers at the points, and the products that they are contracted with.
  struct Term {
    std::array<CeedInt, 3> factors = {};  ///< of each direction
    std::vector<CeedInt> components;      ///< of D, for r = c = 0: their sum is contracted
  };

  explicit ElementMatrices(const Kernels &kernels) : kernels_(&kernels) {}
  bool choose_points(const CeedProgram &program, CeedInt source, CeedInt sink);
  void add_rows(const CeedProgram &program, bool is_trial, CeedInt side);
  CeedInt add_table(CeedBasis basis, CeedEvalMode mode, CeedInt value);
  bool make_terms(const CeedProgram &program);
  bool choose_kernels(std::size_t num_factors);
  Factor product(const Table &test, const Table &trial) const;
  void make_arrays();
  void make_places();
  void read_values(const CeedProgram &program, CeedInt num_elem, const CeedScalar *D, CeedInt pair);
  void make_moments(const CeedProgram &program, CeedInt lane, CeedInt e, const CeedScalar *x_ref, const CeedScalar *D);
  void read_moments(CeedInt num_elem, CeedInt pair);
  void contract();

  const Kernels *kernels_;
  ComponentPairs pairs_ = {};
  bool is_tensor_ = false;
  CeedInt num_directions_ = 1, N_ = 0;  ///< N: points of a direction
  CeedInt num_products_ = 0;            ///< in each direction
  Side trial_, test_;
  std::vector<Table> tables_;
  std::vector<Factor> factors_;
  std::vector<Term> terms_;      ///< sorted by their factors, the last direction's first
  std::vector<CeedInt> places_;  ///< of the entries in the last stage
  int values_ = -1, sum_ = -1, moments_ = -1, table_ = -1;
  std::array<int, 3> stages_ = {-1, -1, -1};
  Arena arena_;

  PointMoments integrate_ = nullptr;  ///< at points
  CeedSize row_ = 0;                  ///< moments of all terms of all pairs, filled up
  std::vector<CeedScalar> x_ref_;
  Array point_values_;
  std::size_t num_point_values_ = 0;
};

}  // namespace hg::host
