/// Fortran: QFunctions, contexts, operators.
#include <memory>

#include "handles.hpp"

namespace hg::fortran {

Handles<CeedQFunction> &qfunctions() {
  static Handles<CeedQFunction> handles("CeedQFunction");
  return handles;
}
Handles<CeedQFunctionContext> &contexts() {
  static Handles<CeedQFunctionContext> handles("CeedQFunctionContext");
  return handles;
}
Handles<CeedOperator> &operators() {
  static Handles<CeedOperator> handles("CeedOperator");
  return handles;
}

CeedQFunction qfunction_at(const int *handle) {
  return *handle == qfunction_none ? CEED_QFUNCTION_NONE : qfunctions().at(*handle);
}

namespace {

constexpr int max_fields = 16;  // of a Fortran QFunction, whose fields are arguments

/// subroutine f(ctx, q, u1, ..., u16, v1, ..., v16, err)
using Subroutine = void (*)(void *ctx, const CeedInt *Q, const CeedScalar *u1, const CeedScalar *u2,
                            const CeedScalar *u3, const CeedScalar *u4, const CeedScalar *u5, const CeedScalar *u6,
                            const CeedScalar *u7, const CeedScalar *u8, const CeedScalar *u9, const CeedScalar *u10,
                            const CeedScalar *u11, const CeedScalar *u12, const CeedScalar *u13, const CeedScalar *u14,
                            const CeedScalar *u15, const CeedScalar *u16, CeedScalar *v1, CeedScalar *v2,
                            CeedScalar *v3, CeedScalar *v4, CeedScalar *v5, CeedScalar *v6, CeedScalar *v7,
                            CeedScalar *v8, CeedScalar *v9, CeedScalar *v10, CeedScalar *v11, CeedScalar *v12,
                            CeedScalar *v13, CeedScalar *v14, CeedScalar *v15, CeedScalar *v16, int *err);

/// The context of a QFunction that calls a subroutine: what to call, and the context of the caller's.
struct SubroutineContext {
  Subroutine subroutine = nullptr;
  CeedInt num_in = 0, num_out = 0;  ///< fields, as they are added
  CeedQFunctionContext inner = nullptr;
};

int destroy_subroutine_context(void *data) {
  std::unique_ptr<SubroutineContext> owned(static_cast<SubroutineContext *>(data));
  return owned->inner != nullptr ? CeedQFunctionContextDestroy(&owned->inner) : CEED_ERROR_SUCCESS;
}

/// The QFunction for C: the subroutine gets as many arrays as it has arguments.
int call_subroutine(void *ctx, CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const auto &context = *static_cast<const SubroutineContext *>(ctx);
  const CeedScalar *u[max_fields] = {};
  CeedScalar *v[max_fields] = {};
  for (CeedInt i = 0; i < context.num_in; i++) u[i] = in[i];
  for (CeedInt i = 0; i < context.num_out; i++) v[i] = out[i];
  void *data = nullptr;
  if (context.inner != nullptr) CeedCall(CeedQFunctionContextGetData(context.inner, CEED_MEM_HOST, &data));
  int err = 0;
  context.subroutine(data, &Q, u[0], u[1], u[2], u[3], u[4], u[5], u[6], u[7], u[8], u[9], u[10], u[11], u[12], u[13],
                     u[14], u[15], v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9], v[10], v[11], v[12],
                     v[13], v[14], v[15], &err);
  if (context.inner != nullptr) CeedCall(CeedQFunctionContextRestoreData(context.inner, &data));
  return err;
}

/// Calls f(SubroutineContext &) if the QFunction calls a subroutine, else does nothing.
template <typename F>
int with_subroutine(CeedQFunction qf, F &&f) {
  CeedQFunctionUser function = nullptr;
  CeedCall(CeedQFunctionGetUserFunction(qf, &function));
  if (function != call_subroutine) return CEED_ERROR_SUCCESS;
  CeedQFunctionContext ctx = nullptr;
  void *data = nullptr;
  CeedCall(CeedQFunctionGetContext(qf, &ctx));
  int code = CeedQFunctionContextGetData(ctx, CEED_MEM_HOST, &data);
  if (code == CEED_ERROR_SUCCESS) {
    code = f(*static_cast<SubroutineContext *>(data));
    CeedQFunctionContextRestoreData(ctx, &data);
  }
  CeedQFunctionContextDestroy(&ctx);
  return code;
}

int create_from_subroutine(Ceed ceed, CeedInt vec_length, Subroutine subroutine, const std::string &source,
                           CeedQFunction *qf) {
  auto context = std::make_unique<SubroutineContext>();
  context->subroutine = subroutine;
  CeedQFunctionContext ctx = nullptr;
  CeedCall(CeedQFunctionContextCreate(ceed, &ctx));
  int code = CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_USE_POINTER, sizeof *context, context.get());
  if (code == CEED_ERROR_SUCCESS) {
    (void)context.release();
    code = CeedQFunctionContextSetDataDestroy(ctx, CEED_MEM_HOST, destroy_subroutine_context);
  }
  if (code == CEED_ERROR_SUCCESS) code = CeedQFunctionCreateInterior(ceed, vec_length, call_subroutine, source.c_str(), qf);
  if (code == CEED_ERROR_SUCCESS) code = CeedQFunctionSetContext(*qf, ctx);
  // The subroutine may write the caller's context, not this one.
  if (code == CEED_ERROR_SUCCESS) code = CeedQFunctionSetContextWritable(*qf, false);
  CeedQFunctionContextDestroy(&ctx);
  return code;
}

