// Making element restrictions.
#include <algorithm>
#include <limits>
#include <vector>

#include "restriction.hpp"

namespace {

using Created = hg::Ref<CeedElemRestriction_private>;

/// A product of sizes as the CeedInt that the interface asks for.
CeedInt narrow(CeedSize product, const char *what, hg::Where where = hg::Where::current()) {
  hg::require(
      product <= std::numeric_limits<CeedInt>::max(), CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction: %s is %td; expected at most %" CeedInt_FMT ", the largest CeedInt", what,
                        product, std::numeric_limits<CeedInt>::max());
      },
      where);
  return static_cast<CeedInt>(product);
}

/// Checks what all kinds share and makes a restriction without a map.
Created make(Ceed ceed, CeedRestrictionType type, CeedInt num_elem, CeedInt num_comp, CeedSize l_size,
             const CeedElemRestriction *rstr, hg::Where where = hg::Where::current()) {
  hg::deref(ceed, "Ceed", where);
  hg::require(rstr != nullptr, CEED_ERROR_MINOR,
              "CeedElemRestriction: the address of the handle is NULL; expected where it goes", where);
  hg::require(
      num_elem >= 0, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction: number of elements is %" CeedInt_FMT "; expected 0 or more", num_elem);
      },
      where);
  hg::require(
      num_comp >= 1, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction: number of components is %" CeedInt_FMT "; expected 1 or more", num_comp);
      },
      where);
  hg::require(
      l_size >= 0, CEED_ERROR_DIMENSION,
      [&] { return hg::text("CeedElemRestriction: L-vector size is %td; expected 0 or more", l_size); }, where);
  auto created = Created::adopt(new CeedElemRestriction_private);
  created->ceed = hg::Ref<Ceed_private>(ceed);
  created->type = type;
  created->num_elem = num_elem;
  created->num_comp = num_comp;
  created->l_size = l_size;
  return created;
}

/// Sizes of elements that all have `elem_size` nodes, in blocks of `block_size`.
void set_elem_size(CeedElemRestriction_private &r, CeedInt elem_size, CeedInt block_size,
                   hg::Where where = hg::Where::current()) {
  hg::require(
      elem_size >= 1, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction: element size is %" CeedInt_FMT "; expected 1 node or more", elem_size);
      },
      where);
  hg::require(
      block_size >= 1, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction: block size is %" CeedInt_FMT "; expected 1 element or more", block_size);
      },
      where);
  r.elem_size = elem_size;
  r.block_size = block_size;
  narrow(r.table_size(1), "number of elements in whole blocks", where);
  const CeedInt elem_stride =
      narrow(static_cast<CeedSize>(elem_size) * r.num_comp, "element size times components", where);
  r.e_size = r.table_size(elem_stride);
  r.e_layout[0] = 1;
  r.e_layout[1] = elem_size;
  r.e_layout[2] = elem_stride;
}

/// Checks what comes with an array of the user's, over the elements, before it is read.
void require_array(const CeedElemRestriction_private &r, CeedMemType mem_type, CeedCopyMode copy_mode,
                   const void *array, const char *what, hg::Where where = hg::Where::current()) {
  hg::require_mem_type(*r.ceed, mem_type, "CeedElemRestriction offsets");
  hg::require(
      mem_type == CEED_MEM_HOST, CEED_ERROR_UNSUPPORTED,
      [&] {
        return hg::text(
            "CeedElemRestriction %s: memory type is CEED_MEM_DEVICE; expected CEED_MEM_HOST, where they are "
            "checked",
            what);
      },
      where);
  hg::require(
      copy_mode == CEED_COPY_VALUES || copy_mode == CEED_USE_POINTER || copy_mode == CEED_OWN_POINTER, CEED_ERROR_MINOR,
      [&] {
        return hg::text(
            "CeedElemRestriction %s: copy mode is %d; expected CEED_COPY_VALUES (0), CEED_USE_POINTER (1) or "
            "CEED_OWN_POINTER (2)",
            what, static_cast<int>(copy_mode));
      },
      where);
  hg::require(
      array != nullptr || r.num_elem == 0, CEED_ERROR_MINOR,
      [&] { return hg::text("CeedElemRestriction: the %s are NULL; expected an array", what); }, where);
}

