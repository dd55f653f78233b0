#include "context.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "view.hpp"

namespace {

CeedQFunctionContext_private &deref_context(CeedQFunctionContext ctx, hg::Where where = hg::Where::current()) {
  return hg::deref(ctx, "CeedQFunctionContext", where);
}

void require_writable(const CeedQFunctionContext_private &c, hg::Where where = hg::Where::current()) {
  hg::require(!c.has_writer(), CEED_ERROR_ACCESS,
              "Cannot grant CeedQFunctionContext data access, the access lock is already in use", where);
  hg::require(c.num_readers == 0, CEED_ERROR_ACCESS,
              "Cannot grant CeedQFunctionContext data access, a process has read access", where);
}

void require_readable(const CeedQFunctionContext_private &c, hg::Where where = hg::Where::current()) {
  hg::require(!c.has_writer(), CEED_ERROR_ACCESS,
              "Cannot grant CeedQFunctionContext data access, the access lock is already in use", where);
}

void require_data(const CeedQFunctionContext_private &c, hg::Where where = hg::Where::current()) {
  hg::require(c.values != nullptr, CEED_ERROR_INCOMPLETE,
              "CeedQFunctionContext holds no data; set them first, with CeedQFunctionContextSetData()", where);
}

/// QFunctions of host backends read the data where the core keeps them; device backends copy from there.
void require_host(const CeedQFunctionContext_private &c, CeedMemType mem_type, const char *what,
                  hg::Where where = hg::Where::current()) {
  hg::require_mem_type(*c.ceed, mem_type, what);
  hg::require(
      mem_type == CEED_MEM_HOST, CEED_ERROR_UNSUPPORTED,
      [&] { return hg::text("%s: memory type is CEED_MEM_DEVICE; expected CEED_MEM_HOST", what); }, where);
}

void require_inside(const CeedQFunctionContext_private &c, const CeedContextFieldLabel_private &label,
                    hg::Where where = hg::Where::current()) {
  hg::require(
      label.offset <= c.size && label.size <= c.size - label.offset, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text(
            "CeedQFunctionContext field \"%s\" takes %zu bytes from offset %zu; expected it within the %zu bytes "
            "of the data",
            label.name.c_str(), label.size, label.offset, c.size);
      },
      where);
}

/// Counts a reader; the backend hears of the first and of the last.
void begin_reading(CeedQFunctionContext_private &c) {
  const auto get = c.ceed->ops.context.get_data_read;
  if (c.num_readers == 0 && get != nullptr) hg::check(get(&c, c.size, c.values));
  c.num_readers++;
}

void end_reading(CeedQFunctionContext_private &c) {
  c.num_readers--;
  const auto restore = c.ceed->ops.context.restore_data_read;
  if (c.num_readers == 0 && restore != nullptr) hg::check(restore(&c, c.size, c.values));
}

int add_field(CeedQFunctionContext ctx, const char *name, CeedContextFieldType type, std::size_t value_size,
              std::size_t offset, std::size_t num_values, const char *description,
              const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(ctx),
      [&] {
        auto &c = deref_context(ctx);
        hg::require(name != nullptr && name[0] != '\0', CEED_ERROR_MINOR,
                    "CeedQFunctionContext field: the name is NULL or empty; expected text");
        for (const auto &label : c.labels) {
          hg::require(label.name != name, CEED_ERROR_UNSUPPORTED, [&] {
            return hg::text("CeedQFunctionContext field with name \"%s\" already registered; expected a new name",
                            name);
          });
        }
        hg::require(num_values >= 1, CEED_ERROR_DIMENSION, [&] {
          return hg::text("CeedQFunctionContext field \"%s\" has %zu values; expected 1 or more", name, num_values);
        });
        CeedContextFieldLabel_private label;
        label.name = name;
        label.description = description != nullptr ? description : "";
        label.type = type;
        label.offset = offset;
        label.num_values = num_values;
        label.size = num_values * value_size;
        hg::require(label.size / value_size == num_values, CEED_ERROR_DIMENSION, [&] {
          return hg::text("CeedQFunctionContext field \"%s\" has %zu values; expected fewer", name, num_values);
        });
        // Fields may be registered before there are data; then they are checked when they are used.
        if (c.values != nullptr) require_inside(c, label);
        c.label_list.reserve(c.labels.size() + 1);
        c.labels.push_back(std::move(label));
        c.label_list.push_back(&c.labels.back());
      },
      function);
}