/// Adds a field, and counts it where there is a subroutine.
int add_field(const int *qf, const std::string &name, CeedInt size, CeedEvalMode mode,
              CeedInt SubroutineContext::*count, int (*add)(CeedQFunction, const char *, CeedInt, CeedEvalMode)) {
  const CeedQFunction function = qfunction_at(qf);
  CeedCall(with_subroutine(function, [&](SubroutineContext &context) -> int {
    CeedCheck(context.*count < max_fields, CeedQFunctionReturnCeed(function), CEED_ERROR_UNSUPPORTED,
              "Field '%s' is one too many: a QFunction in Fortran has at most %d inputs and as many outputs",
              name.c_str(), max_fields);
    return 0;
  }));
  CeedCall(add(function, name.c_str(), size, mode));
  return with_subroutine(function, [&](SubroutineContext &context) -> int {
    context.*count += 1;
    return 0;
  });
}

}  // namespace

}  // namespace hg::fortran

using namespace hg::fortran;

int CeedQFunctionGetInnerContext(CeedQFunction qf, CeedQFunctionContext *ctx) {
  CeedCheck(qf != nullptr, nullptr, CEED_ERROR_INCOMPLETE, "CeedQFunction is NULL; expected a live object");
  CeedCheck(ctx != nullptr, CeedQFunctionReturnCeed(qf), CEED_ERROR_INCOMPLETE,
            "Argument 'ctx' is NULL; expected where its value goes");
  CeedQFunctionUser function = nullptr;
  CeedCall(CeedQFunctionGetUserFunction(qf, &function));
  if (function != call_subroutine) return CeedQFunctionGetContext(qf, ctx);
  *ctx = nullptr;
  return with_subroutine(qf, [&](SubroutineContext &context) -> int {
    return context.inner != nullptr ? CeedQFunctionContextReferenceCopy(context.inner, ctx) : CEED_ERROR_SUCCESS;
  });
}

namespace {

/// Calls f(inner context of a subroutine, maybe NULL), or `other` where there is no subroutine.
template <typename F, typename Other>
int with_inner_context(CeedQFunction qf, F &&f, Other &&other) {
  CeedQFunctionUser function = nullptr;
  CeedCall(CeedQFunctionGetUserFunction(qf, &function));
  if (function != call_subroutine) return other();
  CeedQFunctionContext inner = nullptr;
  CeedCall(CeedQFunctionGetInnerContext(qf, &inner));
  if (inner == nullptr) return CEED_ERROR_SUCCESS;
  const int code = f(inner);
  CeedQFunctionContextDestroy(&inner);
  return code;
}

}  // namespace

int CeedQFunctionGetInnerContextData(CeedQFunction qf, CeedMemType mem_type, void *data) {
  CeedCheck(qf != nullptr, nullptr, CEED_ERROR_INCOMPLETE, "CeedQFunction is NULL; expected a live object");
  CeedCheck(data != nullptr, CeedQFunctionReturnCeed(qf), CEED_ERROR_INCOMPLETE,
            "Argument 'data' is NULL; expected where its value goes");
  *static_cast<void **>(data) = nullptr;
  return with_inner_context(
      qf, [&](CeedQFunctionContext inner) { return CeedQFunctionContextGetData(inner, mem_type, data); },
      [&] { return CeedQFunctionGetContextData(qf, mem_type, data); });
}

