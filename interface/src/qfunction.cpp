#include "qfunction.hpp"

#include <ceed/cuda.h>
#include <ceed/hip.h>

#include <map>
#include <mutex>

#include "vector.hpp"
#include "view.hpp"

namespace {

struct NoneQFunction {
  NoneQFunction() { object.is_sentinel = true; }
  CeedQFunction_private object;
};
NoneQFunction none;

/// A QFunction that can be created by name.
struct Registered {
  std::string source;
  CeedInt vec_length;
  CeedQFunctionUser function;
  int (*init)(Ceed, const char *, CeedQFunction);
};

struct QFunctionRegistry {
  std::mutex mutex;
  std::map<std::string, Registered, std::less<>> entries;
};

QFunctionRegistry &qfunction_registry() {
  static QFunctionRegistry registry;
  return registry;
}

void split_source(const char *source, CeedQFunction_private &qf) {
  if (source == nullptr) return;
  const std::string_view text = source;
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos) {
    qf.kernel_name = text;
    return;
  }
  qf.source_path = text.substr(0, colon);
  qf.kernel_name = text.substr(colon + 1);
}

hg::Ref<CeedQFunction_private> create(Ceed ceed, CeedInt vec_length, CeedQFunctionUser function, const char *source) {
  hg::deref(ceed, "Ceed");
  hg::require(vec_length >= 1, CEED_ERROR_DIMENSION,
              [&] { return hg::text("QFunction: vec_length is %" CeedInt_FMT "; expected at least 1", vec_length); });
  auto qf = hg::Ref<CeedQFunction_private>::adopt(new CeedQFunction_private);
  qf->ceed = hg::Ref<Ceed_private>(ceed);
  qf->vec_length = vec_length;
  qf->function = function;
  split_source(source, *qf);
  if (ceed->ops.qfunction.create != nullptr) hg::check(ceed->ops.qfunction.create(qf.get()));
  qf->is_known_to_backend = true;
  return qf;
}

/// Handle -> QFunction that can be changed and applied; NULL and CEED_QFUNCTION_NONE are errors.
CeedQFunction_private &deref_qfunction(CeedQFunction qf) {
  hg::deref(qf, "CeedQFunction");
  hg::require(!qf->is_sentinel, CEED_ERROR_INCOMPATIBLE,
              "CeedQFunction is CEED_QFUNCTION_NONE, which does nothing; expected one that was created");
  return *qf;
}

/// Appends a field whose checks are done: all of it, or nothing where memory ends.
void append(std::vector<std::unique_ptr<CeedQFunctionField_private>> &fields, std::vector<CeedQFunctionField> &list,
            std::unique_ptr<CeedQFunctionField_private> field) {
  list.reserve(list.size() + 1);
  fields.push_back(std::move(field));
  list.push_back(fields.back().get());
}

/// Checks that belong to inputs and outputs alike; returns the new field.
std::unique_ptr<CeedQFunctionField_private> new_field(const CeedQFunction_private &qf, const char *field_name,
                                                      CeedInt size, CeedEvalMode eval_mode) {
  hg::require(!qf.is_immutable, CEED_ERROR_MAJOR, [&] {
    return hg::text("QFunction '%s' takes no more fields after it has been used ('%s')", qf.kernel_name.c_str(),
                    field_name != nullptr ? field_name : "(null)");
  });
  hg::require(field_name != nullptr && field_name[0] != '\0', CEED_ERROR_MINOR, [&] {
    return hg::text("QFunction '%s': the name of a field is NULL or empty; expected text", qf.kernel_name.c_str());
  });
  hg::require(size >= 1, CEED_ERROR_DIMENSION, [&] {
    return hg::text("QFunction field '%s': size is %" CeedInt_FMT "; expected at least 1", field_name, size);
  });
  for (const auto *list : {&qf.input_list, &qf.output_list}) {
    hg::require(hg::find_field(*list, field_name) < 0, CEED_ERROR_MINOR, [&] {
      return hg::text("QFunction '%s' has a field '%s' already; expected a new name", qf.kernel_name.c_str(),
                      field_name);
    });
  }
  const bool is_known = eval_mode == CEED_EVAL_NONE || eval_mode == CEED_EVAL_INTERP || eval_mode == CEED_EVAL_GRAD ||
                        eval_mode == CEED_EVAL_DIV || eval_mode == CEED_EVAL_CURL || eval_mode == CEED_EVAL_WEIGHT;
  hg::require(is_known, CEED_ERROR_MINOR, [&] {
    return hg::text("QFunction field '%s': evaluation mode is %d; expected a CeedEvalMode", field_name,
                    static_cast<int>(eval_mode));
  });
  auto field = std::make_unique<CeedQFunctionField_private>();
  field->name = field_name;
  field->size = size;
  field->eval_mode = eval_mode;
  return field;
}

