#include "operator.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "../host/access.hpp"
#include "../jit/compiler.hpp"
#include "../jit/tell.hpp"

namespace hg::gen {

using host::chk, jit::is_set, jit::NoSource, jit::NotCompiled, jit::tell_once;

namespace {

Side side_of(CeedElemRestriction rstr) {
  const CeedElementMap *map = nullptr;
  chk(CeedElemRestrictionGetElementMap(rstr, &map));
  const bool is_strided = map->offsets == nullptr;
  return {.offsets = map->offsets,
          .comp_stride = is_strided ? map->strides[1] : map->comp_stride,
          .elem_stride = is_strided ? map->strides[2] : 0,
          .l_size = map->l_size};
}

std::vector<Side> sides_of(const CeedProgramSide *sides, CeedInt count) {
  std::vector<Side> all;
  for (CeedInt i = 0; i < count; i++) all.push_back(side_of(sides[i].rstr));
  return all;
}

/// Even-odd contractions of any shape up to this one: larger ones would not stay in registers.
constexpr CeedInt largest_even_odd = 16;
void never_called(const CeedScalar *, CeedInt, CeedInt, CeedInt, CeedInt, const CeedScalar *, CeedScalar *,
                  host::Ahead &) {}
host::Contraction printed_contraction(CeedInt M, CeedInt N, host::Symmetry symmetry, bool) {
  return symmetry == host::Symmetry::none || std::max(M, N) <= largest_even_odd ? never_called : nullptr;
}

/// Elements of a block: as many as there are lanes, or half of them in three dimensions where derivatives are evaluated
/// (what is stored for them is then asked for less long before it is used: 3 to 20 % faster with 27 points or more, up
/// to 30 % slower with fewer), and where the points' planes are whole pages apart, which a contraction across them
/// would read from one set of the first-level cache (up to 25 %). Measured with eight lanes, docs/performance/cpu.md.
CeedInt width_for(const host::Kernels &kernels, const CeedProgram &program) {
  constexpr std::size_t page = 4096;
  constexpr CeedInt few_points = 27;
  bool is_half = false;
  for (CeedInt i = 0; i < program.num_inputs && !program.at_points; i++) {
    const CeedProgramField &field = program.inputs[i];
    if (field.eval_mode != CEED_EVAL_INTERP && field.eval_mode != CEED_EVAL_GRAD) continue;
    const CeedBasis basis = program.spaces[field.space].basis;
    CeedInt dim = 0, Q_1d = 0;
    bool is_tensor = false;
    chk(CeedBasisIsTensor(basis, &is_tensor));
    if (!is_tensor) continue;
    chk(CeedBasisGetDimension(basis, &dim));
    chk(CeedBasisGetNumQuadraturePoints1D(basis, &Q_1d));
    const bool has_planes_in_a_set = sizeof(CeedScalar) * kernels.width * Q_1d * Q_1d % page == 0;
    const bool has_derivatives = field.eval_mode == CEED_EVAL_GRAD && program.num_qpts >= few_points;
    is_half = is_half || (dim == 3 && (has_planes_in_a_set || has_derivatives));
  }
  return is_half && kernels.width == host::max_width ? kernels.width / 2 : kernels.width;
}

}  // namespace

Operator::Operator(host::Operator &&interpreted, const host::Kernels &kernels, const CeedProgram &program)
    : host::Operator(std::move(interpreted)), kernels_(kernels) {
  kernels_.contraction = printed_contraction;
  kernels_.width = width_for(kernels, program);
}

std::unique_ptr<Operator> Operator::make(const host::Kernels &kernels, const CeedProgram &program) {
  auto interpreted = host::Operator::make(kernels, program);
  if (interpreted == nullptr) return nullptr;
  return std::unique_ptr<Operator>(new Operator(std::move(*interpreted), kernels, program));
}

void Operator::prepare_assembly(const CeedProgram &program) {
  if (!has_function_) compile(program, false);
}

void Operator::prepare(const CeedProgram &program) {
  if (!has_loop_) compile(program, true);
}

void Operator::compile(const CeedProgram &program, bool with_loop) {
  const bool had_function = std::exchange(has_function_, true);
  has_loop_ = has_loop_ || with_loop;
  const char *name = nullptr;
  chk(CeedQFunctionGetName(program.qf, &name));
  try {
    const Source source = Source::of(program.qf);
    Printed printed = with_loop ? print(program, source.function) : Printed();
    const Library library = gen::compile(kernels_, source, printed);
    if (library.function != nullptr) set_function(library.function);
    has_function_ = had_function || library.function != nullptr;
    if (library.apply == nullptr) return;
    work_ = host::allocate_array(printed.work);
    work_length_ = printed.work;
    if (!work_) throw std::bad_alloc();
    std::fill_n(work_.get(), printed.work, 0.0);
    numbers_ = std::move(printed.numbers);
    apply_ = library.apply;
  } catch (const NotCompiled &reason) {
    if (is_set("CEED_JIT_ERROR_ON_FAILURE") && dynamic_cast<const NoSource *>(&reason) == nullptr) {
      has_function_ = had_function;
      has_loop_ = false;  // the next call is an error again
      throw;
    }
    const std::string what =
        "gen: the QFunction '" + std::string(name) + "' is not compiled, and runs as on /cpu/self/avx/blocked: ";
    tell_once(what, what + reason.what());
  }
}

std::size_t Operator::num_bytes() const {
  std::size_t bytes = host::Operator::num_bytes() + sizeof *this - sizeof(host::Operator);
  bytes += work_length_ * sizeof(CeedScalar) + numbers_.size() * sizeof(const CeedScalar *);
  for (const auto &basis : block_bases_) bytes += basis.num_bytes();
  for (const auto &basis : point_bases_) bytes += basis.num_bytes();
  return bytes;
}

Printed Operator::print(const CeedProgram &program, const std::string &function) {
  std::vector<const host::PointBasis *> at_points;
  std::vector<const host::BlockBasis *> in_blocks;
  block_bases_.clear();
  point_bases_.clear();
  block_bases_.reserve(program.num_spaces);  // they are pointed to
  point_bases_.reserve(program.num_spaces);
  for (CeedInt i = 0; i < program.num_spaces; i++) {
    const CeedProgramSpace &space = program.spaces[i];
    if (!program.at_points) {
      in_blocks.push_back(&block_bases_.emplace_back(kernels_, space.basis));
    } else if (space.rstr == CEED_ELEMRESTRICTION_NONE) {
      at_points.push_back(nullptr);
    } else {
      at_points.push_back(&point_bases_.emplace_back(kernels_, space.basis));
    }
  }
  return program.at_points ? print_points(kernels_, program, function, at_points)
                           : print_blocks(kernels_, program, function, in_blocks);
}

void Operator::apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  prepare(program);
  if (apply_ == nullptr) {
    follow(program);
    return host::Operator::apply_add(program, in, out, mode);
  }
  host::ProgramArrays arrays(program, in, out, mode, program.at_points);
  const auto sets = std::make_unique<bool[]>(program.num_sinks);
  for (CeedInt t = 0; t < program.num_sinks; t++) sets[t] = arrays.is_set(t);
  host::ContextData context(program.qf);
  const auto sources = sides_of(program.sources, program.num_sources);
  const auto sinks = sides_of(program.sinks, program.num_sinks);
  const Side points = program.at_points ? side_of(program.points_rstr) : Side{};
  const CeedInt W = kernels_.width;
  Job job{.first = 0,
          .end = program.at_points ? program.num_elem : program.num_elem / W * W,
          .context = context.data(),
          .sources = sources.data(),
          .sinks = sinks.data(),
          .inputs = arrays.sources().data(),
          .outputs = arrays.sinks().data(),
          .sets = sets.get(),
          .numbers = numbers_.data(),
          .work = work_.get(),
          .points = &points,
          .x_ref = arrays.points(),
          .failed = 0};
  const int code = apply_(&job);
  host::check_returned(program, code, job.failed, std::min(W, program.num_elem - job.failed));
  if (job.end < program.num_elem) apply_from(job.end, program, arrays, context.data());
  context.release();
  arrays.release();
}

}  // namespace hg::gen
