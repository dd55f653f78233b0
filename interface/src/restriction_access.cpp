// What an element restriction tells about itself.
#include <algorithm>
#include <cstdio>

#include "restriction.hpp"
#include "vector.hpp"
#include "view.hpp"

namespace {

/// Body of the getters; `function` is the getter.
template <typename T, typename Get>
int get(CeedElemRestriction rstr, T *value, const char *name, Get &&getter,
        const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(rstr), [&] { hg::result(value, name) = getter(hg::deref(rstr, "CeedElemRestriction")); }, function);
}

/// Body of the getters of tables: grants read access on the host.
template <typename T, typename Get>
int get_array(CeedElemRestriction rstr, CeedMemType mem_type, const T **array, Get &&getter,
              const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(rstr),
      [&] {
        auto &r = hg::deref_restriction(rstr);
        hg::require_mem_type(*r.ceed, mem_type, function);
        hg::require(mem_type == CEED_MEM_HOST, CEED_ERROR_UNSUPPORTED,
                    "CeedElemRestriction: memory type is CEED_MEM_DEVICE; expected CEED_MEM_HOST");
        const std::scoped_lock lock(r.access);
        hg::result(array, "array") = getter(r);
        r.num_readers++;
      },
      function);
}

template <typename T>
int restore_array(CeedElemRestriction rstr, const T **array, const char *what,
                  const char *function = __builtin_FUNCTION()) {
  return hg::guard(
      hg::ceed_of(rstr),
      [&] {
        auto &r = hg::deref_restriction(rstr);
        const std::scoped_lock lock(r.access);
        hg::require(r.num_readers > 0, CEED_ERROR_ACCESS,
                    [&] { return hg::text("Cannot restore CeedElemRestriction %s, access was not granted", what); });
        hg::result(array, "array") = nullptr;
        r.num_readers--;
      },
      function);
}

void require_points(const CeedElemRestriction_private &r, hg::Where where = hg::Where::current()) {
  hg::require(r.is_points(), CEED_ERROR_INCOMPATIBLE,
              "CeedElemRestriction has no points; expected one made by CeedElemRestrictionCreateAtPoints()", where);
}

void require_strided(const CeedElemRestriction_private &r, hg::Where where = hg::Where::current()) {
  hg::require(r.is_strided(), CEED_ERROR_MINOR,
              "CeedElemRestriction has no strides; expected one made by CeedElemRestrictionCreateStrided()", where);
}

/// For what only the backend's create() may do.
void require_new(const CeedElemRestriction_private &r, hg::Where where = hg::Where::current()) {
  hg::require(!r.is_known_to_backend, CEED_ERROR_ACCESS,
              "CeedElemRestriction is made already; its layouts are set by the backend while it is made", where);
}

void require_elem(const CeedElemRestriction_private &r, CeedInt elem, hg::Where where = hg::Where::current()) {
  hg::require(
      elem >= 0 && elem < r.num_elem, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction: element is %" CeedInt_FMT "; expected one in [0, %" CeedInt_FMT ")", elem,
                        r.num_elem);
      },
      where);
}

/// The smallest number of points of an element; 0 without elements.
CeedInt min_points(const CeedElemRestriction_private &r) {
  CeedInt least = r.elem_size;
  for (CeedInt e = 0; e < r.num_elem; e++) least = std::min(least, r.num_nodes(e));
  return least;
}

}  // namespace

namespace hg {

CeedElemRestriction_private &deref_restriction(CeedElemRestriction rstr, hg::Where where) {
  deref(rstr, "CeedElemRestriction", where);
  require(!rstr->is_sentinel, CEED_ERROR_INCOMPATIBLE,
          "CeedElemRestriction is CEED_ELEMRESTRICTION_NONE; expected one with elements", where);
  return *rstr;
}

bool equal(const CeedElemRestriction_private &a, const CeedElemRestriction_private &b) {
  if (&a == &b) return true;
  if (a.is_sentinel || b.is_sentinel) return false;
  if (a.type != b.type || a.block_size != b.block_size || a.num_bands != b.num_bands || a.num_elem != b.num_elem ||
      a.elem_size != b.elem_size || a.num_points != b.num_points || a.num_comp != b.num_comp || a.l_size != b.l_size ||
      a.e_size != b.e_size || !std::equal(a.strides, a.strides + 3, b.strides)) {
    return false;
  }
  if (a.num_comp > 1 && a.comp_stride != b.comp_stride) return false;
  const auto same = [](const auto *x, const auto *y, CeedSize size) { return x == y || std::equal(x, x + size, y); };
  return same(a.offsets, b.offsets, a.num_offsets()) &&
         same(a.bands, b.bands, a.table_size(static_cast<CeedSize>(a.num_bands) * a.elem_size));
}

PointRange points_in_element(const CeedElemRestriction_private &rstr, CeedInt elem) {
  const CeedInt start = rstr.offsets[elem];
  return {rstr.offsets + start, rstr.offsets[elem + 1] - start};
}

}  // namespace hg

