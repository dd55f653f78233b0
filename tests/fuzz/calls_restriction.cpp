// Calls on restrictions.
#include <algorithm>
#include <cstdlib>

#include "objects.hpp"

namespace hg::fuzz {
namespace {

/// A copy for a function that will own it.
template <typename T>
T *owned_copy(const T *array, std::size_t size) {
  auto *copy = static_cast<T *>(std::malloc(std::max<std::size_t>(size, 1) * sizeof(T)));
  std::copy_n(array, size, copy);
  return copy;
}

/// Restrictions with offsets, of all orientations, blocked or not.
int create_with_offsets(Objects &o) {
  const Ceed ceed = o.ceed();
  const int kind = o.bytes.next_byte() % 6;
  const CeedInt num_elem = o.count(), elem_size = o.count(), num_comp = o.count(), comp_stride = o.count();
  const CeedInt block_size = o.count();
  const CeedSize l_size = o.length();
  const CeedMemType mem_type = o.mem_type();
  const CeedCopyMode copy_mode = o.copy_mode();
  const std::size_t size = static_cast<std::size_t>(std::max(num_elem, 0)) * std::max(elem_size, 0);
  std::vector<CeedInt> offsets(size);
  std::vector<char> orients(size);
  std::vector<CeedInt8> curl_orients(3 * size);
  const CeedSize room = std::max<CeedSize>(
      1, std::max<CeedSize>(l_size, 0) - static_cast<CeedSize>(std::max(num_comp, 1) - 1) * std::max(comp_stride, 0));
  const std::uint8_t seed = o.bytes.next_byte();
  for (std::size_t i = 0; i < size; i++) {
    offsets[i] = static_cast<CeedInt>((i * (seed % 7) + i / 3 + seed) % room);
    orients[i] = static_cast<char>((i * seed >> 3) & 1);
    for (int k = 0; k < 3; k++) curl_orients[3 * i + k] = static_cast<CeedInt8>((i * 3 + k + seed) % 3) - 1;
  }
  if (size > 0 && seed >= 240) offsets[seed % size] = seed % 2 == 0 ? -1 : static_cast<CeedInt>(l_size);
  const bool is_null = o.bytes.next_byte() >= 250;
  const bool is_owned = copy_mode == CEED_OWN_POINTER;
  CeedInt *given = is_null ? nullptr : is_owned ? owned_copy(offsets.data(), size) : o.keep(offsets);
  auto *signs = o.keep(orients);
  auto *given_signs = reinterpret_cast<bool *>(is_owned ? owned_copy(signs, size) : signs);
  auto *given_bands = is_owned ? owned_copy(curl_orients.data(), 3 * size) : o.keep(curl_orients);
  const int code = o.create(o.restrictions, [&](CeedElemRestriction *rstr) {
    switch (kind) {
      case 0:
        return CeedElemRestrictionCreate(ceed, num_elem, elem_size, num_comp, comp_stride, l_size, mem_type, copy_mode,
                                         given, rstr);
      case 1:
        return CeedElemRestrictionCreateOriented(ceed, num_elem, elem_size, num_comp, comp_stride, l_size, mem_type,
                                                 copy_mode, given, given_signs, rstr);
      case 2:
        return CeedElemRestrictionCreateCurlOriented(ceed, num_elem, elem_size, num_comp, comp_stride, l_size, mem_type,
                                                     copy_mode, given, given_bands, rstr);
      case 3:
        return CeedElemRestrictionCreateBlocked(ceed, num_elem, elem_size, block_size, num_comp, comp_stride, l_size,
                                                mem_type, copy_mode, given, rstr);
      case 4:
        return CeedElemRestrictionCreateBlockedOriented(ceed, num_elem, elem_size, block_size, num_comp, comp_stride,
                                                        l_size, mem_type, copy_mode, given, given_signs, rstr);
      default:
        return CeedElemRestrictionCreateBlockedCurlOriented(ceed, num_elem, elem_size, block_size, num_comp,
                                                            comp_stride, l_size, mem_type, copy_mode, given,
                                                            given_bands, rstr);
    }
  });
  if (!is_owned) return code;
  const bool keeps = code == CEED_ERROR_SUCCESS;
  if (!keeps) std::free(given);
  if (!keeps || (kind != 1 && kind != 4)) std::free(given_signs);
  if (!keeps || (kind != 2 && kind != 5)) std::free(given_bands);
  return code;
}

int create_strided(Objects &o) {
  const Ceed ceed = o.ceed();
  const CeedInt num_elem = o.count(), elem_size = o.count(), num_comp = o.count(), block_size = o.count();
  const CeedSize l_size = o.length();
  const bool is_blocked = o.flag();
  const CeedInt given[3] = {o.count(), o.count(), o.count()};
  const CeedInt P = std::max(elem_size, 0), C = std::max(num_comp, 0);
  const CeedInt dense[3] = {1, P, P * C};
  const int choice = o.bytes.next_byte() % 8;
  const CeedInt *strides = choice == 0 ? given : choice == 1 ? nullptr : choice < 5 ? CEED_STRIDES_BACKEND : dense;
  return o.create(o.restrictions, [&](CeedElemRestriction *rstr) {
    return is_blocked ? CeedElemRestrictionCreateBlockedStrided(ceed, num_elem, elem_size, block_size, num_comp, l_size,
                                                                strides, rstr)
                      : CeedElemRestrictionCreateStrided(ceed, num_elem, elem_size, num_comp, l_size, strides, rstr);
  });
}

/// Starts and point numbers, right or not, that stay within the array.
int create_at_points(Objects &o) {
  const Ceed ceed = o.ceed();
  const CeedInt num_elem = o.few(), num_comp = o.count();
  std::vector<CeedInt> list(512, 0);
  CeedInt start = num_elem + 1, total = 0;
  for (CeedInt e = 0; e < num_elem; e++) {
    const CeedInt n = o.bytes.next_byte() % 5;
    list[e] = start;
    for (CeedInt i = 0; i < n; i++) list[start + i] = total++;
    start += n;
  }
  list[std::max(num_elem, 0)] = start;
  const std::uint8_t wrong = o.bytes.next_byte();
  if (wrong >= 240) list[wrong % 16] = wrong % 3 == 0 ? -1 : wrong;
  const CeedInt num_points = wrong % 16 == 15 ? o.count() : total;
  const CeedSize l_size = wrong % 16 == 14 ? o.length() : static_cast<CeedSize>(total) * std::max(num_comp, 0);
  const CeedMemType mem_type = o.mem_type();
  const CeedCopyMode copy_mode = o.copy_mode();
  const bool is_owned = copy_mode == CEED_OWN_POINTER;
  CeedInt *given = o.bytes.next_byte() >= 250 ? nullptr
                   : is_owned                 ? owned_copy(list.data(), list.size())
                                              : o.keep(list);
  const int code = o.create(o.restrictions, [&](CeedElemRestriction *rstr) {
    return CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_points, num_comp, l_size, mem_type, copy_mode, given,
                                             rstr);
  });
  if (is_owned && code != CEED_ERROR_SUCCESS) std::free(given);
  return code;
}

int get_offsets(Objects &o) {
  const CeedElemRestriction rstr = o.restriction();
  const CeedInt *offsets = nullptr;
  const int code = CeedElemRestrictionGetOffsets(rstr, o.mem_type(), &offsets);
  if (code == CEED_ERROR_SUCCESS) o.restrictions.lend(rstr);
  return code;
}

int restore_offsets(Objects &o) {
  const CeedElemRestriction rstr = o.restriction();
  const CeedInt *offsets = nullptr;
  const int code = CeedElemRestrictionRestoreOffsets(rstr, &offsets);
  if ((code == CEED_ERROR_SUCCESS) != o.restrictions.give_back(rstr)) throw Defect("restored offsets were not counted");
  return code;
}

const Call calls[] = {
    {"CeedElemRestrictionCreate (with offsets)", false, create_with_offsets},
    {"CeedElemRestrictionCreateStrided", false, create_strided},
    {"CeedElemRestrictionCreateAtPoints", false, create_at_points},
    {"CeedElemRestrictionDestroy", false,
     [](Objects &o) { return o.restrictions.remove(o.restrictions.at(o.slot())); }},
    {"CeedElemRestrictionReferenceCopy", false,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       return o.create(o.restrictions,
                       [&](CeedElemRestriction *copy) { return CeedElemRestrictionReferenceCopy(rstr, copy); });
     }},
    {"CeedElemRestrictionCreateUnsignedCopy", false,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       return o.create(o.restrictions,
                       [&](CeedElemRestriction *copy) { return CeedElemRestrictionCreateUnsignedCopy(rstr, copy); });
     }},
    {"CeedElemRestrictionCreateUnorientedCopy", false,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       return o.create(o.restrictions,
                       [&](CeedElemRestriction *copy) { return CeedElemRestrictionCreateUnorientedCopy(rstr, copy); });
     }},
    {"CeedElemRestrictionCreateVector", false,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       const bool wants_l = o.flag();
       return o.create(o.vectors, [&](CeedVector *vec) {
         return CeedElemRestrictionCreateVector(rstr, wants_l ? vec : nullptr, wants_l ? nullptr : vec);
       });
     }},
    {"CeedElemRestrictionApply", true,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       const CeedTransposeMode t_mode = o.t_mode();
       const CeedVector u = o.vector(), v = o.vector();
       return CeedElemRestrictionApply(rstr, t_mode, u, v, o.request());
     }},
    {"CeedElemRestrictionApplyBlock", true,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       const CeedInt block = o.count();
       const CeedTransposeMode t_mode = o.t_mode();
       const CeedVector u = o.vector(), v = o.vector();
       return CeedElemRestrictionApplyBlock(rstr, block, t_mode, u, v, o.request());
     }},
    {"CeedElemRestrictionApplyAtPointsInElement", true,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       const CeedInt elem = o.count();
       const CeedTransposeMode t_mode = o.t_mode();
       const CeedVector u = o.vector(), v = o.vector();
       return CeedElemRestrictionApplyAtPointsInElement(rstr, elem, t_mode, u, v, o.request());
     }},
    {"CeedElemRestrictionGetOffsets", false, get_offsets},
    {"CeedElemRestrictionRestoreOffsets", false, restore_offsets},
    {"CeedElemRestrictionGetOrientations", false,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       const bool *orients = nullptr;
       const int code = CeedElemRestrictionGetOrientations(rstr, o.mem_type(), &orients);
       return code != CEED_ERROR_SUCCESS ? code : CeedElemRestrictionRestoreOrientations(rstr, &orients);
     }},
    {"CeedElemRestrictionGetCurlOrientations", false,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       const CeedInt8 *orients = nullptr;
       const int code = CeedElemRestrictionGetCurlOrientations(rstr, o.mem_type(), &orients);
       return code != CEED_ERROR_SUCCESS ? code : CeedElemRestrictionRestoreCurlOrientations(rstr, &orients);
     }},
    {"CeedElemRestrictionGetNumPointsInElement", false,
     [](Objects &o) {
       CeedInt n = 0;
       const CeedElemRestriction rstr = o.restriction();
       return CeedElemRestrictionGetNumPointsInElement(rstr, o.count(), &n);
     }},
    {"CeedElemRestrictionGetAtPointsElementOffset", false,
     [](Objects &o) {
       CeedSize offset = 0;
       const CeedElemRestriction rstr = o.restriction();
       return CeedElemRestrictionGetAtPointsElementOffset(rstr, o.count(), &offset);
     }},
    {"CeedElemRestrictionAtPointsAreCompatible", false,
     [](Objects &o) {
       bool are = false;
       const CeedElemRestriction a = o.restriction(), b = o.restriction();
       return CeedElemRestrictionAtPointsAreCompatible(a, b, &are);
     }},
    {"CeedElemRestriction getters", false,
     [](Objects &o) {
       static int (*const getters[])(CeedElemRestriction, CeedInt *) = {
           CeedElemRestrictionGetCompStride,         CeedElemRestrictionGetNumElements,
           CeedElemRestrictionGetElementSize,        CeedElemRestrictionGetNumPoints,
           CeedElemRestrictionGetMaxPointsInElement, CeedElemRestrictionGetMinPointsInElement,
           CeedElemRestrictionGetNumComponents,      CeedElemRestrictionGetNumBlocks,
           CeedElemRestrictionGetBlockSize,          CeedElemRestrictionGetNumViewTabs};
       CeedInt value = 0;
       const CeedElemRestriction rstr = o.restriction();
       return getters[o.bytes.next_byte() % std::size(getters)](rstr, &value);
     }},
    {"CeedElemRestriction layouts", false,
     [](Objects &o) {
       static int (*const getters[])(CeedElemRestriction, CeedInt *) = {
           CeedElemRestrictionGetStrides, CeedElemRestrictionGetLLayout, CeedElemRestrictionGetELayout};
       CeedInt layout[3];
       const CeedElemRestriction rstr = o.restriction();
       return getters[o.bytes.next_byte() % std::size(getters)](rstr, layout);
     }},
    {"CeedElemRestrictionSetELayout", false,
     [](Objects &o) {
       CeedInt layout[3] = {o.count(), o.count(), o.count()};
       return CeedElemRestrictionSetELayout(o.restriction(), layout);
     }},
    {"CeedElemRestrictionGetMultiplicity", true,
     [](Objects &o) {
       const CeedElemRestriction rstr = o.restriction();
       return CeedElemRestrictionGetMultiplicity(rstr, o.vector());
     }},
    {"CeedElemRestrictionView", false, [](Objects &o) { return CeedElemRestrictionView(o.restriction(), o.stream()); }},
    {"CeedElemRestrictionGetFlopsEstimate", false,
     [](Objects &o) {
       CeedSize flops = 0;
       const CeedElemRestriction rstr = o.restriction();
       return CeedElemRestrictionGetFlopsEstimate(rstr, o.t_mode(), &flops);
     }},
};

}  // namespace

std::span<const Call> restriction_calls() {
  return calls;
}

}  // namespace hg::fuzz