/// A table of the user's, `per_elem` entries for each element, in the blocks of the restriction.
template <typename T>
std::unique_ptr<T[]> in_blocks(const CeedElemRestriction_private &r, const T *table, CeedSize per_elem) {
  auto blocked = std::make_unique<T[]>(static_cast<std::size_t>(r.table_size(per_elem)));
  const CeedInt num_places = static_cast<CeedInt>(r.table_size(1));
  for (CeedInt place = 0; place < num_places; place++) {
    const CeedSize e = std::min(place, r.num_elem - 1);
    for (CeedSize k = 0; k < per_elem; k++) blocked[r.table_index(place, k, per_elem)] = table[e * per_elem + k];
  }
  return blocked;
}

/// Takes in a table that has been checked, `per_elem` entries for each element; adopt() follows where the user gave it
/// away. Returns what the restriction is to read.
template <typename T>
const T *keep_table(const CeedElemRestriction_private &r, CeedCopyMode copy_mode, const T *table, CeedSize per_elem,
                    hg::HostArray<T> &kept) {
  if (r.block_size > 1) {
    kept.keep(in_blocks(r, table, per_elem));
  } else if (copy_mode == CEED_COPY_VALUES) {
    kept.copy(table, r.table_size(per_elem));
  } else {
    kept.lend(table);
  }
  return kept.data();
}

/// Checks starts and point numbers, sets the largest number of points of an element and whether each entry is listed
/// once, and returns the number of entries.
CeedInt check_points(CeedElemRestriction_private &r, CeedInt num_points, const CeedInt *offsets,
                     hg::Where where = hg::Where::current()) {
  const CeedInt num_elem = r.num_elem;
  const CeedInt first = narrow(static_cast<CeedSize>(num_elem) + 1, "number of elements plus one", where);
  hg::require(
      offsets[0] == first, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction at points: the points of element 0 start at offsets[%" CeedInt_FMT
                        "]; expected offsets[%" CeedInt_FMT "], after the starts of %" CeedInt_FMT
                        " elements and the end",
                        offsets[0], first, num_elem);
      },
      where);
  for (CeedInt e = 0; e < num_elem; e++) {
    hg::require(
        offsets[e + 1] >= offsets[e], CEED_ERROR_DIMENSION,
        [&] {
          return hg::text("CeedElemRestriction at points: the points of element %" CeedInt_FMT
                          " are offsets[%" CeedInt_FMT "] up to offsets[%" CeedInt_FMT
                          "]; expected an end that is not before the start",
                          e, offsets[e], offsets[e + 1]);
        },
        where);
    r.elem_size = std::max(r.elem_size, offsets[e + 1] - offsets[e]);
  }
  // A point may belong to several elements, so there can be more entries than points.
  const CeedInt num_entries = offsets[num_elem] - first;
  hg::require(
      num_entries >= num_points, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction at points: the elements hold %" CeedInt_FMT
                        " points; expected at least %" CeedInt_FMT ", the number of points",
                        num_entries, num_points);
      },
      where);
  const CeedSize num_places = r.l_size / r.num_comp;
  const CeedInt *numbers = offsets + first;
  // One pass without branches: numbers that are in range, and rise, as they do once points were sorted by elements.
  CeedInt least = num_entries > 0 ? numbers[0] : 0, most = num_entries > 0 ? numbers[0] : -1, num_falls = 0;
  for (CeedInt i = 1; i < num_entries; i++) {
    least = std::min(least, numbers[i]);
    most = std::max(most, numbers[i]);
    num_falls += numbers[i] <= numbers[i - 1];
  }
  hg::require(
      least >= 0 && most < num_places, CEED_ERROR_DIMENSION,
      [&] {
        const auto is_wrong = [&](CeedInt number) { return number < 0 || number >= num_places; };
        const auto i = static_cast<CeedInt>(std::find_if(numbers, numbers + num_entries, is_wrong) - offsets);
        const auto e = static_cast<CeedInt>(std::upper_bound(offsets, offsets + num_elem + 1, i) - offsets) - 1;
        return hg::text("CeedElemRestriction at points: point %" CeedInt_FMT " of element %" CeedInt_FMT
                        " has the number %" CeedInt_FMT
                        "; expected one in [0, %td), as the L-vector has %td entries of %" CeedInt_FMT " components",
                        i - offsets[e], e, offsets[i], num_places, r.l_size, r.num_comp);
      },
      where);
  // Each place once?
  r.is_copy = num_entries * static_cast<CeedSize>(r.num_comp) == r.l_size;
  if (r.is_copy && num_falls > 0) {
    std::vector<bool> is_listed(static_cast<std::size_t>(num_places));
    for (CeedInt i = 0; r.is_copy && i < num_entries; i++) {
      r.is_copy = !is_listed[numbers[i]];
      is_listed[numbers[i]] = true;
    }
  }
  return num_entries;
}