/// Body of the getters of a field; `function` is the getter.
template <typename T, typename Get>
int get(CeedQFunctionField qf_field, T *value, const char *name, Get &&getter,
        const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      nullptr, [&] { hg::result(value, name) = getter(hg::deref(qf_field, "CeedQFunctionField")); }, function);
}

/// Shows a loaded kernel to a backend that launches such ones.
template <typename F>
void set_device_function(CeedQFunction qf, F *f, int (*CeedQFunctionOps::*entry)(CeedQFunction, F *)) {
  const auto &ops = deref_qfunction(qf).ceed->ops.qfunction;
  hg::require_argument(f, "f (a loaded kernel)");
  if (ops.*entry != nullptr) hg::check((ops.*entry)(qf, f));
}

}  // namespace

const CeedQFunction CEED_QFUNCTION_NONE = &none.object;

namespace hg {

int find_field(const std::vector<CeedQFunctionField> &fields, std::string_view name) {
  for (std::size_t i = 0; i < fields.size(); i++) {
    if (fields[i]->name == name) return static_cast<int>(i);
  }
  return -1;
}

// The identities take u and give v, the scales take u and a scale besides. With n the size of u, a scale and v have n
// values at a point too; but one in "Scale (scalar)" and "Identity to scalar".
void require_gallery_fields(const CeedQFunction_private &qf) {
  if (!qf.counts_components) return;
  const bool is_scale = qf.gallery_name.starts_with("Scale");
  const CeedInt n = qf.input_list.empty() ? 1 : qf.input_list[0]->size;
  const auto require_field = [&](const std::vector<CeedQFunctionField> &fields, std::size_t i, CeedInt size,
                                 const char *what) {
    require(i < fields.size() && fields[i]->size >= size, CEED_ERROR_INCOMPLETE, [&] {
      return text("QFunction '%s': %s %zu %s; expected a field of size %" CeedInt_FMT, qf.gallery_name.c_str(), what, i,
                  i < fields.size() ? "is too small" : "was not added", size);
    });
  };
  require_field(qf.input_list, 0, n, "input");
  if (is_scale) require_field(qf.input_list, 1, qf.gallery_name == "Scale" ? n : 1, "input");
  require_field(qf.output_list, 0, qf.gallery_name == "Identity to scalar" ? 1 : n, "output");
}

}  // namespace hg

CeedQFunction_private::~CeedQFunction_private() {
  if (is_known_to_backend && ceed->ops.qfunction.destroy != nullptr) ceed->ops.qfunction.destroy(this);
}

void CeedQFunction_private::view(FILE *stream) const {
  const hg::Lines line(stream, num_view_tabs);
  line(0, "%s CeedQFunction - %s", gallery_name.empty() ? "User" : "Gallery", name().c_str());
  const auto print = [&](const char *what, const char *title, const std::vector<CeedQFunctionField> &fields) {
    line(1, "%zu %s field%s:", fields.size(), what, hg::plural(fields.size()));
    for (std::size_t i = 0; i < fields.size(); i++) {
      line(2, "%s field %zu:", title, i);
      line(3, "Name: \"%s\"", fields[i]->name.c_str());
      line(3, "Size: %" CeedInt_FMT, fields[i]->size);
      line(3, "EvalMode: \"%s\"", CeedEvalModes[fields[i]->eval_mode]);
    }
  };
  print("input", "Input", input_list);
  print("output", "Output", output_list);
}

