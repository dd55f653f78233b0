/// @file
/// The text of an operator, printed from its program.
#pragma once

#include <ceed/plugin.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "../host/block_basis.hpp"
#include "../host/point_basis.hpp"

namespace hg::gen {

/// A text with an entry `int hg_apply(hg::gen::Job *)`, and what a Job for it needs.
struct Printed {
  std::string text;                         ///< empty where the program is not one that is printed
  std::vector<const CeedScalar *> numbers;  ///< Job::numbers, which belong to the bases
  std::size_t work = 0;                     ///< length of Job::work
  bool does_all = false;                    ///< all elements: the QFunction is not called from elsewhere
};

/// Lines, and the arrays and numbers that they name.
class Printer {
 public:
  explicit Printer(CeedInt width) : W_(width) {}

  /// A line of the text; an empty one stays empty.
  template <typename... Args>
  void line(fmt::format_string<Args...> format, Args &&...args) {
    const std::string text = fmt::format(format, std::forward<Args>(args)...);
    const bool closes = !text.empty() && text[0] == '}';
    indent_ -= closes ? 2 : 0;
    text_ += text.empty() ? "\n" : std::string(indent_, ' ') + text + '\n';
    indent_ += !text.empty() && text.back() == '{' ? 2 : 0;
  }
  /// An array of so many packs in Job::work, declared here.
  std::string array(const std::string &name, std::size_t packs) {
    line("CeedScalar *const {} = job->work + {};  // {} packs", name, work_, packs);
    work_ += packs * W_;
    return name;
  }
  /// Numbers that the text reads.
  std::string numbers(const CeedScalar *values) {
    numbers_.push_back(values);
    return fmt::format("job->numbers[{}]", numbers_.size() - 1);
  }
  /// Entry (a, n, c) of an array is at array[(a*pre + n*row + c)*W].
  struct Rows {
    std::string array;
    CeedInt pre, row;
  };
  /// out (+)= B in, or with the transpose of B, for `pre` rows of `columns` numbers.
  void contract(const host::Factor &factor, bool is_transpose, CeedInt pre, CeedInt columns, const Rows &in,
                const Rows &out, bool add = false);
  /// What is printed from now on is repeated so often.
  void repeat(CeedInt times) { in_loop_ = times; }
  /// Steps of all contractions, see Ahead.
  CeedSize num_steps() const { return num_steps_; }
  /// Fills in a text for a mark that was printed before.
  void fill_in(const std::string &mark, const std::string &text) { text_.replace(text_.find(mark), mark.size(), text); }
  Printed printed() && { return {std::move(text_), std::move(numbers_), work_ + host::max_width}; }

 private:
  std::string text_;
  std::size_t indent_ = 0;
  std::vector<const CeedScalar *> numbers_;
  std::size_t work_ = 0;
  CeedInt W_, in_loop_ = 1;
  CeedSize num_steps_ = 0;
};

/// Prints an operator at quadrature points, for full blocks of elements. `bases`: of the program's spaces.
Printed print_blocks(const host::Kernels &kernels, const CeedProgram &program, const std::string &function,
                     const std::vector<const host::BlockBasis *> &bases);
/// Prints an operator at points of the elements' own. `bases`: of the program's spaces, NULL for weights.
Printed print_points(const host::Kernels &kernels, const CeedProgram &program, const std::string &function,
                     const std::vector<const host::PointBasis *> &bases);

}  // namespace hg::gen
