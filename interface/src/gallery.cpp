/// The QFunctions that can be asked for by name.
#include <gallery.h>

#include <cstring>
#include <mutex>

#include "qfunction.hpp"

namespace {

const HgGalleryEntry &entry_named(const char *name) {
  for (const HgGalleryEntry *entry = hg_gallery; entry->name != nullptr; entry++) {
    if (std::strcmp(entry->name, name) == 0) return *entry;
  }
  throw hg::Error(CEED_ERROR_UNSUPPORTED, hg::text("'%s' is not in the gallery", name));
}

/// Adds the fields of a gallery QFunction; those that have none count the components of the fields they are given.
int init(Ceed ceed, const char *name, CeedQFunction qf) {
  return hg::guard(ceed, [&] {
    const HgGalleryEntry &entry = entry_named(name);
    for (CeedInt i = 0; i < entry.num_inputs; i++) {
      hg::check(CeedQFunctionAddInput(qf, entry.inputs[i].name, entry.inputs[i].size, entry.inputs[i].eval_mode));
    }
    for (CeedInt i = 0; i < entry.num_outputs; i++) {
      hg::check(CeedQFunctionAddOutput(qf, entry.outputs[i].name, entry.outputs[i].size, entry.outputs[i].eval_mode));
    }
    qf->is_context_writable = false;
    if (!entry.takes_num_comp) return;
    CeedQFunctionContext context = nullptr;
    hg::check(CeedQFunctionContextCreate(ceed, &context));
    const auto held = hg::Ref<CeedQFunctionContext_private>::adopt(context);
    CeedInt size = 1;
    hg::check(CeedQFunctionContextSetData(context, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof size, &size));
    hg::check(CeedQFunctionContextRegisterInt32(context, "size", 0, 1, "components of the field"));
    hg::check(CeedQFunctionSetContext(qf, context));
    qf->counts_components = true;
  });
}

}  // namespace

int CeedQFunctionRegisterAll(void) {
  static std::mutex mutex;
  static bool is_done = false;
  return hg::guard(nullptr, [] {
    // Not std::call_once(): what was thrown in it hangs the next call under the thread sanitizer.
    const std::scoped_lock lock(mutex);
    if (is_done) return;
    for (const HgGalleryEntry *entry = hg_gallery; entry->name != nullptr; entry++) {
      hg::check(CeedQFunctionRegister(entry->name, entry->source, 1, entry->function, init));
    }
    is_done = true;
  });
}