int CeedQFunctionRegister(const char *name, const char *source, CeedInt vec_length, CeedQFunctionUser f,
                          int (*init)(Ceed, const char *, CeedQFunction)) {
  return hg::guard(nullptr, [&] {
    hg::require(name != nullptr && f != nullptr && init != nullptr, CEED_ERROR_MINOR,
                "Registering a QFunction: an argument is NULL; expected a name, a function and an init");
    auto &registry = qfunction_registry();
    const std::lock_guard lock(registry.mutex);
    registry.entries.insert_or_assign(name, Registered{source != nullptr ? source : "", vec_length, f, init});
  });
}

int CeedQFunctionCreateInterior(Ceed ceed, CeedInt vec_length, CeedQFunctionUser f, const char *source,
                                CeedQFunction *qf) {
  return hg::guard(ceed, [&] {
    hg::require(f != nullptr, CEED_ERROR_MINOR, [&] {
      return hg::text("QFunction '%s': the function is NULL; expected its address",
                      source != nullptr ? source : "(no source)");
    });
    hg::require_argument(qf, "qf (where the handle goes)");
    *qf = create(ceed, vec_length, f, source).release();
  });
}

int CeedQFunctionCreateInteriorByName(Ceed ceed, const char *name, CeedQFunction *qf) {
  return hg::guard(ceed, [&] {
    hg::require(name != nullptr, CEED_ERROR_MINOR, "QFunction name is NULL; expected a name of the gallery");
    hg::require_argument(qf, "qf (where the handle goes)");
    hg::check(CeedQFunctionRegisterAll());
    Registered found;
    {
      auto &registry = qfunction_registry();
      const std::lock_guard lock(registry.mutex);
      const auto entry = registry.entries.find(name);
      hg::require(entry != registry.entries.end(), CEED_ERROR_UNSUPPORTED, [&] {
        std::string known;
        for (const auto &[other, _] : registry.entries) known += (known.empty() ? "" : ", ") + other;
        return hg::text("No suitable gallery QFunction: '%s'; there are %s", name, known.c_str());
      });
      found = entry->second;
    }
    auto created = create(ceed, found.vec_length, found.function, found.source.c_str());
    created->gallery_name = name;
    hg::check(found.init(ceed, name, created.get()));
    *qf = created.release();
  });
}

int CeedQFunctionCreateIdentity(Ceed ceed, CeedInt size, CeedEvalMode in_mode, CeedEvalMode out_mode,
                                CeedQFunction *qf) {
  return hg::guard(ceed, [&] {
    hg::deref(ceed, "Ceed");
    hg::require_argument(qf, "qf (where the handle goes)");
    CeedQFunction identity = nullptr;
    hg::check(CeedQFunctionCreateInteriorByName(ceed, "Identity", &identity));
    auto created = hg::Ref<CeedQFunction_private>::adopt(identity);
    created->is_identity = true;
    hg::check(CeedQFunctionAddInput(identity, "input", size, in_mode));
    hg::check(CeedQFunctionAddOutput(identity, "output", size, out_mode));
    *qf = created.release();
  });
}

int CeedQFunctionReferenceCopy(CeedQFunction qf, CeedQFunction *qf_copy) {
  return hg::guard(hg::ceed_of(qf), [&] { hg::reference_copy(qf, qf_copy); });
}

int CeedQFunctionReference(CeedQFunction qf) {
  return hg::guard(hg::ceed_of(qf), [&] { hg::reference(&hg::deref(qf, "CeedQFunction")); });
}

int CeedQFunctionDestroy(CeedQFunction *qf) {
  return hg::guard(qf != nullptr ? hg::ceed_of(*qf) : nullptr, [&] { hg::destroy(qf); });
}

