#include "restriction_case.hpp"

#include <algorithm>
#include <cstdlib>

#include "support/errors.hpp"

namespace hg::test {
namespace {

/// An array for a function that takes one by `copy_mode`.
template <typename T>
const T *given(const T *array, std::size_t size, CeedCopyMode copy_mode) {
  if (copy_mode != CEED_OWN_POINTER || array == nullptr) return array;
  auto *copy = static_cast<T *>(std::malloc(std::max<std::size_t>(size, 1) * sizeof(T)));
  std::copy_n(array, size, copy);
  return copy;
}

/// Nodes of elements, shared at random, in an L-vector with components next to each other or one after another, and
/// room between them.
void place_nodes(RestrictionCase &c, Random &random) {
  const CeedInt num_nodes = 20;
  const bool is_interlaced = random.chance(0.5);
  const CeedInt node_stride = is_interlaced ? c.num_comp : 1;
  c.comp_stride = is_interlaced ? 1 : num_nodes + random.integer(0, 3);
  c.l_size = is_interlaced ? num_nodes * c.num_comp : c.comp_stride * c.num_comp;
  for (CeedInt i = 0; i < c.num_elem * c.elem_size; i++) {
    c.offsets.push_back(random.integer(0, num_nodes - 1) * node_stride);
  }
}

void place_strides(RestrictionCase &c, Random &random) {
  const CeedInt N = c.num_elem, P = c.elem_size, C = c.num_comp;
  const CeedInt orders[][3] = {
      {1, P, P * C},  // (node, component, element)
      {C, 1, P * C},  // (component, node, element)
      {1, P * N, P},  // (node, element, component)
      {N, P * N, 1},  // (element, node, component)
  };
  std::copy_n(orders[random.integer(0, 3)], 3, c.strides);
  c.l_size = CeedSize{N} * P * C;
}

/// Ragged, some elements empty, every point in one element, some numbers without a point.
void place_points(RestrictionCase &c, Random &random) {
  std::vector<CeedInt> counts(static_cast<std::size_t>(c.num_elem));
  for (CeedInt &count : counts) {
    count = random.chance(0.3) ? 0 : random.integer(1, 9);
    c.num_points += count;
    c.elem_size = std::max(c.elem_size, count);
  }
  const CeedInt num_places = c.num_points + random.integer(0, 3);
  c.l_size = CeedSize{num_places} * c.num_comp;
  c.offsets.push_back(c.num_elem + 1);
  for (const CeedInt count : counts) c.offsets.push_back(c.offsets.back() + count);
  const std::vector<CeedInt> points = random.distinct(c.num_points, num_places);
  c.offsets.insert(c.offsets.end(), points.begin(), points.end());
}

}  // namespace

CeedInt RestrictionCase::num_nodes(CeedInt e) const {
  return type == CEED_RESTRICTION_POINTS ? offsets[e + 1] - offsets[e] : elem_size;
}

std::vector<RestrictionCase::Term> RestrictionCase::terms(CeedInt e, CeedInt n, CeedInt c) const {
  const auto place = [&](CeedInt m) -> CeedSize {
    if (type == CEED_RESTRICTION_POINTS) return CeedSize{offsets[offsets[e] + m]} * num_comp + c;
    if (type == CEED_RESTRICTION_STRIDED) {
      return CeedSize{m} * strides[0] + CeedSize{c} * strides[1] + CeedSize{e} * strides[2];
    }
    return offsets[e * elem_size + m] + CeedSize{c} * comp_stride;
  };
  if (type == CEED_RESTRICTION_ORIENTED) {
    return {{place(n), orients[static_cast<std::size_t>(e) * elem_size + n] ? -1.0 : 1.0}};
  }
  if (type != CEED_RESTRICTION_CURL_ORIENTED) return {{place(n), 1.0}};
  std::vector<Term> row;
  const CeedInt8 *bands = curl_orients.data() + 3 * (e * elem_size + n);
  if (n > 0) row.push_back({place(n - 1), static_cast<CeedScalar>(bands[0])});
  row.push_back({place(n), static_cast<CeedScalar>(bands[1])});
  if (n < elem_size - 1) row.push_back({place(n + 1), static_cast<CeedScalar>(bands[2])});
  return row;
}

std::string describe(const RestrictionCase &c) {
  static const char *const names[] = {"", "standard", "oriented", "curl-oriented", "strided", "at points"};
  return std::string(names[c.type]) + ", " + std::to_string(c.num_elem) + " elements of " +
         std::to_string(c.elem_size) + " nodes, " + std::to_string(c.num_comp) + " components, block size " +
         std::to_string(c.block_size);
}

RestrictionCase random_restriction(Random &random, CeedRestrictionType type, bool is_blocked) {
  RestrictionCase c;
  c.type = type;
  c.num_elem = random.chance(0.1) ? 0 : random.chance(0.1) ? 1 : random.integer(2, 12);
  c.num_comp = random.integer(1, 9);
  if (is_blocked) c.block_size = random.integer(1, 5);
  if (type == CEED_RESTRICTION_POINTS) {
    place_points(c, random);
    return c;
  }
  c.elem_size = random.integer(1, 9);
  if (type == CEED_RESTRICTION_STRIDED) {
    place_strides(c, random);
    return c;
  }
  place_nodes(c, random);
  const std::size_t num_nodes = c.offsets.size();
  if (type == CEED_RESTRICTION_ORIENTED) {
    c.orients = std::make_shared<bool[]>(num_nodes);
    for (std::size_t i = 0; i < num_nodes; i++) c.orients[i] = random.chance(0.5);
  }
  if (type == CEED_RESTRICTION_CURL_ORIENTED) {
    // What lies outside of the matrix is there too, and must not matter.
    for (std::size_t i = 0; i < 3 * num_nodes; i++) {
      c.curl_orients.push_back(static_cast<CeedInt8>(random.integer(-2, 2)));
    }
  }
  return c;
}

Restriction make_restriction(Ceed ceed, const RestrictionCase &c, CeedCopyMode copy_mode) {
  Restriction rstr;
  if (c.type == CEED_RESTRICTION_STRIDED) {
    ok(c.block_size == 0 ? CeedElemRestrictionCreateStrided(ceed, c.num_elem, c.elem_size, c.num_comp, c.l_size,
                                                            c.strides, rstr.out())
                         : CeedElemRestrictionCreateBlockedStrided(ceed, c.num_elem, c.elem_size, c.block_size,
                                                                   c.num_comp, c.l_size, c.strides, rstr.out()));
    return rstr;
  }
  const CeedInt *offsets = given(c.offsets.data(), c.offsets.size(), copy_mode);
  const bool *orients = given<bool>(c.orients.get(), c.offsets.size(), copy_mode);
  const CeedInt8 *curl_orients = given(c.curl_orients.data(), c.curl_orients.size(), copy_mode);
  // What follows the number of nodes, and of blocks if there are any, in the functions that take offsets.
  const auto with = [&](auto create, auto... orientation) {
    return create(c.num_comp, c.comp_stride, c.l_size, CEED_MEM_HOST, copy_mode, offsets, orientation..., rstr.out());
  };
  const auto plain = [&](auto create) {
    return [&, create](auto... rest) { return create(ceed, c.num_elem, c.elem_size, rest...); };
  };
  const auto blocked = [&](auto create) {
    return [&, create](auto... rest) { return create(ceed, c.num_elem, c.elem_size, c.block_size, rest...); };
  };
  const bool is_blocked = c.block_size > 0;
  switch (c.type) {
    case CEED_RESTRICTION_STANDARD:
      ok(is_blocked ? with(blocked(CeedElemRestrictionCreateBlocked)) : with(plain(CeedElemRestrictionCreate)));
      break;
    case CEED_RESTRICTION_ORIENTED:
      ok(is_blocked ? with(blocked(CeedElemRestrictionCreateBlockedOriented), orients)
                    : with(plain(CeedElemRestrictionCreateOriented), orients));
      break;
    case CEED_RESTRICTION_CURL_ORIENTED:
      ok(is_blocked ? with(blocked(CeedElemRestrictionCreateBlockedCurlOriented), curl_orients)
                    : with(plain(CeedElemRestrictionCreateCurlOriented), curl_orients));
      break;
    default:
      ok(CeedElemRestrictionCreateAtPoints(ceed, c.num_elem, c.num_points, c.num_comp, c.l_size, CEED_MEM_HOST,
                                           copy_mode, offsets, rstr.out()));
  }
  return rstr;
}

RestrictionCase without_signs(RestrictionCase c) {
  if (c.type == CEED_RESTRICTION_ORIENTED) return without_orientation(std::move(c));
  for (CeedInt8 &entry : c.curl_orients) entry = static_cast<CeedInt8>(std::abs(entry));
  return c;
}

RestrictionCase without_orientation(RestrictionCase c) {
  if (c.type == CEED_RESTRICTION_ORIENTED || c.type == CEED_RESTRICTION_CURL_ORIENTED) {
    c.type = CEED_RESTRICTION_STANDARD;
  }
  return c;
}

CeedSize e_place(CeedElemRestriction rstr, CeedInt e, CeedInt n, CeedInt c) {
  bool is_points = false;
  CeedInt layout[3], block_size = 0;
  ok(CeedElemRestrictionIsAtPoints(rstr, &is_points));
  ok(CeedElemRestrictionGetELayout(rstr, layout));
  ok(CeedElemRestrictionGetBlockSize(rstr, &block_size));
  if (!is_points) {
    const CeedSize B = block_size;
    return (n * B + e % B) * layout[0] + c * B * layout[1] + e / B * B * layout[2];
  }
  CeedSize start = 0;
  CeedInt num_points = 0;
  ok(CeedElemRestrictionGetAtPointsElementOffset(rstr, e, &start));
  ok(CeedElemRestrictionGetNumPointsInElement(rstr, e, &num_points));
  return start + CeedSize{c} * (layout[1] > 0 ? layout[1] : num_points) + CeedSize{n} * layout[0];
}

}  // namespace hg::test
