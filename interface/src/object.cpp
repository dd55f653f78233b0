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

int view_object(const CeedObject_private *object, FILE *stream, const char *function) {
  return guard(
      ceed_of(object),
      [&] {
        const auto &shown = deref(object, "Object to view");
        require(stream != nullptr, CEED_ERROR_MINOR, "The stream is NULL; expected an open file");
        shown.view(stream);
      },
      function);
}

int set_view_tabs(CeedObject_private *object, CeedInt num_tabs, const char *function) {
  return guard(
      ceed_of(object),
      [&] {
        require(num_tabs >= 0, CEED_ERROR_MINOR, [&] {
          return text("Number of view tabs is %" CeedInt_FMT "; expected a non-negative number", num_tabs);
        });
        auto &shown = deref(object, "Object to view");
        if (!shown.is_sentinel) shown.num_view_tabs = num_tabs;
      },
      function);
}

int get_view_tabs(const CeedObject_private *object, CeedInt *num_tabs, const char *function) {
  return guard(
      ceed_of(object), [&] { result(num_tabs, "num_tabs") = deref(object, "Object to view").num_view_tabs; }, function);
}

int get_ceed(const CeedObject_private *object, Ceed *ceed, const char *function) {
  return guard(
      ceed_of(object),
      [&] {
        hand_out(deref(object, "Object of a Ceed").owner(), ceed, "ceed");
      },
      function);
}

}  // namespace hg

int CeedObjectView(CeedObject obj, FILE *stream) {
  return hg::view_object(obj, stream);
}

int CeedObjectSetNumViewTabs(CeedObject obj, CeedInt num_tabs) {
  return hg::set_view_tabs(obj, num_tabs);
}

int CeedObjectGetNumViewTabs(CeedObject obj, CeedInt *num_tabs) {
  return hg::get_view_tabs(obj, num_tabs);
}

int CeedObjectGetCeed(CeedObject obj, Ceed *ceed) {
  return hg::get_ceed(obj, ceed);
}

Ceed CeedObjectReturnCeed(CeedObject obj) {
  return hg::ceed_of(obj);
}

int CeedObjectDestroy(CeedObject *obj) {
  return hg::guard(obj != nullptr ? hg::ceed_of(*obj) : nullptr, [&] { hg::destroy(obj); });
}
