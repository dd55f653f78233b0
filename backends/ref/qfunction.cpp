/// QFunctions called by themselves.
#include <vector>

#include "operator.hpp"

namespace hg::ref {

namespace {

int apply(CeedQFunction qf, CeedInt Q, const CeedVector *u, const CeedVector *v) {
  CeedInt num_in = 0, num_out = 0;
  CeedQFunctionUser f = nullptr;
  CeedCallBackend(CeedQFunctionGetNumArgs(qf, &num_in, &num_out));
  CeedCallBackend(CeedQFunctionGetUserFunction(qf, &f));
  std::vector<const CeedScalar *> in(num_in);
  std::vector<CeedScalar *> out(num_out);
  for (CeedInt i = 0; i < num_in; i++) CeedCallBackend(CeedVectorGetArrayRead(u[i], CEED_MEM_HOST, &in[i]));
  for (CeedInt i = 0; i < num_out; i++) CeedCallBackend(CeedVectorGetArrayWrite(v[i], CEED_MEM_HOST, &out[i]));
  void *context = nullptr;
  CeedCallBackend(CeedQFunctionGetContextData(qf, CEED_MEM_HOST, &context));
  const int code = f(context, Q, in.data(), out.data());
  CeedCallBackend(CeedQFunctionRestoreContextData(qf, &context));
  for (CeedInt i = 0; i < num_in; i++) CeedCallBackend(CeedVectorRestoreArrayRead(u[i], &in[i]));
  for (CeedInt i = 0; i < num_out; i++) CeedCallBackend(CeedVectorRestoreArray(v[i], &out[i]));
  const char *name = nullptr;
  CeedCallBackend(CeedQFunctionGetKernelName(qf, &name));
  CeedCheck(code == 0, CeedQFunctionReturnCeed(qf), CEED_ERROR_BACKEND, "QFunction '%s' returned %d; expected 0", name,
            code);
  return CEED_ERROR_SUCCESS;
}

}  // namespace

void fill_qfunction_ops(CeedQFunctionOps &ops) { ops = {.create = nullptr, .destroy = nullptr, .apply = apply}; }

}  // namespace hg::ref