CeedSize CeedElemRestriction_private::num_offsets() const {
  switch (type) {
    case CEED_RESTRICTION_STRIDED:
      return 0;
    case CEED_RESTRICTION_POINTS:
      return offsets != nullptr ? offsets[num_elem] : 0;
    default:
      return table_size(elem_size);
  }
}

CeedSize CeedElemRestriction_private::place(CeedInt e, CeedInt n, CeedInt c) const {
  switch (type) {
    case CEED_RESTRICTION_STRIDED:
      return static_cast<CeedSize>(n) * strides[0] + static_cast<CeedSize>(c) * strides[1] +
             static_cast<CeedSize>(e) * strides[2];
    case CEED_RESTRICTION_POINTS:
      return static_cast<CeedSize>(offsets[offsets[e] + n]) * num_comp + c;
    default:
      return offsets[table_index(e, n, elem_size)] + static_cast<CeedSize>(c) * comp_stride;
  }
}

void CeedElemRestriction_private::view(FILE *stream) const {
  const CeedInt *shown = has_backend_strides ? CEED_STRIDES_BACKEND : strides;
  const std::string nodes =
      is_points() ? hg::text("a maximum of %" CeedInt_FMT " points on an element", elem_size)
      : is_strided()
          ? hg::text("%" CeedInt_FMT " nodes each and strides [%" CeedInt_FMT ", %" CeedInt_FMT ", %" CeedInt_FMT "]",
                     elem_size, shown[0], shown[1], shown[2])
          : hg::text("%" CeedInt_FMT " nodes each and component stride %" CeedInt_FMT, elem_size, comp_stride);
  hg::Lines(stream, num_view_tabs)(
      0, "%sCeedElemRestriction%s from (%td, %" CeedInt_FMT ") to %" CeedInt_FMT " elements with %s",
      block_size > 1 ? "Blocked " : "", is_points() ? " at points" : "", l_size, num_comp, num_elem, nodes.c_str());
}

int CeedElemRestrictionView(CeedElemRestriction rstr, FILE *stream) {
  return hg::view_object(rstr, stream);
}

int CeedElemRestrictionSetNumViewTabs(CeedElemRestriction rstr, CeedInt num_tabs) {
  return hg::set_view_tabs(rstr, num_tabs);
}

int CeedElemRestrictionGetNumViewTabs(CeedElemRestriction rstr, CeedInt *num_tabs) {
  return hg::get_view_tabs(rstr, num_tabs);
}

int CeedElemRestrictionGetCeed(CeedElemRestriction rstr, Ceed *ceed) {
  return hg::get_ceed(rstr, ceed);
}

Ceed CeedElemRestrictionReturnCeed(CeedElemRestriction rstr) {
  return hg::ceed_of(rstr);
}

int CeedElemRestrictionGetCompStride(CeedElemRestriction rstr, CeedInt *comp_stride) {
  return get(rstr, comp_stride, "comp_stride", [](auto &r) { return r.comp_stride; });
}

int CeedElemRestrictionGetNumElements(CeedElemRestriction rstr, CeedInt *num_elem) {
  return get(rstr, num_elem, "num_elem", [](auto &r) { return r.num_elem; });
}

int CeedElemRestrictionGetElementSize(CeedElemRestriction rstr, CeedInt *elem_size) {
  return get(rstr, elem_size, "elem_size", [](auto &r) { return r.elem_size; });
}

int CeedElemRestrictionGetLVectorSize(CeedElemRestriction rstr, CeedSize *l_size) {
  return get(rstr, l_size, "l_size", [](auto &r) { return r.l_size; });
}

