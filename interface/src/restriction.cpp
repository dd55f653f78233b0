// Making element restrictions, and applying them.
#include "restriction.hpp"

#include <algorithm>
#include <limits>

#include "vector.hpp"

namespace {

/// Never destroyed: programs may still hold the sentinel when they end.
union Sentinel {
  Sentinel() : object() { object.is_sentinel = true; }
  ~Sentinel() {}
  CeedElemRestriction_private object;
};
Sentinel none;

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
  hg::require(rstr != nullptr, CEED_ERROR_MINOR, "CeedElemRestriction: the address of the handle is NULL", where);
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

/// Sizes of elements that all have `elem_size` nodes.
void set_elem_size(CeedElemRestriction_private &r, CeedInt elem_size, hg::Where where = hg::Where::current()) {
  hg::require(
      elem_size >= 1, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedElemRestriction: element size is %" CeedInt_FMT "; expected 1 node or more", elem_size);
      },
      where);
  r.elem_size = elem_size;
  const CeedInt elem_stride =
      narrow(static_cast<CeedSize>(elem_size) * r.num_comp, "element size times components", where);
  r.e_size = static_cast<CeedSize>(r.num_elem) * elem_stride;
  r.e_layout = {1, elem_size, elem_stride};
}

void require_offsets(const CeedElemRestriction_private &r, CeedMemType mem_type, CeedCopyMode copy_mode,
                     const CeedInt *offsets, hg::Where where = hg::Where::current()) {
  hg::require_mem_type(*r.ceed, mem_type, "CeedElemRestriction offsets");
  hg::require(mem_type == CEED_MEM_HOST, CEED_ERROR_UNSUPPORTED,
              "CeedElemRestriction offsets: memory type is CEED_MEM_DEVICE; expected CEED_MEM_HOST, where they are "
              "checked",
              where);
  hg::require(
      copy_mode == CEED_COPY_VALUES || copy_mode == CEED_USE_POINTER || copy_mode == CEED_OWN_POINTER, CEED_ERROR_MINOR,
      [&] {
        return hg::text(
            "CeedElemRestriction offsets: copy mode is %d; expected CEED_COPY_VALUES (0), "
            "CEED_USE_POINTER (1) or CEED_OWN_POINTER (2)",
            static_cast<int>(copy_mode));
      },
      where);
  hg::require(offsets != nullptr || r.num_elem == 0, CEED_ERROR_MINOR,
              "CeedElemRestriction: the offsets are NULL; expected an array", where);
}

/// Takes the offsets in; they have been checked.
void keep_offsets(CeedElemRestriction_private &r, CeedCopyMode copy_mode, const CeedInt *offsets) {
  r.offsets = offsets;
  if (copy_mode == CEED_COPY_VALUES && offsets != nullptr) {
    r.owned_offsets.assign(offsets, offsets + r.num_offsets());
    r.offsets = r.owned_offsets.data();
  }
}

/// Shows the restriction to the backend and hands it out. An adopted array becomes the restriction's when nothing can
/// fail any more: until then it is the caller's.
void finish(Created created, CeedElemRestriction *rstr, CeedInt *adopted = nullptr) {
  const auto create = created->ops().create;
  if (create != nullptr) hg::check(create(created.get()));
  created->is_known_to_backend = true;
  created->adopted_offsets.reset(adopted);
  *rstr = created.release();
}

CeedInt *adopted(CeedCopyMode copy_mode, const CeedInt *offsets) {
  return copy_mode == CEED_OWN_POINTER ? const_cast<CeedInt *>(offsets) : nullptr;
}

/// Checks starts and point numbers, sets the largest number of points of an element and returns the number of entries.
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
  for (CeedInt e = 0; e < num_elem; e++) {
    for (CeedInt i = offsets[e]; i < offsets[e + 1]; i++) {
      hg::require(
          offsets[i] >= 0 && offsets[i] < num_places, CEED_ERROR_DIMENSION,
          [&] {
            return hg::text("CeedElemRestriction at points: point %" CeedInt_FMT " of element %" CeedInt_FMT
                            " has the number %" CeedInt_FMT
                            "; expected one in [0, %td), as the L-vector has %td entries of %" CeedInt_FMT
                            " components",
                            i - offsets[e], e, offsets[i], num_places, r.l_size, r.num_comp);
          },
          where);
    }
  }
  return num_entries;
}