/// The label's values in the data of this context. Labels of another context, or of a composite operator, are refused.
void *field_values(CeedQFunctionContext_private &c, CeedContextFieldLabel label, CeedContextFieldType type,
                   hg::Where where = hg::Where::current()) {
  hg::require(
      label != nullptr, CEED_ERROR_UNSUPPORTED,
      "Invalid CeedQFunctionContext field label: it is NULL; expected one from CeedQFunctionContextGetFieldLabel()",
      where);
  hg::require(
      std::find(c.label_list.begin(), c.label_list.end(), label) != c.label_list.end(), CEED_ERROR_UNSUPPORTED,
      [&] {
        return hg::text("CeedQFunctionContext field label \"%s\" belongs to another object", label->name.c_str());
      },
      where);
  hg::require(
      label->type == type, CEED_ERROR_UNSUPPORTED,
      [&] {
        return hg::text("CeedQFunctionContext field \"%s\" is registered as %s; expected %s", label->name.c_str(),
                        CeedContextFieldTypes[label->type], CeedContextFieldTypes[type]);
      },
      where);
  require_data(c, where);
  require_inside(c, *label, where);
  return static_cast<char *>(c.values) + label->offset;
}

template <typename T>
int set_field(CeedQFunctionContext ctx, CeedContextFieldLabel label, CeedContextFieldType type, const T *values,
              const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(ctx),
      [&] {
        auto &c = deref_context(ctx);
        require_writable(c);
        void *place = field_values(c, label, type);
        hg::require(values != nullptr, CEED_ERROR_MINOR, [&] {
          return hg::text("CeedQFunctionContext field \"%s\": the values are NULL; expected %zu", label->name.c_str(),
                          label->num_values);
        });
        std::memcpy(place, values, label->size);
        c.state += 2;
      },
      function);
}

template <typename T>
int get_field(CeedQFunctionContext ctx, CeedContextFieldLabel label, CeedContextFieldType type, std::size_t *num_values,
              const T **values, const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(ctx),
      [&] {
        auto &c = deref_context(ctx);
        const std::scoped_lock lock(c.access);
        require_readable(c);
        hg::result(values, "values") = static_cast<const T *>(field_values(c, label, type));
        if (num_values != nullptr) *num_values = label->num_values;
        begin_reading(c);
      },
      function);
}

/// Ends a read access; `data` is the address of a pointer, or NULL.
int restore_read(CeedQFunctionContext ctx, void *data, const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(ctx),
      [&] {
        auto &c = deref_context(ctx);
        const std::scoped_lock lock(c.access);
        hg::require(c.num_readers > 0, CEED_ERROR_ACCESS,
                    "Cannot restore CeedQFunctionContext data read access, access was not granted");
        if (data != nullptr) *static_cast<void **>(data) = nullptr;
        end_reading(c);
      },
      function);
}

}  // namespace

void CeedQFunctionContext_private::forget() {
  if (values != nullptr && data_destroy != nullptr) {
    const int code = data_destroy(values);
    hg::require(code == CEED_ERROR_SUCCESS, CEED_ERROR_MAJOR, [&] {
      return hg::text("CeedQFunctionContext: the function that destroys the data returned %d; expected 0", code);
    });
  }
  values = nullptr;
  allocated.reset();
}

CeedQFunctionContext_private::~CeedQFunctionContext_private() {
  hg::guard(ceed.get(), [&] { forget(); });
}

void CeedQFunctionContext_private::check_destroyable() const {
  hg::require(!has_writer(), CEED_ERROR_ACCESS, "Cannot destroy CeedQFunctionContext, the access lock is in use");
  hg::require(num_readers == 0, CEED_ERROR_ACCESS, "Cannot destroy CeedQFunctionContext, a process has read access");
}

void CeedQFunctionContext_private::view(FILE *stream) const {
  const hg::Lines line(stream, num_view_tabs);
  line(0, "CeedQFunctionContext");
  line(1, "Context Data Size: %zu", size);
  for (const auto &label : labels) {
    line(1, "Labeled %s field: %s", CeedContextFieldTypes[label.type], label.name.c_str());
  }
}

