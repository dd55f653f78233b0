// Calls on vectors.
#include <algorithm>
#include <cstdlib>

#include "objects.hpp"

namespace hg::fuzz {
namespace {

std::size_t length_of(CeedVector vec) {
  CeedSize length = 0;
  if (vec != nullptr) CeedVectorGetLength(vec, &length);
  return static_cast<std::size_t>(length);
}

int set_array(Objects &o) {
  const CeedVector vec = o.vector();
  const CeedMemType mem_type = o.mem_type();
  const CeedCopyMode copy_mode = o.copy_mode();
  const std::size_t length = length_of(vec);
  CeedScalar *array = o.bytes.next_byte() >= 250 ? nullptr : o.scalars(length);
  if (copy_mode != CEED_OWN_POINTER || array == nullptr) return CeedVectorSetArray(vec, mem_type, copy_mode, array);
  auto *owned = static_cast<CeedScalar *>(std::malloc(std::max<std::size_t>(length, 1) * sizeof(CeedScalar)));
  std::copy_n(array, length, owned);
  const int code = CeedVectorSetArray(vec, mem_type, copy_mode, owned);
  if (code != CEED_ERROR_SUCCESS) std::free(owned);
  return code;
}

int get_array(Objects &o) {
  const CeedVector vec = o.vector();
  CeedScalar *array = nullptr;
  const bool is_write_only = o.flag();
  const int code = is_write_only ? CeedVectorGetArrayWrite(vec, o.mem_type(), &array)
                                 : CeedVectorGetArray(vec, o.mem_type(), &array);
  if (code != CEED_ERROR_SUCCESS) return code;
  o.vectors.lend(vec);
  std::fill_n(array, length_of(vec), 0.25);
  return code;
}

int restore_array(Objects &o) {
  const CeedVector vec = o.vector();
  CeedScalar *array = nullptr;
  const int code = CeedVectorRestoreArray(vec, &array);
  if ((code == CEED_ERROR_SUCCESS) != o.vectors.give_back(vec)) throw Defect("CeedVectorRestoreArray lost count");
  return code;
}

int get_array_read(Objects &o) {
  const CeedVector vec = o.vector();
  const CeedScalar *array = nullptr;
  const int code = CeedVectorGetArrayRead(vec, o.mem_type(), &array);
  if (code != CEED_ERROR_SUCCESS) return code;
  volatile CeedScalar sum = 0;
  for (std::size_t i = 0; i < length_of(vec); i++) sum = sum + array[i];
  o.readers.push_back(vec);
  return code;
}

int restore_array_read(Objects &o) {
  const CeedVector vec = o.vector();
  const CeedScalar *array = nullptr;
  const int code = CeedVectorRestoreArrayRead(vec, &array);
  const auto reader = std::find(o.readers.begin(), o.readers.end(), vec);
  if ((code == CEED_ERROR_SUCCESS) != (reader != o.readers.end()))
    throw Defect("CeedVectorRestoreArrayRead lost count");
  if (code == CEED_ERROR_SUCCESS) o.readers.erase(reader);
  return code;
}

const Call calls[] = {
    {"CeedVectorCreate", false,
     [](Objects &o) {
       const Ceed ceed = o.ceed();
       const CeedSize length = o.length();
       return o.create(o.vectors, [&](CeedVector *vec) { return CeedVectorCreate(ceed, length, vec); });
     }},
    {"CeedVectorDestroy", false, [](Objects &o) { return o.vectors.remove(o.vectors.at(o.slot())); }},
    {"CeedVectorReferenceCopy", false,
     [](Objects &o) {
       const CeedVector vec = o.vector();
       return o.create(o.vectors, [&](CeedVector *copy) { return CeedVectorReferenceCopy(vec, copy); });
     }},
    {"CeedVectorSetValue", true,
     [](Objects &o) {
       const CeedVector vec = o.vector();
       return CeedVectorSetValue(vec, o.scalar());
     }},
    {"CeedVectorSetValueStrided", true,
     [](Objects &o) {
       const CeedVector vec = o.vector();
       const CeedSize start = o.length(), stop = o.length(), step = o.length();
       return CeedVectorSetValueStrided(vec, start, stop, step, o.scalar());
     }},
    {"CeedVectorSetArray", true, set_array},
    {"CeedVectorTakeArray", true,
     [](Objects &o) {
       CeedScalar *array = nullptr;
       const CeedVector vec = o.vector();
       return CeedVectorTakeArray(vec, o.mem_type(), &array);
     }},
    {"CeedVectorSyncArray", false,
     [](Objects &o) {
       const CeedVector vec = o.vector();
       return CeedVectorSyncArray(vec, o.mem_type());
     }},
    {"CeedVectorGetArray", true, get_array},
    {"CeedVectorRestoreArray", true, restore_array},
    {"CeedVectorGetArrayRead", true, get_array_read},
    {"CeedVectorRestoreArrayRead", false, restore_array_read},
    {"CeedVectorCopy", true,
     [](Objects &o) {
       const CeedVector from = o.vector();
       return CeedVectorCopy(from, o.vector());
     }},
    {"CeedVectorCopyStrided", true,
     [](Objects &o) {
       const CeedVector from = o.vector(), to = o.vector();
       const CeedSize start = o.length(), stop = o.length(), step = o.length();
       return CeedVectorCopyStrided(from, start, stop, step, to);
     }},
    {"CeedVectorNorm", false,
     [](Objects &o) {
       CeedScalar norm = 0;
       const CeedVector vec = o.vector();
       return CeedVectorNorm(vec, static_cast<CeedNormType>(o.bytes.next_byte() % 3), &norm);
     }},
    {"CeedVectorScale", true,
     [](Objects &o) {
       const CeedVector vec = o.vector();
       return CeedVectorScale(vec, o.scalar());
     }},
    {"CeedVectorFilter", true,
     [](Objects &o) {
       const CeedVector vec = o.vector();
       return CeedVectorFilter(vec, o.scalar());
     }},
    {"CeedVectorAXPY", true,
     [](Objects &o) {
       const CeedVector y = o.vector(), x = o.vector();
       return CeedVectorAXPY(y, o.scalar(), x);
     }},
    {"CeedVectorAXPBY", true,
     [](Objects &o) {
       const CeedVector y = o.vector(), x = o.vector();
       const CeedScalar alpha = o.scalar();
       return CeedVectorAXPBY(y, alpha, o.scalar(), x);
     }},
    {"CeedVectorPointwiseMult", true,
     [](Objects &o) {
       const CeedVector w = o.vector(), x = o.vector(), y = o.vector();
       return CeedVectorPointwiseMult(w, x, y);
     }},
    {"CeedVectorReciprocal", true, [](Objects &o) { return CeedVectorReciprocal(o.vector()); }},
    {"CeedVectorView", false,
     [](Objects &o) {
       const CeedVector vec = o.vector();
       return CeedVectorView(vec, o.flag() ? "%g" : nullptr, o.stream());
     }},
    {"CeedVectorViewRange", false,
     [](Objects &o) {
       const CeedVector vec = o.vector();
       const CeedSize start = o.length(), stop = o.length();
       return CeedVectorViewRange(vec, start, stop, o.count(), "%12.8f", o.stream());
     }},
    {"CeedVectorHasValidArray", false,
     [](Objects &o) {
       bool has = false;
       return CeedVectorHasValidArray(o.vector(), &has);
     }},
    {"CeedVectorHasBorrowedArrayOfType", false,
     [](Objects &o) {
       bool has = false;
       const CeedVector vec = o.vector();
       return CeedVectorHasBorrowedArrayOfType(vec, o.mem_type(), &has);
     }},
    {"CeedVectorGetState", false,
     [](Objects &o) {
       std::uint64_t state = 0;
       return CeedVectorGetState(o.vector(), &state);
     }},
    {"CeedVectorGetLength", false,
     [](Objects &o) {
       CeedSize length = 0;
       return CeedVectorGetLength(o.vector(), &length);
     }},
};

}  // namespace

std::span<const Call> vector_calls() {
  return calls;
}

}  // namespace hg::fuzz
