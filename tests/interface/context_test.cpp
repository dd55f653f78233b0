// User data of QFunctions: access, ownership and registered fields.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>

#include "support/errors.hpp"
#include "support/handles.hpp"
#include "support/values.hpp"
#include "view_text.hpp"

namespace {

using namespace hg::test;

struct Data {
  double moduli[2];
  std::int32_t steps;
  bool flags[3];
};

int num_destroyed = 0;
double destroyed_value = 0;

int count_destroyed(void *data) {
  num_destroyed++;
  destroyed_value = static_cast<Data *>(data)->moduli[0];
  return CEED_ERROR_SUCCESS;
}

class ContextTest : public testing::Test {
 protected:
  void SetUp() override { ok(CeedQFunctionContextCreate(ceed, ctx.out())); }
  void lend() { ok(CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_USE_POINTER, sizeof data, &data)); }
  void add_fields() {
    ok(CeedQFunctionContextRegisterDouble(ctx, "moduli", offsetof(Data, moduli), 2, "E and nu"));
    ok(CeedQFunctionContextRegisterInt32(ctx, "steps", offsetof(Data, steps), 1, "load steps"));
    ok(CeedQFunctionContextRegisterBoolean(ctx, "flags", offsetof(Data, flags), 3, nullptr));
  }
  CeedContextFieldLabel label(const char *name) {
    CeedContextFieldLabel found = nullptr;
    ok(CeedQFunctionContextGetFieldLabel(ctx, name, &found));
    return found;
  }
  std::uint64_t state() {
    std::uint64_t value = 0;
    ok(CeedQFunctionContextGetState(ctx, &value));
    return value;
  }

  CeedHandle ceed{open(reference_resource)};
  Context ctx;
  Data data{{1.5, 0.3}, 7, {true, false, true}};
  Data *got = nullptr, *other = nullptr;
};

TEST_F(ContextTest, LendsWhatItWasLent) {
  lend();
  ok(CeedQFunctionContextGetData(ctx, CEED_MEM_HOST, &got));
  EXPECT_EQ(got, &data);
  got->moduli[0] = 9;
  ok(CeedQFunctionContextRestoreData(ctx, &got));
  EXPECT_EQ(got, nullptr);
  EXPECT_EQ(data.moduli[0], 9);
  bool is_borrowed = false;
  ok(CeedQFunctionContextHasBorrowedDataOfType(ctx, CEED_MEM_HOST, &is_borrowed));
  EXPECT_TRUE(is_borrowed);
  ok(CeedQFunctionContextTakeData(ctx, CEED_MEM_HOST, &got));
  EXPECT_EQ(got, &data);
  bool is_valid = true;
  ok(CeedQFunctionContextHasValidData(ctx, &is_valid));
  EXPECT_FALSE(is_valid);
  expect_error(CeedQFunctionContextGetData(ctx, CEED_MEM_HOST, &got), CEED_ERROR_INCOMPLETE, {"holds no data"});
  expect_error(CeedQFunctionContextTakeData(ctx, CEED_MEM_HOST, &got), CEED_ERROR_INCOMPLETE, {"holds no data"});
}

TEST_F(ContextTest, CopiesAndOwns) {
  ok(CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof data, &data));
  data.moduli[0] = -1;
  ok(CeedQFunctionContextGetDataRead(ctx, CEED_MEM_HOST, &got));
  EXPECT_NE(got, &data);
  EXPECT_EQ(got->moduli[0], 1.5);
  EXPECT_TRUE(got->flags[2]);
  ok(CeedQFunctionContextRestoreDataRead(ctx, &got));
  expect_error(CeedQFunctionContextTakeData(ctx, CEED_MEM_HOST, &got), CEED_ERROR_INCOMPLETE, {"no borrowed data"});

  auto *own = static_cast<Data *>(std::malloc(sizeof(Data)));
  *own = data;
  ok(CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_OWN_POINTER, sizeof *own, own));
  ok(CeedQFunctionContextGetDataRead(ctx, CEED_MEM_HOST, &got));
  EXPECT_EQ(got, own);
  ok(CeedQFunctionContextRestoreDataRead(ctx, &got));
  std::size_t size = 0;
  ok(CeedQFunctionContextGetContextSize(ctx, &size));
  EXPECT_EQ(size, sizeof(Data));
}

