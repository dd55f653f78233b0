// Calls on QFunctions and their contexts.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "objects.hpp"

namespace hg::fuzz {
namespace {

int does_nothing(void *, CeedInt, const CeedScalar *const *, CeedScalar *const *) {
  return 0;
}
int fails(void *, CeedInt, const CeedScalar *const *, CeedScalar *const *) {
  return 7;
}
int throws(void *, CeedInt, const CeedScalar *const *, CeedScalar *const *) {
  throw std::runtime_error("thrown");
}

int create_interior(Objects &o) {
  static const CeedQFunctionUser functions[] = {does_nothing, does_nothing, does_nothing, fails, throws};
  static const char *const sources[] = {"fuzz.h:f", "f", "", nullptr, ":"};
  const Ceed ceed = o.ceed();
  const CeedInt vec_length = o.count();
  const auto function = functions[o.bytes.next_byte() % 5];
  const char *source = sources[o.bytes.next_byte() % 5];
  return o.create(o.qfunctions, [&](CeedQFunction *qf) {
    const int code = CeedQFunctionCreateInterior(ceed, vec_length, function, source, qf);
    if (code == CEED_ERROR_SUCCESS) o.plain.push_back(*qf);
    return code;
  });
}

int create_by_name(Objects &o) {
  static const char *const names[] = {"Mass1DBuild",
                                      "Mass2DBuild",
                                      "Mass3DBuild",
                                      "MassApply",
                                      "Vector3MassApply",
                                      "Poisson1DBuild",
                                      "Poisson2DBuild",
                                      "Poisson3DBuild",
                                      "Poisson1DApply",
                                      "Poisson2DApply",
                                      "Poisson3DApply",
                                      "Vector3Poisson1DApply",
                                      "Vector3Poisson2DApply",
                                      "Vector3Poisson3DApply",
                                      "Identity",
                                      "Scale",
                                      "Scale (scalar)",
                                      "Identity to scalar",
                                      "Nothing",
                                      "",
                                      nullptr};
  const Ceed ceed = o.ceed();
  const char *name = names[o.bytes.next_byte() % std::size(names)];
  return o.create(o.qfunctions, [&](CeedQFunction *qf) {
    const int code = CeedQFunctionCreateInteriorByName(ceed, name, qf);
    std::erase(o.plain, *qf);  // a handle of the same value was another one before
    return code;
  });
}

/// The context of a QFunction of the gallery is its own business; others may be given any.
int set_context(Objects &o) {
  const CeedQFunction qf = o.qfunction();
  const CeedQFunctionContext ctx = o.context();
  const bool is_plain = std::find(o.plain.begin(), o.plain.end(), qf) != o.plain.end();
  o.took_nothing = o.took_nothing || !is_plain;
  return CeedQFunctionSetContext(is_plain ? qf : nullptr, ctx);
}

int apply(Objects &o) {
  CeedVector in[16] = {}, out[16] = {};
  const CeedQFunction qf = o.qfunction();
  const CeedInt Q = o.count();
  CeedInt num_in = 0, num_out = 0;
  if (qf != nullptr && qf != CEED_QFUNCTION_NONE) CeedQFunctionGetNumArgs(qf, &num_in, &num_out);
  for (CeedInt i = 0; i < std::min(num_in, 16); i++) in[i] = o.vector();
  for (CeedInt i = 0; i < std::min(num_out, 16); i++) out[i] = o.vector();
  return num_in > 16 || num_out > 16 ? CEED_ERROR_SUCCESS : CeedQFunctionApply(qf, Q, in, out);
}

const Call calls_on_qfunctions[] = {
    {"CeedQFunctionCreateInterior", false, create_interior},
    {"CeedQFunctionCreateInteriorByName", false, create_by_name},
    {"CeedQFunctionCreateIdentity", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       const CeedInt size = o.count();
       const CeedEvalMode in = o.eval_mode(), out = o.eval_mode();
       return o.create(o.qfunctions, [&](CeedQFunction *qf) {
         const int code = CeedQFunctionCreateIdentity(ceed, size, in, out, qf);
         std::erase(o.plain, *qf);
         return code;
       });
     }},
    {"CeedQFunctionDestroy", false, [](Objects &o) { return o.qfunctions.remove(o.qfunctions.at(o.slot())); }},
    {"CeedQFunctionReferenceCopy", false,
     [](Objects &o) {
       const CeedQFunction qf = o.qfunction();
       return o.create(o.qfunctions, [&](CeedQFunction *copy) { return CeedQFunctionReferenceCopy(qf, copy); });
     }},
    {"CeedQFunctionAddInput", true,
     [](Objects &o) {
       const CeedQFunction qf = o.qfunction();
       const char *name = o.name();
       const CeedInt size = o.count();
       return CeedQFunctionAddInput(qf, name, size, o.eval_mode());
     }},
    {"CeedQFunctionAddOutput", true,
     [](Objects &o) {
       const CeedQFunction qf = o.qfunction();
       const char *name = o.name();
       const CeedInt size = o.count();
       return CeedQFunctionAddOutput(qf, name, size, o.eval_mode());
     }},
    {"CeedQFunctionGetFields", false,
     [](Objects &o) {
       CeedInt num_in = 0, num_out = 0;
       CeedQFunctionField *in = nullptr, *out = nullptr;
       const int code = CeedQFunctionGetFields(o.qfunction(), &num_in, &in, &num_out, &out);
       if (code != CEED_ERROR_SUCCESS) return code;
       for (CeedInt i = 0; i < num_in; i++) {
         const char *name = nullptr;
         CeedInt size = 0;
         CeedEvalMode mode;
         const int told = CeedQFunctionFieldGetData(in[i], &name, &size, &mode);
         if (told != CEED_ERROR_SUCCESS) throw Defect("a field has no data");
       }
       return code;
     }},
    {"CeedQFunctionSetContext", true, set_context},
    {"CeedQFunctionSetContextWritable", true,
     [](Objects &o) {
       const CeedQFunction qf = o.qfunction();
       return CeedQFunctionSetContextWritable(qf, o.flag());
     }},
    {"CeedQFunctionGetContext", false,
     [](Objects &o) {
       CeedQFunctionContext ctx = nullptr;
       const int code = CeedQFunctionGetContext(o.qfunction(), &ctx);
       return code != CEED_ERROR_SUCCESS || ctx == nullptr ? code : CeedQFunctionContextDestroy(&ctx);
     }},
    {"CeedQFunctionSetUserFlopsEstimate", false,
     [](Objects &o) {
       const CeedQFunction qf = o.qfunction();
       return CeedQFunctionSetUserFlopsEstimate(qf, o.count());
     }},
    {"CeedQFunctionGetFlopsEstimate", false,
     [](Objects &o) {
       CeedSize flops = 0;
       return CeedQFunctionGetFlopsEstimate(o.qfunction(), &flops);
     }},
    {"CeedQFunctionApply", true, apply},
    {"CeedQFunctionView", false, [](Objects &o) { return CeedQFunctionView(o.qfunction(), o.stream()); }},
};

int set_data(Objects &o) {
  const CeedQFunctionContext ctx = o.context();
  const CeedMemType mem_type = o.mem_type();
  const CeedCopyMode copy_mode = o.copy_mode();
  const std::size_t size = o.bytes.next_byte() % 64;
  char *data = o.bytes.next_byte() >= 250 ? nullptr : o.keep(std::vector<char>(size, '\1'));
  const bool is_owned = copy_mode == CEED_OWN_POINTER && data != nullptr;
  if (is_owned) data = static_cast<char *>(std::calloc(std::max<std::size_t>(size, 1), 1));
  const int code = CeedQFunctionContextSetData(ctx, mem_type, copy_mode, size, data);
  if (is_owned && code != CEED_ERROR_SUCCESS) std::free(data);
  return code;
}

int get_data(Objects &o) {
  const CeedQFunctionContext ctx = o.context();
  char *data = nullptr;
  const int code = CeedQFunctionContextGetData(ctx, o.mem_type(), &data);
  if (code == CEED_ERROR_SUCCESS) o.contexts.lend(ctx);
  return code;
}

int restore_data(Objects &o) {
  const CeedQFunctionContext ctx = o.context();
  char *data = nullptr;
  const int code = CeedQFunctionContextRestoreData(ctx, &data);
  if ((code == CEED_ERROR_SUCCESS) != o.contexts.give_back(ctx)) throw Defect("restored data were not counted");
  return code;
}

int get_data_read(Objects &o) {
  const CeedQFunctionContext ctx = o.context();
  const char *data = nullptr;
  const int code = CeedQFunctionContextGetDataRead(ctx, o.mem_type(), &data);
  if (code == CEED_ERROR_SUCCESS) o.context_readers.push_back(ctx);
  return code;
}

int restore_data_read(Objects &o) {
  const CeedQFunctionContext ctx = o.context();
  const char *data = nullptr;
  const int code = CeedQFunctionContextRestoreDataRead(ctx, &data);
  const auto reader = std::find(o.context_readers.begin(), o.context_readers.end(), ctx);
  const bool is_lent = reader != o.context_readers.end();
  if ((code == CEED_ERROR_SUCCESS) != is_lent) throw Defect("restored data were not counted");
  if (code == CEED_ERROR_SUCCESS) o.context_readers.erase(reader);
  return code;
}

int register_field(Objects &o) {
  static int (*const registers[])(CeedQFunctionContext, const char *, std::size_t, std::size_t, const char *) = {
      CeedQFunctionContextRegisterDouble, CeedQFunctionContextRegisterInt32, CeedQFunctionContextRegisterBoolean};
  const CeedQFunctionContext ctx = o.context();
  const auto call = registers[o.bytes.next_byte() % 3];
  const char *name = o.name();
  const std::size_t offset = o.bytes.next_byte() % 40;
  const int choice = o.bytes.next_byte();
  const std::size_t num_values = choice == 255 ? SIZE_MAX / 2 : choice == 254 ? SIZE_MAX / 4 + 1 : choice % 5;
  return call(ctx, name, offset * 4, num_values, o.name());
}

/// One of the labels of a context, which may be used with another.
CeedContextFieldLabel label_of(Objects &o, CeedQFunctionContext ctx) {
  CeedContextFieldLabel label = nullptr;
  const char *name = o.name();
  if (ctx != nullptr && name != nullptr) CeedQFunctionContextGetFieldLabel(ctx, name, &label);
  return label;
}

int set_values(Objects &o) {
  double doubles[8] = {};
  std::int32_t integers[8] = {};
  bool flags[8] = {};
  const CeedQFunctionContext from = o.context(), ctx = o.flag() ? from : o.context();
  const CeedContextFieldLabel label = label_of(o, from);
  switch (o.bytes.next_byte() % 3) {
    case 0:
      return CeedQFunctionContextSetDouble(ctx, label, doubles);
    case 1:
      return CeedQFunctionContextSetInt32(ctx, label, integers);
    default:
      return CeedQFunctionContextSetBoolean(ctx, label, flags);
  }
}

int read_values(Objects &o) {
  const double *doubles = nullptr;
  const std::int32_t *integers = nullptr;
  const bool *flags = nullptr;
  std::size_t num = 0;
  const CeedQFunctionContext from = o.context(), ctx = o.flag() ? from : o.context();
  const CeedContextFieldLabel label = label_of(o, from);
  int code;
  switch (o.bytes.next_byte() % 3) {
    case 0:
      code = CeedQFunctionContextGetDoubleRead(ctx, label, &num, &doubles);
      return code != CEED_ERROR_SUCCESS ? code : CeedQFunctionContextRestoreDoubleRead(ctx, label, &doubles);
    case 1:
      code = CeedQFunctionContextGetInt32Read(ctx, label, &num, &integers);
      return code != CEED_ERROR_SUCCESS ? code : CeedQFunctionContextRestoreInt32Read(ctx, label, &integers);
    default:
      code = CeedQFunctionContextGetBooleanRead(ctx, label, &num, &flags);
      return code != CEED_ERROR_SUCCESS ? code : CeedQFunctionContextRestoreBooleanRead(ctx, label, &flags);
  }
}

const Call calls_on_contexts[] = {
    {"CeedQFunctionContextCreate", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       return o.create(o.contexts, [&](CeedQFunctionContext *ctx) { return CeedQFunctionContextCreate(ceed, ctx); });
     }},
    {"CeedQFunctionContextDestroy", false, [](Objects &o) { return o.contexts.remove(o.contexts.at(o.slot())); }},
    {"CeedQFunctionContextReferenceCopy", false,
     [](Objects &o) {
       const CeedQFunctionContext ctx = o.context();
       return o.create(o.contexts,
                       [&](CeedQFunctionContext *copy) { return CeedQFunctionContextReferenceCopy(ctx, copy); });
     }},
    {"CeedQFunctionContextSetData", true, set_data},
    {"CeedQFunctionContextTakeData", true,
     [](Objects &o) {
       void *data = nullptr;
       const CeedQFunctionContext ctx = o.context();
       return CeedQFunctionContextTakeData(ctx, o.mem_type(), o.flag() ? &data : nullptr);
     }},
    {"CeedQFunctionContextGetData", true, get_data},
    {"CeedQFunctionContextRestoreData", true, restore_data},
    {"CeedQFunctionContextGetDataRead", true, get_data_read},
    {"CeedQFunctionContextRestoreDataRead", true, restore_data_read},
    {"CeedQFunctionContextRegister", false, register_field},
    {"CeedQFunctionContextSet (values)", true, set_values},
    {"CeedQFunctionContextGet (values)", false, read_values},
    {"CeedQFunctionContextGetAllFieldLabels", false,
     [](Objects &o) {
       const CeedContextFieldLabel *labels = nullptr;
       CeedInt num = 0;
       const int code = CeedQFunctionContextGetAllFieldLabels(o.context(), &labels, &num);
       for (CeedInt i = 0; code == CEED_ERROR_SUCCESS && i < num; i++) {
         const char *name = nullptr, *description = nullptr;
         std::size_t offset = 0, num_values = 0;
         CeedContextFieldType type;
         const int told =
             CeedContextFieldLabelGetDescription(labels[i], &name, &offset, &num_values, &description, &type);
         if (told != CEED_ERROR_SUCCESS) throw Defect("a label has no description");
       }
       return code;
     }},
    {"CeedQFunctionContextGetContextSize", false,
     [](Objects &o) {
       std::size_t size = 0;
       return CeedQFunctionContextGetContextSize(o.context(), &size);
     }},
    {"CeedQFunctionContextSetDataDestroy", false,
     [](Objects &o) {
       const CeedQFunctionContext ctx = o.context();
       return CeedQFunctionContextSetDataDestroy(ctx, o.mem_type(), [](void *) { return 0; });
     }},
    {"CeedQFunctionContextView", false, [](Objects &o) { return CeedQFunctionContextView(o.context(), o.stream()); }},
};

}  // namespace

std::span<const Call> qfunction_calls() {
  return calls_on_qfunctions;
}
std::span<const Call> context_calls() {
  return calls_on_contexts;
}

}  // namespace hg::fuzz