void require_length(const CeedElemRestriction_private &r, const char *what, const CeedVector_private &vec,
                    CeedSize needed, hg::Where where = hg::Where::current()) {
  hg::require(
      vec.length >= needed, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text(
            "%s has %td entries; expected at least %td for a CeedElemRestriction with an L-vector of %td and an "
            "E-vector of %td entries",
            what, vec.length, needed, r.l_size, r.e_size);
      },
      where);
}

}  // namespace

const CeedElemRestriction CEED_ELEMRESTRICTION_NONE = &none.object;
const CeedInt CEED_STRIDES_BACKEND[3] = {0, 0, 0};

CeedElemRestriction_private::~CeedElemRestriction_private() {
  if (is_known_to_backend && ops().destroy != nullptr) ops().destroy(this);
}

void CeedElemRestriction_private::check_destroyable() const {
  hg::require(num_readers == 0, CEED_ERROR_ACCESS,
              "Cannot destroy CeedElemRestriction, a process has read access to the offset data");
}

int CeedElemRestrictionCreate(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp, CeedInt comp_stride,
                              CeedSize l_size, CeedMemType mem_type, CeedCopyMode copy_mode, const CeedInt *offsets,
                              CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] {
    auto created = make(ceed, CEED_RESTRICTION_STANDARD, num_elem, num_comp, l_size, rstr);
    set_elem_size(*created, elem_size);
    hg::require(num_comp == 1 || comp_stride >= 1, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedElemRestriction: component stride is %" CeedInt_FMT "; expected 1 or more for %" CeedInt_FMT
                      " components",
                      comp_stride, num_comp);
    });
    created->comp_stride = comp_stride;
    require_offsets(*created, mem_type, copy_mode, offsets);
    const CeedSize last_comp = static_cast<CeedSize>(num_comp - 1) * comp_stride;
    for (CeedSize i = 0; i < created->num_offsets(); i++) {
      hg::require(offsets[i] >= 0 && offsets[i] + last_comp < l_size, CEED_ERROR_DIMENSION, [&] {
        return hg::text("CeedElemRestriction: the offset of element %td, node %td is %" CeedInt_FMT
                        "; its components lie at %" CeedInt_FMT " to %td, expected in [0, %td), the L-vector's entries",
                        i / elem_size, i % elem_size, offsets[i], offsets[i], offsets[i] + last_comp, l_size);
      });
    }
    keep_offsets(*created, copy_mode, offsets);
    finish(std::move(created), rstr, adopted(copy_mode, offsets));
  });
}

int CeedElemRestrictionCreateStrided(Ceed ceed, CeedInt num_elem, CeedInt elem_size, CeedInt num_comp, CeedSize l_size,
                                     const CeedInt strides[3], CeedElemRestriction *rstr) {
  return hg::guard(ceed, [&] {
    auto created = make(ceed, CEED_RESTRICTION_STRIDED, num_elem, num_comp, l_size, rstr);
    auto &r = *created;
    set_elem_size(r, elem_size);
    hg::require(strides != nullptr, CEED_ERROR_MINOR,
                "CeedElemRestriction: the strides are NULL; expected three numbers or CEED_STRIDES_BACKEND");
    r.has_backend_strides = std::equal(strides, strides + 3, CEED_STRIDES_BACKEND);
    if (r.has_backend_strides) {
      r.strides = r.e_layout;
    } else {
      std::copy_n(strides, 3, r.strides.begin());
    }
    const CeedInt sizes[3] = {elem_size, num_comp, num_elem};
    CeedSize last = 0;
    for (int d = 0; d < 3; d++) {
      hg::require(r.strides[d] >= 0, CEED_ERROR_DIMENSION, [&] {
        return hg::text("CeedElemRestriction: strides are [%" CeedInt_FMT ", %" CeedInt_FMT ", %" CeedInt_FMT
                        "]; expected 0 or more each",
                        strides[0], strides[1], strides[2]);
      });
      last += static_cast<CeedSize>(std::max(sizes[d] - 1, 0)) * r.strides[d];
    }
    hg::require(num_elem == 0 || last < l_size, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedElemRestriction: strides [%" CeedInt_FMT ", %" CeedInt_FMT ", %" CeedInt_FMT
                      "] with %" CeedInt_FMT " nodes, %" CeedInt_FMT " components and %" CeedInt_FMT
                      " elements lead to entry %td; expected less than the L-vector size %td",
                      r.strides[0], r.strides[1], r.strides[2], elem_size, num_comp, num_elem, last, l_size);
    });
    finish(std::move(created), rstr);
  });
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
    require_offsets(r, mem_type, copy_mode, offsets);
    const CeedInt num_entries = offsets != nullptr ? check_points(r, num_points, offsets) : 0;
    r.num_points = num_points;
    r.comp_stride = 1;
    narrow(static_cast<CeedSize>(r.elem_size) * num_comp, "points of an element times components");
    r.e_size = static_cast<CeedSize>(num_entries) * num_comp;
    r.e_layout = {1, 0, 0};
    keep_offsets(r, copy_mode, offsets);
    finish(std::move(created), rstr, adopted(copy_mode, offsets));
  });
}