int CeedQFunctionRestoreInnerContextData(CeedQFunction qf, void *data) {
  CeedCheck(qf != nullptr, nullptr, CEED_ERROR_INCOMPLETE, "CeedQFunction is NULL; expected a live object");
  return with_inner_context(
      qf, [&](CeedQFunctionContext inner) { return CeedQFunctionContextRestoreData(inner, data); },
      [&] { return CeedQFunctionRestoreContextData(qf, data); });
}

// QFunctions

CEED_EXTERN void ceedqfunctioncreateinterior_(const int *ceed, const int *vec_length, Subroutine f, const char *source,
                                              int *qf, int *err, Length length) {
  make(qfunctions(), qf, err, [&](CeedQFunction *made) {
    return create_from_subroutine(ceed_at(ceed), *vec_length, f, text_of(source, length), made);
  });
}
CEED_EXTERN void ceedqfunctioncreateinteriorbyname_(const int *ceed, const char *name, int *qf, int *err,
                                                    Length length) {
  make(qfunctions(), qf, err, [&](CeedQFunction *made) {
    return CeedQFunctionCreateInteriorByName(ceed_at(ceed), text_of(name, length).c_str(), made);
  });
}
CEED_EXTERN void ceedqfunctioncreateidentity_(const int *ceed, const int *size, const int *in_mode, const int *out_mode,
                                              int *qf, int *err) {
  make(qfunctions(), qf, err, [&](CeedQFunction *made) {
    return CeedQFunctionCreateIdentity(ceed_at(ceed), *size, static_cast<CeedEvalMode>(*in_mode),
                                       static_cast<CeedEvalMode>(*out_mode), made);
  });
}
CEED_EXTERN void ceedqfunctionaddinput_(const int *qf, const char *name, const int *size, const int *eval_mode,
                                        int *err, Length length) {
  run(err, [&] {
    return add_field(qf, text_of(name, length), *size, static_cast<CeedEvalMode>(*eval_mode), &SubroutineContext::num_in,
                     CeedQFunctionAddInput);
  });
}
CEED_EXTERN void ceedqfunctionaddoutput_(const int *qf, const char *name, const int *size, const int *eval_mode,
                                         int *err, Length length) {
  run(err, [&] {
    return add_field(qf, text_of(name, length), *size, static_cast<CeedEvalMode>(*eval_mode),
                     &SubroutineContext::num_out, CeedQFunctionAddOutput);
  });
}
CEED_EXTERN void ceedqfunctionsetcontext_(const int *qf, const int *ctx, int *err) {
  run(err, [&] {
    const CeedQFunction function = qfunction_at(qf);
    const CeedQFunctionContext context = context_at(ctx);
    CeedQFunctionUser user = nullptr;
    CeedCall(CeedQFunctionGetUserFunction(function, &user));
    if (user != call_subroutine) return CeedQFunctionSetContext(function, context);
    return with_subroutine(function, [&](SubroutineContext &of_subroutine) {
      return CeedQFunctionContextReferenceCopy(context, &of_subroutine.inner);
    });
  });
}
CEED_EXTERN void ceedqfunctionsetnumviewtabs_(const int *qf, const int *num_tabs, int *err) {
  run(err, [&] { return CeedQFunctionSetNumViewTabs(qfunction_at(qf), *num_tabs); });
}
CEED_EXTERN void ceedqfunctionview_(const int *qf, int *err) {
  run(err, [&] { return CeedQFunctionView(qfunction_at(qf), stdout); });
}
CEED_EXTERN void ceedqfunctionapply_(const int *qf, const int *Q, const int *u1, const int *u2, const int *u3,
                                     const int *u4, const int *u5, const int *u6, const int *u7, const int *u8,
                                     const int *u9, const int *u10, const int *u11, const int *u12, const int *u13,
                                     const int *u14, const int *u15, const int *u16, const int *v1, const int *v2,
                                     const int *v3, const int *v4, const int *v5, const int *v6, const int *v7,
                                     const int *v8, const int *v9, const int *v10, const int *v11, const int *v12,
                                     const int *v13, const int *v14, const int *v15, const int *v16, int *err) {
  run(err, [&] {
    const int *const inputs[] = {u1, u2, u3, u4, u5, u6, u7, u8, u9, u10, u11, u12, u13, u14, u15, u16};
    const int *const outputs[] = {v1, v2, v3, v4, v5, v6, v7, v8, v9, v10, v11, v12, v13, v14, v15, v16};
    CeedVector u[max_fields] = {}, v[max_fields] = {};
    for (int i = 0; i < max_fields; i++) {
      if (*inputs[i] != null) u[i] = vector_at(inputs[i]);
      if (*outputs[i] != null) v[i] = vector_at(outputs[i]);
    }
    return CeedQFunctionApply(qfunction_at(qf), *Q, u, v);
  });
}
CEED_EXTERN void ceedqfunctiondestroy_(int *qf, int *err) { destroy(qfunctions(), qf, err, CeedQFunctionDestroy); }

