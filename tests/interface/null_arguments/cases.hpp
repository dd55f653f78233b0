/// @file
/// One case for each public function that takes pointers: each of them in turn is NULL, the others are in order.
#pragma once

#include <ceed/backend.h>
#include <ceed/cuda.h>
#include <ceed/hip.h>
#include <ceed/jit-tools.h>
#include <ceed/plugin.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace hg::test {

struct ContextData {
  double a = 1;
  int32_t n = 2;
  bool b = true;
};

/// Arguments that are in order: one object of each kind, in use, and places for results. What calls have made and
/// borrowed goes with it.
struct Objects {
  Objects();
  Objects(const Objects &) = delete;
  Objects &operator=(const Objects &) = delete;
  ~Objects();

  CeedObject object() const { return reinterpret_cast<CeedObject>(x); }
  /// The stored messages of the Ceed and of what has none.
  std::string messages() const;
  void forget_messages() const;

  Ceed ceed = nullptr;
  FILE *stream = nullptr;
  CeedVector x = nullptr, y = nullptr, w = nullptr;  ///< L-vectors of 5 entries
  CeedVector e = nullptr, q = nullptr;               ///< 2 elements of 3 nodes, of 3 quadrature points
  CeedVector p = nullptr, at_p = nullptr;            ///< coordinates of 3 points, values there
  CeedVector entries = nullptr;                      ///< of 2 element matrices
  CeedElemRestriction rstr = nullptr, coarse_rstr = nullptr, strided = nullptr, oriented = nullptr,
                      curl_oriented = nullptr, points = nullptr;
  CeedBasis basis = nullptr, coarse_basis = nullptr, hdiv = nullptr, hcurl = nullptr;
  CeedQFunction qf = nullptr, new_qf = nullptr;
  CeedQFunctionContext ctx = nullptr;  ///< of qf
  CeedOperator op = nullptr, new_op = nullptr, points_op = nullptr, composite = nullptr;
  CeedQFunctionField qf_field = nullptr;
  CeedOperatorField op_field = nullptr;
  CeedContextFieldLabel label_a = nullptr, label_n = nullptr, label_b = nullptr;

  // What is passed by address.
  CeedInt offsets[6] = {0, 1, 2, 2, 3, 4}, coarse_offsets[4] = {0, 1, 1, 2}, points_offsets[6] = {3, 4, 6, 0, 1, 2};
  bool orients[6] = {};
  CeedInt8 curl_orients[18] = {};
  CeedInt strides[3] = {1, 3, 3}, index = 0, counts[2] = {1, 2};
  CeedScalar matrix[64], other_matrix[64], third_matrix[64], tau[64];
  ContextData data;
  CeedVector inputs[1], outputs[1];
  CeedPlugin plugin{};

  // Places for results.
  Ceed made_ceed = nullptr;
  CeedVector made_vector = nullptr, second_vector = nullptr, work_vector = nullptr;
  CeedElemRestriction made_rstr = nullptr, second_rstr = nullptr;
  CeedBasis made_basis = nullptr, second_basis = nullptr;
  CeedQFunction made_qf = nullptr;
  CeedQFunctionContext made_ctx = nullptr;
  CeedOperator made_op = nullptr, second_op = nullptr, third_op = nullptr;
  CeedRequest request = nullptr;
  CeedInt number = 0, second_number = 0, three[3] = {1, 3, 3};
  CeedSize size = 0, second_size = 0;
  CeedOperatorMemory memory{};
  CeedTransfers transfers{};
  CeedScalar scalar = 0;
  std::size_t count = 0, second_count = 0;
  std::uint64_t state = 0;
  int version[3] = {};
  bool flag = false;
  const char *text = nullptr, *second_text = nullptr;
  const char *absolute_path = nullptr;  ///< freed
  char *own_text = nullptr;             ///< freed
  char **names = nullptr;               ///< freed, and what follows
  const char **strings = nullptr;
  CeedInt *rows = nullptr, *cols = nullptr;
  CeedPluginInfo *plugins = nullptr;
  void *pointer = nullptr;
  CeedScalar *array = nullptr;
  const CeedScalar *read_array = nullptr;
  const CeedInt *read_offsets = nullptr;
  const bool *read_orients = nullptr;
  const CeedInt8 *read_curl_orients = nullptr;
  const double *doubles = nullptr;
  const int32_t *integers = nullptr;
  const bool *booleans = nullptr;
  CeedMemType mem_type = CEED_MEM_HOST;
  CeedScalarType scalar_type = CEED_SCALAR_FP64;
  CeedEvalMode eval_mode = CEED_EVAL_NONE;
  CeedRestrictionType rstr_type = CEED_RESTRICTION_STANDARD;
  CeedElemTopology topology = CEED_TOPOLOGY_LINE;
  CeedFESpace space = CEED_FE_SPACE_H1;
  CeedContextFieldType field_type = CEED_CONTEXT_FIELD_DOUBLE;
  CeedContextFieldLabel label = nullptr;
  const CeedContextFieldLabel *labels = nullptr;
  CeedQFunctionField *qf_inputs = nullptr, *qf_outputs = nullptr;
  CeedOperatorField *op_inputs = nullptr, *op_outputs = nullptr, field = nullptr;
  CeedOperator *sub_operators = nullptr, sub_operator = nullptr;
  CeedQFunctionUser function = nullptr;
  const CeedBackendOps *ops = nullptr;
  const CeedElementMap *map = nullptr;
  const CeedProgram *program = nullptr;
};

