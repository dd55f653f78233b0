#include "fused.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "restriction.hpp"

namespace hg::gpu {

using host::chk;

namespace {

Side side_of(CeedElemRestriction rstr, const CeedScalar *values) {
  const CeedElementMap &map = map_of(rstr);
  const bool is_strided = map.offsets == nullptr;
  return {.values = const_cast<CeedScalar *>(values),  // sinks are written
          .offsets = is_strided ? nullptr : offsets_of(rstr),
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
  const void *data() const { return bytes_.data(); }
  std::size_t size() const { return bytes_.size(); }

 private:
  std::vector<std::byte> bytes_;
};

/// Three quarters of a block's threads, in whole warps.
int block_of_points(const Properties &device, int threads) {
  return std::max(device.warp_size, threads * 3 / 4 / device.warp_size * device.warp_size);
}

/// Whether two components of nodes of one element are one entry of the L-vector.
bool meets_itself(CeedElemRestriction rstr) {
  const CeedElementMap &map = map_of(rstr);
  std::vector<CeedInt> last_elem(map.l_size, -1);
  for (CeedInt e = 0; e < map.num_elem; e++) {
    for (CeedInt n = 0; n < map.elem_size; n++) {
      const CeedSize node = map.offsets != nullptr
                                ? map.offsets[static_cast<CeedSize>(e) * map.elem_size + n]
                                : static_cast<CeedSize>(n) * map.strides[0] + static_cast<CeedSize>(e) * map.strides[2];
      for (CeedInt c = 0; c < map.num_comp; c++) {
        const CeedSize step = map.offsets != nullptr ? map.comp_stride : map.strides[1];
        if (std::exchange(last_elem[node + c * step], e) == e) return true;
      }
    }
  }
  return false;
}

bool is_diagonal(Purpose purpose) {
  return purpose == Purpose::diagonal || purpose == Purpose::point_blocks;
}

}  // namespace

std::unique_ptr<FusedOperator> FusedOperator::make(Device &device, const CeedProgram &program, Purpose purpose) {
  const FunctionText function(program.qf);
  const Properties &properties = device.driver().properties();
  // At points fewer threads in a block, which have more to keep in shared memory: seven cells of 27 points, three
  // of 64.
  const int at_points = block_of_points(properties, device.block_threads());
  const Block block{.num_threads = program.at_points ? at_points : device.block_threads(),
                    .warp_size = properties.warp_size,
                    .shared_bytes = properties.shared_per_block};
  OperatorText text = program.at_points ? cells_text(block, program, function, purpose)
                                        : elements_text(block, program, function, purpose);
  if (text.text.empty()) return nullptr;
  for (CeedInt t = 0; is_diagonal(purpose) && t < program.num_sinks; t++) {
    if (program.sinks[t].is_active && meets_itself(program.sinks[t].rstr)) return nullptr;
  }
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

/// Cells that follow each other, as long as a thread of the block has no more than one point.
void FusedOperator::group(const CeedProgram &program) {
  const CeedElementMap &map = map_of(program.points_rstr);
  std::vector<CeedInt> groups, elem;
  elem.reserve(map.offsets[program.num_elem] - map.offsets[0]);
  for (CeedInt e = 0; e < program.num_elem; e++) {
    const CeedInt first = groups.empty() ? 0 : groups.back();
    const bool is_full = e - first >= text_.num_elem || map.offsets[e + 1] - map.offsets[first] > text_.num_threads;
    if (groups.empty() || (is_full && e > first)) groups.push_back(e);
    elem.insert(elem.end(), map.offsets[e + 1] - map.offsets[e], e);
  }
  num_groups_ = static_cast<CeedInt>(groups.size());
  groups.push_back(program.num_elem);
  most_cells_ = 0;
  for (CeedInt g = 0; g < num_groups_; g++) most_cells_ = std::max(most_cells_, groups[g + 1] - groups[g]);
  groups_ = device_.upload(groups);
  elem_ = device_.upload(elem);
  points_epoch_ = program.points_epoch;
}

void FusedOperator::prepare(const CeedProgram &program) {
  const auto one_thread = device_.lock();
  list_nodes(program);
  state_.context();
}

void FusedOperator::list_nodes(const CeedProgram &program) {
  if (program.at_points && program.points_epoch != points_epoch_) group(program);
  const auto list = [](CeedElemRestriction rstr) {
    if (map_of(rstr).offsets != nullptr) offsets_of(rstr);
  };
  for (CeedInt s = 0; s < program.num_sources; s++) list(program.sources[s].rstr);
  for (CeedInt t = 0; t < program.num_sinks; t++) list(program.sinks[t].rstr);
  if (program.at_points) list(program.points_rstr);
}

void FusedOperator::apply_add(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode) {
  host::ProgramArrays arrays(program, in, out, mode, program.at_points, CEED_MEM_DEVICE);
  std::vector<Side> sinks;
  for (CeedInt t = 0; t < program.num_sinks; t++) {
    sinks.push_back(side_of(program.sinks[t].rstr, arrays.sinks()[t]));
    const bool is_own = map_of(program.sinks[t].rstr).is_copy && is_alone(program, t);
    sinks.back().access = arrays.is_set(t) ? Side::set : is_own ? Side::add_own : Side::add_shared;
  }
  launch(program, arrays, sinks, nullptr);
  arrays.release();
}

void FusedOperator::assemble(const CeedProgram &program, CeedSize offset, CeedVector values) {
  host::ProgramArrays arrays(program, CEED_MEM_DEVICE);
  host::Writer entries(values, purpose_ == Purpose::qfunction ? host::Writer::write_only : host::Writer::read_write,
                       CEED_MEM_DEVICE);
  std::vector<Side> sinks;
  for (CeedInt t = 0; t < program.num_sinks; t++) {
    sinks.push_back(side_of(program.sinks[t].rstr, is_diagonal(purpose_) ? entries.data() : nullptr));
  }
  launch(program, arrays, sinks, entries.data() + offset);
  entries.release();
  arrays.release();
}

void FusedOperator::launch(const CeedProgram &program, const host::ProgramArrays &arrays,
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
    facts.groups = groups_.as<CeedInt>();
    facts.elem = elem_.as<CeedInt>();
  }
  JobBytes job;
  job.add(&facts, 1);
  job.add(sources.data(), sources.size());
  job.add(sinks.data(), sinks.size());
  job.add(text_.numbers.data(), text_.numbers.size());
  const CeedInt num_blocks = program.at_points ? num_groups_ : (program.num_elem + text_.num_elem - 1) / text_.num_elem;
  const Launch launch{.num_blocks = static_cast<std::uint64_t>(num_blocks),
                      .num_threads = text_.num_threads,
                      .shared_bytes = text_.shared_bytes + most_cells_ * text_.bytes_of_cell,
                      .has_barriers = text_.shared_bytes + text_.bytes_of_cell > 0};
  if (num_blocks > 0) device_.driver().launch(kernel_, launch, job.data(), job.size());
  host::check_returned(program, state_.returned(), 0, program.num_elem);
}

}  // namespace hg::gpu