/// What the functions that make restrictions with offsets are given.
struct WithOffsets {
  CeedRestrictionType type = CEED_RESTRICTION_STANDARD;
  CeedInt num_elem, elem_size, block_size = 1, num_comp, comp_stride;
  CeedSize l_size;
  CeedMemType mem_type;
  CeedCopyMode copy_mode;
  const CeedInt *offsets;
  const bool *orients = nullptr;           ///< for CEED_RESTRICTION_ORIENTED
  const CeedInt8 *curl_orients = nullptr;  ///< for CEED_RESTRICTION_CURL_ORIENTED
};

/// Takes in a sign for each node of each element, true for -1.
void take_orients(CeedElemRestriction_private &r, const WithOffsets &given, hg::Where where) {
  require_array(r, given.mem_type, given.copy_mode, given.orients, "orientations", where);
  const bool *orients = keep_table(r, given.copy_mode, given.orients, r.elem_size, r.orients);
  const CeedSize size = r.table_size(r.elem_size);
  auto signs = std::make_unique<CeedInt8[]>(static_cast<std::size_t>(size));
  std::transform(orients, orients + size, signs.get(), [](bool is_flipped) { return CeedInt8(is_flipped ? -1 : 1); });
  r.own_bands.keep(std::move(signs));
  r.num_bands = 1;
}

/// Takes in a tridiagonal matrix for each element.
void take_curl_orients(CeedElemRestriction_private &r, const WithOffsets &given, hg::Where where) {
  require_array(r, given.mem_type, given.copy_mode, given.curl_orients, "curl-orientations", where);
  const CeedSize per_elem = 3 * static_cast<CeedSize>(r.elem_size);
  for (CeedSize i = 0; i < r.num_elem * per_elem; i++) {
    // An unsigned copy holds absolute values.
    hg::require(
        given.curl_orients[i] >= -127, CEED_ERROR_DIMENSION,
        [&] {
          return hg::text(
              "CeedElemRestriction: curl-orientation %td of element %td is %d; expected -127 or more, and "
              "usually -1, 0 or 1",
              i % per_elem, i / per_elem, given.curl_orients[i]);
        },
        where);
  }
  keep_table(r, given.copy_mode, given.curl_orients, per_elem, r.own_bands);
  r.num_bands = 3;
}

void create(Ceed ceed, const WithOffsets &given, CeedElemRestriction *rstr, hg::Where where = hg::Where::current()) {
  auto created = make(ceed, given.type, given.num_elem, given.num_comp, given.l_size, rstr, where);
  auto &r = *created;
  set_elem_size(r, given.elem_size, given.block_size, where);
  hg::require(
      given.num_comp == 1 || given.comp_stride >= 1, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction: component stride is %" CeedInt_FMT
                        "; expected 1 or more for %" CeedInt_FMT " components",
                        given.comp_stride, given.num_comp);
      },
      where);
  r.comp_stride = given.comp_stride;
  require_array(r, given.mem_type, given.copy_mode, given.offsets, "offsets", where);
  const CeedSize last_comp = static_cast<CeedSize>(given.num_comp - 1) * given.comp_stride;
  for (CeedSize i = 0; i < static_cast<CeedSize>(given.num_elem) * given.elem_size; i++) {
    const CeedInt offset = given.offsets[i];
    hg::require(
        offset >= 0 && offset + last_comp < given.l_size, CEED_ERROR_DIMENSION,
        [&] {
          return hg::text("CeedElemRestriction: the offset of element %td, node %td is %" CeedInt_FMT
                          "; its components lie at %" CeedInt_FMT
                          " to %td, expected in [0, %td), the L-vector's entries",
                          i / given.elem_size, i % given.elem_size, offset, offset, offset + last_comp, given.l_size);
        },
        where);
  }
  r.offsets = keep_table(r, given.copy_mode, given.offsets, given.elem_size, r.own_offsets);
  if (given.type == CEED_RESTRICTION_ORIENTED) take_orients(r, given, where);
  if (given.type == CEED_RESTRICTION_CURL_ORIENTED) take_curl_orients(r, given, where);
  r.bands = r.own_bands.data();
  hg::show_to_backend(r);
  if (given.copy_mode == CEED_OWN_POINTER) {
    r.own_offsets.adopt(given.offsets);
    r.orients.adopt(given.orients);
    r.own_bands.adopt(given.curl_orients);
  }
  *rstr = created.release();
}