int CeedElemRestrictionReferenceCopy(CeedElemRestriction rstr, CeedElemRestriction *rstr_copy) {
  return hg::guard(hg::ceed_of(rstr), [&] { hg::reference_copy(rstr, rstr_copy); });
}

int CeedElemRestrictionReference(CeedElemRestriction rstr) {
  return hg::guard(hg::ceed_of(rstr), [&] { hg::reference(&hg::deref(rstr, "CeedElemRestriction")); });
}

int CeedElemRestrictionDestroy(CeedElemRestriction *rstr) {
  return hg::guard(rstr != nullptr ? hg::ceed_of(*rstr) : nullptr, [&] { hg::destroy(rstr); });
}

int CeedElemRestrictionCreateVector(CeedElemRestriction rstr, CeedVector *lvec, CeedVector *evec) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    CeedVector l = nullptr;
    if (lvec != nullptr) {
      hg::check(CeedVectorCreate(r.ceed.get(), r.l_size, &l));
      *lvec = l;
    }
    if (evec != nullptr) {
      const int code = CeedVectorCreate(r.ceed.get(), r.e_size, evec);
      if (code != CEED_ERROR_SUCCESS && lvec != nullptr) CeedVectorDestroy(lvec);
      hg::check(code);
    }
  });
}

int CeedElemRestrictionApply(CeedElemRestriction rstr, CeedTransposeMode t_mode, CeedVector u, CeedVector ru,
                             CeedRequest *) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    auto &in = hg::deref_vector(u, "Input CeedVector");
    auto &out = hg::deref_vector(ru, "Output CeedVector");
    const bool is_transpose = t_mode == CEED_TRANSPOSE;
    require_length(r, "Input CeedVector", in, is_transpose ? r.e_size : r.l_size);
    require_length(r, "Output CeedVector", out, is_transpose ? r.l_size : r.e_size);
    hg::require(u != ru, CEED_ERROR_INCOMPATIBLE,
                "CeedElemRestrictionApply: input and output are the same vector; expected two");
    hg::require_readable(in);
    hg::require_writable(out);
    hg::require_values(in, "Input CeedVector");
    if (is_transpose) hg::require_values(out, "Output CeedVector");
    if (r.e_size > 0) hg::check(r.ops().apply(rstr, t_mode, u, ru));
  });
}

int CeedElemRestrictionApplyAtPointsInElement(CeedElemRestriction rstr, CeedInt elem, CeedTransposeMode t_mode,
                                              CeedVector u, CeedVector ru, CeedRequest *) {
  return hg::guard(hg::ceed_of(rstr), [&] {
    auto &r = hg::deref_restriction(rstr);
    hg::require(r.is_points(), CEED_ERROR_INCOMPATIBLE,
                "CeedElemRestrictionApplyAtPointsInElement: the CeedElemRestriction is not one at points");
    hg::require(elem >= 0 && elem < r.num_elem, CEED_ERROR_DIMENSION, [&] {
      return hg::text("CeedElemRestrictionApplyAtPointsInElement: element is %" CeedInt_FMT
                      "; expected one in [0, %" CeedInt_FMT ")",
                      elem, r.num_elem);
    });
    auto &in = hg::deref_vector(u, "Input CeedVector");
    auto &out = hg::deref_vector(ru, "Output CeedVector");
    const bool is_transpose = t_mode == CEED_TRANSPOSE;
    const CeedSize size = static_cast<CeedSize>(hg::points_in_element(r, elem).size) * r.num_comp;
    require_length(r, "Input CeedVector", in, is_transpose ? size : r.l_size);
    require_length(r, "Output CeedVector", out, is_transpose ? r.l_size : size);
    hg::require(u != ru, CEED_ERROR_INCOMPATIBLE,
                "CeedElemRestrictionApplyAtPointsInElement: input and output are the same vector; expected two");
    hg::require_readable(in);
    hg::require_writable(out);
    hg::require_values(in, "Input CeedVector");
    if (is_transpose) hg::require_values(out, "Output CeedVector");
    if (size > 0) hg::check(r.ops().apply_at_points_in_element(rstr, elem, t_mode, u, ru));
  });
}
