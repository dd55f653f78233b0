#include "cg.hpp"

#include <array>

#include "clock.hpp"

namespace hg::bps {

namespace {

double norm(Ceed ceed, CeedVector x) {
  CeedScalar value = 0;
  check(ceed, CeedVectorNorm(x, CEED_NORM_2, &value));
  return value;
}

double dot_on_host(Ceed ceed, CeedVector x, CeedVector y, CeedSize length) {
  const CeedScalar *a = nullptr, *b = nullptr;
  check(ceed, CeedVectorGetArrayRead(x, CEED_MEM_HOST, &a));
  check(ceed, CeedVectorGetArrayRead(y, CEED_MEM_HOST, &b));
  std::array<double, 8> lanes{};
  const CeedSize whole = length - length % 8;
  for (CeedSize i = 0; i < whole; i += 8)
    for (int l = 0; l < 8; l++) lanes[l] += a[i + l] * b[i + l];
  for (CeedSize i = whole; i < length; i++) lanes[i - whole] += a[i] * b[i];
  check(ceed, CeedVectorRestoreArrayRead(x, &a));
  check(ceed, CeedVectorRestoreArrayRead(y, &b));
  double sum = 0;
  for (double lane : lanes) sum += lane;
  return sum;
}

double dot_by_norms(Ceed ceed, CeedVector x, CeedVector y, CeedVector work) {
  const double nx = norm(ceed, x), ny = norm(ceed, y);
  if (nx == 0 || ny == 0) return 0;
  check(ceed, CeedVectorCopy(x, work));
  check(ceed, CeedVectorAXPBY(work, 1 / ny, 1 / nx, y));
  const double sum = norm(ceed, work);
  check(ceed, CeedVectorAXPY(work, -2 / ny, y));
  const double difference = norm(ceed, work);
  return nx * ny * (sum * sum - difference * difference) / 4;
}

}  // namespace

CgResult conjugate_gradients(Ceed ceed, const Bakeoff &A, CeedVector mask, CeedVector b, CeedVector x,
                             const CgOptions &options) {
  const CeedSize length = A.num_dofs();
  CeedMemType preferred = CEED_MEM_HOST;
  check(ceed, CeedGetPreferredMemType(ceed, &preferred));
  const bool by_norms = options.dot == Dot::by_norms || (options.dot == Dot::preferred && preferred == CEED_MEM_DEVICE);
  if (mask) check(ceed, CeedVectorPointwiseMult(b, b, mask));
  Vector r = make_vector(ceed, length), p = make_vector(ceed, length), Ap = make_vector(ceed, length), work;
  if (by_norms) work = make_vector(ceed, length);
  check(ceed, CeedVectorSetValue(x, 0));
  check(ceed, CeedVectorCopy(b, r));
  check(ceed, CeedVectorCopy(b, p));
  const double b_norm = norm(ceed, b);
  double r_norm = b_norm;

  CgResult result;
  const double start = now();
  while (result.iterations < options.max_iterations && r_norm > options.relative_tolerance * b_norm) {
    A.apply(p, Ap);
    if (mask) check(ceed, CeedVectorPointwiseMult(Ap, Ap, mask));
    const double pAp = by_norms ? dot_by_norms(ceed, p, Ap, work) : dot_on_host(ceed, p, Ap, length);
    if (!(pAp > 0)) break;  // not positive definite, or not a number: the caller sees that it did not converge
    const double alpha = r_norm * r_norm / pAp;
    check(ceed, CeedVectorAXPY(x, alpha, p));
    check(ceed, CeedVectorAXPY(r, -alpha, Ap));
    const double new_norm = norm(ceed, r);
    const double beta = new_norm * new_norm / (r_norm * r_norm);
    check(ceed, CeedVectorAXPBY(p, 1, beta, r));
    r_norm = new_norm;
    result.iterations++;
  }
  result.seconds = now() - start;
  result.relative_residual = b_norm > 0 ? r_norm / b_norm : 0;
  result.converged = r_norm <= options.relative_tolerance * b_norm;
  return result;
}

}  // namespace hg::bps