// Contexts: data are real*8 values

CEED_EXTERN void ceedqfunctioncontextcreate_(const int *ceed, int *ctx, int *err) {
  make(contexts(), ctx, err,
       [&](CeedQFunctionContext *made) { return CeedQFunctionContextCreate(ceed_at(ceed), made); });
}
CEED_EXTERN void ceedqfunctioncontextsetdata_(const int *ctx, const int *mem_type, const int *copy_mode, const int *n,
                                              CeedScalar *data, const std::int64_t *offset, int *err) {
  run(err, [&] {
    return CeedQFunctionContextSetData(context_at(ctx), static_cast<CeedMemType>(*mem_type),
                                       static_cast<CeedCopyMode>(*copy_mode),
                                       static_cast<std::size_t>(*n) * sizeof(CeedScalar), data + *offset);
  });
}
CEED_EXTERN void ceedqfunctioncontextgetdata_(const int *ctx, const int *mem_type, CeedScalar *data,
                                              std::int64_t *offset, int *err) {
  run(err, [&] {
    CeedScalar *got = nullptr;
    const int code = CeedQFunctionContextGetData(context_at(ctx), static_cast<CeedMemType>(*mem_type), &got);
    if (code == CEED_ERROR_SUCCESS) *offset = offset_of(got, data);
    return code;
  });
}
CEED_EXTERN void ceedqfunctioncontextrestoredata_(const int *ctx, CeedScalar *, std::int64_t *offset, int *err) {
  run(err, [&] {
    *offset = 0;
    void *data = nullptr;
    return CeedQFunctionContextRestoreData(context_at(ctx), &data);
  });
}
CEED_EXTERN void ceedqfunctioncontextsetnumviewtabs_(const int *ctx, const int *num_tabs, int *err) {
  run(err, [&] { return CeedQFunctionContextSetNumViewTabs(context_at(ctx), *num_tabs); });
}
CEED_EXTERN void ceedqfunctioncontextview_(const int *ctx, int *err) {
  run(err, [&] { return CeedQFunctionContextView(context_at(ctx), stdout); });
}
CEED_EXTERN void ceedqfunctioncontextdestroy_(int *ctx, int *err) {
  destroy(contexts(), ctx, err, CeedQFunctionContextDestroy);
}

// Operators

CEED_EXTERN void ceedoperatorcreate_(const int *ceed, const int *qf, const int *dqf, const int *dqfT, int *op,
                                     int *err) {
  make(operators(), op, err, [&](CeedOperator *made) {
    return CeedOperatorCreate(ceed_at(ceed), qfunction_at(qf), qfunction_at(dqf), qfunction_at(dqfT), made);
  });
}
CEED_EXTERN void ceedoperatorcreatecomposite_(const int *ceed, int *op, int *err) {
  make(operators(), op, err, [&](CeedOperator *made) { return CeedOperatorCreateComposite(ceed_at(ceed), made); });
}
CEED_EXTERN void ceedoperatorsetfield_(const int *op, const char *name, const int *rstr, const int *basis,
                                       const int *vec, int *err, Length length) {
  run(err, [&] {
    return CeedOperatorSetField(operator_at(op), text_of(name, length).c_str(), restriction_at(rstr), basis_at(basis),
                                vector_at(vec));
  });
}
CEED_EXTERN void ceedoperatorcompositeaddsub_(const int *composite, const int *sub, int *err) {
  run(err, [&] { return CeedOperatorCompositeAddSub(operator_at(composite), operator_at(sub)); });
}
CEED_EXTERN void ceedoperatorsetname_(const int *op, const char *name, int *err, Length length) {
  run(err, [&] { return CeedOperatorSetName(operator_at(op), text_of(name, length).c_str()); });
}
CEED_EXTERN void ceedoperatorlinearassembleqfunction_(const int *op, int *assembled, int *rstr, const int *request,
                                                      int *err) {
  run(err, [&] {
    CeedVector vec = nullptr;
    CeedElemRestriction restriction = nullptr;
    CeedCall(CeedOperatorLinearAssembleQFunction(operator_at(op), &vec, &restriction, request_at(request)));
    *assembled = vectors().add(vec);
    *rstr = restrictions().add(restriction);
    return 0;
  });
}
CEED_EXTERN void ceedoperatorlinearassemblediagonal_(const int *op, const int *assembled, const int *request,
                                                     int *err) {
  run(err, [&] {
    return CeedOperatorLinearAssembleDiagonal(operator_at(op), vector_at(assembled), request_at(request));
  });
}

