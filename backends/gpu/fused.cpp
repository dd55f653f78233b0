#include "fused.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>

#include "restriction.hpp"

namespace hg::gpu {

using host::chk;

namespace {

/// Whether an L-vector is reached by a list of nodes of its own. At points all have one list, that of the coordinates.
bool has_list(const CeedElementMap &map) {
  return map.offsets != nullptr && map.type != CEED_RESTRICTION_POINTS;
}

Side side_of(CeedElemRestriction rstr, const CeedScalar *values) {
  const CeedElementMap &map = map_of(rstr);
  const bool is_strided = map.offsets == nullptr;
  return {.values = const_cast<CeedScalar *>(values),  // sinks are written
          .offsets = has_list(map) ? offsets_of(rstr) : nullptr,
          .node_stride = is_strided ? map.strides[0] : 0,
          .comp_stride = is_strided ? map.strides[1] : map.comp_stride,
          .elem_stride = is_strided ? map.strides[2] : 0};
}

/// The bytes of an OperatorJob, part after part.
class JobBytes {
 public:
  template <typename T>
  void add(const T *values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(CeedSize) == 0);
    const auto *from = reinterpret_cast<const std::byte *>(values);
    bytes_.insert(bytes_.end(), from, from + count * sizeof(T));
    if (count == 0) bytes_.resize(bytes_.size() + sizeof(T));  // arrays have at least one entry
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// The cells that have points. Those that follow each other are in order of their steps, most of them first, so that a
/// warp has cells that take about as many, and its first one as many as any; not over all cells, which would lose what
/// neighbours share in caches.
std::vector<CeedInt> cells_with_points(const CeedElementMap &map, CeedInt points_of_step) {
  constexpr std::size_t together = 512;  // whole warps, however many cells these have
  std::vector<CeedInt> cells, before(together), steps(together), places;
  cells.reserve(map.num_elem);
  for (CeedInt e = 0; e < map.num_elem; e++) {
    if (map.offsets[e + 1] > map.offsets[e]) cells.push_back(e);
  }
  // Counted, not compared, which takes a tenth of the time; there are fewer counts than points of the largest cell.
  for (std::size_t first = 0; first < cells.size(); first += together) {
    const std::size_t count = std::min(together, cells.size() - first);
    CeedInt most = 0;
    for (std::size_t i = 0; i < count; i++) {
      const CeedInt e = before[i] = cells[first + i];
      steps[i] = (map.offsets[e + 1] - map.offsets[e] + points_of_step - 1) / points_of_step;
      most = std::max(most, steps[i]);
    }
    places.assign(most + 1, 0);
    for (std::size_t i = 0; i < count; i++) places[most - steps[i] + 1]++;
    for (CeedInt s = 0; s < most; s++) places[s + 1] += places[s];
    for (std::size_t i = 0; i < count; i++) cells[first + places[most - steps[i]]++] = before[i];
  }
  return cells;
}

/// Whether an element meets an entry of the L-vectors twice in active fields with different restrictions, or in one.
bool meets_entries_twice(const CeedProgram &program) {
  std::vector<CeedElemRestriction> spaces;
  const auto find = [&](const CeedProgramSide *sides, CeedInt count) {
    for (CeedInt i = 0; i < count; i++) {
      const bool is_new = std::find(spaces.begin(), spaces.end(), sides[i].rstr) == spaces.end();
      if (sides[i].is_active && is_new) spaces.push_back(sides[i].rstr);
    }
  };
  find(program.sources, program.num_sources);
  find(program.sinks, program.num_sinks);
  CeedSize length = 0;
  for (CeedElemRestriction rstr : spaces) length = std::max(length, map_of(rstr).l_size);
  std::vector<CeedInt> last_elem(length, -1);
  for (CeedInt e = 0; e < program.num_elem; e++) {
    for (CeedElemRestriction rstr : spaces) {
      const CeedElementMap &map = map_of(rstr);
      const bool is_strided = map.offsets == nullptr;
      const CeedSize step = is_strided ? map.strides[1] : map.comp_stride;
      for (CeedInt n = 0; n < map.elem_size; n++) {
        const CeedSize node =
            is_strided ? static_cast<CeedSize>(n) * map.strides[0] + static_cast<CeedSize>(e) * map.strides[2]
                       : static_cast<CeedSize>(map.offsets[static_cast<CeedSize>(e) * map.elem_size + n]);
        for (CeedInt c = 0; c < map.num_comp; c++) {
          if (std::exchange(last_elem[node + c * step], e) == e) return true;
        }
      }
    }
  }
  return false;
}

/// The text of an operator at points, laid out as those of its kind that were made before, unless that leaves many more
/// threads without a point than another layout would: so nothing is compiled when points move a little, and operators
/// are made anew for them.
OperatorText lasting_text(Device &device, Block block, const CeedProgram &program, const FunctionText &function,
                          Purpose purpose) {
  constexpr double many_more = 1.25;
  OperatorText best = cells_text(block, program, function, purpose);
  if (best.lanes == 0 || block.lanes != 0 || block.slots != 0) return best;
  // A layout that says nothing of the points, and fits where any does.
  block.lanes = block.warp_size;
  block.slots = 1;
  const OperatorText kind = cells_text(block, program, function, purpose);
  if (kind.text.empty()) return best;
  const auto one_thread = device.lock();
  Device::Layout &layout = device.layout_of(std::hash<std::string>()(kind.text));
  if (layout.lanes != 0 && (layout.lanes != best.lanes || layout.slots != best.slots)) {
    block.lanes = layout.lanes;
    block.slots = layout.slots;
    OperatorText as_before = cells_text(block, program, function, purpose);
    if (as_before.lanes != 0 && as_before.places_of_point <= many_more * best.places_of_point) return as_before;
  }
  layout = {.lanes = best.lanes, .slots = best.slots};
  return best;
}

bool is_diagonal(Purpose purpose) {
  return purpose == Purpose::diagonal || purpose == Purpose::point_blocks;
}

}  // namespace

std::unique_ptr<FusedOperator> FusedOperator::make(Device &device, const CeedProgram &program, Purpose purpose) {
  const FunctionText function(program.qf);
  const Properties &properties = device.driver().properties();
  // At points warps do not wait for each other: blocks are small, and the next one begins sooner.
  const Tuning &tuning = device.tuning();
  const int at_points = std::max(1, tuning.threads / 2 / properties.warp_size) * properties.warp_size;
  const Block block{.num_threads = program.at_points ? at_points : tuning.threads,
                    .warp_size = properties.warp_size,
                    .shared_bytes = properties.shared_per_block,
                    .lanes = tuning.lanes,
                    .slots = tuning.slots};
  OperatorText text = program.at_points ? lasting_text(device, block, program, function, purpose)
                                        : elements_text(block, program, function, purpose);
  if (text.text.empty()) return nullptr;
  if (is_diagonal(purpose) && meets_entries_twice(program)) return nullptr;
  return std::unique_ptr<FusedOperator>(new FusedOperator(device, program, function, std::move(text), purpose));
}

FusedOperator::FusedOperator(Device &device, const CeedProgram &program, const FunctionText &function,
                             OperatorText text, Purpose purpose)
    : device_(device),
      purpose_(purpose),
      state_(device, program.qf, function.may_fail),
      text_(std::move(text)),
      module_(device.driver().compile("operator of " + function.name, text_.text)),
      kernel_(module_->kernel("hg_operator")),
      tables_(device.upload(text_.tables)) {}

void FusedOperator::list_cells(const CeedProgram &program) {
  const CeedElementMap &map = map_of(program.points_rstr);
  num_points_ = map.offsets[program.num_elem] - map.offsets[0];
  if (text_.num_elem > 0) {
    const std::vector<CeedInt> cells = cells_with_points(map, text_.points_of_step);
    num_cells_ = static_cast<CeedSize>(cells.size());
    cells_ = device_.upload(cells);
  }
  points_epoch_ = program.points_epoch;
}

void FusedOperator::prepare(const CeedProgram &program) {
  const auto one_thread = device_.lock();
  list_nodes(program);
  state_.context();
}

void FusedOperator::list_nodes(const CeedProgram &program) {
  if (program.at_points && program.points_epoch != points_epoch_) list_cells(program);
  const auto list = [](CeedElemRestriction rstr) {
    if (has_list(map_of(rstr))) offsets_of(rstr);
  };
  for (CeedInt s = 0; s < program.num_sources; s++) list(program.sources[s].rstr);
  for (CeedInt t = 0; t < program.num_sinks; t++) list(program.sinks[t].rstr);
  if (program.at_points) offsets_of(program.points_rstr);
}

Call FusedOperator::call_of(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  host::ProgramArrays arrays(program, in, out, mode, program.at_points, CEED_MEM_DEVICE);
  std::vector<Side> sinks;
  for (CeedInt t = 0; t < program.num_sinks; t++) {
    sinks.push_back(side_of(program.sinks[t].rstr, arrays.sinks()[t]));
    const bool is_own = map_of(program.sinks[t].rstr).is_copy && is_alone(program, t);
    sinks.back().access = arrays.is_set(t) ? Side::set : is_own ? Side::add_own : Side::add_shared;
  }
  Call call = call_of(program, arrays, sinks, nullptr);
  arrays.release();
  return call;
}

void FusedOperator::apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  launch(call_of(program, in, out, mode), program);
}

void FusedOperator::assemble(const CeedProgram &program, CeedSize offset, CeedVector values) {
  host::ProgramArrays arrays(program, CEED_MEM_DEVICE);
  host::Writer entries(values, purpose_ == Purpose::qfunction ? host::Writer::write_only : host::Writer::read_write,
                       CEED_MEM_DEVICE);
  std::vector<Side> sinks;
  for (CeedInt t = 0; t < program.num_sinks; t++) {
    sinks.push_back(side_of(program.sinks[t].rstr, is_diagonal(purpose_) ? entries.data() : nullptr));
  }
  launch(call_of(program, arrays, sinks, entries.data() + offset), program);
  entries.release();
  arrays.release();
}

void FusedOperator::launch(const Call &call, const CeedProgram &program) {
  const auto one_thread = device_.lock();
  if (call.launch.num_blocks > 0) device_.driver().make(call);
  check(program);
}

void FusedOperator::check(const CeedProgram &program) {
  host::check_returned(program, state_.returned(), 0, program.num_elem);
}

Call FusedOperator::call_of(const CeedProgram &program, const host::ProgramArrays &arrays,
                            const std::vector<Side> &sinks, CeedScalar *entries) {
  list_nodes(program);
  std::vector<Side> sources;
  for (CeedInt s = 0; s < program.num_sources; s++) {
    sources.push_back(side_of(program.sources[s].rstr, arrays.sources()[s]));
  }
  const auto one_thread = device_.lock();
  OperatorFacts facts{.num_elem = program.num_elem,
                      .tables = tables_.as<CeedScalar>(),
                      .context = state_.context(),
                      .failed = state_.clear_failed(),
                      .entries = entries};
  if (program.at_points) {
    facts.points = side_of(program.points_rstr, arrays.points());
    facts.points.offsets = offsets_of(program.points_rstr);
    facts.cells = cells_.as<CeedInt>();
    facts.num_cells = num_cells_;
  }
  JobBytes job;
  job.add(&facts, 1);
  job.add(sources.data(), sources.size());
  job.add(sinks.data(), sinks.size());
  job.add(text_.numbers.data(), text_.numbers.size());
  const bool is_by_points = text_.num_elem == 0;
  const CeedSize work = is_by_points ? num_points_ : program.at_points ? num_cells_ : program.num_elem;
  const CeedSize of_block = is_by_points ? text_.num_threads : text_.num_elem;
  const CeedSize num_blocks = (work + of_block - 1) / of_block;
  const Launch launch{.num_blocks = static_cast<std::uint64_t>(num_blocks),
                      .num_threads = text_.num_threads,
                      .shared_bytes = text_.shared_bytes,
                      .has_barriers = program.at_points ? !is_by_points : text_.shared_bytes > 0};
  return {.kernel = kernel_, .launch = launch, .job = job.take()};
}

}  // namespace hg::gpu