void create_strided(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt block_size, CeedInt num_comp,
                    CeedSize l_size, const CeedInt *strides, CeedElemRestriction *rstr,
                    hg::Where where = hg::Where::current()) {
  auto created = make(ceed, CEED_RESTRICTION_STRIDED, num_elem, num_comp, l_size, rstr, where);
  auto &r = *created;
  set_elem_size(r, elem_size, block_size, where);
  hg::require(strides != nullptr, CEED_ERROR_MINOR,
              "CeedElemRestriction: the strides are NULL; expected three numbers or CEED_STRIDES_BACKEND", where);
  r.has_backend_strides = std::equal(strides, strides + 3, CEED_STRIDES_BACKEND);
  std::copy_n(r.has_backend_strides ? r.e_layout : strides, 3, r.strides);
  const CeedInt sizes[3] = {elem_size, num_comp, num_elem};
  CeedSize last = 0;
  for (int d = 0; d < 3; d++) {
    hg::require(
        r.strides[d] >= 0, CEED_ERROR_DIMENSION,
        [&] {
          return hg::text("CeedElemRestriction: strides are [%" CeedInt_FMT ", %" CeedInt_FMT ", %" CeedInt_FMT
                          "]; expected 0 or more each",
                          strides[0], strides[1], strides[2]);
        },
        where);
    last += static_cast<CeedSize>(std::max(sizes[d] - 1, 0)) * r.strides[d];
  }
  hg::require(
      num_elem == 0 || last < l_size, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction: strides [%" CeedInt_FMT ", %" CeedInt_FMT ", %" CeedInt_FMT
                        "] with %" CeedInt_FMT " nodes, %" CeedInt_FMT " components and %" CeedInt_FMT
                        " elements lead to entry %td; expected less than the L-vector size %td",
                        r.strides[0], r.strides[1], r.strides[2], elem_size, num_comp, num_elem, last, l_size);
      },
      where);
  hg::show_to_backend(r);
  *rstr = created.release();
}

}  // namespace

int CeedElemRestrictionCreate(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp, CeedInt comp_stride,
                              CeedSize l_size, CeedMemType mem_type, CeedCopyMode copy_mode, const CeedInt *offsets,
                              CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] {
    create(ceed,
           {.num_elem = num_elem,
            .elem_size = elem_size,
            .num_comp = num_comp,
            .comp_stride = comp_stride,
            .l_size = l_size,
            .mem_type = mem_type,
            .copy_mode = copy_mode,
            .offsets = offsets},
           rstr);
  });
}

int CeedElemRestrictionCreateOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp,
                                      CeedInt comp_stride, CeedSize l_size, CeedMemType mem_type,
                                      CeedCopyMode copy_mode, const CeedInt *offsets, const bool *orients,
                                      CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] {
    create(ceed,
           {.type = CEED_RESTRICTION_ORIENTED,
            .num_elem = num_elem,
            .elem_size = elem_size,
            .num_comp = num_comp,
            .comp_stride = comp_stride,
            .l_size = l_size,
            .mem_type = mem_type,
            .copy_mode = copy_mode,
            .offsets = offsets,
            .orients = orients},
           rstr);
  });
}

int CeedElemRestrictionCreateCurlOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp,
                                          CeedInt comp_stride, CeedSize l_size, CeedMemType mem_type,
                                          CeedCopyMode copy_mode, const CeedInt *offsets, const CeedInt8 *curl_orients,
                                          CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] {
    create(ceed,
           {.type = CEED_RESTRICTION_CURL_ORIENTED,
            .num_elem = num_elem,
            .elem_size = elem_size,
            .num_comp = num_comp,
            .comp_stride = comp_stride,
            .l_size = l_size,
            .mem_type = mem_type,
            .copy_mode = copy_mode,
            .offsets = offsets,
            .curl_orients = curl_orients},
           rstr);
  });
}

