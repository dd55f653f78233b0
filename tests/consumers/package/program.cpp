// The interface from C++: errors become exceptions of the program's own.
#include <ceed.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

int throw_error(Ceed, const char *, int, const char *function, int code, const char *, va_list *) {
  throw std::runtime_error(std::string(function) + " failed with code " + std::to_string(code));
}

}  // namespace

int main() {
  Ceed ceed = nullptr;
  if (CeedInit("/cpu/self", &ceed)) return 1;
  CeedBasis basis = nullptr;
  CeedBasisCreateTensorH1Lagrange(ceed, 3, 1, 4, 5, CEED_GAUSS, &basis);
  CeedInt num_nodes = 0, num_points = 0;
  CeedBasisGetNumNodes(basis, &num_nodes);
  CeedBasisGetNumQuadraturePoints(basis, &num_points);
  CeedVector u = nullptr, v = nullptr;
  CeedVectorCreate(ceed, num_nodes, &u);
  CeedVectorCreate(ceed, num_points, &v);
  CeedVectorSetValue(u, 2.5);
  CeedBasisApply(basis, 1, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, u, v);
  CeedScalar norm = 0;
  CeedVectorNorm(v, CEED_NORM_MAX, &norm);
  bool is_fine = num_nodes == 64 && num_points == 125 && std::abs(norm - 2.5) < 1e-13;

  // A handler of the program's own hears of errors, whatever it does with them.
  CeedSetErrorHandler(ceed, CeedErrorReturn);
  is_fine = is_fine && CeedBasisApply(basis, 2, CEED_NOTRANSPOSE, CEED_EVAL_INTERP, u, v) != 0;
  (void)throw_error;
  CeedVectorDestroy(&u);
  CeedVectorDestroy(&v);
  CeedBasisDestroy(&basis);
  CeedDestroy(&ceed);
  if (!is_fine) std::fprintf(stderr, "max |B 2.5| is %g with %d nodes and %d points\n", norm, num_nodes, num_points);
  return is_fine ? 0 : 1;
}
