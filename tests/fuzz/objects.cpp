#include "objects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hg::fuzz {

using namespace hg::test;

namespace {

FILE *nowhere() {
  static FILE *const stream = std::fopen("/dev/null", "w");
  return stream;
}

}  // namespace

Objects::Objects(Random &random) : bytes(random), stream_(nowhere()) {
  ceeds_[0] = open("/cpu/self/ref/serial");
  ceeds_[1] = open(backend_of(bytes.next_byte()));
}

Objects::~Objects() {
  CeedDestroy(&ceeds_[0]);
  CeedDestroy(&ceeds_[1]);
}

void Objects::take_in(const Instance &instance) {
  int i = 0;
  for (const Restriction &rstr : instance.restrictions) {
    if (i < 5) ok(CeedElemRestrictionReferenceCopy(rstr, &restrictions.at(i++)));
  }
  if (instance.points_restriction)
    ok(CeedElemRestrictionReferenceCopy(instance.points_restriction, &restrictions.at(5)));
  i = 0;
  for (const Basis &basis : instance.bases) {
    if (basis && i < 5) ok(CeedBasisReferenceCopy(basis, &bases.at(i++)));
  }
  ok(CeedBasisReferenceCopy(instance.weight_basis, &bases.at(5)));
  i = 0;
  for (const Vector &vec : instance.passive) {
    if (i < 4) ok(CeedVectorReferenceCopy(vec, &vectors.at(i++)));
  }
  if (instance.points) ok(CeedVectorReferenceCopy(instance.points, &vectors.at(5)));
  ok(CeedQFunctionReferenceCopy(instance.qf, &qfunctions.at(0)));
  ok(CeedOperatorReferenceCopy(instance.op, &operators.at(0)));
}

void Objects::end() {
  const auto expect = [](int code, const char *what) {
    if (code != CEED_ERROR_SUCCESS) throw Defect(std::string("at the end: ") + what + " failed");
  };
  for (const CeedVector vec : vectors.lent()) {
    CeedScalar *array = nullptr;
    expect(CeedVectorRestoreArray(vec, &array), "restoring an array");
  }
  for (const CeedVector vec : readers) {
    const CeedScalar *array = nullptr;
    expect(CeedVectorRestoreArrayRead(vec, &array), "restoring an array for reading");
  }
  for (const CeedElemRestriction rstr : restrictions.lent()) {
    const CeedInt *offsets = nullptr;
    expect(CeedElemRestrictionRestoreOffsets(rstr, &offsets), "restoring offsets");
  }
  for (const CeedQFunctionContext ctx : contexts.lent()) {
    void *data = nullptr;
    expect(CeedQFunctionContextRestoreData(ctx, &data), "restoring data");
  }
  for (const CeedQFunctionContext ctx : context_readers) {
    void *data = nullptr;
    expect(CeedQFunctionContextRestoreDataRead(ctx, &data), "restoring data for reading");
  }
  operators.destroy_all();
  qfunctions.destroy_all();
  contexts.destroy_all();
  bases.destroy_all();
  restrictions.destroy_all();
  vectors.destroy_all();
  temporaries_.clear();
  for (CeedVector &vec : work_vectors) {
    Ceed ceed = CeedVectorReturnCeed(vec);
    expect(CeedRestoreWorkVector(ceed, &vec), "giving a work vector back");
  }
}

Ceed Objects::ceed() {
  const int choice = bytes.next_byte() % 16;
  return choice == 15 ? noted<Ceed>(nullptr, true) : ceeds_[choice == 14];
}

CeedVector Objects::vector() {
  const int choice = bytes.next_byte() % 16;
  if (choice == 13 && !work_vectors.empty()) return work_vectors.front();
  CeedVector vec = choice == 15 ? CEED_VECTOR_NONE : choice == 14 ? CEED_VECTOR_ACTIVE : vectors.at(choice);
  return noted(vec, vec == nullptr || vec == CEED_VECTOR_NONE || vec == CEED_VECTOR_ACTIVE);
}

CeedElemRestriction Objects::restriction() {
  const int choice = bytes.next_byte() % 16;
  CeedElemRestriction rstr = choice == 15 ? CEED_ELEMRESTRICTION_NONE : restrictions.at(choice);
  return noted(rstr, rstr == nullptr || rstr == CEED_ELEMRESTRICTION_NONE);
}

CeedBasis Objects::basis() {
  const int choice = bytes.next_byte() % 16;
  CeedBasis basis = choice == 15 ? CEED_BASIS_NONE : bases.at(choice);
  return noted(basis, basis == nullptr || basis == CEED_BASIS_NONE);
}

CeedQFunction Objects::qfunction() {
  const int choice = bytes.next_byte() % 16;
  CeedQFunction qf = choice == 15 ? CEED_QFUNCTION_NONE : qfunctions.at(choice);
  return noted(qf, qf == nullptr || qf == CEED_QFUNCTION_NONE);
}

CeedQFunctionContext Objects::context() {
  CeedQFunctionContext ctx = contexts.at(slot());
  return noted(ctx, ctx == nullptr);
}

