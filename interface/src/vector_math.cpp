// Arithmetic of vectors: the backend's where it has it, else on the host.
#include <algorithm>
#include <cmath>

#include "vector.hpp"

namespace {

using hg::ReadArray;
using hg::WriteArray;

void require_same_length(const CeedVector_private &a, const char *a_name, const CeedVector_private &b,
                         const char *b_name, hg::Where where = hg::Where::current()) {
  hg::require(
      a.length == b.length, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("CeedVectors of different lengths: %s has %td entries, %s has %td; expected the same number",
                        a_name, a.length, b_name, b.length);
      },
      where);
}

/// Checks a range with stop < 0 for "to the end" and returns where it ends.
CeedSize range_end(CeedSize start, CeedSize stop, CeedSize step, CeedSize length,
                   hg::Where where = hg::Where::current()) {
  hg::require(
      step >= 1, CEED_ERROR_DIMENSION,
      [&] { return hg::text("Range with step %td; expected a step of at least 1", step); }, where);
  hg::require(
      stop <= length, CEED_ERROR_DIMENSION,
      [&] {
        return hg::text("Range with stop %td; expected at most the length %td, or a negative number for the end", stop,
                        length);
      },
      where);
  const CeedSize end = stop < 0 ? length : stop;
  hg::require(
      start >= 0 && start <= end, CEED_ERROR_DIMENSION,
      [&] { return hg::text("Range with start %td; expected a value in [0, %td]", start, end); }, where);
  return end;
}

/// What a backend function that changes `vec` needs, and what the core does after it.
template <typename Call>
void change(CeedVector_private &vec, Call &&call, hg::Where where = hg::Where::current()) {
  hg::require_writable(vec, where);
  hg::check(call());
  vec.state += 2;
}

/// Whether the backend of one vector knows the other one: it has the same function, and memory on the same device.
template <typename Function>
bool both_have(Function CeedVectorOps::*function, const CeedVector_private &to, const CeedVector_private &from) {
  return to.ops().*function != nullptr && to.ops().*function == from.ops().*function &&
         to.ceed->ops.device_id == from.ceed->ops.device_id;
}

}  // namespace

int CeedVectorSetValue(CeedVector vec, CeedScalar value) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    hg::require_writable(v);
    if (v.length == 0) return;
    if (v.ops().set_value != nullptr) return change(v, [&] { return v.ops().set_value(vec, value); });
    const WriteArray array(vec, WriteArray::write_only);
    std::fill_n(array.data(), v.length, value);
  });
}

int CeedVectorSetValueStrided(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step, CeedScalar value) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    hg::require_writable(v);
    const CeedSize end = range_end(start, stop, step, v.length);
    hg::require_values(v, "CeedVector");
    if (start == end) return;
    if (v.ops().set_value_strided != nullptr) {
      return change(v, [&] { return v.ops().set_value_strided(vec, start, end, step, value); });
    }
    const WriteArray array(vec);
    for (CeedSize i = start; i < end; i += step) array[i] = value;
  });
}

int CeedVectorCopy(CeedVector vec, CeedVector vec_copy) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &from = hg::deref_vector(vec, "CeedVector to copy from");
    auto &to = hg::deref_vector(vec_copy, "CeedVector to copy to");
    require_same_length(from, "the source", to, "the destination");
    hg::require_readable(from);
    hg::require_values(from, "CeedVector to copy from");
    if (vec == vec_copy || from.length == 0) return;
    if (both_have(&CeedVectorOps::copy, to, from)) {
      return change(to, [&] { return to.ops().copy(vec, vec_copy); });
    }
    const ReadArray source(vec);
    const WriteArray destination(vec_copy, WriteArray::write_only);
    std::copy_n(source.data(), from.length, destination.data());
  });
}

int CeedVectorCopyStrided(CeedVector vec, CeedSize start, CeedSize stop, CeedSize step, CeedVector vec_copy) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &from = hg::deref_vector(vec, "CeedVector to copy from");
    auto &to = hg::deref_vector(vec_copy, "CeedVector to copy to");
    const CeedSize end = range_end(start, stop, step, std::min(from.length, to.length));
    hg::require_readable(from);
    hg::require_values(from, "CeedVector to copy from");
    hg::require_values(to, "CeedVector to copy to");
    if (vec == vec_copy || start == end) return;
    if (both_have(&CeedVectorOps::copy_strided, to, from)) {
      return change(to, [&] { return to.ops().copy_strided(vec, start, end, step, vec_copy); });
    }
    const ReadArray source(vec);
    const WriteArray destination(vec_copy);
    for (CeedSize i = start; i < end; i += step) destination[i] = source[i];
  });
}

int CeedVectorNorm(CeedVector vec, CeedNormType type, CeedScalar *norm) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    hg::require(type == CEED_NORM_1 || type == CEED_NORM_2 || type == CEED_NORM_MAX, CEED_ERROR_MINOR, [&] {
      return hg::text("CeedVectorNorm: norm type is %d; expected CEED_NORM_1 (0), CEED_NORM_2 (1) or CEED_NORM_MAX (2)",
                      static_cast<int>(type));
    });
    hg::require_readable(v);
    hg::require_values(v, "CeedVector");
    hg::result(norm, "norm") = 0;
    if (v.length == 0) return;
    if (v.ops().norm != nullptr) return hg::check(v.ops().norm(vec, type, norm));
    const ReadArray x(vec);
    CeedScalar sum = 0;
    switch (type) {
      case CEED_NORM_1:
        for (CeedSize i = 0; i < v.length; i++) sum += std::abs(x[i]);
        break;
      case CEED_NORM_2:
        for (CeedSize i = 0; i < v.length; i++) sum += x[i] * x[i];
        sum = std::sqrt(sum);
        break;
      case CEED_NORM_MAX:
        // A NaN must not hide behind a comparison.
        for (CeedSize i = 0; i < v.length; i++) {
          if (!(std::abs(x[i]) <= sum)) sum = std::abs(x[i]);
          if (std::isnan(sum)) break;
        }
        break;
    }
    *norm = sum;
  });
}

