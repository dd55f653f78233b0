// Calls QFunctions as the plain functions they are, with named fields and random input from fixed seeds.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/material.hpp"

namespace hg::test {

using Fields = std::map<std::string, std::vector<double>>;
using Tensor = std::array<double, 9>;

/// Runs a QFunction at Q points. Fields are found by name; outputs start as a value that no result should keep.
inline Fields call(const QFunctionSpec &spec, CeedInt Q, const Fields &given, void *context = nullptr) {
  std::vector<const CeedScalar *> in;
  std::vector<CeedScalar *> out;
  Fields results;
  for (const QFunctionField &field : spec.inputs) {
    const auto found = given.find(field.name);
    if (found == given.end()) throw std::runtime_error(std::string("no field ") + field.name);
    if (found->second.size() != std::size_t(field.size) * Q)
      throw std::runtime_error(std::string("size of ") + field.name);
    in.push_back(found->second.data());
  }
  for (const QFunctionField &field : spec.outputs) {
    std::vector<double> &values = results[field.name];
    values.assign(std::size_t(field.size) * Q, 12345.);
    out.push_back(values.data());
  }
  if (spec.function(context, Q, in.data(), out.data()) != 0) throw std::runtime_error("QFunction failed");
  return results;
}

/// One output of a QFunction.
inline std::vector<double> call(const QFunctionSpec &spec, CeedInt Q, const Fields &given, const char *output) {
  return call(spec, Q, given).at(output);
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  /// I + entries in [-size, size]
  Tensor near_identity(double size) {
    Tensor A;
    for (int k = 0; k < 9; k++) A[k] = uniform(-size, size) + (k % 4 == 0);
    return A;
  }
  /// A rotation, from a random unit quaternion.
  Tensor rotation() {
    double q[4], norm = 0.;
    for (double &c : q) {
      c = std::normal_distribution<double>()(engine_);
      norm += c * c;
    }
    for (double &c : q) c /= std::sqrt(norm);
    const auto [w, x, y, z] = q;
    return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
            2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  }
  std::vector<double> vector(std::size_t size, double low, double high) {
    std::vector<double> values(size);
    for (double &value : values) value = uniform(low, high);
    return values;
  }

 private:
  std::mt19937 engine_;
};

inline Tensor multiply(const Tensor &A, const Tensor &B) {
  Tensor C{};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      for (int k = 0; k < 3; k++) C[3 * i + j] += A[3 * i + k] * B[3 * k + j];
  return C;
}

inline Tensor transpose(const Tensor &A) {
  return {A[0], A[3], A[6], A[1], A[4], A[7], A[2], A[5], A[8]};
}

inline double determinant(const Tensor &A) {
  return A[0] * (A[4] * A[8] - A[5] * A[7]) - A[1] * (A[3] * A[8] - A[5] * A[6]) + A[2] * (A[3] * A[7] - A[4] * A[6]);
}

inline Tensor inverse(const Tensor &A) {
  const double d = determinant(A);
  Tensor B;
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
      B[3 * i + j] = (A[3 * r0 + c0] * A[3 * r1 + c1] - A[3 * r0 + c1] * A[3 * r1 + c0]) / d;
    }
  }
  return B;
}

/// Point i of a 9-component field, stored as field[c*Q + i].
inline Tensor get(const std::vector<double> &field, CeedInt Q, CeedInt i, CeedInt first = 0) {
  Tensor A;
  for (int c = 0; c < 9; c++) A[c] = field[std::size_t(first + c) * Q + i];
  return A;
}

inline void set(std::vector<double> &field, CeedInt Q, CeedInt i, const Tensor &A, CeedInt first = 0) {
  for (int c = 0; c < 9; c++) field[std::size_t(first + c) * Q + i] = A[c];
}

inline double dot(const std::vector<double> &a, const std::vector<double> &b) {
  double sum = 0.;
  for (std::size_t k = 0; k < a.size(); k++) sum += a[k] * b[k];
  return sum;
}

inline double norm(const std::vector<double> &a) {
  return std::sqrt(dot(a, a));
}

inline double distance(const std::vector<double> &a, const std::vector<double> &b) {
  double sum = 0.;
  for (std::size_t k = 0; k < a.size(); k++) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

inline std::vector<double> plus(const std::vector<double> &a, double h, const std::vector<double> &b) {
  std::vector<double> c = a;
  for (std::size_t k = 0; k < a.size(); k++) c[k] += h * b[k];
  return c;
}

}  // namespace hg::test
