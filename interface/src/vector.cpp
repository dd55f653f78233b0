#include "vector.hpp"

#include <algorithm>
#include <cstdio>

#include "view.hpp"

namespace {

/// Never destroyed: programs may still hold the sentinels when they end.
union Sentinel {
  Sentinel() : object() { object.is_sentinel = true; }
  ~Sentinel() {}
  CeedVector_private object;
};
Sentinel active, none;

CeedRequest immediate = nullptr, ordered = nullptr;

void view_range(CeedVector_private &v, CeedSize start, CeedSize stop, CeedInt step, const char *fp_fmt, FILE *stream) {
  hg::require(stream != nullptr, CEED_ERROR_MINOR, "The stream is NULL; expected an open file");
  hg::require(step != 0, CEED_ERROR_MINOR, "View range 'step' must be nonzero");
  hg::require(start >= 0 && start <= v.length, CEED_ERROR_DIMENSION,
              [&] { return hg::text("View range starts at %td; expected an index in [0, %td]", start, v.length); });
  const hg::Lines line(stream, v.num_view_tabs);
  line(0, "CeedVector length %td", v.length);
  if (v.is_sentinel) return;
  if (start != 0 || stop != v.length || step != 1) {
    line(1, "start: %td", start);
    line(1, "stop:  %td", stop);
    line(1, "step:  %" CeedInt_FMT, step);
  }
  const CeedSize end = stop < 0 || stop > v.length ? v.length : stop;
  const char *format = fp_fmt != nullptr ? fp_fmt : "%g";
  const hg::ReadArray array(&v);
  for (CeedSize i = start; step > 0 ? i < end : i > end; i += step) {
    if (i < v.length) line(1, format, array[i]);
  }
  if (end < v.length) line(1, "...");
}

}  // namespace

const CeedVector CEED_VECTOR_ACTIVE = &active.object;
const CeedVector CEED_VECTOR_NONE = &none.object;
CeedRequest *const CEED_REQUEST_IMMEDIATE = &immediate;
CeedRequest *const CEED_REQUEST_ORDERED = &ordered;

CeedVector_private::~CeedVector_private() {
  if (is_known_to_backend && ops().destroy != nullptr) ops().destroy(this);
}

void CeedVector_private::check_destroyable() const {
  hg::require(!has_writer(), CEED_ERROR_ACCESS, "Cannot destroy CeedVector, the writable access lock is in use");
  hg::require(num_readers == 0, CEED_ERROR_ACCESS, [&] {
    return hg::text("Cannot destroy CeedVector, a process has read access (%llu arrays not restored)",
                    static_cast<unsigned long long>(num_readers));
  });
}

void CeedVector_private::view(FILE *stream) const {
  view_range(const_cast<CeedVector_private &>(*this), 0, length, 1, "%12.8f", stream);
}

namespace hg {

CeedVector_private &deref_vector(CeedVector vec, const char *what, Where where) {
  deref(vec, what, where);
  require(
      !vec->is_sentinel, CEED_ERROR_INCOMPATIBLE,
      [&] {
        return text("%s is %s, which has no array; expected a vector with values", what,
                    vec == CEED_VECTOR_ACTIVE ? "CEED_VECTOR_ACTIVE" : "CEED_VECTOR_NONE");
      },
      where);
  return *vec;
}

void require_writable(const CeedVector_private &vec, Where where) {
  require(!vec.has_writer(), CEED_ERROR_ACCESS,
          "Cannot grant CeedVector array access, the access lock is already in use", where);
  require(vec.num_readers == 0, CEED_ERROR_ACCESS, "Cannot grant CeedVector array access, a process has read access",
          where);
}

void require_readable(const CeedVector_private &vec, Where where) {
  require(!vec.has_writer(), CEED_ERROR_ACCESS,
          "Cannot grant CeedVector read-only array access, the access lock is already in use", where);
}

void require_values(CeedVector_private &vec, const char *what, Where where) {
  bool has_values = vec.length == 0;
  if (!has_values) check(vec.ops().has_valid_array(&vec, &has_values));
  require(
      has_values, CEED_ERROR_INCOMPLETE,
      [&] {
        return text(
            "%s of length %td holds no values; set them first, with CeedVectorSetValue() or CeedVectorSetArray()", what,
            vec.length);
      },
      where);
}

}  // namespace hg