int CeedElemRestrictionGetEVectorSize(CeedElemRestriction rstr, CeedSize *e_size) {
  return get(rstr, e_size, "e_size", [](auto &r) { return r.e_size; });
}

int CeedElemRestrictionGetNumComponents(CeedElemRestriction rstr, CeedInt *num_comp) {
  return get(rstr, num_comp, "num_comp", [](auto &r) { return r.num_comp; });
}

int CeedElemRestrictionGetNumBlocks(CeedElemRestriction rstr, CeedInt *num_block) {
  return get(rstr, num_block, "num_block", [](auto &r) { return r.num_block(); });
}

int CeedElemRestrictionGetBlockSize(CeedElemRestriction rstr, CeedInt *block_size) {
  return get(rstr, block_size, "block_size", [](auto &r) { return r.block_size; });
}

int CeedElemRestrictionGetNumPoints(CeedElemRestriction rstr, CeedInt *num_points) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_points(r);
    hg::result(num_points, "num_points") = r.num_points;
  });
}

int CeedElemRestrictionGetNumPointsInElement(CeedElemRestriction rstr, CeedInt elem, CeedInt *num_points) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_points(r);
    require_elem(r, elem);
    hg::result(num_points, "num_points") = r.num_nodes(elem);
  });
}

int CeedElemRestrictionGetMaxPointsInElement(CeedElemRestriction rstr, CeedInt *max_points) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_points(r);
    hg::result(max_points, "max_points") = r.elem_size;
  });
}

int CeedElemRestrictionGetMinPointsInElement(CeedElemRestriction rstr, CeedInt *min_points) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_points(r);
    hg::result(min_points, "min_points") = ::min_points(r);
  });
}

int CeedElemRestrictionGetMinMaxPointsInElement(CeedElemRestriction rstr, CeedInt *min_points, CeedInt *max_points) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_points(r);
    if (min_points != nullptr) *min_points = ::min_points(r);
    if (max_points != nullptr) *max_points = r.elem_size;
  });
}

int CeedElemRestrictionGetType(CeedElemRestriction rstr, CeedRestrictionType *rstr_type) {
  return get(rstr, rstr_type, "rstr_type", [](auto &r) { return r.type; });
}

int CeedElemRestrictionIsStrided(CeedElemRestriction rstr, bool *is_strided) {
  return get(rstr, is_strided, "is_strided", [](auto &r) { return r.is_strided(); });
}

int CeedElemRestrictionIsAtPoints(CeedElemRestriction rstr, bool *is_points) {
  return get(rstr, is_points, "is_points", [](auto &r) { return r.is_points(); });
}

int CeedElemRestrictionAtPointsAreCompatible(CeedElemRestriction rstr_a, CeedElemRestriction rstr_b,
                                             bool *are_compatible) {
  return hg::guard(hg::ceed_of(rstr_a), [&] {
    auto &a = hg::deref_restriction(rstr_a);
    auto &b = hg::deref_restriction(rstr_b);
    require_points(a);
    require_points(b);
    hg::result(are_compatible, "are_compatible") =
        a.num_elem == b.num_elem && a.num_offsets() == b.num_offsets() &&
        (a.offsets == b.offsets || std::equal(a.offsets, a.offsets + a.num_offsets(), b.offsets));
  });
}

int CeedElemRestrictionGetStrides(CeedElemRestriction rstr, CeedInt strides[3]) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_strided(r);
    std::copy_n(r.has_backend_strides ? CEED_STRIDES_BACKEND : r.strides, 3, &hg::result(strides, "strides"));
  });
}

int CeedElemRestrictionHasBackendStrides(CeedElemRestriction rstr, bool *has_backend_strides) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_strided(r);
    hg::result(has_backend_strides, "has_backend_strides") = r.has_backend_strides;
  });
}

int CeedElemRestrictionGetOffsets(CeedElemRestriction rstr, CeedMemType mem_type, const CeedInt **offsets) {
  return get_array(rstr, mem_type, offsets, [](auto &r) { return r.offsets; });
}

int CeedElemRestrictionRestoreOffsets(CeedElemRestriction rstr, const CeedInt **offsets) {
  return restore_array(rstr, offsets, "offsets");
}

