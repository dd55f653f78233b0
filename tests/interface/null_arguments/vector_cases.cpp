#include "cases.hpp"

namespace hg::test {

std::vector<Case> vector_cases() {
  return {
      HG_CASE(CeedVectorCreate, o.ceed, 3, &o.made_vector),
      HG_CASE_NULLS(CeedVectorReference, o.x),
      HG_CASE(CeedVectorReferenceCopy, o.x, &o.made_vector),
      HG_CASE(CeedVectorDestroy, optional(&o.x)),
      HG_CASE(CeedVectorCopy, o.x, o.y),
      HG_CASE(CeedVectorCopyStrided, o.x, 0, 4, 2, o.y),
      HG_CASE(CeedVectorSetArray, o.x, CEED_MEM_HOST, CEED_COPY_VALUES, o.matrix),
      HG_CASE(CeedVectorSetValue, o.x, 1.0),
      HG_CASE(CeedVectorSetValueStrided, o.x, 0, 4, 2, 1.0),
      HG_CASE(CeedVectorSyncArray, o.x, CEED_MEM_HOST),
      HG_CASE_AFTER(CeedVectorSetArray(o.x, CEED_MEM_HOST, CEED_USE_POINTER, o.matrix), CeedVectorTakeArray, o.x,
                    CEED_MEM_HOST, optional(&o.array)),
      HG_CASE(CeedVectorGetArray, o.x, CEED_MEM_HOST, &o.array),
      HG_CASE(CeedVectorGetArrayRead, o.x, CEED_MEM_HOST, &o.read_array),
      HG_CASE(CeedVectorGetArrayWrite, o.x, CEED_MEM_HOST, &o.array),
      HG_CASE_AFTER(CeedVectorGetArray(o.x, CEED_MEM_HOST, &o.array), CeedVectorRestoreArray, o.x, optional(&o.array)),
      HG_CASE_AFTER(CeedVectorGetArrayRead(o.x, CEED_MEM_HOST, &o.read_array), CeedVectorRestoreArrayRead, o.x,
                    optional(&o.read_array)),
      HG_CASE(CeedVectorNorm, o.x, CEED_NORM_2, &o.scalar),
      HG_CASE(CeedVectorScale, o.x, 2.0),
      HG_CASE(CeedVectorFilter, o.x, 0.1),
      HG_CASE(CeedVectorAXPY, o.y, 2.0, o.x),
      HG_CASE(CeedVectorAXPBY, o.y, 2.0, 3.0, o.x),
      HG_CASE(CeedVectorPointwiseMult, o.w, o.x, o.y),
      HG_CASE(CeedVectorReciprocal, o.x),
      HG_CASE(CeedVectorSetNumViewTabs, o.x, 1),
      HG_CASE(CeedVectorGetNumViewTabs, o.x, &o.number),
      HG_CASE(CeedVectorViewRange, o.x, 0, 3, 1, optional("%g"), o.stream),
      HG_CASE(CeedVectorView, o.x, optional("%g"), o.stream),
      HG_CASE(CeedVectorGetCeed, o.x, &o.made_ceed),
      HG_CASE(CeedVectorReturnCeed, o.x),
      HG_CASE(CeedVectorGetLength, o.x, &o.size),
      HG_CASE(CeedVectorHasValidArray, o.x, &o.flag),
      HG_CASE(CeedVectorHasBorrowedArrayOfType, o.x, CEED_MEM_HOST, &o.flag),
      HG_CASE(CeedVectorGetState, o.x, &o.state),
      HG_CASE_NULLS(CeedVectorGetData, o.x, static_cast<void *>(&o.pointer)),
      HG_CASE(CeedRequestWait, &o.request),
  };
}

}  // namespace hg::test
