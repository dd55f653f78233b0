#include "restriction.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include "../host/access.hpp"
#include "tables.hpp"

namespace hg::gpu {

using host::chk, host::wall;

const CeedElementMap &map_of(CeedElemRestriction rstr) {
  const CeedElementMap *map = nullptr;
  chk(CeedElemRestrictionGetElementMap(rstr, &map));
  return *map;
}

namespace {

/// Places of the nodes in the order of elements, and what belongs to them.
struct Lists {
  std::vector<CeedSize> place, entry;
  std::vector<CeedInt> step;
  std::vector<CeedInt8> bands;

  void add(const CeedElementMap &map, CeedInt e, CeedSize first_entry, CeedInt stride) {
    const bool is_points = map.type == CEED_RESTRICTION_POINTS;
    const CeedInt B = map.block_size, count = is_points ? map.offsets[e + 1] - map.offsets[e] : map.elem_size;
    for (CeedInt n = 0; n < count; n++) {
      const CeedSize in_table = (static_cast<CeedSize>(e / B) * map.elem_size + n) * B + e % B;
      if (is_points) {
        place.push_back(static_cast<CeedSize>(map.offsets[map.offsets[e] + n]) * map.num_comp);
      } else if (map.offsets == nullptr) {
        place.push_back(static_cast<CeedSize>(n) * map.strides[0] + static_cast<CeedSize>(e) * map.strides[2]);
      } else {
        place.push_back(map.offsets[in_table]);
      }
      entry.push_back(first_entry + static_cast<CeedSize>(n) * stride);
      step.push_back(count * stride);
      for (CeedInt k = 0; k < map.num_bands; k++) {
        const CeedSize row = static_cast<CeedSize>(e / B) * map.elem_size * map.num_bands + n * map.num_bands + k;
        bands.push_back(map.bands[row * B + e % B]);
      }
    }
  }
};

}  // namespace

Nodes::Nodes(Device &device, CeedElemRestriction rstr, Layout layout) : device_(&device) {
  const CeedElementMap &map = map_of(rstr);
  const bool is_points = map.type == CEED_RESTRICTION_POINTS;
  const CeedInt B = layout == Layout::blocks ? map.block_size : 1;
  const CeedSize of_element = static_cast<CeedSize>(map.elem_size) * map.num_comp;
  const auto first_entry = [&](CeedInt e) {
    return is_points ? (static_cast<CeedSize>(map.offsets[e]) - map.offsets[0]) * map.num_comp
                     : e / B * of_element * B + e % B;
  };
  Lists lists;
  for (CeedInt e = 0; e < map.num_elem; e++) lists.add(map, e, first_entry(e), B);
  const auto num_nodes = static_cast<CeedSize>(lists.place.size());
  e_size_ = is_points ? num_nodes * map.num_comp : (map.num_elem + B - 1) / B * B * of_element;

  std::vector<CeedSize> nodes(num_nodes), rows;
  std::iota(nodes.begin(), nodes.end(), CeedSize{0});
  const auto place = [&](CeedSize node) { return lists.place[node]; };
  std::stable_sort(nodes.begin(), nodes.end(), [&](CeedSize a, CeedSize b) { return place(a) < place(b); });
  for (CeedSize i = 0; i < num_nodes; i++) {
    if (i == 0 || place(nodes[i]) != place(nodes[i - 1])) rows.push_back(i);
  }
  const auto num_rows = static_cast<CeedSize>(rows.size());
  rows.push_back(num_nodes);

  // The last element again, until its block is full.
  for (CeedInt e = map.num_elem; B > 1 && map.num_elem > 0 && e % B != 0; e++) {
    lists.add(map, map.num_elem - 1, first_entry(e), B);
  }
  num_repeated_ = static_cast<CeedSize>(lists.place.size()) - num_nodes;

  place_ = device.upload(lists.place);
  entry_ = device.upload(lists.entry);
  step_ = device.upload(lists.step);
  bands_ = device.upload(lists.bands);
  rows_ = device.upload(rows);
  nodes_ = device.upload(nodes);
  job_.num_nodes = num_nodes;
  job_.num_comp = map.num_comp;
  job_.comp_stride = is_points ? 1 : map.offsets == nullptr ? map.strides[1] : map.comp_stride;
  job_.place = place_.as<CeedSize>();
  job_.entry = entry_.as<CeedSize>();
  job_.step = step_.as<CeedInt>();
  job_.elem_size = map.elem_size;
  job_.num_bands = map.num_bands;
  job_.bands = bands_.as<CeedInt8>();
  job_.rows = rows_.as<CeedSize>();
  job_.nodes = nodes_.as<CeedSize>();
  job_.num_rows = num_rows;
}

void Nodes::gather(const CeedScalar *u, CeedScalar *v) const {
  RestrictionJob job = job_;
  job.num_nodes += num_repeated_;
  job.u = u;
  job.v = v;
  device_->run("hg_gather", job.num_nodes, job);
}

// Components may lie on each other in the L-vector, so they are added one after another.
void Nodes::scatter_add(const CeedScalar *u, CeedScalar *v) const {
  RestrictionJob job = job_;
  job.u = u;
  job.v = v;
  for (job.comp = 0; job.comp < job.num_comp; job.comp++) device_->run("hg_scatter_add", job.num_rows, job);
}

std::size_t Nodes::num_bytes() const {
  std::size_t bytes = 0;
  for (const Buffer *buffer : {&place_, &entry_, &step_, &bands_, &rows_, &nodes_}) bytes += buffer->num_bytes();
  return bytes;
}

namespace {

/// What a restriction keeps, each when it is used.
struct Kept {
  std::unique_ptr<Nodes> nodes;
  Buffer offsets;
};

Kept &kept_of(CeedElemRestriction rstr) {
  return kept_with<Kept>(rstr, CeedElemRestrictionGetData, CeedElemRestrictionSetData);
}

int create(CeedElemRestriction rstr) {
  return CeedElemRestrictionSetData(rstr, nullptr);
}

int destroy(CeedElemRestriction rstr) {
  Kept *kept = nullptr;
  CeedCallBackend(CeedElemRestrictionGetData(rstr, &kept));
  delete kept;
  return CEED_ERROR_SUCCESS;
}

const Nodes &nodes_of(CeedElemRestriction rstr) {
  Device &device = Device::of(CeedElemRestrictionReturnCeed(rstr));
  const auto one_thread = device.lock();
  auto &nodes = kept_of(rstr).nodes;
  if (nodes == nullptr) nodes = std::make_unique<Nodes>(device, rstr, Nodes::Layout::blocks);
  return *nodes;
}

int apply(CeedElemRestriction rstr, CeedInt first_block, CeedInt num_block, CeedTransposeMode t_mode, CeedVector u,
          CeedVector ru) {
  return wall(CeedElemRestrictionReturnCeed(rstr), [&] {
    const CeedElementMap &map = map_of(rstr);
    if (first_block != 0 || num_block != (map.num_elem + map.block_size - 1) / map.block_size) {
      bool has_values = false;
      chk(CeedVectorHasValidArray(ru, &has_values));
      if (has_values) chk(CeedVectorSyncArray(ru, CEED_MEM_HOST));  // what is not written stays
      return chk(parents_tables().restriction.apply(rstr, first_block, num_block, t_mode, u, ru));
    }
    const Nodes *nodes = &nodes_of(rstr);
    host::Reader from(u, CEED_MEM_DEVICE);
    // What of an E-vector does not belong to elements stays.
    bool has_values = true;
    if (t_mode == CEED_NOTRANSPOSE) chk(CeedVectorHasValidArray(ru, &has_values));
    host::Writer to(ru, has_values ? host::Writer::read_write : host::Writer::write_only, CEED_MEM_DEVICE);
    if (t_mode == CEED_NOTRANSPOSE) {
      nodes->gather(from.data(), to.data());
    } else {
      nodes->scatter_add(from.data(), to.data());
    }
    to.release();
    from.release();
  });
}

}  // namespace

const CeedInt *offsets_of(CeedElemRestriction rstr) {
  Device &device = Device::of(CeedElemRestrictionReturnCeed(rstr));
  const auto one_thread = device.lock();
  Buffer &offsets = kept_of(rstr).offsets;
  if (!offsets) {
    const CeedElementMap &map = map_of(rstr);
    const std::size_t count = map.type == CEED_RESTRICTION_POINTS
                                  ? static_cast<std::size_t>(map.offsets[map.num_elem])
                                  : static_cast<std::size_t>(map.num_elem) * map.elem_size;
    offsets = device.upload(std::span(map.offsets, count));
  }
  return offsets.as<CeedInt>();
}

void fill_restriction_ops(CeedElemRestrictionOps &ops) {
  ops = {.create = create, .destroy = destroy, .apply = apply};
}

}  // namespace hg::gpu