/// A QFunction: out = in.
int copy_values(void *, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out);
inline constexpr const char *copy_values_source = "cases.cpp:copy_values";
int init_nothing(Ceed, const char *, CeedQFunction);
int destroy_nothing(void *);

/// An argument that may be NULL.
template <typename T>
struct Optional {
  T value;
};
template <typename T>
Optional<T> optional(T value) {
  return {value};
}

template <typename T>
const T &value_of(const T &argument) {
  return argument;
}
template <typename T>
const T &value_of(const Optional<T> &argument) {
  return argument.value;
}
template <typename T>
inline constexpr bool is_optional = false;
template <typename T>
inline constexpr bool is_optional<Optional<T>> = true;

struct Case {
  std::string function;
  std::function<void()> check;
};

/// Expects that a call with a NULL failed, and has said so.
void expect_refused(const std::string &function, const Objects &objects, int code);
inline void expect_refused(const std::string &, const Objects &, Ceed result) {
  EXPECT_EQ(result, nullptr);
}
/// Expects that a call without fault went well.
void expect_accepted(const Objects &objects, int code);
inline void expect_accepted(const Objects &objects, Ceed result) {
  EXPECT_EQ(result, objects.ceed);
}

enum class Tried { nulls_and_valid, nulls };

/// `make` gives the arguments, as a tuple, from new objects for each call.
template <typename Return, typename... Params, typename Make>
Case make_case(const char *name, Return (*function)(Params...), Tried tried, Make make) {
  const auto call = [=](auto null_index) {
    constexpr std::size_t null = decltype(null_index)::value;
    Objects objects;
    const auto arguments = make(objects);
    static_assert(std::tuple_size_v<std::decay_t<decltype(arguments)>> == sizeof...(Params));
    objects.forget_messages();
    const auto argument = [&]<std::size_t I, typename Param>() -> Param {
      if constexpr (I == null) {
        return nullptr;
      } else {
        return static_cast<Param>(value_of(std::get<I>(arguments)));
      }
    };
    const Return result = [&]<std::size_t... I>(std::index_sequence<I...>) {
      return function(argument.template operator()<I, Params>()...);
    }
    (std::index_sequence_for<Params...>{});
    bool is_in_order = null == sizeof...(Params);
    if constexpr (null < sizeof...(Params)) {
      is_in_order = is_optional<std::tuple_element_t<null, std::decay_t<decltype(arguments)>>>;
    }
    is_in_order ? expect_accepted(objects, result) : expect_refused(name, objects, result);
  };
  return {name, [=] {
            const auto call_with_null = [&]<std::size_t I, typename Param>() {
              if constexpr (std::is_pointer_v<Param>) {
                SCOPED_TRACE(std::string(name) + "(), argument " + std::to_string(I) + " NULL");
                call(std::integral_constant<std::size_t, I>{});
              }
            };
            [&]<std::size_t... I>(std::index_sequence<I...>) {
              (call_with_null.template operator()<I, Params>(), ...);
            }
            (std::index_sequence_for<Params...>{});
            if (tried == Tried::nulls) return;
            SCOPED_TRACE(std::string(name) + "(), all arguments in order");
            call(std::integral_constant<std::size_t, sizeof...(Params)>{});
          }};
}

std::vector<Case> ceed_cases(), vector_cases(), restriction_cases(), basis_cases(), qfunction_cases(), context_cases(),
    operator_cases(), assembly_cases();

}  // namespace hg::test

/// The name, the function, and arguments made of the objects `o`.
#define HG_CASE(function, ...)                                            \
  make_case(#function, function, Tried::nulls_and_valid, [](Objects &o) { \
    static_cast<void>(o);                                                 \
    return std::make_tuple(__VA_ARGS__);                                  \
  })
/// The same after a call that makes it possible.
#define HG_CASE_AFTER(before, function, ...)                              \
  make_case(#function, function, Tried::nulls_and_valid, [](Objects &o) { \
    before;                                                               \
    return std::make_tuple(__VA_ARGS__);                                  \
  })
/// The same for a function that cannot succeed here, or whose success would outlive the test.
#define HG_CASE_NULLS(function, ...)                            \
  make_case(#function, function, Tried::nulls, [](Objects &o) { \
    static_cast<void>(o);                                       \
    return std::make_tuple(__VA_ARGS__);                        \
  })
