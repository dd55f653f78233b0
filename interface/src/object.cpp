#include "object.hpp"

#include <cstdio>

#include "ceed.hpp"

namespace hg {

void dereference(CeedObject_private *object) {
  if (object->is_sentinel || object->ref_count.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
  try {
    object->check_destroyable();
  } catch (...) {
    object->ref_count.store(1, std::memory_order_release);
    throw;
  }
  delete object;
}

}  // namespace hg

int CeedObjectView(CeedObject obj, FILE *stream) {
  return hg::guard(hg::ceed_of(obj), [&] {
    hg::require(stream != nullptr, CEED_ERROR_MINOR, "CeedObjectView: the stream is NULL; expected an open file");
    hg::deref(obj, "CeedObject").view(stream);
  });
}

int CeedObjectSetNumViewTabs(CeedObject obj, CeedInt num_tabs) {
  return hg::guard(hg::ceed_of(obj), [&] {
    hg::require(num_tabs >= 0, CEED_ERROR_MINOR, [&] {
      return hg::text("Number of view tabs is %" CeedInt_FMT "; expected a non-negative number", num_tabs);
    });
    auto &object = hg::deref(obj, "CeedObject");
    if (!object.is_sentinel) object.num_view_tabs = num_tabs;
  });
}

int CeedObjectGetNumViewTabs(CeedObject obj, CeedInt *num_tabs) {
  return hg::guard(hg::ceed_of(obj), [&] { *num_tabs = hg::deref(obj, "CeedObject").num_view_tabs; });
}

int CeedObjectGetCeed(CeedObject obj, Ceed *ceed) {
  return hg::guard(hg::ceed_of(obj), [&] {
    Ceed owner = hg::deref(obj, "CeedObject").owner();
    hg::reference(owner);
    *ceed = owner;
  });
}

Ceed CeedObjectReturnCeed(CeedObject obj) {
  return hg::ceed_of(obj);
}

int CeedObjectDestroy(CeedObject *obj) {
  return hg::guard(obj != nullptr ? hg::ceed_of(*obj) : nullptr, [&] { hg::destroy(obj); });
}
