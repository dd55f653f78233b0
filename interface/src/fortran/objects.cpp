/// Fortran: Ceeds, vectors, restrictions, bases.
#include "handles.hpp"

namespace hg::fortran {

Handles<Ceed> &ceeds() {
  static Handles<Ceed> handles("Ceed");
  return handles;
}
Handles<CeedVector> &vectors() {
  static Handles<CeedVector> handles("CeedVector");
  return handles;
}
Handles<CeedElemRestriction> &restrictions() {
  static Handles<CeedElemRestriction> handles("CeedElemRestriction");
  return handles;
}
Handles<CeedBasis> &bases() {
  static Handles<CeedBasis> handles("CeedBasis");
  return handles;
}

CeedVector vector_at(const int *handle) {
  if (*handle == vector_active) return CEED_VECTOR_ACTIVE;
  if (*handle == vector_none) return CEED_VECTOR_NONE;
  return vectors().at(*handle);
}
CeedElemRestriction restriction_at(const int *handle) {
  return *handle == restriction_none ? CEED_ELEMRESTRICTION_NONE : restrictions().at(*handle);
}
CeedBasis basis_at(const int *handle) {
  return *handle == basis_none ? CEED_BASIS_NONE : bases().at(*handle);
}

CeedRequest *request_at(const int *request) {
  return *request == request_ordered ? CEED_REQUEST_ORDERED : CEED_REQUEST_IMMEDIATE;
}

namespace {

/// Strides, or the constant that is passed in their place.
const CeedInt *strides_at(const CeedInt *strides) {
  return strides[0] == strides_backend ? CEED_STRIDES_BACKEND : strides;
}

}  // namespace

}  // namespace hg::fortran

using namespace hg::fortran;

// Ceed

CEED_EXTERN void ceedinit_(const char *resource, int *ceed, int *err, Length length) {
  make(ceeds(), ceed, err, [&](Ceed *made) { return CeedInit(text_of(resource, length).c_str(), made); });
}
CEED_EXTERN void ceedisdeterministic_(const int *ceed, int *is_deterministic, int *err) {
  run(err, [&] {
    bool is = false;
    const int code = CeedIsDeterministic(ceed_at(ceed), &is);
    *is_deterministic = is ? 1 : 0;
    return code;
  });
}
CEED_EXTERN void ceedgetpreferredmemtype_(const int *ceed, int *mem_type, int *err) {
  run(err, [&] {
    CeedMemType type = CEED_MEM_HOST;
    const int code = CeedGetPreferredMemType(ceed_at(ceed), &type);
    *mem_type = type;
    return code;
  });
}
CEED_EXTERN void ceedsetnumviewtabs_(const int *ceed, const int *num_tabs, int *err) {
  run(err, [&] { return CeedSetNumViewTabs(ceed_at(ceed), *num_tabs); });
}
CEED_EXTERN void ceedview_(const int *ceed, int *err) {
  run(err, [&] { return CeedView(ceed_at(ceed), stdout); });
}
CEED_EXTERN void ceeddestroy_(int *ceed, int *err) { destroy(ceeds(), ceed, err, CeedDestroy); }
CEED_EXTERN void ceedgaussquadrature_(const int *Q, CeedScalar *q_ref_1d, CeedScalar *q_weight_1d, int *err) {
  run(err, [&] { return CeedGaussQuadrature(*Q, q_ref_1d, q_weight_1d); });
}
CEED_EXTERN void ceedlobattoquadrature_(const int *Q, CeedScalar *q_ref_1d, CeedScalar *q_weight_1d, int *err) {
  run(err, [&] { return CeedLobattoQuadrature(*Q, q_ref_1d, q_weight_1d); });
}
CEED_EXTERN void ceedrequestwait_(int *, int *err) { *err = CEED_ERROR_SUCCESS; }

// Vectors

