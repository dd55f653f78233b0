#include "gen_workshop.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace hg::test {

namespace fs = std::filesystem;

namespace {

void write_text(const fs::path &file, const std::string &text) {
  std::ofstream stream(file);
  stream << text << std::flush;
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

void write_results(const fs::path &file, const Results &results) {
  std::ofstream stream(file, std::ios::binary);
  for (const Values &values : results) {
    const std::size_t size = values.size();
    stream.write(reinterpret_cast<const char *>(&size), sizeof size);
    stream.write(reinterpret_cast<const char *>(values.data()),
                 static_cast<std::streamsize>(size * sizeof(CeedScalar)));
  }
  stream.flush();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

Results read_results(const fs::path &file) {
  std::ifstream stream(file, std::ios::binary);
  Results results;
  std::size_t size = 0;
  while (stream.read(reinterpret_cast<char *>(&size), sizeof size)) {
    Values &values = results.emplace_back(size);
    stream.read(reinterpret_cast<char *>(values.data()), static_cast<std::streamsize>(size * sizeof(CeedScalar)));
  }
  return results;
}

int num_lines_with(const std::string &text, const std::string &fragment) {
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line);) count += line.find(fragment) != std::string::npos;
  return count;
}

}  // namespace

Process::Process(const Environment &environment, const std::function<Results()> &work) {
  std::fflush(nullptr);
  id_ = ::fork();
  if (id_ < 0) throw std::runtime_error("fork() failed");
  if (id_ > 0) return;
  int code = 1;
  try {
    for (const auto &[name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    if (std::freopen((folder_ / "err").c_str(), "w", stderr) == nullptr) throw std::runtime_error("no file for stderr");
    write_results(folder_ / "results", work());
    code = 0;
  } catch (const std::exception &error) {
    std::ofstream(folder_ / "thrown") << error.what();
  }
  std::exit(code);  // not _exit(): leaks count
}

Ran Process::wait() {
  int status = 0;
  if (::waitpid(id_, &status, 0) != id_) throw std::runtime_error("the process is gone");
  Ran ran{.results = read_results(folder_ / "results"), .err = read_text(folder_ / "err"), .failure = ""};
  if (status != 0) {
    ran.failure = "status " + std::to_string(status) + "; " + read_text(folder_ / "thrown") + "; it said:\n" + ran.err;
  }
  return ran;
}

Ran in_process(const Environment &environment, const std::function<Results()> &work) {
  return Process(environment, work).wait();
}

Model::Model(Ceed ceed, const Shape &shape, const Function &function, const Values &context, bool is_writable)
    : ceed_(ceed), shape_(shape), elem_size_(CeedIntPow(shape.P, shape.dim)) {
  const CeedInt Q = CeedIntPow(shape.Q, shape.dim);
  std::vector<CeedInt> offsets;
  for (CeedInt e = 0; e < shape.num_elem; e++) {
    for (CeedInt n = 0; n < elem_size_; n++) offsets.push_back(e * (elem_size_ - 1) + n);
  }
  ok(CeedElemRestrictionCreate(ceed, shape.num_elem, elem_size_, 1, 1, size(), CEED_MEM_HOST, CEED_COPY_VALUES,
                               offsets.data(), rstr_.out()));
  ok(CeedBasisCreateTensorH1Lagrange(ceed, shape.dim, 1, shape.P, shape.Q, CEED_GAUSS, basis_.out()));
  const char *location = function.location.c_str();
  ok(CeedQFunctionCreateInterior(ceed, 1, function.pointer, location, qf_.out()));
  ok(CeedQFunctionAddInput(qf_, "u", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf_, "c", 1, CEED_EVAL_INTERP));
  ok(CeedQFunctionAddInput(qf_, "w", 1, CEED_EVAL_WEIGHT));
  ok(CeedQFunctionAddInput(qf_, "id", 1, CEED_EVAL_NONE));
  ok(CeedQFunctionAddOutput(qf_, "v", 1, CEED_EVAL_INTERP));
  if (!context.empty()) {
    ok(CeedQFunctionContextCreate(ceed, context_.out()));
    set_context(context);
    ok(CeedQFunctionSetContext(qf_, context_));
    ok(CeedQFunctionSetContextWritable(qf_, is_writable));
  }
  Values coefficient(size());
  for (CeedSize i = 0; i < size(); i++) coefficient[i] = 1 + 0.5 * std::sin(0.9 * static_cast<CeedScalar>(i));
  coefficient_ = make_vector(ceed, coefficient);
  const auto create = shape.at_points ? CeedOperatorCreateAtPoints : CeedOperatorCreate;
  ok(create(ceed, qf_, CEED_QFUNCTION_NONE, CEED_QFUNCTION_NONE, op_.out()));
  ok(CeedOperatorSetField(op_, "u", rstr_, basis_, CEED_VECTOR_ACTIVE));
  ok(CeedOperatorSetField(op_, "c", rstr_, basis_, coefficient_));
  ok(CeedOperatorSetField(op_, "w", CEED_ELEMRESTRICTION_NONE, basis_, CEED_VECTOR_NONE));
  ok(CeedOperatorSetField(op_, "v", rstr_, basis_, CEED_VECTOR_ACTIVE));
  if (shape.at_points) return;
  Values id(static_cast<std::size_t>(shape.num_elem) * Q);
  for (std::size_t i = 0; i < id.size(); i++) id[i] = static_cast<CeedScalar>(i);
  id_ = make_vector(ceed, id);
  const CeedInt strides[] = {1, Q, Q};
  ok(CeedElemRestrictionCreateStrided(ceed, shape.num_elem, Q, 1, static_cast<CeedSize>(id.size()), strides,
                                      rstr_id_.out()));
  ok(CeedOperatorSetField(op_, "id", rstr_id_, CEED_BASIS_NONE, id_));
}

void Model::place_points(const std::vector<CeedInt> &counts, Random &random) {
  std::vector<CeedInt> list{shape_.num_elem + 1};
  for (const CeedInt count : counts) list.push_back(list.back() + count);
  const CeedInt total = list.back() - list.front();
  Values id;
  for (CeedInt p = 0; p < total; p++) {
    list.push_back(p);
    id.push_back(p);
  }
  const auto at_points = [&](CeedInt num_comp, Restriction &rstr) {
    ok(CeedElemRestrictionCreateAtPoints(ceed_, shape_.num_elem, total, num_comp, CeedSize{total} * num_comp,
                                         CEED_MEM_HOST, CEED_COPY_VALUES, list.data(), rstr.out()));
  };
  at_points(1, rstr_id_);
  at_points(shape_.dim, rstr_x_);
  id_ = make_vector(ceed_, id);
  x_ = make_vector(ceed_, random.reals(CeedSize{total} * shape_.dim));
  ok(CeedOperatorAtPointsSetPoints(op_, rstr_x_, x_));
  ok(CeedOperatorSetField(op_, "id", rstr_id_, CEED_BASIS_NONE, id_));
}

void Model::set_context(const Values &values) {
  Values copy = values;
  ok(CeedQFunctionContextSetData(context_, CEED_MEM_HOST, CEED_COPY_VALUES, copy.size() * sizeof(CeedScalar),
                                 copy.data()));
}

void Model::set_coefficient(const Values &values) {
  set_values(coefficient_, values);
}

Values Model::context_values() const {
  std::size_t size = 0;
  const void *data = nullptr;
  ok(CeedQFunctionContextGetContextSize(context_, &size));
  ok(CeedQFunctionContextGetDataRead(context_, CEED_MEM_HOST, &data));
  const auto *begin = static_cast<const CeedScalar *>(data);
  Values values(begin, begin + size / sizeof(CeedScalar));
  ok(CeedQFunctionContextRestoreDataRead(context_, &data));
  return values;
}

Values Model::some_input() const {
  Values u(size());
  for (CeedSize i = 0; i < size(); i++) u[i] = std::cos(0.7 * static_cast<CeedScalar>(i)) + 0.25;
  return u;
}

Values Model::apply(const Values &u) const {
  const Vector in = make_vector(ceed_, u), out = make_vector(ceed_, size(), 1e30);
  ok(CeedOperatorApply(op_, in, out, CEED_REQUEST_IMMEDIATE));
  return values_of(out);
}

Workshop::Workshop() {
  write_program("diary_cxx", "echo \"$*\" >> " + quoted(folder_ / "diary") + "\nexec " + real_compiler() + " \"$@\"\n");
}

Environment Workshop::environment(const Environment &changes) const {
  const char *flags = std::getenv("CEED_GEN_FLAGS");
  Environment all = changes;
  all.merge(Environment{{"CEED_CACHE_DIR", cache()},
                        {"CEED_CACHE_SIZE", ""},
                        {"CEED_CXX", folder_ / "diary_cxx"},
                        {"CXX", ""},
                        {"CEED_GEN_FLAGS", flags != nullptr ? flags : "-O1"},
                        {"CEED_GEN_REPORT", ""},
                        {"CEED_JIT_ERROR_ON_FAILURE", ""},
                        {"LC_ALL", "C"}});
  return all;
}

std::string Workshop::write_program(const std::string &name, const std::string &text) const {
  const fs::path file = folder_ / name;
  write_text(file, "#!/bin/sh\n" + text);
  fs::permissions(file, fs::perms::owner_all);
  return file;
}

Function Workshop::write(const std::string &file, const std::string &function, const std::string &text,
                         CeedQFunctionUser pointer) const {
  write_text(folder_ / file, text);
  return {pointer, (folder_ / file).string() + ":" + function};
}

Function Workshop::write_scale() const {
  return write("scale.h", "scale", R"(#include <ceed/types.h>
#include "factor.h"

CEED_QFUNCTION(scale)(void *context, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out) {
  const CeedScalar factor = context ? *(const CeedScalar *)context : FACTOR;
  CeedPragmaSIMD for (CeedInt q = 0; q < Q; q++) out[0][q] = factor * in[2][q] * in[1][q] * in[0][q];
  return 0;
}
)",
               scale<7>);
}

void Workshop::write_factor(int factor) const {
  write_text(folder_ / "factor.h", "#ifndef FACTOR\n#define FACTOR " + std::to_string(factor) + "\n#endif\n");
}

int Workshop::num_made() const {
  return num_lines_with(read_text(folder_ / "diary"), " -shared ");
}

int Workshop::num_starts() const {
  return num_lines_with(read_text(folder_ / "diary"), "");
}

int Workshop::num_cached(const std::string &extension) const {
  int count = 0;
  for (const auto &found : fs::directory_iterator(cache())) count += found.path().extension() == extension;
  return count;
}

std::string real_compiler() {
  for (const char *variable : {"CEED_CXX", "CXX"}) {
    if (const char *value = std::getenv(variable); value != nullptr && *value != '\0') return value;
  }
  return "c++";
}

int num_warnings(const std::string &err) {
  return num_lines_with(err, "is not compiled");
}

void expect_equal(const Results &got, const Results &want, SourceLocation where) {
  const ::testing::ScopedTrace trace(where.file_name(), static_cast<int>(where.line()), "compared here");
  ASSERT_EQ(got.size(), want.size());
  for (std::size_t i = 0; i < got.size(); i++) EXPECT_EQ(got[i], want[i]) << "result " << i;
}

}  // namespace hg::test