int CeedQFunctionAddInput(CeedQFunction qf, const char *field_name, CeedInt size, CeedEvalMode eval_mode) {
  return hg::guard(hg::ceed_of(qf), [&] {
    deref_qfunction(qf);
    auto field = new_field(*qf, field_name, size, eval_mode);
    hg::require(eval_mode != CEED_EVAL_WEIGHT || size == 1, CEED_ERROR_DIMENSION, [&] {
      return hg::text("QFunction field '%s' of mode CEED_EVAL_WEIGHT: size is %" CeedInt_FMT "; expected 1", field_name,
                      size);
    });
    if (qf->counts_components && qf->inputs.empty()) {
      hg::check(CeedQFunctionContextSetData(qf->context.get(), CEED_MEM_HOST, CEED_COPY_VALUES, sizeof size, &size));
    }
    append(qf->inputs, qf->input_list, std::move(field));
  });
}

int CeedQFunctionAddOutput(CeedQFunction qf, const char *field_name, CeedInt size, CeedEvalMode eval_mode) {
  return hg::guard(hg::ceed_of(qf), [&] {
    deref_qfunction(qf);
    auto field = new_field(*qf, field_name, size, eval_mode);
    hg::require(eval_mode != CEED_EVAL_WEIGHT, CEED_ERROR_DIMENSION, [&] {
      return hg::text("QFunction field '%s' is an output of mode CEED_EVAL_WEIGHT, which is for inputs alone",
                      field_name);
    });
    append(qf->outputs, qf->output_list, std::move(field));
  });
}

int CeedQFunctionGetFields(CeedQFunction qf, CeedInt *num_input_fields, CeedQFunctionField **input_fields,
                           CeedInt *num_output_fields, CeedQFunctionField **output_fields) {
  return hg::guard(hg::ceed_of(qf), [&] {
    deref_qfunction(qf).is_immutable = true;
    if (num_input_fields != nullptr) *num_input_fields = static_cast<CeedInt>(qf->input_list.size());
    if (input_fields != nullptr) *input_fields = qf->input_list.data();
    if (num_output_fields != nullptr) *num_output_fields = static_cast<CeedInt>(qf->output_list.size());
    if (output_fields != nullptr) *output_fields = qf->output_list.data();
  });
}

int CeedQFunctionSetContext(CeedQFunction qf, CeedQFunctionContext ctx) {
  return hg::guard(hg::ceed_of(qf), [&] { deref_qfunction(qf).context = hg::Ref<CeedQFunctionContext_private>(ctx); });
}

int CeedQFunctionSetContextWritable(CeedQFunction qf, bool is_writable) {
  return hg::guard(hg::ceed_of(qf), [&] { deref_qfunction(qf).is_context_writable = is_writable; });
}

int CeedQFunctionSetUserFlopsEstimate(CeedQFunction qf, CeedSize flops) {
  return hg::guard(hg::ceed_of(qf), [&] {
    hg::require(flops >= 0, CEED_ERROR_INCOMPATIBLE, [&] {
      return hg::text("QFunction '%s': flops estimate is %" CeedSize_FMT "; expected at least 0",
                      deref_qfunction(qf).kernel_name.c_str(), flops);
    });
    deref_qfunction(qf).user_flops = flops;
  });
}

int CeedQFunctionGetFlopsEstimate(CeedQFunction qf, CeedSize *flops) {
  return hg::guard(hg::ceed_of(qf), [&] {
    hg::require(hg::deref(qf, "CeedQFunction").user_flops >= 0, CEED_ERROR_INCOMPLETE, [&] {
      return hg::text("QFunction '%s' has no flops estimate; set one with CeedQFunctionSetUserFlopsEstimate()",
                      qf->kernel_name.c_str());
    });
    hg::result(flops, "flops") = qf->user_flops;
  });
}

int CeedQFunctionSetNumViewTabs(CeedQFunction qf, CeedInt num_tabs) {
  return hg::set_view_tabs(qf, num_tabs);
}

int CeedQFunctionGetNumViewTabs(CeedQFunction qf, CeedInt *num_tabs) {
  return hg::get_view_tabs(qf, num_tabs);
}

int CeedQFunctionView(CeedQFunction qf, FILE *stream) {
  return hg::view_object(qf, stream);
}

int CeedQFunctionGetCeed(CeedQFunction qf, Ceed *ceed) {
  return hg::get_ceed(qf, ceed);
}