int CeedElemRestrictionCreateStrided(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp, CeedSize l_size,
                                     const CeedInt strides[3], CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] { create_strided(ceed, num_elem, elem_size, 1, num_comp, l_size, strides, rstr); });
}

int CeedElemRestrictionCreateBlocked(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt block_size,
                                     CeedInt num_comp, CeedInt comp_stride, CeedSize l_size, CeedMemType mem_type,
                                     CeedCopyMode copy_mode, const CeedInt *offsets, CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] {
    create(ceed,
           {.num_elem = num_elem,
            .elem_size = elem_size,
            .block_size = block_size,
            .num_comp = num_comp,
            .comp_stride = comp_stride,
            .l_size = l_size,
            .mem_type = mem_type,
            .copy_mode = copy_mode,
            .offsets = offsets},
           rstr);
  });
}

int CeedElemRestrictionCreateBlockedOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt block_size,
                                             CeedInt num_comp, CeedInt comp_stride, CeedSize l_size,
                                             CeedMemType mem_type, CeedCopyMode copy_mode, const CeedInt *offsets,
                                             const bool *orients, CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] {
    create(ceed,
           {.type = CEED_RESTRICTION_ORIENTED,
            .num_elem = num_elem,
            .elem_size = elem_size,
            .block_size = block_size,
            .num_comp = num_comp,
            .comp_stride = comp_stride,
            .l_size = l_size,
            .mem_type = mem_type,
            .copy_mode = copy_mode,
            .offsets = offsets,
            .orients = orients},
           rstr);
  });
}

int CeedElemRestrictionCreateBlockedCurlOriented(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt block_size,
                                                 CeedInt num_comp, CeedInt comp_stride, CeedSize l_size,
                                                 CeedMemType mem_type, CeedCopyMode copy_mode, const CeedInt *offsets,
                                                 const CeedInt8 *curl_orients, CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] {
    create(ceed,
           {.type = CEED_RESTRICTION_CURL_ORIENTED,
            .num_elem = num_elem,
            .elem_size = elem_size,
            .block_size = block_size,
            .num_comp = num_comp,
            .comp_stride = comp_stride,
            .l_size = l_size,
            .mem_type = mem_type,
            .copy_mode = copy_mode,
            .offsets = offsets,
            .curl_orients = curl_orients},
           rstr);
  });
}

int CeedElemRestrictionCreateBlockedStrided(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt block_size,
                                            CeedInt num_comp, CeedSize l_size, const CeedInt strides[3],
                                            CeedElemRestriction *rstr) {
  return hg::guard(ceed,
                   [&] { create_strided(ceed, num_elem, elem_size, block_size, num_comp, l_size, strides, rstr); });
}

int CeedElemRestrictionCreateAtPoints(Ceed ceed, CeedInt num_elem, CeedInt num_points, CeedInt num_comp,
                                      CeedSize l_size, CeedMemType mem_type, CeedCopyMode copy_mode,
                                      const CeedInt *offsets, CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] {
    auto created = make(ceed, CEED_RESTRICTION_POINTS, num_elem, num_comp, l_size, rstr);
    auto &r = *created;
    hg::require(num_points >= 0, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedElemRestriction at points: number of points is %" CeedInt_FMT "; expected 0 or more",
                      num_points);
    });
    hg::require(l_size >= static_cast<CeedSize>(num_points) * num_comp, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedElemRestriction at points: L-vector size is %td; expected at least %td for %" CeedInt_FMT
                      " points with %" CeedInt_FMT " components",
                      l_size, static_cast<CeedSize>(num_points) * num_comp, num_points, num_comp);
    });
    require_array(r, mem_type, copy_mode, offsets, "offsets");
    const CeedInt num_entries = offsets != nullptr ? check_points(r, num_points, offsets) : 0;
    r.num_points = num_points;
    r.comp_stride = 1;
    narrow(static_cast<CeedSize>(r.elem_size) * num_comp, "points of an element times components");
    r.e_size = static_cast<CeedSize>(num_entries) * num_comp;
    r.e_layout[0] = 1;
    if (copy_mode == CEED_COPY_VALUES && offsets != nullptr) {
      r.own_offsets.copy(offsets, offsets[num_elem]);
    } else {
      r.own_offsets.lend(offsets);
    }
    r.offsets = r.own_offsets.data();
    hg::show_to_backend(r);
    if (copy_mode == CEED_OWN_POINTER) r.own_offsets.adopt(offsets);
    *rstr = created.release();
  });
}