int CeedQFunctionContextCreate(Ceed ceed, CeedQFunctionContext *ctx) {
  return hg::guard(ceed, [&] {
    hg::deref(ceed, "Ceed");
    hg::require(ctx != nullptr, CEED_ERROR_MINOR,
                "CeedQFunctionContextCreate: the address of the handle is NULL; expected where it goes");
    auto created = hg::Ref<CeedQFunctionContext_private>::adopt(new CeedQFunctionContext_private);
    created->ceed = hg::Ref<Ceed_private>(ceed);
    *ctx = created.release();
  });
}

int CeedQFunctionContextReferenceCopy(CeedQFunctionContext ctx, CeedQFunctionContext *ctx_copy) {
  return hg::guard(hg::ceed_of(ctx), [&] { hg::reference_copy(ctx, ctx_copy); });
}

int CeedQFunctionContextReference(CeedQFunctionContext ctx) {
  return hg::guard(hg::ceed_of(ctx), [&] { hg::reference(&deref_context(ctx)); });
}

int CeedQFunctionContextDestroy(CeedQFunctionContext *ctx) {
  return hg::guard(ctx != nullptr ? hg::ceed_of(*ctx) : nullptr, [&] { hg::destroy(ctx); });
}

int CeedQFunctionContextSetData(CeedQFunctionContext ctx, CeedMemType mem_type, CeedCopyMode copy_mode, size_t size,
                                void *data) {
  return hg::guard(hg::ceed_of(ctx), [&] {
    auto &c = deref_context(ctx);
    require_writable(c);
    require_host(c, mem_type, "CeedQFunctionContextSetData");
    hg::require(data != nullptr || size == 0, CEED_ERROR_MINOR,
                [&] { return hg::text("CeedQFunctionContextSetData: the data are NULL; expected %zu bytes", size); });
    std::unique_ptr<void, CeedQFunctionContext_private::Free> block;
    switch (copy_mode) {
      case CEED_COPY_VALUES:
        block.reset(std::malloc(std::max<std::size_t>(size, 1)));
        if (!block) throw std::bad_alloc();
        if (size > 0) std::memcpy(block.get(), data, size);
        data = block.get();
        break;
      case CEED_OWN_POINTER:
      case CEED_USE_POINTER:
        break;
      default:
        throw hg::Error(CEED_ERROR_MINOR,
                        hg::text("CeedQFunctionContextSetData: copy mode is %d; expected CEED_COPY_VALUES (0), "
                                 "CEED_USE_POINTER (1) or CEED_OWN_POINTER (2)",
                                 static_cast<int>(copy_mode)));
    }
    c.forget();
    if (copy_mode == CEED_OWN_POINTER) block.reset(data);
    c.values = data;
    c.allocated = std::move(block);
    c.size = size;
    c.state += 2;
  });
}

int CeedQFunctionContextTakeData(CeedQFunctionContext ctx, CeedMemType mem_type, void *data) {
  return hg::guard(hg::ceed_of(ctx), [&] {
    auto &c = deref_context(ctx);
    require_writable(c);
    require_host(c, mem_type, "CeedQFunctionContextTakeData");
    require_data(c);
    hg::require(
        c.is_borrowed(), CEED_ERROR_INCOMPLETE,
        "CeedQFunctionContext has no borrowed data to take; lend it some with CeedQFunctionContextSetData() and "
        "CEED_USE_POINTER");
    if (data != nullptr) *static_cast<void **>(data) = c.values;
    c.values = nullptr;
    c.state += 2;
  });
}

int CeedQFunctionContextGetData(CeedQFunctionContext ctx, CeedMemType mem_type, void *data) {
  return hg::guard(hg::ceed_of(ctx), [&] {
    auto &c = deref_context(ctx);
    const std::scoped_lock lock(c.access);
    // The function's name stands in the message that programs look for, so this is not shared with the other checks.
    require_writable(c);
    require_host(c, mem_type, "CeedQFunctionContextGetData");
    require_data(c);
    hg::result(static_cast<void **>(data), "data") = c.values;
    c.state++;
  });
}