CeedOperator Objects::op() {
  CeedOperator op = operators.at(slot());
  return noted(op, op == nullptr);
}

CeedInt Objects::count() {
  const int choice = bytes.next_byte();
  const bool before = took_nothing;
  CeedInt value = choice % 8;
  switch (choice / 8) {
    case 31:
      value = -1;
      break;
    case 30:
      value = std::numeric_limits<CeedInt>::min();
      break;
    case 29:
      value = 9;
      break;
    case 28:
    case 27:
      if (CeedBasis b = bases.at(choice)) CeedBasisGetNumNodes(b, &value);
      break;
    case 26:
    case 25:
      if (CeedBasis b = bases.at(choice)) CeedBasisGetNumQuadraturePoints(b, &value);
      break;
    case 24:
      if (CeedBasis b = bases.at(choice)) CeedBasisGetNumComponents(b, &value);
      break;
    case 23:
      if (CeedElemRestriction r = restrictions.at(choice)) CeedElemRestrictionGetElementSize(r, &value);
      break;
    case 22:
      if (CeedElemRestriction r = restrictions.at(choice)) CeedElemRestrictionGetNumComponents(r, &value);
      break;
    case 21:
      if (CeedElemRestriction r = restrictions.at(choice)) CeedElemRestrictionGetNumElements(r, &value);
      break;
    default:
      break;
  }
  took_nothing = before;
  return std::min(value, 64);
}

CeedInt Objects::few() {
  const int choice = bytes.next_byte();
  return choice == 255 ? -1 : choice == 254 ? std::numeric_limits<CeedInt>::min() : choice % 5;
}

CeedSize Objects::length() {
  const int choice = bytes.next_byte();
  CeedSize value = choice % 32;
  if (choice >= 252) return choice == 252 ? 1000 : choice == 253 ? -1 : std::numeric_limits<CeedSize>::min();
  switch (choice / 32) {
    case 7:
      if (CeedVector v = vectors.at(choice)) CeedVectorGetLength(v, &value);
      break;
    case 6:
    case 5:
      if (CeedElemRestriction r = restrictions.at(choice)) CeedElemRestrictionGetLVectorSize(r, &value);
      break;
    case 4:
    case 3:
      if (CeedElemRestriction r = restrictions.at(choice)) CeedElemRestrictionGetEVectorSize(r, &value);
      break;
    case 2:
      value *= bytes.next_byte() % 32;
      break;
    default:
      break;
  }
  return std::min<CeedSize>(value, 20000);
}

CeedScalar Objects::scalar() {
  static const CeedScalar values[] = {0, 1, -1, 0.5, 2, -3.25, 1e300, 1e-300, NAN, INFINITY};
  return values[bytes.next_byte() % std::size(values)];
}

const char *Objects::name() {
  static const char *const names[] = {nullptr, "",  "a",  "b",  "c",     "in0", "in1",     "in2",   "out0",   "out1",
                                      "u",     "v", "du", "dv", "qdata", "dx",  "weights", "input", "output", "size"};
  return names[bytes.next_byte() % std::size(names)];
}

CeedEvalMode Objects::eval_mode() {
  static const CeedEvalMode modes[] = {CEED_EVAL_NONE, CEED_EVAL_INTERP, CEED_EVAL_GRAD,
                                       CEED_EVAL_DIV,  CEED_EVAL_CURL,   CEED_EVAL_WEIGHT};
  return modes[bytes.next_byte() % 6];
}

CeedTransposeMode Objects::t_mode() {
  return flag() ? CEED_TRANSPOSE : CEED_NOTRANSPOSE;
}

CeedMemType Objects::mem_type() {
  return bytes.next_byte() >= 250 ? CEED_MEM_DEVICE : CEED_MEM_HOST;
}

CeedCopyMode Objects::copy_mode() {
  return static_cast<CeedCopyMode>(bytes.next_byte() % 3);
}

CeedElemTopology Objects::topology() {
  static const CeedElemTopology all[] = {CEED_TOPOLOGY_LINE, CEED_TOPOLOGY_TRIANGLE, CEED_TOPOLOGY_QUAD,
                                         CEED_TOPOLOGY_TET,  CEED_TOPOLOGY_PYRAMID,  CEED_TOPOLOGY_PRISM,
                                         CEED_TOPOLOGY_HEX};
  return all[bytes.next_byte() % 7];
}

CeedVector Objects::temporary(CeedSize length, CeedScalar value) {
  Vector vec;
  if (CeedVectorCreate(ceed(), length, vec.out()) != CEED_ERROR_SUCCESS) return nullptr;
  CeedVectorSetValue(vec, value);
  return temporaries_.emplace_back(std::move(vec));
}

CeedScalar *Objects::scalars(std::size_t size) {
  std::vector<CeedScalar> values(size);
  const std::uint8_t seed = bytes.next_byte();
  for (std::size_t i = 0; i < size; i++) values[i] = static_cast<CeedScalar>((i * 37 + seed * 11) % 23) / 8 - 1;
  return keep(values);
}

}  // namespace hg::fuzz