namespace {

/// Three operators of a level.
template <typename F>
int make_level(int *coarse, int *prolong, int *restrict_, F &&create) {
  CeedOperator made[3] = {};
  CeedCall(create(made, made + 1, made + 2));
  *coarse = operators().add(made[0]);
  *prolong = operators().add(made[1]);
  *restrict_ = operators().add(made[2]);
  return 0;
}

}  // namespace

CEED_EXTERN void ceedoperatormultigridlevelcreate_(const int *op, const int *p_mult, const int *rstr, const int *basis,
                                                   int *coarse, int *prolong, int *restrict_, int *err) {
  run(err, [&] {
    return make_level(coarse, prolong, restrict_, [&](CeedOperator *c, CeedOperator *p, CeedOperator *r) {
      return CeedOperatorMultigridLevelCreate(operator_at(op), vector_at(p_mult), restriction_at(rstr), basis_at(basis),
                                              c, p, r);
    });
  });
}
CEED_EXTERN void ceedoperatormultigridlevelcreatetensorh1_(const int *op, const int *p_mult, const int *rstr,
                                                           const int *basis, const CeedScalar *interp, int *coarse,
                                                           int *prolong, int *restrict_, int *err) {
  run(err, [&] {
    return make_level(coarse, prolong, restrict_, [&](CeedOperator *c, CeedOperator *p, CeedOperator *r) {
      return CeedOperatorMultigridLevelCreateTensorH1(operator_at(op), vector_at(p_mult), restriction_at(rstr),
                                                      basis_at(basis), interp, c, p, r);
    });
  });
}
CEED_EXTERN void ceedoperatormultigridlevelcreateh1_(const int *op, const int *p_mult, const int *rstr,
                                                     const int *basis, const CeedScalar *interp, int *coarse,
                                                     int *prolong, int *restrict_, int *err) {
  run(err, [&] {
    return make_level(coarse, prolong, restrict_, [&](CeedOperator *c, CeedOperator *p, CeedOperator *r) {
      return CeedOperatorMultigridLevelCreateH1(operator_at(op), vector_at(p_mult), restriction_at(rstr),
                                                basis_at(basis), interp, c, p, r);
    });
  });
}
CEED_EXTERN void ceedoperatorcreatefdmelementinverse_(const int *op, int *inverse, const int *request, int *err) {
  make(operators(), inverse, err, [&](CeedOperator *made) {
    return CeedOperatorCreateFDMElementInverse(operator_at(op), made, request_at(request));
  });
}
CEED_EXTERN void ceedoperatorsetnumviewtabs_(const int *op, const int *num_tabs, int *err) {
  run(err, [&] { return CeedOperatorSetNumViewTabs(operator_at(op), *num_tabs); });
}
CEED_EXTERN void ceedoperatorview_(const int *op, int *err) {
  run(err, [&] { return CeedOperatorView(operator_at(op), stdout); });
}
CEED_EXTERN void ceedoperatorapply_(const int *op, const int *in, const int *out, const int *request, int *err) {
  run(err, [&] { return CeedOperatorApply(operator_at(op), vector_at(in), vector_at(out), request_at(request)); });
}
CEED_EXTERN void ceedoperatorapplyadd_(const int *op, const int *in, const int *out, const int *request, int *err) {
  run(err, [&] { return CeedOperatorApplyAdd(operator_at(op), vector_at(in), vector_at(out), request_at(request)); });
}
CEED_EXTERN void ceedoperatordestroy_(int *op, int *err) { destroy(operators(), op, err, CeedOperatorDestroy); }
