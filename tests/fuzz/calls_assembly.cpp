// Calls that make matrices of operators, and other operators of them.
#include <algorithm>
#include <cstdlib>

#include "objects.hpp"

namespace hg::fuzz {
namespace {

/// A vector of the length, or any.
CeedVector sized(Objects &o, CeedSize length) {
  return o.bytes.next_byte() >= 192 || length < 0 ? o.vector() : o.temporary(length, 0);
}

CeedSize input_length(CeedOperator op) {
  CeedSize in = 0;
  return op != nullptr && CeedOperatorGetActiveVectorLengths(op, &in, nullptr) == CEED_ERROR_SUCCESS ? in : 0;
}

int assemble_qfunction(Objects &o) {
  const CeedOperator op = o.op();
  const bool is_updated = o.flag();
  CeedVector assembled = nullptr;
  CeedElemRestriction rstr = nullptr;
  const int code = is_updated ? CeedOperatorLinearAssembleQFunctionBuildOrUpdate(op, &assembled, &rstr, o.request())
                              : CeedOperatorLinearAssembleQFunction(op, &assembled, &rstr, o.request());
  if (code != CEED_ERROR_SUCCESS && (assembled != nullptr || rstr != nullptr)) {
    throw Defect("a failed assembly left handles");
  }
  CeedVectorDestroy(&assembled);
  CeedElemRestrictionDestroy(&rstr);
  return code;
}

template <int (*Assemble)(CeedOperator, CeedVector, CeedRequest *)>
int diagonal(Objects &o) {
  const CeedOperator op = o.op();
  return Assemble(op, sized(o, input_length(op)), o.request());
}

template <int (*Assemble)(CeedOperator, CeedVector, CeedRequest *)>
int point_blocks(Objects &o) {
  const CeedOperator op = o.op();
  CeedSize num = 0;
  CeedInt *rows = nullptr, *cols = nullptr;
  if (op != nullptr && o.flag()) CeedOperatorLinearAssemblePointBlockDiagonalSymbolic(op, &num, &rows, &cols);
  std::free(rows);
  std::free(cols);
  return Assemble(op, sized(o, std::min<CeedSize>(num, 1 << 20)), o.request());
}

int symbolic(Objects &o) {
  const CeedOperator op = o.op();
  CeedSize num = 0, again = 0;
  CeedInt *rows = nullptr, *cols = nullptr;
  int code = CeedOperatorLinearAssembleGetNumEntries(op, &num);
  if (code != CEED_ERROR_SUCCESS || num > 1 << 20) return code;
  code = CeedOperatorLinearAssembleSymbolic(op, &again, &rows, &cols);
  std::free(rows);
  std::free(cols);
  if (code == CEED_ERROR_SUCCESS && num != again) throw Defect("two counts of the entries differ");
  return code;
}

int assemble(Objects &o) {
  const CeedOperator op = o.op();
  CeedSize num = 0;
  const int code = CeedOperatorLinearAssembleGetNumEntries(op, &num);
  if (code != CEED_ERROR_SUCCESS || num > 1 << 20) return code;
  return CeedOperatorLinearAssemble(op, sized(o, num));
}

int coarsen(Objects &o) {
  const int kind = o.bytes.next_byte() % 3;
  const CeedOperator fine = o.op();
  const CeedVector multiplicity = sized(o, input_length(fine));
  const CeedElemRestriction rstr = o.restriction();
  const CeedBasis basis = o.basis();
  const CeedScalar *interp = o.scalars(64 * 64);
  const int wanted = o.bytes.next_byte();
  CeedOperator coarse = nullptr, prolong = nullptr, restricted = nullptr;
  CeedOperator *const p = (wanted & 1) != 0 ? nullptr : &prolong, *const r = (wanted & 2) != 0 ? nullptr : &restricted;
  const CeedVector mult = (wanted & 12) == 12 ? nullptr : multiplicity;
  const int code = kind == 0 ? CeedOperatorMultigridLevelCreate(fine, mult, rstr, basis, &coarse, p, r)
                   : kind == 1
                       ? CeedOperatorMultigridLevelCreateTensorH1(fine, mult, rstr, basis, interp, &coarse, p, r)
                       : CeedOperatorMultigridLevelCreateH1(fine, mult, rstr, basis, interp, &coarse, p, r);
  if (code != CEED_ERROR_SUCCESS && (coarse != nullptr || prolong != nullptr || restricted != nullptr)) {
    throw Defect("a failed multigrid level left handles");
  }
  if (coarse != nullptr) o.operators.put(3, coarse);
  if (prolong != nullptr) o.operators.put(4, prolong);
  if (restricted != nullptr) o.operators.put(5, restricted);
  return code;
}

const Call calls[] = {
    {"CeedOperatorLinearAssembleQFunction", false, assemble_qfunction},
    {"CeedOperatorLinearAssembleDiagonal", true, diagonal<CeedOperatorLinearAssembleDiagonal>},
    {"CeedOperatorLinearAssembleAddDiagonal", true, diagonal<CeedOperatorLinearAssembleAddDiagonal>},
    {"CeedOperatorLinearAssemblePointBlockDiagonal", true, point_blocks<CeedOperatorLinearAssemblePointBlockDiagonal>},
    {"CeedOperatorLinearAssembleAddPointBlockDiagonal", true,
     point_blocks<CeedOperatorLinearAssembleAddPointBlockDiagonal>},
    {"CeedOperatorLinearAssembleSymbolic", false, symbolic},
    {"CeedOperatorLinearAssemble", true, assemble},
    {"CeedOperatorSetQFunctionAssemblyReuse", false,
     [](Objects &o) {
       const CeedOperator op = o.op();
       return CeedOperatorSetQFunctionAssemblyReuse(op, o.flag());
     }},
    {"CeedOperatorSetQFunctionAssemblyDataUpdateNeeded", false,
     [](Objects &o) {
       const CeedOperator op = o.op();
       return CeedOperatorSetQFunctionAssemblyDataUpdateNeeded(op, o.flag());
     }},
    {"CeedOperatorAssemblyDataStrip", false, [](Objects &o) { return CeedOperatorAssemblyDataStrip(o.op()); }},
    {"CeedOperatorMultigridLevelCreate", false, coarsen},
    {"CeedOperatorCreateFDMElementInverse", false,
     [](Objects &o) {
       const CeedOperator op = o.op();
       return o.create(o.operators, [&](CeedOperator *inverse) {
         return CeedOperatorCreateFDMElementInverse(op, inverse, o.request());
       });
     }},
};

}  // namespace

std::span<const Call> assembly_calls() {
  return calls;
}

}  // namespace hg::fuzz