int CeedQFunctionContextGetDataRead(CeedQFunctionContext ctx, CeedMemType mem_type, void *data) {
  return hg::guard(hg::ceed_of(ctx), [&] {
    auto &c = deref_context(ctx);
    const std::scoped_lock lock(c.access);
    require_readable(c);
    require_host(c, mem_type, "CeedQFunctionContextGetDataRead");
    require_data(c);
    hg::result(static_cast<void **>(data), "data") = c.values;
    begin_reading(c);
  });
}

int CeedQFunctionContextRestoreData(CeedQFunctionContext ctx, void *data) {
  return hg::guard(hg::ceed_of(ctx), [&] {
    auto &c = deref_context(ctx);
    const std::scoped_lock lock(c.access);
    hg::require(c.has_writer(), CEED_ERROR_ACCESS,
                "Cannot restore CeedQFunctionContext data access, access was not granted");
    if (data != nullptr) *static_cast<void **>(data) = nullptr;
    c.state++;
  });
}

int CeedQFunctionContextRestoreDataRead(CeedQFunctionContext ctx, void *data) {
  return restore_read(ctx, data);
}

int CeedQFunctionContextSetDataDestroy(CeedQFunctionContext ctx, CeedMemType f_mem_type,
                                       CeedQFunctionContextDataDestroyUser f) {
  return hg::guard(hg::ceed_of(ctx), [&] {
    auto &c = deref_context(ctx);
    require_host(c, f_mem_type, "CeedQFunctionContextSetDataDestroy");
    c.data_destroy = f;
  });
}

int CeedQFunctionContextRegisterDouble(CeedQFunctionContext ctx, const char *field_name, size_t field_offset,
                                       size_t num_values, const char *field_description) {
  return add_field(ctx, field_name, CEED_CONTEXT_FIELD_DOUBLE, sizeof(double), field_offset, num_values,
                   field_description);
}

int CeedQFunctionContextRegisterInt32(CeedQFunctionContext ctx, const char *field_name, size_t field_offset,
                                      size_t num_values, const char *field_description) {
  return add_field(ctx, field_name, CEED_CONTEXT_FIELD_INT32, sizeof(int32_t), field_offset, num_values,
                   field_description);
}

int CeedQFunctionContextRegisterBoolean(CeedQFunctionContext ctx, const char *field_name, size_t field_offset,
                                        size_t num_values, const char *field_description) {
  return add_field(ctx, field_name, CEED_CONTEXT_FIELD_BOOL, sizeof(bool), field_offset, num_values, field_description);
}

int CeedQFunctionContextGetAllFieldLabels(CeedQFunctionContext ctx, const CeedContextFieldLabel **field_labels,
                                          CeedInt *num_fields) {
  return hg::guard(hg::ceed_of(ctx), [&] {
    auto &c = deref_context(ctx);
    if (field_labels != nullptr) *field_labels = c.label_list.data();
    if (num_fields != nullptr) *num_fields = static_cast<CeedInt>(c.label_list.size());
  });
}

int CeedQFunctionContextGetFieldLabel(CeedQFunctionContext ctx, const char *field_name,
                                      CeedContextFieldLabel *field_label) {
  return hg::guard(hg::ceed_of(ctx), [&] {
    auto &c = deref_context(ctx);
    hg::require(field_name != nullptr, CEED_ERROR_MINOR, "CeedQFunctionContext field: the name is NULL; expected text");
    const auto found =
        std::find_if(c.labels.begin(), c.labels.end(), [&](auto &label) { return label.name == field_name; });
    hg::result(field_label, "field_label") = found != c.labels.end() ? &*found : nullptr;
  });
}

int CeedContextFieldLabelGetDescription(CeedContextFieldLabel label, const char **field_name, size_t *field_offset,
                                        size_t *num_values, const char **field_description,
                                        CeedContextFieldType *field_type) {
  return hg::guard(nullptr, [&] {
    auto &l = hg::deref(label, "CeedContextFieldLabel");
    if (field_name != nullptr) *field_name = l.name.c_str();
    if (field_offset != nullptr) *field_offset = l.offset;
    if (num_values != nullptr) *num_values = l.num_values;
    if (field_description != nullptr) *field_description = l.description.c_str();
    if (field_type != nullptr) *field_type = l.type;
  });
}

int CeedQFunctionContextGetContextSize(CeedQFunctionContext ctx, size_t *ctx_size) {
  return hg::guard(hg::ceed_of(ctx), [&] { hg::result(ctx_size, "ctx_size") = deref_context(ctx).size; });
}