Ceed CeedQFunctionReturnCeed(CeedQFunction qf) {
  return hg::ceed_of(qf);
}

int CeedQFunctionSetCUDAUserFunction(CeedQFunction qf, CUfunc_st *f) {
  return hg::guard(hg::ceed_of(qf), [&] { set_device_function(qf, f, &CeedQFunctionOps::set_cuda_function); });
}

int CeedQFunctionSetHIPUserFunction(CeedQFunction qf, ihipModuleSymbol_t *f) {
  return hg::guard(hg::ceed_of(qf), [&] { set_device_function(qf, f, &CeedQFunctionOps::set_hip_function); });
}

int CeedQFunctionApply(CeedQFunction qf, CeedInt Q, CeedVector *u, CeedVector *v) {
  return hg::guard(hg::ceed_of(qf), [&] {
    deref_qfunction(qf);
    hg::require(Q >= 0 && Q % qf->vec_length == 0, CEED_ERROR_DIMENSION, [&] {
      return hg::text("QFunction '%s': %" CeedInt_FMT " points; expected a multiple of its vec_length %" CeedInt_FMT,
                      qf->kernel_name.c_str(), Q, qf->vec_length);
    });
    const auto check_lengths = [&](const std::vector<CeedQFunctionField> &fields, const CeedVector *vectors) {
      for (std::size_t i = 0; i < fields.size(); i++) {
        const CeedSize needed = static_cast<CeedSize>(Q) * fields[i]->size;
        const CeedSize length = hg::deref_vector(vectors[i], "vector of a QFunction field").length;
        hg::require(length >= needed, CEED_ERROR_DIMENSION, [&] {
          return hg::text("QFunction '%s' field '%s': vector of length %" CeedSize_FMT
                          "; expected at least %" CeedSize_FMT,
                          qf->kernel_name.c_str(), fields[i]->name.c_str(), length, needed);
        });
      }
    };
    hg::require_gallery_fields(*qf);
    if (!qf->input_list.empty()) hg::require_argument(u, "u (a vector for each input)");
    if (!qf->output_list.empty()) hg::require_argument(v, "v (a vector for each output)");
    check_lengths(qf->input_list, u);
    check_lengths(qf->output_list, v);
    qf->is_immutable = true;
    if (Q > 0) hg::check(qf->ceed->ops.qfunction.apply(qf, Q, u, v));
  });
}

int CeedQFunctionGetVectorLength(CeedQFunction qf, CeedInt *vec_length) {
  return hg::guard(hg::ceed_of(qf),
                   [&] { hg::result(vec_length, "vec_length") = hg::deref(qf, "CeedQFunction").vec_length; });
}

int CeedQFunctionGetNumArgs(CeedQFunction qf, CeedInt *num_input_fields, CeedInt *num_output_fields) {
  return hg::guard(hg::ceed_of(qf), [&] {
    const auto &f = hg::deref(qf, "CeedQFunction");
    if (num_input_fields != nullptr) *num_input_fields = static_cast<CeedInt>(f.input_list.size());
    if (num_output_fields != nullptr) *num_output_fields = static_cast<CeedInt>(f.output_list.size());
  });
}

int CeedQFunctionGetKernelName(CeedQFunction qf, const char **kernel_name) {
  return hg::guard(hg::ceed_of(qf), [&] {
    hg::result(kernel_name, "kernel_name") = hg::deref(qf, "CeedQFunction").kernel_name.c_str();
  });
}

int CeedQFunctionGetName(CeedQFunction qf, const char **name) {
  return hg::guard(hg::ceed_of(qf), [&] { hg::result(name, "name") = hg::deref(qf, "CeedQFunction").name().c_str(); });
}

int CeedQFunctionGetSourcePath(CeedQFunction qf, const char **source_path) {
  return hg::guard(hg::ceed_of(qf), [&] {
    const auto &f = hg::deref(qf, "CeedQFunction");
    hg::result(source_path, "source_path") = f.source_path.empty() ? nullptr : f.source_path.c_str();
  });
}