int CeedVectorCreate(Ceed ceed, CeedSize len, CeedVector *vec) {
  return hg::guard(ceed, [&] {
    hg::deref(ceed, "Ceed");
    hg::require(vec != nullptr, CEED_ERROR_MINOR,
                "CeedVectorCreate: the address of the vector is NULL; expected where it goes");
    hg::require(len >= 0, CEED_ERROR_DIMENSION,
                [&] { return hg::text("Length of a CeedVector is %td; expected 0 or more", len); });
    hg::require(ceed->ops.vector.create != nullptr, CEED_ERROR_UNSUPPORTED,
                [&] { return hg::text("Backend does not implement CeedVectorCreate (%s)", ceed->resource.c_str()); });
    auto created = hg::Ref<CeedVector_private>::adopt(new CeedVector_private);
    created->ceed = hg::Ref<Ceed_private>(ceed);
    created->length = len;
    hg::check(ceed->ops.vector.create(created.get()));
    created->is_known_to_backend = true;
    *vec = created.release();
  });
}

int CeedVectorReferenceCopy(CeedVector vec, CeedVector *vec_copy) {
  return hg::guard(hg::ceed_of(vec), [&] { hg::reference_copy(vec, vec_copy); });
}

int CeedVectorReference(CeedVector vec) {
  return hg::guard(hg::ceed_of(vec), [&] { hg::reference(&hg::deref(vec, "CeedVector")); });
}

int CeedVectorDestroy(CeedVector *vec) {
  return hg::guard(vec != nullptr ? hg::ceed_of(*vec) : nullptr, [&] { hg::destroy(vec); });
}

int CeedVectorSetArray(CeedVector vec, CeedMemType mem_type, CeedCopyMode copy_mode, CeedScalar *array) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    const std::scoped_lock lock(v.access);
    hg::require_writable(v);
    hg::require_mem_type(*v.ceed, mem_type, "CeedVectorSetArray");
    hg::require(copy_mode == CEED_COPY_VALUES || copy_mode == CEED_USE_POINTER || copy_mode == CEED_OWN_POINTER,
                CEED_ERROR_MINOR, [&] {
                  return hg::text(
                      "CeedVectorSetArray: copy mode is %d; expected CEED_COPY_VALUES (0), "
                      "CEED_USE_POINTER (1) or CEED_OWN_POINTER (2)",
                      static_cast<int>(copy_mode));
                });
    hg::require(array != nullptr || v.length == 0, CEED_ERROR_MINOR,
                [&] { return hg::text("CeedVectorSetArray: the array is NULL; expected %td entries", v.length); });
    hg::check(v.ops().set_array(vec, mem_type, copy_mode, array));
    v.state += 2;
  });
}

int CeedVectorSyncArray(CeedVector vec, CeedMemType mem_type) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    hg::require(!v.has_writer(), CEED_ERROR_ACCESS, "Cannot sync CeedVector, the access lock is already in use");
    hg::require_mem_type(*v.ceed, mem_type, "CeedVectorSyncArray");
    hg::require_values(v, "CeedVector");
    hg::check(v.ops().sync_array(vec, mem_type));
  });
}

int CeedVectorTakeArray(CeedVector vec, CeedMemType mem_type, CeedScalar **array) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    const std::scoped_lock lock(v.access);
    hg::require(!v.has_writer(), CEED_ERROR_ACCESS, "Cannot take CeedVector array, the access lock is already in use");
    hg::require(v.num_readers == 0, CEED_ERROR_ACCESS, "Cannot take CeedVector array, a process has read access");
    hg::require_mem_type(*v.ceed, mem_type, "CeedVectorTakeArray");
    bool has_borrowed = false;
    hg::check(v.ops().has_borrowed_array(vec, mem_type, &has_borrowed));
    // An empty vector may have been lent a NULL array.
    hg::require(has_borrowed || v.length == 0, CEED_ERROR_INCOMPLETE, [&] {
      return hg::text(
          "CeedVector of length %td has no borrowed %s array to take; lend it one with CeedVectorSetArray() "
          "and CEED_USE_POINTER",
          v.length, CeedMemTypes[mem_type]);
    });
    CeedScalar *taken = nullptr;
    hg::check(v.ops().take_array(vec, mem_type, &taken));
    if (array != nullptr) *array = taken;
    v.state += 2;
  });
}

int CeedVectorGetArray(CeedVector vec, CeedMemType mem_type, CeedScalar **array) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    const std::scoped_lock lock(v.access);
    hg::require_writable(v);
    hg::require_mem_type(*v.ceed, mem_type, "CeedVectorGetArray");
    hg::require_values(v, "CeedVector");
    hg::check(v.ops().get_array(vec, mem_type, &hg::result(array, "array")));
    v.state++;
  });
}

