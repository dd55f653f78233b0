#include "print.hpp"

namespace hg::gen {

void Printer::contract(const host::Factor &factor, bool is_transpose, CeedInt pre, CeedInt columns, const Rows &in,
                       const Rows &out, bool add) {
  const host::Factor::Direction &B = factor.direction(is_transpose);
  const int s = B.symmetry == host::Symmetry::even ? 1 : B.symmetry == host::Symmetry::odd ? -1 : 0;
  line("contract<{}, {}, {}{}>({}, {}, {}, {{{}, {}, {}}}, {{{}, {}, {}}});", B.M, B.N, s, add ? ", true" : "",
       numbers(B.coefficients.data()), pre, columns, in.array, in.pre, in.row, out.array, out.pre, out.row);
}

}  // namespace hg::gen