CEED_EXTERN void ceedvectorcreate_(const int *ceed, const int *length, int *vec, int *err) {
  make(vectors(), vec, err, [&](CeedVector *made) { return CeedVectorCreate(ceed_at(ceed), *length, made); });
}
CEED_EXTERN void ceedvectorsetarray_(const int *vec, const int *mem_type, const int *copy_mode, CeedScalar *array,
                                     const std::int64_t *offset, int *err) {
  run(err, [&] {
    return CeedVectorSetArray(vector_at(vec), static_cast<CeedMemType>(*mem_type), static_cast<CeedCopyMode>(*copy_mode),
                              array + *offset);
  });
}
CEED_EXTERN void ceedvectortakearray_(const int *vec, const int *mem_type, CeedScalar *array, std::int64_t *offset,
                                      int *err) {
  run(err, [&] {
    CeedScalar *taken = nullptr;
    const int code = CeedVectorTakeArray(vector_at(vec), static_cast<CeedMemType>(*mem_type), &taken);
    if (code == CEED_ERROR_SUCCESS) *offset = offset_of(taken, array);
    return code;
  });
}
CEED_EXTERN void ceedvectorsyncarray_(const int *vec, const int *mem_type, int *err) {
  run(err, [&] { return CeedVectorSyncArray(vector_at(vec), static_cast<CeedMemType>(*mem_type)); });
}
CEED_EXTERN void ceedvectorsetvalue_(const int *vec, const CeedScalar *value, int *err) {
  run(err, [&] { return CeedVectorSetValue(vector_at(vec), *value); });
}
CEED_EXTERN void ceedvectorgetarray_(const int *vec, const int *mem_type, CeedScalar *array, std::int64_t *offset,
                                     int *err) {
  run(err, [&] {
    CeedScalar *got = nullptr;
    const int code = CeedVectorGetArray(vector_at(vec), static_cast<CeedMemType>(*mem_type), &got);
    if (code == CEED_ERROR_SUCCESS) *offset = offset_of(got, array);
    return code;
  });
}
CEED_EXTERN void ceedvectorgetarraywrite_(const int *vec, const int *mem_type, CeedScalar *array, std::int64_t *offset,
                                          int *err) {
  run(err, [&] {
    CeedScalar *got = nullptr;
    const int code = CeedVectorGetArrayWrite(vector_at(vec), static_cast<CeedMemType>(*mem_type), &got);
    if (code == CEED_ERROR_SUCCESS) *offset = offset_of(got, array);
    return code;
  });
}
CEED_EXTERN void ceedvectorgetarrayread_(const int *vec, const int *mem_type, CeedScalar *array, std::int64_t *offset,
                                         int *err) {
  run(err, [&] {
    const CeedScalar *got = nullptr;
    const int code = CeedVectorGetArrayRead(vector_at(vec), static_cast<CeedMemType>(*mem_type), &got);
    if (code == CEED_ERROR_SUCCESS) *offset = offset_of(got, static_cast<const CeedScalar *>(array));
    return code;
  });
}
CEED_EXTERN void ceedvectorrestorearray_(const int *vec, CeedScalar *, std::int64_t *offset, int *err) {
  run(err, [&] {
    *offset = 0;
    return CeedVectorRestoreArray(vector_at(vec), nullptr);
  });
}
CEED_EXTERN void ceedvectorrestorearrayread_(const int *vec, const CeedScalar *, std::int64_t *offset, int *err) {
  run(err, [&] {
    *offset = 0;
    return CeedVectorRestoreArrayRead(vector_at(vec), nullptr);
  });
}
CEED_EXTERN void ceedvectornorm_(const int *vec, const int *type, CeedScalar *norm, int *err) {
  run(err, [&] { return CeedVectorNorm(vector_at(vec), static_cast<CeedNormType>(*type), norm); });
}
CEED_EXTERN void ceedvectorreciprocal_(const int *vec, int *err) {
  run(err, [&] { return CeedVectorReciprocal(vector_at(vec)); });
}
CEED_EXTERN void ceedvectorsetnumviewtabs_(const int *vec, const int *num_tabs, int *err) {
  run(err, [&] { return CeedVectorSetNumViewTabs(vector_at(vec), *num_tabs); });
}
CEED_EXTERN void ceedvectorview_(const int *vec, int *err) {
  run(err, [&] { return CeedVectorView(vector_at(vec), "%12.8f", stdout); });
}
CEED_EXTERN void ceedvectordestroy_(int *vec, int *err) { destroy(vectors(), vec, err, CeedVectorDestroy); }

// Restrictions