int CeedElemRestrictionGetOrientations(CeedElemRestriction rstr, CeedMemType mem_type, const bool **orients) {
  return get_array(rstr, mem_type, orients, [](auto &r) { return r.orients.data(); });
}

int CeedElemRestrictionRestoreOrientations(CeedElemRestriction rstr, const bool **orients) {
  return restore_array(rstr, orients, "orientations");
}

int CeedElemRestrictionGetCurlOrientations(CeedElemRestriction rstr, CeedMemType mem_type,
                                           const CeedInt8 **curl_orients) {
  return get_array(rstr, mem_type, curl_orients, [](auto &r) { return r.num_bands == 3 ? r.bands : nullptr; });
}

int CeedElemRestrictionRestoreCurlOrientations(CeedElemRestriction rstr, const CeedInt8 **curl_orients) {
  return restore_array(rstr, curl_orients, "curl-orientations");
}

int CeedElemRestrictionGetElementMap(CeedElemRestriction rstr, const CeedElementMap **map) {
  return hg::guard(hg::ceed_of(rstr), [&] { hg::result(map, "map") = &hg::deref_restriction(rstr); });
}

int CeedElemRestrictionGetLLayout(CeedElemRestriction rstr, CeedInt layout[3]) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_strided(r);
    std::copy_n(r.strides, 3, &hg::result(layout, "layout"));
  });
}

int CeedElemRestrictionGetELayout(CeedElemRestriction rstr, CeedInt layout[3]) {
  return hg::guard(hg::ceed_of(rstr),
                   [&] { std::copy_n(hg::deref_restriction(rstr).e_layout, 3, &hg::result(layout, "layout")); });
}

int CeedElemRestrictionGetAtPointsElementOffset(CeedElemRestriction rstr, CeedInt elem, CeedSize *elem_offset) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_points(r);
    require_elem(r, elem);
    hg::result(elem_offset, "elem_offset") = r.e_layout[2] > 0
                                                 ? static_cast<CeedSize>(elem) * r.e_layout[2]
                                                 : (static_cast<CeedSize>(r.offsets[elem]) - r.offsets[0]) * r.num_comp;
  });
}

int CeedElemRestrictionSetELayout(CeedElemRestriction rstr, CeedInt layout[3]) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    hg::require_argument(layout, "layout (three strides)");
    require_new(r);
    std::copy_n(layout, 3, r.e_layout);
  });
}

int CeedElemRestrictionSetLLayout(CeedElemRestriction rstr, CeedInt layout[3]) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_strided(r);
    hg::require_argument(layout, "layout (three strides)");
    require_new(r);
    hg::require(r.has_backend_strides, CEED_ERROR_MINOR,
                "CeedElemRestriction has the strides that the user gave; expected CEED_STRIDES_BACKEND");
    std::copy_n(layout, 3, r.strides);
  });
}

int CeedElemRestrictionSetAtPointsEVectorSize(CeedElemRestriction rstr, CeedSize e_size) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    require_points(r);
    require_new(r);
    hg::require(e_size >= r.e_size, CEED_ERROR_DIMENSION, [&] {
      return hg::text(
          "CeedElemRestriction: size of the E-vector is %td; expected at least %td for the points of all "
          "elements",
          e_size, r.e_size);
    });
    r.e_size = e_size;
  });
}

int CeedElemRestrictionGetData(CeedElemRestriction rstr, void *data) {
  return get(rstr, static_cast<void **>(data), "data", [](auto &r) { return r.data; });
}

int CeedElemRestrictionSetData(CeedElemRestriction rstr, void *data) {
  return hg::guard(hg::ceed_of(rstr), [&] { hg::deref_restriction(rstr).data = data; });
}

int CeedElemRestrictionGetFlopsEstimate(CeedElemRestriction rstr, CeedTransposeMode t_mode, CeedSize *flops) {
  // A band multiplies each entry of the E-vector, and all but the first add to it; scattering adds it once for each
  // band.
  return get(rstr, flops, "flops", [&](auto &r) -> CeedSize {
    hg::require_transpose_mode(t_mode, "CeedElemRestriction");
    const CeedSize adds = t_mode == CEED_TRANSPOSE ? std::max(r.num_bands, 1) : std::max(r.num_bands - 1, 0);
    return r.e_size * (r.num_bands + adds);
  });
}