int CeedVectorGetArrayRead(CeedVector vec, CeedMemType mem_type, const CeedScalar **array) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    const std::scoped_lock lock(v.access);
    hg::require_readable(v);
    hg::require_mem_type(*v.ceed, mem_type, "CeedVectorGetArrayRead");
    hg::require_values(v, "CeedVector");
    hg::check(v.ops().get_array_read(vec, mem_type, &hg::result(array, "array")));
    v.num_readers++;
  });
}

int CeedVectorGetArrayWrite(CeedVector vec, CeedMemType mem_type, CeedScalar **array) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    const std::scoped_lock lock(v.access);
    hg::require_writable(v);
    hg::require_mem_type(*v.ceed, mem_type, "CeedVectorGetArrayWrite");
    hg::check(v.ops().get_array_write(vec, mem_type, &hg::result(array, "array")));
    v.state++;
  });
}

int CeedVectorRestoreArray(CeedVector vec, CeedScalar **array) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    const std::scoped_lock lock(v.access);
    hg::require(v.has_writer(), CEED_ERROR_ACCESS, "Cannot restore CeedVector array access, access was not granted");
    // Whatever the backend thinks of what was done, the access is over.
    if (array != nullptr) *array = nullptr;
    v.state++;
    if (v.ops().restore_array != nullptr) hg::check(v.ops().restore_array(vec));
  });
}

int CeedVectorRestoreArrayRead(CeedVector vec, const CeedScalar **array) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    const std::scoped_lock lock(v.access);
    hg::require(v.num_readers > 0, CEED_ERROR_ACCESS,
                "Cannot restore CeedVector array read access, access was not granted");
    // The backend hears of the last reader only: that is when its array may move.
    if (array != nullptr) *array = nullptr;
    v.num_readers--;
    if (v.num_readers == 0 && v.ops().restore_array_read != nullptr) hg::check(v.ops().restore_array_read(vec));
  });
}

int CeedVectorGetLength(CeedVector vec, CeedSize *length) {
  return hg::guard(hg::ceed_of(vec), [&] { hg::result(length, "length") = hg::deref(vec, "CeedVector").length; });
}

int CeedVectorGetCeed(CeedVector vec, Ceed *ceed) {
  return hg::get_ceed(vec, ceed);
}

Ceed CeedVectorReturnCeed(CeedVector vec) {
  return hg::ceed_of(vec);
}

int CeedVectorSetNumViewTabs(CeedVector vec, CeedInt num_tabs) {
  return hg::set_view_tabs(vec, num_tabs);
}

int CeedVectorGetNumViewTabs(CeedVector vec, CeedInt *num_tabs) {
  return hg::get_view_tabs(vec, num_tabs);
}

int CeedVectorViewRange(CeedVector vec, CeedSize start, CeedSize stop, CeedInt step, const char *fp_fmt, FILE *stream) {
  return hg::guard(hg::ceed_of(vec),
                   [&] { view_range(hg::deref(vec, "CeedVector"), start, stop, step, fp_fmt, stream); });
}

int CeedVectorView(CeedVector vec, const char *fp_fmt, FILE *stream) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref(vec, "CeedVector");
    view_range(v, 0, v.length, 1, fp_fmt, stream);
  });
}

int CeedVectorHasValidArray(CeedVector vec, bool *has_valid_array) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    hg::check(v.ops().has_valid_array(vec, &hg::result(has_valid_array, "has_valid_array")));
  });
}

int CeedVectorHasBorrowedArrayOfType(CeedVector vec, CeedMemType mem_type, bool *has_borrowed_array_of_type) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    hg::require_mem_type(*v.ceed, mem_type, "CeedVectorHasBorrowedArrayOfType");
    bool &has_borrowed = hg::result(has_borrowed_array_of_type, "has_borrowed_array_of_type");
    hg::check(v.ops().has_borrowed_array(vec, mem_type, &has_borrowed));
  });
}

int CeedVectorGetState(CeedVector vec, uint64_t *state) {
  return hg::guard(hg::ceed_of(vec), [&] { hg::result(state, "state") = hg::deref(vec, "CeedVector").state; });
}

int CeedVectorGetData(CeedVector vec, void *data) {
  return hg::guard(hg::ceed_of(vec),
                   [&] { hg::result(static_cast<void **>(data), "data") = hg::deref(vec, "CeedVector").data; });
}

int CeedVectorSetData(CeedVector vec, void *data) {
  return hg::guard(hg::ceed_of(vec), [&] { hg::deref_vector(vec).data = data; });
}

// Work is complete when a function returns, or in the stream of its device: there is nothing to wait for.
int CeedRequestWait(CeedRequest *req) {
  return hg::guard(nullptr, [&] {
    hg::require(req != nullptr, CEED_ERROR_MINOR, "CeedRequestWait: the address of the request is NULL; expected one");
    *req = nullptr;
  });
}