CEED_EXTERN void ceedelemrestrictioncreate_(const int *ceed, const int *num_elem, const int *elem_size,
                                            const int *num_comp, const int *comp_stride, const int *l_size,
                                            const int *mem_type, const int *copy_mode, const int *offsets, int *rstr,
                                            int *err) {
  make(restrictions(), rstr, err, [&](CeedElemRestriction *made) {
    return CeedElemRestrictionCreate(ceed_at(ceed), *num_elem, *elem_size, *num_comp, *comp_stride, *l_size,
                                     static_cast<CeedMemType>(*mem_type), static_cast<CeedCopyMode>(*copy_mode),
                                     offsets, made);
  });
}
/// orients: logical*1
CEED_EXTERN void ceedelemrestrictioncreateoriented_(const int *ceed, const int *num_elem, const int *elem_size,
                                                    const int *num_comp, const int *comp_stride, const int *l_size,
                                                    const int *mem_type, const int *copy_mode, const int *offsets,
                                                    const bool *orients, int *rstr, int *err) {
  make(restrictions(), rstr, err, [&](CeedElemRestriction *made) {
    return CeedElemRestrictionCreateOriented(ceed_at(ceed), *num_elem, *elem_size, *num_comp, *comp_stride, *l_size,
                                             static_cast<CeedMemType>(*mem_type), static_cast<CeedCopyMode>(*copy_mode),
                                             offsets, orients, made);
  });
}
/// curl_orients: integer*1
CEED_EXTERN void ceedelemrestrictioncreatecurloriented_(const int *ceed, const int *num_elem, const int *elem_size,
                                                        const int *num_comp, const int *comp_stride, const int *l_size,
                                                        const int *mem_type, const int *copy_mode, const int *offsets,
                                                        const CeedInt8 *curl_orients, int *rstr, int *err) {
  make(restrictions(), rstr, err, [&](CeedElemRestriction *made) {
    return CeedElemRestrictionCreateCurlOriented(
        ceed_at(ceed), *num_elem, *elem_size, *num_comp, *comp_stride, *l_size, static_cast<CeedMemType>(*mem_type),
        static_cast<CeedCopyMode>(*copy_mode), offsets, curl_orients, made);
  });
}
CEED_EXTERN void ceedelemrestrictioncreatestrided_(const int *ceed, const int *num_elem, const int *elem_size,
                                                   const int *num_comp, const int *l_size, const int *strides,
                                                   int *rstr, int *err) {
  make(restrictions(), rstr, err, [&](CeedElemRestriction *made) {
    return CeedElemRestrictionCreateStrided(ceed_at(ceed), *num_elem, *elem_size, *num_comp, *l_size,
                                            strides_at(strides), made);
  });
}
CEED_EXTERN void ceedelemrestrictioncreateblocked_(const int *ceed, const int *num_elem, const int *elem_size,
                                                   const int *block_size, const int *num_comp, const int *comp_stride,
                                                   const int *l_size, const int *mem_type, const int *copy_mode,
                                                   const int *offsets, int *rstr, int *err) {
  make(restrictions(), rstr, err, [&](CeedElemRestriction *made) {
    return CeedElemRestrictionCreateBlocked(ceed_at(ceed), *num_elem, *elem_size, *block_size, *num_comp, *comp_stride,
                                            *l_size, static_cast<CeedMemType>(*mem_type),
                                            static_cast<CeedCopyMode>(*copy_mode), offsets, made);
  });
}
CEED_EXTERN void ceedelemrestrictioncreateblockedoriented_(const int *ceed, const int *num_elem, const int *elem_size,
                                                           const int *block_size, const int *num_comp,
                                                           const int *comp_stride, const int *l_size,
                                                           const int *mem_type, const int *copy_mode,
                                                           const int *offsets, const bool *orients, int *rstr,
                                                           int *err) {
  make(restrictions(), rstr, err, [&](CeedElemRestriction *made) {
    return CeedElemRestrictionCreateBlockedOriented(
        ceed_at(ceed), *num_elem, *elem_size, *block_size, *num_comp, *comp_stride, *l_size,
        static_cast<CeedMemType>(*mem_type), static_cast<CeedCopyMode>(*copy_mode), offsets, orients, made);
  });
}
CEED_EXTERN void ceedelemrestrictioncreateblockedcurloriented_(const int *ceed, const int *num_elem,
                                                               const int *elem_size, const int *block_size,
                                                               const int *num_comp, const int *comp_stride,
                                                               const int *l_size, const int *mem_type,
                                                               const int *copy_mode, const int *offsets,
                                                               const CeedInt8 *curl_orients, int *rstr, int *err) {
  make(restrictions(), rstr, err, [&](CeedElemRestriction *made) {
    return CeedElemRestrictionCreateBlockedCurlOriented(
        ceed_at(ceed), *num_elem, *elem_size, *block_size, *num_comp, *comp_stride, *l_size,
        static_cast<CeedMemType>(*mem_type), static_cast<CeedCopyMode>(*copy_mode), offsets, curl_orients, made);
  });
}
CEED_EXTERN void ceedelemrestrictioncreateblockedstrided_(const int *ceed, const int *num_elem, const int *elem_size,
                                                          const int *block_size, const int *num_comp,
                                                          const int *l_size, const int *strides, int *rstr, int *err) {
  make(restrictions(), rstr, err, [&](CeedElemRestriction *made) {
    return CeedElemRestrictionCreateBlockedStrided(ceed_at(ceed), *num_elem, *elem_size, *block_size, *num_comp,
                                                   *l_size, strides_at(strides), made);
  });
}
CEED_EXTERN void ceedelemrestrictionapply_(const int *rstr, const int *t_mode, const int *u, const int *ru,
                                           const int *request, int *err) {
  run(err, [&] {
    return CeedElemRestrictionApply(restriction_at(rstr), static_cast<CeedTransposeMode>(*t_mode), vector_at(u),
                                    vector_at(ru), request_at(request));
  });
}
CEED_EXTERN void ceedelemrestrictionapplyblock_(const int *rstr, const int *block, const int *t_mode, const int *u,
                                                const int *ru, const int *request, int *err) {
  run(err, [&] {
    return CeedElemRestrictionApplyBlock(restriction_at(rstr), *block, static_cast<CeedTransposeMode>(*t_mode),
                                         vector_at(u), vector_at(ru), request_at(request));
  });
}
CEED_EXTERN void ceedelemrestrictiongetmultiplicity_(const int *rstr, const int *multiplicity, int *err) {
  run(err, [&] { return CeedElemRestrictionGetMultiplicity(restriction_at(rstr), vector_at(multiplicity)); });
}
CEED_EXTERN void ceedelemrestrictiongetelayout_(const int *rstr, int *layout, int *err) {
  run(err, [&] { return CeedElemRestrictionGetELayout(restriction_at(rstr), layout); });
}
CEED_EXTERN void ceedelemrestrictionsetnumviewtabs_(const int *rstr, const int *num_tabs, int *err) {
  run(err, [&] { return CeedElemRestrictionSetNumViewTabs(restriction_at(rstr), *num_tabs); });
}
CEED_EXTERN void ceedelemrestrictionview_(const int *rstr, int *err) {
  run(err, [&] { return CeedElemRestrictionView(restriction_at(rstr), stdout); });
}
CEED_EXTERN void ceedelemrestrictiondestroy_(int *rstr, int *err) {
  destroy(restrictions(), rstr, err, CeedElemRestrictionDestroy);
}

