/// @file
/// What tests of compiled operators share: processes with an environment of their own, a compiler that keeps a diary,
/// and small operators with any QFunction.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/program.hpp"
#include "support/values.hpp"

namespace hg::test {

inline constexpr const char *compiled_resource = "/cpu/self/gen", *interpreted_resource = "/cpu/self/avx/blocked";

/// Variables of the environment. An empty one counts as one that is not there.
using Environment = std::map<std::string, std::string>;
using Results = std::vector<Values>;

/// What became of a process.
struct Ran {
  Results results;
  std::string err;      ///< its standard error
  std::string failure;  ///< how it ended where it did not end well; else empty
};

/// A process that does some work. Nothing is compiled, loaded or told in it yet, provided that this one has not either.
class Process {
 public:
  Process(const Environment &environment, const std::function<Results()> &work);
  Ran wait();

 private:
  TemporaryFolder folder_;
  int id_;
};
Ran in_process(const Environment &environment, const std::function<Results()> &work);

/// A function, and the place of its text.
struct Function {
  CeedQFunctionUser pointer;
  std::string location;
};

/// An operator v = B^T f(B u, B c, w, id) on elements in a row, neighbours of which share a node; c is passive, and so
/// is id, the number of a point, element by element.
class Model {
 public:
  struct Shape {
    CeedInt dim = 2, num_elem = 11, P = 3, Q = 4;
    bool at_points = false;  ///< then to be followed by place_points()
  };
  /// With a context of these numbers, which the QFunction may write to if `is_writable`.
  Model(Ceed ceed, const Shape &shape, const Function &function, const Values &context = {}, bool is_writable = false);

  /// So many points in each element, at random places.
  void place_points(const std::vector<CeedInt> &counts, Random &random);
  void set_context(const Values &values);
  void set_coefficient(const Values &values);
  Values context_values() const;
  /// Entries of u, v and c.
  CeedSize size() const { return shape_.num_elem * (elem_size_ - 1) + 1; }
  /// A smooth u, the same for all.
  Values some_input() const;
  Values apply(const Values &u) const;
  Values apply() const { return apply(some_input()); }
  CeedOperator op() const { return op_; }

 private:
  Ceed ceed_;
  Shape shape_;
  CeedInt elem_size_;
  Restriction rstr_, rstr_id_, rstr_x_;
  Basis basis_;
  Vector coefficient_, id_, x_;
  Context context_;
  QFunction qf_;
  Operator op_;
};

/// v = factor w c u, or with the factor in the context.
template <int factor>
int scale(void *context, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar by = context != nullptr ? *static_cast<const CeedScalar *>(context) : factor;
  for (CeedInt q = 0; q < Q; q++) out[0][q] = by * in[2][q] * in[1][q] * in[0][q];
  return 0;
}

/// A folder with a cache, a compiler and QFunctions, for one test.
class Workshop : public ::testing::Test {
 protected:
  Workshop();
  /// What processes of this test begin with; `changes` go before.
  Environment environment(const Environment &changes = {}) const;
  std::filesystem::path cache() const { return folder_ / "cache"; }
  std::filesystem::path folder() const { return folder_.path(); }
  /// A program in the folder.
  std::string write_program(const std::string &name, const std::string &text) const;
  /// Text of a QFunction in the folder; what is called unless it is compiled is `pointer`.
  Function write(const std::string &file, const std::string &function, const std::string &text,
                 CeedQFunctionUser pointer) const;
  /// A QFunction scale() whose text has the factor FACTOR, which factor.h defines unless it is defined already; what is
  /// called unless it is compiled has the factor 7.
  Function write_scale() const;
  void write_factor(int factor) const;
  /// How often a library was made, and how often the compiler was started.
  int num_made() const;
  int num_starts() const;
  /// Files of the cache that end so.
  int num_cached(const std::string &extension) const;

 private:
  TemporaryFolder folder_;
};

/// The compiler that the tests' compilers call.
std::string real_compiler();
/// Warnings among what a process said.
int num_warnings(const std::string &err);
void expect_equal(const Results &got, const Results &want, SourceLocation where = SourceLocation::current());

}  // namespace hg::test