int CeedQFunctionGetUserFunction(CeedQFunction qf, CeedQFunctionUser *f) {
  return hg::guard(hg::ceed_of(qf), [&] { hg::result(f, "f") = hg::deref(qf, "CeedQFunction").function; });
}

int CeedQFunctionGetContext(CeedQFunction qf, CeedQFunctionContext *ctx) {
  return hg::guard(hg::ceed_of(qf), [&] { hg::hand_out(hg::deref(qf, "CeedQFunction").context.get(), ctx, "ctx"); });
}

int CeedQFunctionGetContextData(CeedQFunction qf, CeedMemType mem_type, void *data) {
  return hg::guard(hg::ceed_of(qf), [&] {
    const auto &f = hg::deref(qf, "CeedQFunction");
    hg::require_argument(data, "data (where the pointer goes)");
    if (!f.context) {
      *static_cast<void **>(data) = nullptr;
    } else if (f.is_context_writable) {
      hg::check(CeedQFunctionContextGetData(f.context.get(), mem_type, data));
    } else {
      hg::check(CeedQFunctionContextGetDataRead(f.context.get(), mem_type, data));
    }
  });
}

int CeedQFunctionRestoreContextData(CeedQFunction qf, void *data) {
  return hg::guard(hg::ceed_of(qf), [&] {
    const auto &f = hg::deref(qf, "CeedQFunction");
    if (!f.context) return;
    if (f.is_context_writable) {
      hg::check(CeedQFunctionContextRestoreData(f.context.get(), data));
    } else {
      hg::check(CeedQFunctionContextRestoreDataRead(f.context.get(), data));
    }
  });
}

int CeedQFunctionIsIdentity(CeedQFunction qf, bool *is_identity) {
  return hg::guard(hg::ceed_of(qf),
                   [&] { hg::result(is_identity, "is_identity") = hg::deref(qf, "CeedQFunction").is_identity; });
}

int CeedQFunctionIsContextWritable(CeedQFunction qf, bool *is_writable) {
  return hg::guard(hg::ceed_of(qf), [&] {
    hg::result(is_writable, "is_writable") = hg::deref(qf, "CeedQFunction").is_context_writable;
  });
}

int CeedQFunctionGetData(CeedQFunction qf, void *data) {
  return hg::guard(hg::ceed_of(qf),
                   [&] { hg::result(static_cast<void **>(data), "data") = hg::deref(qf, "CeedQFunction").data; });
}

int CeedQFunctionSetData(CeedQFunction qf, void *data) {
  return hg::guard(hg::ceed_of(qf), [&] { deref_qfunction(qf).data = data; });
}

int CeedQFunctionIsImmutable(CeedQFunction qf, bool *is_immutable) {
  return hg::guard(hg::ceed_of(qf),
                   [&] { hg::result(is_immutable, "is_immutable") = hg::deref(qf, "CeedQFunction").is_immutable; });
}

int CeedQFunctionSetImmutable(CeedQFunction qf) {
  return hg::guard(hg::ceed_of(qf), [&] { deref_qfunction(qf).is_immutable = true; });
}

int CeedQFunctionFieldGetName(CeedQFunctionField qf_field, const char **field_name) {
  return get(qf_field, field_name, "field_name", [](auto &field) { return field.name.c_str(); });
}

int CeedQFunctionFieldGetSize(CeedQFunctionField qf_field, CeedInt *size) {
  return get(qf_field, size, "size", [](auto &field) { return field.size; });
}

int CeedQFunctionFieldGetEvalMode(CeedQFunctionField qf_field, CeedEvalMode *eval_mode) {
  return get(qf_field, eval_mode, "eval_mode", [](auto &field) { return field.eval_mode; });
}

int CeedQFunctionFieldGetData(CeedQFunctionField qf_field, const char **field_name, CeedInt *size,
                              CeedEvalMode *eval_mode) {
  return hg::guard(nullptr, [&] {
    const auto &field = hg::deref(qf_field, "CeedQFunctionField");
    if (field_name != nullptr) *field_name = field.name.c_str();
    if (size != nullptr) *size = field.size;
    if (eval_mode != nullptr) *eval_mode = field.eval_mode;
  });
}