// Bases

CEED_EXTERN void ceedbasiscreatetensorh1lagrange_(const int *ceed, const int *dim, const int *num_comp, const int *P,
                                                  const int *Q, const int *quad_mode, int *basis, int *err) {
  make(bases(), basis, err, [&](CeedBasis *made) {
    return CeedBasisCreateTensorH1Lagrange(ceed_at(ceed), *dim, *num_comp, *P, *Q,
                                           static_cast<CeedQuadMode>(*quad_mode), made);
  });
}
CEED_EXTERN void ceedbasiscreatetensorh1_(const int *ceed, const int *dim, const int *num_comp, const int *P_1d,
                                          const int *Q_1d, const CeedScalar *interp_1d, const CeedScalar *grad_1d,
                                          const CeedScalar *q_ref_1d, const CeedScalar *q_weight_1d, int *basis,
                                          int *err) {
  make(bases(), basis, err, [&](CeedBasis *made) {
    return CeedBasisCreateTensorH1(ceed_at(ceed), *dim, *num_comp, *P_1d, *Q_1d, interp_1d, grad_1d, q_ref_1d,
                                   q_weight_1d, made);
  });
}
CEED_EXTERN void ceedbasiscreateh1_(const int *ceed, const int *topo, const int *num_comp, const int *num_nodes,
                                    const int *num_qpts, const CeedScalar *interp, const CeedScalar *grad,
                                    const CeedScalar *q_ref, const CeedScalar *q_weight, int *basis, int *err) {
  make(bases(), basis, err, [&](CeedBasis *made) {
    return CeedBasisCreateH1(ceed_at(ceed), static_cast<CeedElemTopology>(*topo), *num_comp, *num_nodes, *num_qpts,
                             interp, grad, q_ref, q_weight, made);
  });
}
CEED_EXTERN void ceedbasiscreatehdiv_(const int *ceed, const int *topo, const int *num_comp, const int *num_nodes,
                                      const int *num_qpts, const CeedScalar *interp, const CeedScalar *div,
                                      const CeedScalar *q_ref, const CeedScalar *q_weight, int *basis, int *err) {
  make(bases(), basis, err, [&](CeedBasis *made) {
    return CeedBasisCreateHdiv(ceed_at(ceed), static_cast<CeedElemTopology>(*topo), *num_comp, *num_nodes, *num_qpts,
                               interp, div, q_ref, q_weight, made);
  });
}
CEED_EXTERN void ceedbasiscreatehcurl_(const int *ceed, const int *topo, const int *num_comp, const int *num_nodes,
                                       const int *num_qpts, const CeedScalar *interp, const CeedScalar *curl,
                                       const CeedScalar *q_ref, const CeedScalar *q_weight, int *basis, int *err) {
  make(bases(), basis, err, [&](CeedBasis *made) {
    return CeedBasisCreateHcurl(ceed_at(ceed), static_cast<CeedElemTopology>(*topo), *num_comp, *num_nodes, *num_qpts,
                                interp, curl, q_ref, q_weight, made);
  });
}
CEED_EXTERN void ceedbasisapply_(const int *basis, const int *num_elem, const int *t_mode, const int *eval_mode,
                                 const int *u, const int *v, int *err) {
  run(err, [&] {
    return CeedBasisApply(basis_at(basis), *num_elem, static_cast<CeedTransposeMode>(*t_mode),
                          static_cast<CeedEvalMode>(*eval_mode), vector_at(u), vector_at(v));
  });
}
CEED_EXTERN void ceedbasisgetnumnodes_(const int *basis, int *num_nodes, int *err) {
  run(err, [&] { return CeedBasisGetNumNodes(basis_at(basis), num_nodes); });
}
CEED_EXTERN void ceedbasisgetnumquadraturepoints_(const int *basis, int *num_qpts, int *err) {
  run(err, [&] { return CeedBasisGetNumQuadraturePoints(basis_at(basis), num_qpts); });
}
CEED_EXTERN void ceedbasisgetcollocatedgrad_(const int *basis, CeedScalar *colo_grad_1d, int *err) {
  run(err, [&] { return CeedBasisGetCollocatedGrad(basis_at(basis), colo_grad_1d); });
}