int CeedVectorScale(CeedVector x, CeedScalar alpha) {
  return hg::guard(hg::ceed_of(x), [&] {
    auto &v = hg::deref_vector(x);
    hg::require_writable(v);
    hg::require_values(v, "CeedVector");
    if (v.length == 0) return;
    if (v.ops().scale != nullptr) return change(v, [&] { return v.ops().scale(x, alpha); });
    const WriteArray array(x);
    for (CeedSize i = 0; i < v.length; i++) array[i] *= alpha;
  });
}

int CeedVectorFilter(CeedVector x, CeedScalar threshold) {
  return hg::guard(hg::ceed_of(x), [&] {
    auto &v = hg::deref_vector(x);
    hg::require_writable(v);
    hg::require_values(v, "CeedVector");
    if (v.length == 0) return;
    if (v.ops().filter != nullptr) return change(v, [&] { return v.ops().filter(x, threshold); });
    const WriteArray array(x);
    for (CeedSize i = 0; i < v.length; i++) {
      if (std::abs(array[i]) <= threshold) array[i] = 0;
    }
  });
}

int CeedVectorAXPY(CeedVector y, CeedScalar alpha, CeedVector x) {
  return hg::guard(hg::ceed_of(y), [&] {
    auto &to = hg::deref_vector(y, "CeedVector y");
    auto &from = hg::deref_vector(x, "CeedVector x");
    require_same_length(from, "x", to, "y");
    hg::require(x != y, CEED_ERROR_UNSUPPORTED, "CeedVectorAXPY: x and y are the same vector; expected two");
    hg::require_readable(from);
    hg::require_writable(to);
    hg::require_values(from, "CeedVector x");
    hg::require_values(to, "CeedVector y");
    if (to.length == 0) return;
    if (both_have(&CeedVectorOps::axpy, to, from)) {
      return change(to, [&] { return to.ops().axpy(y, alpha, x); });
    }
    const ReadArray x_array(x);
    const WriteArray y_array(y);
    for (CeedSize i = 0; i < to.length; i++) y_array[i] += alpha * x_array[i];
  });
}

int CeedVectorAXPBY(CeedVector y, CeedScalar alpha, CeedScalar beta, CeedVector x) {
  return hg::guard(hg::ceed_of(y), [&] {
    auto &to = hg::deref_vector(y, "CeedVector y");
    auto &from = hg::deref_vector(x, "CeedVector x");
    require_same_length(from, "x", to, "y");
    hg::require(x != y, CEED_ERROR_UNSUPPORTED, "CeedVectorAXPBY: x and y are the same vector; expected two");
    hg::require_readable(from);
    hg::require_writable(to);
    hg::require_values(from, "CeedVector x");
    hg::require_values(to, "CeedVector y");
    if (to.length == 0) return;
    if (both_have(&CeedVectorOps::axpby, to, from)) {
      return change(to, [&] { return to.ops().axpby(y, alpha, beta, x); });
    }
    const ReadArray x_array(x);
    const WriteArray y_array(y);
    for (CeedSize i = 0; i < to.length; i++) y_array[i] = alpha * x_array[i] + beta * y_array[i];
  });
}

int CeedVectorPointwiseMult(CeedVector w, CeedVector x, CeedVector y) {
  return hg::guard(hg::ceed_of(w), [&] {
    auto &to = hg::deref_vector(w, "CeedVector w");
    auto &a = hg::deref_vector(x, "CeedVector x");
    auto &b = hg::deref_vector(y, "CeedVector y");
    require_same_length(a, "x", to, "w");
    require_same_length(b, "y", to, "w");
    hg::require_writable(to);
    hg::require_readable(a);
    hg::require_readable(b);
    hg::require_values(a, "CeedVector x");
    hg::require_values(b, "CeedVector y");
    if (to.length == 0) return;
    if (both_have(&CeedVectorOps::pointwise_mult, to, a) && both_have(&CeedVectorOps::pointwise_mult, to, b)) {
      return change(to, [&] { return to.ops().pointwise_mult(w, x, y); });
    }
    const auto multiply = [&](CeedScalar *result, const CeedScalar *left, const CeedScalar *right) {
      for (CeedSize i = 0; i < to.length; i++) result[i] = left[i] * right[i];
    };
    if (x == w && y == w) {
      const WriteArray array(w);
      multiply(array.data(), array.data(), array.data());
    } else if (x == w || y == w) {
      const ReadArray other(x == w ? y : x);
      const WriteArray array(w);
      multiply(array.data(), array.data(), other.data());
    } else {
      const ReadArray left(x), right(y);
      const WriteArray result(w, WriteArray::write_only);
      multiply(result.data(), left.data(), right.data());
    }
  });
}

int CeedVectorReciprocal(CeedVector vec) {
  return hg::guard(hg::ceed_of(vec), [&] {
    auto &v = hg::deref_vector(vec);
    hg::require_writable(v);
    hg::require_values(v, "CeedVector");
    if (v.length == 0) return;
    if (v.ops().reciprocal != nullptr) return change(v, [&] { return v.ops().reciprocal(vec); });
    const WriteArray array(vec);
    for (CeedSize i = 0; i < v.length; i++) {
      if (std::abs(array[i]) > CEED_EPSILON) array[i] = 1 / array[i];
    }
  });
}