TEST_F(ContextTest, HasOneWriterOrManyReaders) {
  lend();
  const char *in_use = "Cannot grant CeedQFunctionContext data access, the access lock is already in use";
  const char *is_read = "Cannot grant CeedQFunctionContext data access, a process has read access";
  ok(CeedQFunctionContextGetData(ctx, CEED_MEM_HOST, &got));
  EXPECT_EQ(state() % 2, 1u);
  expect_error(CeedQFunctionContextGetData(ctx, CEED_MEM_HOST, &other), CEED_ERROR_ACCESS, {in_use});
  expect_error(CeedQFunctionContextGetDataRead(ctx, CEED_MEM_HOST, &other), CEED_ERROR_ACCESS, {in_use});
  expect_error(CeedQFunctionContextTakeData(ctx, CEED_MEM_HOST, &other), CEED_ERROR_ACCESS, {in_use});
  expect_error(CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_USE_POINTER, sizeof data, &data), CEED_ERROR_ACCESS,
               {in_use});
  expect_error(CeedQFunctionContextRestoreDataRead(ctx, &other), CEED_ERROR_ACCESS, {"access was not granted"});
  expect_error(CeedQFunctionContextDestroy(ctx.address()), CEED_ERROR_ACCESS, {"Cannot destroy CeedQFunctionContext"});
  ASSERT_NE(ctx.get(), nullptr);
  ok(CeedQFunctionContextRestoreData(ctx, &got));
  expect_error(CeedQFunctionContextRestoreData(ctx, &got), CEED_ERROR_ACCESS, {"access was not granted"});

  ok(CeedQFunctionContextGetDataRead(ctx, CEED_MEM_HOST, &got));
  ok(CeedQFunctionContextGetDataRead(ctx, CEED_MEM_HOST, &other));
  expect_error(CeedQFunctionContextGetData(ctx, CEED_MEM_HOST, &other), CEED_ERROR_ACCESS, {is_read});
  EXPECT_EQ(last_report().function, "CeedQFunctionContextGetData");
  expect_error(CeedQFunctionContextDestroy(ctx.address()), CEED_ERROR_ACCESS, {"a process has read access"});
  ok(CeedQFunctionContextRestoreDataRead(ctx, &got));
  ok(CeedQFunctionContextRestoreDataRead(ctx, &other));
  ok(CeedQFunctionContextGetData(ctx, CEED_MEM_HOST, &got));
  ok(CeedQFunctionContextRestoreData(ctx, &got));
}

TEST_F(ContextTest, SetsAndReadsFields) {
  lend();
  add_fields();
  const std::uint64_t before = state();
  double moduli[2] = {200, 0.25};
  std::int32_t steps = 40;
  bool flags[3] = {false, true, false};
  ok(CeedQFunctionContextSetDouble(ctx, label("moduli"), moduli));
  ok(CeedQFunctionContextSetInt32(ctx, label("steps"), &steps));
  ok(CeedQFunctionContextSetBoolean(ctx, label("flags"), flags));
  EXPECT_EQ(state(), before + 6);
  EXPECT_EQ(data.moduli[0], 200);
  EXPECT_EQ(data.moduli[1], 0.25);
  EXPECT_EQ(data.steps, 40);
  EXPECT_FALSE(data.flags[0]);
  EXPECT_TRUE(data.flags[1]);

  std::size_t count = 0;
  const double *values = nullptr;
  ok(CeedQFunctionContextGetDoubleRead(ctx, label("moduli"), &count, &values));
  EXPECT_EQ(count, 2u);
  EXPECT_EQ(values[1], 0.25);
  expect_error(CeedQFunctionContextSetInt32(ctx, label("steps"), &steps), CEED_ERROR_ACCESS, {"read access"});
  ok(CeedQFunctionContextRestoreDoubleRead(ctx, label("moduli"), &values));
  EXPECT_EQ(values, nullptr);
  const std::int32_t *integers = nullptr;
  ok(CeedQFunctionContextGetInt32Read(ctx, label("steps"), &count, &integers));
  EXPECT_EQ(*integers, 40);
  ok(CeedQFunctionContextRestoreInt32Read(ctx, label("steps"), &integers));
  const bool *booleans = nullptr;
  ok(CeedQFunctionContextGetBooleanRead(ctx, label("flags"), &count, &booleans));
  EXPECT_EQ(count, 3u);
  EXPECT_TRUE(booleans[1]);
  ok(CeedQFunctionContextRestoreBooleanRead(ctx, label("flags"), &booleans));
  EXPECT_EQ(state(), before + 6) << "reading changes nothing";
}

TEST_F(ContextTest, DescribesItsFields) {
  add_fields();
  const CeedContextFieldLabel *labels = nullptr;
  CeedInt count = 0;
  ok(CeedQFunctionContextGetAllFieldLabels(ctx, &labels, &count));
  ASSERT_EQ(count, 3);
  const char *name = nullptr, *description = nullptr;
  std::size_t offset = 0, num_values = 0;
  CeedContextFieldType type = CEED_CONTEXT_FIELD_BOOL;
  ok(CeedContextFieldLabelGetDescription(labels[1], &name, &offset, &num_values, &description, &type));
  EXPECT_STREQ(name, "steps");
  EXPECT_STREQ(description, "load steps");
  EXPECT_EQ(offset, offsetof(Data, steps));
  EXPECT_EQ(num_values, 1u);
  EXPECT_EQ(type, CEED_CONTEXT_FIELD_INT32);
  ok(CeedContextFieldLabelGetDescription(labels[2], nullptr, nullptr, nullptr, &description, nullptr));
  EXPECT_STREQ(description, "");
  EXPECT_EQ(label("nothing"), nullptr);
  EXPECT_EQ(label("moduli"), labels[0]) << "labels keep their addresses";
}