int CeedQFunctionContextSetNumViewTabs(CeedQFunctionContext ctx, CeedInt num_tabs) {
  return hg::set_view_tabs(ctx, num_tabs);
}

int CeedQFunctionContextGetNumViewTabs(CeedQFunctionContext ctx, CeedInt *num_tabs) {
  return hg::get_view_tabs(ctx, num_tabs);
}

int CeedQFunctionContextView(CeedQFunctionContext ctx, FILE *stream) {
  return hg::view_object(ctx, stream);
}

int CeedQFunctionContextGetCeed(CeedQFunctionContext ctx, Ceed *ceed) {
  return hg::get_ceed(ctx, ceed);
}

Ceed CeedQFunctionContextReturnCeed(CeedQFunctionContext ctx) {
  return hg::ceed_of(ctx);
}

int CeedQFunctionContextHasValidData(CeedQFunctionContext ctx, bool *has_valid_data) {
  return hg::guard(hg::ceed_of(ctx),
                   [&] { hg::result(has_valid_data, "has_valid_data") = deref_context(ctx).values != nullptr; });
}

int CeedQFunctionContextHasBorrowedDataOfType(CeedQFunctionContext ctx, CeedMemType mem_type,
                                              bool *has_borrowed_data_of_type) {
  return hg::guard(hg::ceed_of(ctx), [&] {
    auto &c = deref_context(ctx);
    hg::require(mem_type == CEED_MEM_HOST || mem_type == CEED_MEM_DEVICE, CEED_ERROR_MINOR, [&] {
      return hg::text("CeedQFunctionContext: memory type is %d; expected CEED_MEM_HOST (0) or CEED_MEM_DEVICE (1)",
                      static_cast<int>(mem_type));
    });
    hg::result(has_borrowed_data_of_type, "has_borrowed_data_of_type") = mem_type == CEED_MEM_HOST && c.is_borrowed();
  });
}

int CeedQFunctionContextGetState(CeedQFunctionContext ctx, uint64_t *state) {
  return hg::guard(hg::ceed_of(ctx), [&] { hg::result(state, "state") = deref_context(ctx).state; });
}

int CeedQFunctionContextSetDouble(CeedQFunctionContext ctx, CeedContextFieldLabel field_label, double *values) {
  return set_field(ctx, field_label, CEED_CONTEXT_FIELD_DOUBLE, values);
}

int CeedQFunctionContextGetDoubleRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label, size_t *num_values,
                                      const double **values) {
  return get_field(ctx, field_label, CEED_CONTEXT_FIELD_DOUBLE, num_values, values);
}

int CeedQFunctionContextRestoreDoubleRead(CeedQFunctionContext ctx, CeedContextFieldLabel, const double **values) {
  return restore_read(ctx, static_cast<void *>(values));
}

int CeedQFunctionContextSetInt32(CeedQFunctionContext ctx, CeedContextFieldLabel field_label, int32_t *values) {
  return set_field(ctx, field_label, CEED_CONTEXT_FIELD_INT32, values);
}

int CeedQFunctionContextGetInt32Read(CeedQFunctionContext ctx, CeedContextFieldLabel field_label, size_t *num_values,
                                     const int32_t **values) {
  return get_field(ctx, field_label, CEED_CONTEXT_FIELD_INT32, num_values, values);
}

int CeedQFunctionContextRestoreInt32Read(CeedQFunctionContext ctx, CeedContextFieldLabel, const int32_t **values) {
  return restore_read(ctx, static_cast<void *>(values));
}

int CeedQFunctionContextSetBoolean(CeedQFunctionContext ctx, CeedContextFieldLabel field_label, bool *values) {
  return set_field(ctx, field_label, CEED_CONTEXT_FIELD_BOOL, values);
}

int CeedQFunctionContextGetBooleanRead(CeedQFunctionContext ctx, CeedContextFieldLabel field_label, size_t *num_values,
                                       const bool **values) {
  return get_field(ctx, field_label, CEED_CONTEXT_FIELD_BOOL, num_values, values);
}

int CeedQFunctionContextRestoreBooleanRead(CeedQFunctionContext ctx, CeedContextFieldLabel, const bool **values) {
  return restore_read(ctx, static_cast<void *>(values));
}
