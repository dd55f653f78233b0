#include "print.hpp"

namespace hg::gen {

void Printer::contract(const host::Factor &factor, bool is_transpose, CeedInt pre, CeedInt columns, const Rows &in,
                       const Rows &out, bool add) {
  const host::Factor::Direction &B = factor.direction(is_transpose);
  const int s = B.symmetry == host::Symmetry::even ? 1 : B.symmetry == host::Symmetry::odd ? -1 : 0;
  num_steps_ += static_cast<CeedSize>(in_loop_) * pre * columns * (s == 0 ? (B.M + 3) / 4 : 1);
  line("contract<{}, {}, {}{}>({}, {}, {}, {{{}, {}, {}}}, {{{}, {}, {}}}, ahead);", B.M, B.N, s, add ? ", true" : "",
       numbers(B.coefficients.data()), pre, columns, in.array, in.pre, in.row, out.array, out.pre, out.row);
}

}  // namespace hg::gen
