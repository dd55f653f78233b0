// A plugin whose E-vectors are laid out otherwise: the element fastest; at points as much room for each element as the
// fullest one needs. Blocked restrictions are the reference's.
#include <ceed/plugin.h>

#include <algorithm>

namespace {

CeedBackendOps parent;

bool is_ours(const CeedElementMap &map) {
  return map.block_size == 1;
}

int create(CeedElemRestriction rstr) {
  const CeedElementMap *map = nullptr;
  CeedCallBackend(CeedElemRestrictionGetElementMap(rstr, &map));
  if (!is_ours(*map)) return CEED_ERROR_SUCCESS;
  if (map->type == CEED_RESTRICTION_POINTS) {
    CeedInt layout[3] = {1, map->elem_size, map->elem_size * map->num_comp};
    CeedCallBackend(CeedElemRestrictionSetELayout(rstr, layout));
    return CeedElemRestrictionSetAtPointsEVectorSize(rstr, static_cast<CeedSize>(layout[2]) * map->num_elem);
  }
  CeedInt layout[3] = {map->num_elem, map->num_elem * map->elem_size, 1};
  CeedCallBackend(CeedElemRestrictionSetELayout(rstr, layout));
  if (map->type != CEED_RESTRICTION_STRIDED) return CEED_ERROR_SUCCESS;
  bool has_backend_strides = false;
  CeedCallBackend(CeedElemRestrictionHasBackendStrides(rstr, &has_backend_strides));
  return has_backend_strides ? CeedElemRestrictionSetLLayout(rstr, layout) : CEED_ERROR_SUCCESS;
}

/// Where component c of node n of element e lies in the L-vector.
CeedSize entry(const CeedElementMap &map, CeedInt e, CeedInt n, CeedInt c) {
  if (map.type == CEED_RESTRICTION_POINTS) {
    return static_cast<CeedSize>(map.offsets[map.offsets[e] + n]) * map.num_comp + c;
  }
  if (map.type == CEED_RESTRICTION_STRIDED) {
    return static_cast<CeedSize>(n) * map.strides[0] + static_cast<CeedSize>(c) * map.strides[1] +
           static_cast<CeedSize>(e) * map.strides[2];
  }
  return map.offsets[static_cast<CeedSize>(e) * map.elem_size + n] + static_cast<CeedSize>(c) * map.comp_stride;
}

/// Calls f(place in the E-vector, place in the L-vector, factor).
template <typename F>
void for_each_term(const CeedElementMap &map, CeedInt first, CeedInt count, F &&f) {
  const bool is_whole = count == map.num_elem;
  for (CeedInt e = first; e < first + count; e++) {
    const bool is_points = map.type == CEED_RESTRICTION_POINTS;
    const CeedInt num_nodes = is_points ? map.offsets[e + 1] - map.offsets[e] : map.elem_size;
    for (CeedInt c = 0; c < map.num_comp; c++) {
      for (CeedInt n = 0; n < num_nodes; n++) {
        const CeedSize place = is_whole ? static_cast<CeedSize>(n) * map.e_layout[0] +
                                              static_cast<CeedSize>(c) * map.e_layout[1] +
                                              static_cast<CeedSize>(e) * map.e_layout[2]
                                        : static_cast<CeedSize>(c) * num_nodes + n;
        if (map.num_bands == 0) f(place, entry(map, e, n, c), CeedScalar{1});
        for (CeedInt k = 0; k < map.num_bands; k++) {
          const CeedInt m = n + k - map.num_bands / 2;
          const CeedSize node = static_cast<CeedSize>(e) * map.elem_size + n;
          if (m >= 0 && m < num_nodes) f(place, entry(map, e, m, c), CeedScalar(map.bands[node * map.num_bands + k]));
        }
      }
    }
  }
}

int apply(CeedElemRestriction rstr, CeedInt first_block, CeedInt num_block, CeedTransposeMode t_mode, CeedVector u,
          CeedVector ru) {
  const CeedElementMap *map = nullptr;
  CeedCallBackend(CeedElemRestrictionGetElementMap(rstr, &map));
  if (!is_ours(*map)) return parent.restriction.apply(rstr, first_block, num_block, t_mode, u, ru);
  const CeedScalar *from = nullptr;
  CeedScalar *to = nullptr;
  CeedCallBackend(CeedVectorGetArrayRead(u, CEED_MEM_HOST, &from));
  if (t_mode == CEED_TRANSPOSE) {
    CeedCallBackend(CeedVectorGetArray(ru, CEED_MEM_HOST, &to));
    for_each_term(*map, first_block, num_block, [&](CeedSize i, CeedSize k, CeedScalar t) { to[k] += t * from[i]; });
  } else {
    CeedCallBackend(CeedVectorGetArrayWrite(ru, CEED_MEM_HOST, &to));
    for_each_term(*map, first_block, num_block, [&](CeedSize i, CeedSize, CeedScalar) { to[i] = 0; });
    for_each_term(*map, first_block, num_block, [&](CeedSize i, CeedSize k, CeedScalar t) { to[i] += t * from[k]; });
  }
  CeedCallBackend(CeedVectorRestoreArrayRead(u, &from));
  return CeedVectorRestoreArray(ru, &to);
}

int init(Ceed, const char *, CeedBackendOps *ops) {
  parent = *ops;
  ops->restriction.create = create;
  ops->restriction.apply = apply;
  return CEED_ERROR_SUCCESS;
}

const CeedBackend backends[] = {{.resource = "/test/layouts",
                                 .parent = "/cpu/self/ref/serial",
                                 .priority = 1000,
                                 .aliases = nullptr,
                                 .score = nullptr,
                                 .init = init}};
const CeedPlugin plugin = {.size = sizeof(CeedPlugin),
                           .api_version = CEED_PLUGIN_API_VERSION,
                           .name = "layouts",
                           .num_backends = 1,
                           .backends = backends};

}  // namespace

const CeedPlugin *ceed_plugin_v1(void) {
  return &plugin;
}