TEST_F(ContextTest, RefusesBadFields) {
  lend();
  add_fields();
  expect_error(CeedQFunctionContextRegisterDouble(ctx, "moduli", 0, 1, ""), CEED_ERROR_UNSUPPORTED,
               {"\"moduli\" already registered"});
  expect_error(CeedQFunctionContextRegisterDouble(ctx, "outside", sizeof(Data), 1, ""), CEED_ERROR_DIMENSION,
               {"\"outside\"", "8 bytes", std::to_string(sizeof(Data))});
  expect_error(CeedQFunctionContextRegisterDouble(ctx, "none", 0, 0, ""), CEED_ERROR_DIMENSION, {"0 values"});
  EXPECT_EQ(label("outside"), nullptr);
  double value = 1;
  std::int32_t integer = 1;
  expect_error(CeedQFunctionContextSetDouble(ctx, label("steps"), &value), CEED_ERROR_UNSUPPORTED,
               {"\"steps\"", "int32", "double"});
  expect_error(CeedQFunctionContextSetInt32(ctx, nullptr, &integer), CEED_ERROR_UNSUPPORTED, {"label", "NULL"});
  EXPECT_EQ(data.steps, 7);
  Context stranger;
  ok(CeedQFunctionContextCreate(ceed, stranger.out()));
  expect_error(CeedQFunctionContextSetInt32(stranger, label("steps"), &integer), CEED_ERROR_UNSUPPORTED,
               {"another object"});
  // Registered before there were data, which then are too short.
  ok(CeedQFunctionContextRegisterDouble(stranger, "late", 8, 1, ""));
  ok(CeedQFunctionContextSetData(stranger, CEED_MEM_HOST, CEED_USE_POINTER, sizeof value, &value));
  CeedContextFieldLabel late = nullptr;
  ok(CeedQFunctionContextGetFieldLabel(stranger, "late", &late));
  expect_error(CeedQFunctionContextSetDouble(stranger, late, &value), CEED_ERROR_DIMENSION, {"\"late\"", "offset 8"});
}

TEST_F(ContextTest, ShowsDataToTheDestroyFunctionFirst) {
  num_destroyed = 0;
  ok(CeedQFunctionContextSetDataDestroy(ctx, CEED_MEM_HOST, count_destroyed));
  EXPECT_EQ(num_destroyed, 0) << "there are no data";
  ok(CeedQFunctionContextSetData(ctx, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof data, &data));
  ctx.reset();
  EXPECT_EQ(num_destroyed, 1);
  EXPECT_EQ(destroyed_value, 1.5);
}

TEST_F(ContextTest, PrintsItsFields) {
  lend();
  add_fields();
  const std::string size = std::to_string(sizeof(Data));
  const auto print = [&](FILE *stream) { ok(CeedQFunctionContextView(ctx, stream)); };
  EXPECT_EQ(printed(print), "CeedQFunctionContext\n  Context Data Size: " + size +
                                "\n  Labeled double field: moduli\n  Labeled int32 field: steps\n"
                                "  Labeled bool field: flags\n");
  ok(CeedQFunctionContextSetNumViewTabs(ctx, 1));
  EXPECT_EQ(printed(print).substr(0, 22), "  CeedQFunctionContext");
}

/// Only QFunctions in Fortran have a context around the user's.
TEST_F(ContextTest, OfAQFunctionInCIsItsInnerOne) {
  double number = 4, *data = nullptr;
  Context own, found;
  QFunction qf;
  ok(CeedQFunctionContextCreate(ceed, own.out()));
  ok(CeedQFunctionContextSetData(own, CEED_MEM_HOST, CEED_COPY_VALUES, sizeof number, &number));
  ok(CeedQFunctionCreateIdentity(ceed, 1, CEED_EVAL_NONE, CEED_EVAL_NONE, qf.out()));
  ok(CeedQFunctionSetContext(qf, own));
  ok(CeedQFunctionGetInnerContext(qf, found.out()));
  EXPECT_EQ(found.get(), own.get());
  ok(CeedQFunctionGetInnerContextData(qf, CEED_MEM_HOST, &data));
  EXPECT_EQ(*data, 4);
  ok(CeedQFunctionRestoreInnerContextData(qf, &data));
}

}  // namespace
