/// @file
/// Restrictions on a device.
#pragma once

#include <ceed/plugin.h>

#include "device.hpp"
#include "text/jobs.hpp"

namespace hg::gpu {

/// Where each node of each element is in the L-vector and in the E-vector, and the way back: which nodes share an entry
/// of the L-vector. About 40 bytes a node, as they are needed by the backends in stages.
class Nodes {
 public:
  enum class Layout {
    blocks,    ///< E-vectors as the interface has them, elements in blocks
    elements,  ///< one element after another
  };
  Nodes(Device &device, CeedElemRestriction rstr, Layout layout);

  /// v = R u, all of the E-vector.
  void gather(const CeedScalar *u, CeedScalar *v) const;
  /// v += R^T u, the same sum each time.
  void scatter_add(const CeedScalar *u, CeedScalar *v) const;
  CeedSize e_size() const { return e_size_; }
  std::size_t num_bytes() const;

 private:
  Device *device_;
  RestrictionJob job_;
  CeedSize num_repeated_ = 0;  ///< nodes of elements that fill up the last block
  CeedSize e_size_ = 0;
  Buffer place_, entry_, step_, bands_, rows_, nodes_;
};

/// What a restriction says of itself.
const CeedElementMap &map_of(CeedElemRestriction rstr);
/// CeedElementMap::offsets of a restriction without strides and blocks, on the device; it keeps them.
const CeedInt *offsets_of(CeedElemRestriction rstr);

}  // namespace hg::gpu