namespace {

/// A table of a basis, as an offset.
void get_table(const int *basis, const CeedScalar *base, std::int64_t *offset, int *err,
               int (*get)(CeedBasis, const CeedScalar **)) {
  run(err, [&] {
    const CeedScalar *table = nullptr;
    const int code = get(basis_at(basis), &table);
    if (code == CEED_ERROR_SUCCESS) *offset = offset_of(table, base);
    return code;
  });
}

}  // namespace

CEED_EXTERN void ceedbasisgetinterp1d_(const int *basis, CeedScalar *interp_1d, std::int64_t *offset, int *err) {
  get_table(basis, interp_1d, offset, err, CeedBasisGetInterp1D);
}
CEED_EXTERN void ceedbasisgetgrad1d_(const int *basis, CeedScalar *grad_1d, std::int64_t *offset, int *err) {
  get_table(basis, grad_1d, offset, err, CeedBasisGetGrad1D);
}
CEED_EXTERN void ceedbasisgetqref_(const int *basis, CeedScalar *q_ref, std::int64_t *offset, int *err) {
  get_table(basis, q_ref, offset, err, CeedBasisGetQRef);
}
CEED_EXTERN void ceedbasissetnumviewtabs_(const int *basis, const int *num_tabs, int *err) {
  run(err, [&] { return CeedBasisSetNumViewTabs(basis_at(basis), *num_tabs); });
}
CEED_EXTERN void ceedbasisview_(const int *basis, int *err) {
  run(err, [&] { return CeedBasisView(basis_at(basis), stdout); });
}
CEED_EXTERN void ceedbasisdestroy_(int *basis, int *err) { destroy(bases(), basis, err, CeedBasisDestroy); }
