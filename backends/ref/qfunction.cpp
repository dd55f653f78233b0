/// QFunctions called by themselves.
#include <vector>

#include "operator.hpp"

namespace hg::ref {

namespace {

/// Access to the arrays of a call, given back however it ends.
struct Access {
  Access(CeedQFunction qf_, const CeedVector *u_, const CeedVector *v_) : qf(qf_), u(u_), v(v_) {}
  Access(const Access &) = delete;
  Access &operator=(const Access &) = delete;
  ~Access() { release(); }
  int get(CeedInt num_in, CeedInt num_out) {
    in.reserve(static_cast<std::size_t>(num_in));  // what is lent can be noted
    out.reserve(static_cast<std::size_t>(num_out));
    for (CeedInt i = 0; i < num_in; i++) {
      const CeedScalar *array = nullptr;
      CeedCallBackend(CeedVectorGetArrayRead(u[i], CEED_MEM_HOST, &array));
      in.push_back(array);
    }
    for (CeedInt i = 0; i < num_out; i++) {
      CeedScalar *array = nullptr;
      CeedCallBackend(CeedVectorGetArrayWrite(v[i], CEED_MEM_HOST, &array));
      out.push_back(array);
    }
    CeedCallBackend(CeedQFunctionGetContextData(qf, CEED_MEM_HOST, &context));
    has_context = true;
    return CEED_ERROR_SUCCESS;
  }
  /// The first error of giving back, if any; everything is tried.
  int release() {
    int first = CEED_ERROR_SUCCESS;
    const auto keep = [&](int code) { first = first != CEED_ERROR_SUCCESS ? first : code; };
    if (has_context) keep(CeedQFunctionRestoreContextData(qf, &context));
    has_context = false;
    while (!out.empty()) {
      keep(CeedVectorRestoreArray(v[out.size() - 1], &out.back()));
      out.pop_back();
    }
    while (!in.empty()) {
      keep(CeedVectorRestoreArrayRead(u[in.size() - 1], &in.back()));
      in.pop_back();
    }
    return first;
  }

  CeedQFunction qf;
  const CeedVector *u, *v;
  std::vector<const CeedScalar *> in;
  std::vector<CeedScalar *> out;
  void *context = nullptr;
  bool has_context = false;
};

int apply(CeedQFunction qf, CeedInt Q, const CeedVector *u, const CeedVector *v) {
  CeedInt num_in = 0, num_out = 0;
  CeedQFunctionUser f = nullptr;
  CeedCallBackend(CeedQFunctionGetNumArgs(qf, &num_in, &num_out));
  CeedCallBackend(CeedQFunctionGetUserFunction(qf, &f));
  Access access(qf, u, v);
  CeedCallBackend(access.get(num_in, num_out));
  const int code = f(access.context, Q, access.in.data(), access.out.data());
  CeedCallBackend(access.release());
  const char *name = nullptr;
  CeedCallBackend(CeedQFunctionGetKernelName(qf, &name));
  CeedCheck(code == 0, CeedQFunctionReturnCeed(qf), CEED_ERROR_BACKEND, "QFunction '%s' returned %d; expected 0", name,
            code);
  return CEED_ERROR_SUCCESS;
}

}  // namespace

void fill_qfunction_ops(CeedQFunctionOps &ops) {
  ops = {
      .create = nullptr, .destroy = nullptr, .apply = apply, .set_cuda_function = nullptr, .set_hip_function = nullptr};
}

}  // namespace hg::ref
