#include "options/options.hpp"

#include <petscviewer.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "options/error.hpp"

namespace hg {

namespace {

constexpr int max_list = 4096;

std::string shortest(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.15g", value);
  return text;
}

template <class T, class Print>
std::string joined(const std::vector<T> &values, Print &&print) {
  std::string text;
  for (const auto &value : values) {
    if (!text.empty()) text += ',';
    text += print(value);
  }
  return text;
}

std::string quoted_value(const std::string &full, const char *fallback) {
  char text[PETSC_MAX_OPTION_NAME] = "";
  PetscBool set = PETSC_FALSE;
  if (PetscOptionsGetString(nullptr, nullptr, full.c_str(), text, sizeof(text), &set)) return fallback;
  return set ? text : fallback;
}

}  // namespace

bool Range::contains(double value) const {
  return (min_open ? value > min : value >= min) && (max_open ? value < max : value <= max);
}

std::string Range::text() const {
  std::string text = "a number";
  const bool low = min > -std::numeric_limits<double>::infinity();
  if (low) text.append(min_open ? " > " : " >= ").append(shortest(min));
  if (max < std::numeric_limits<double>::infinity()) {
    text.append(low ? " and" : "").append(max_open ? " < " : " <= ").append(shortest(max));
  }
  return text;
}

OptionGroup::OptionGroup(MPI_Comm comm, std::string prefix, std::string title)
    : comm_(comm), prefix_(std::move(prefix)), title_(std::move(title)) {
  PetscBool help = PETSC_FALSE;
  petsc_check(PetscOptionsHasHelp(nullptr, &help));
  help_ = help;
}

std::string OptionGroup::full(const char *name) const {
  return std::string("-").append(prefix_).append(name);
}

bool OptionGroup::given(const char *name) const {
  PetscBool set = PETSC_FALSE;
  petsc_check(PetscOptionsHasName(nullptr, nullptr, full(name).c_str(), &set));
  return set;
}

void OptionGroup::describe(const char *name, const std::string &fallback, const char *help) {
  if (!help_) return;
  if (!title_printed_) petsc_check(PetscPrintf(comm_, "%s:\n", title_.c_str()));
  title_printed_ = true;
  petsc_check(PetscPrintf(comm_, "  %s <%s>: %s\n", full(name).c_str(), fallback.c_str(), help));
}

double OptionGroup::real(const char *name, const char *help, double fallback, Range range) {
  describe(name, shortest(fallback), help);
  const std::string option = full(name);
  PetscReal value = fallback;
  PetscBool set = PETSC_FALSE;
  if (PetscOptionsGetReal(nullptr, nullptr, option.c_str(), &value, &set)) {
    fail("option %s: '%s' is not %s", option.c_str(), quoted_value(option, "").c_str(), range.text().c_str());
  }
  if (!range.contains(value)) {
    fail("option %s: %s, expected %s", option.c_str(), shortest(value).c_str(), range.text().c_str());
  }
  return value;
}

double OptionGroup::required_real(const char *name, const char *help, Range range) {
  describe(name, "required", help);
  if (!given(name)) {
    if (help_) return range.contains(1) ? 1 : range.max / 2;  // the run ends before the value matters
    fail("option %s is missing (%s): expected %s", full(name).c_str(), help, range.text().c_str());
  }
  const bool printed = std::exchange(help_, false);
  const double value = real(name, help, 0, range);
  help_ = printed;
  return value;
}

PetscInt OptionGroup::integer(const char *name, const char *help, PetscInt fallback, Range range) {
  describe(name, std::to_string(fallback), help);
  const std::string option = full(name);
  PetscInt value = fallback;
  PetscBool set = PETSC_FALSE;
  if (PetscOptionsGetInt(nullptr, nullptr, option.c_str(), &value, &set)) {
    fail("option %s: '%s' is not an integer", option.c_str(), quoted_value(option, "").c_str());
  }
  if (!range.contains(static_cast<double>(value))) {
    fail("option %s: %" PetscInt_FMT ", expected %s", option.c_str(), value, range.text().c_str());
  }
  return value;
}

bool OptionGroup::boolean(const char *name, const char *help, bool fallback) {
  describe(name, fallback ? "true" : "false", help);
  const std::string option = full(name);
  PetscBool value = fallback ? PETSC_TRUE : PETSC_FALSE;
  if (PetscOptionsGetBool(nullptr, nullptr, option.c_str(), &value, nullptr)) {
    fail("option %s: '%s' is not true or false", option.c_str(), quoted_value(option, "").c_str());
  }
  return value;
}

std::string OptionGroup::string(const char *name, const char *help, const std::string &fallback) {
  describe(name, fallback, help);
  char text[PETSC_MAX_PATH_LEN] = "";
  PetscBool set = PETSC_FALSE;
  petsc_check(PetscOptionsGetString(nullptr, nullptr, full(name).c_str(), text, sizeof(text), &set));
  return set ? text : fallback;
}

std::string OptionGroup::choice(const char *name, const char *help, const std::vector<std::string> &choices,
                                const std::string &fallback) {
  const std::string list = joined(choices, [](const std::string &choice) { return choice; });
  const std::string text = string(name, (std::string(help) + " (one of " + list + ")").c_str(), fallback);
  if (std::find(choices.begin(), choices.end(), text) == choices.end()) {
    fail("option %s: unknown value '%s', expected one of %s", full(name).c_str(), text.c_str(), list.c_str());
  }
  return text;
}

std::vector<double> OptionGroup::reals(const char *name, const char *help, const std::vector<double> &fallback,
                                       int count) {
  describe(name, joined(fallback, shortest), help);
  const std::string option = full(name);
  std::vector<PetscReal> values(max_list);
  PetscInt found = max_list;
  PetscBool set = PETSC_FALSE;
  if (PetscOptionsGetRealArray(nullptr, nullptr, option.c_str(), values.data(), &found, &set)) {
    fail("option %s: '%s' is not a list of numbers", option.c_str(), quoted_value(option, "").c_str());
  }
  if (!set) return fallback;
  if (count >= 0 && found != count) {
    fail("option %s: %" PetscInt_FMT " numbers, expected %d", option.c_str(), found, count);
  }
  return {values.begin(), values.begin() + found};
}

std::vector<PetscInt> OptionGroup::integers(const char *name, const char *help, const std::vector<PetscInt> &fallback,
                                            int count) {
  describe(name, joined(fallback, [](PetscInt value) { return std::to_string(value); }), help);
  const std::string option = full(name);
  std::vector<PetscInt> values(max_list);
  PetscInt found = max_list;
  PetscBool set = PETSC_FALSE;
  if (PetscOptionsGetIntArray(nullptr, nullptr, option.c_str(), values.data(), &found, &set)) {
    fail("option %s: '%s' is not a list of integers", option.c_str(), quoted_value(option, "").c_str());
  }
  if (!set) return fallback;
  if (count >= 0 && found != count) {
    fail("option %s: %" PetscInt_FMT " integers, expected %d", option.c_str(), found, count);
  }
  return {values.begin(), values.begin() + found};
}

std::vector<std::string> OptionGroup::strings(const char *name, const char *help,
                                              const std::vector<std::string> &fallback) {
  describe(name, joined(fallback, [](const std::string &text) { return text; }), help);
  std::vector<char *> values(max_list, nullptr);
  PetscInt found = max_list;
  PetscBool set = PETSC_FALSE;
  petsc_check(PetscOptionsGetStringArray(nullptr, nullptr, full(name).c_str(), values.data(), &found, &set));
  std::vector<std::string> result = set ? std::vector<std::string>(values.begin(), values.begin() + found) : fallback;
  for (PetscInt i = 0; i < found && set; ++i) petsc_check(PetscFree(values[i]));
  return result;
}

std::array<double, 3> vector_at(const std::vector<double> &times, const std::vector<std::array<double, 3>> &vectors,
                                Ramp ramp, double t) {
  if (vectors.empty()) return {0, 0, 0};
  std::size_t next = 0;
  while (next < times.size() && times[next] < t) ++next;
  if (next >= times.size()) return vectors.back();
  if (ramp == Ramp::step) return vectors[next];
  const double t0 = next ? times[next - 1] : 0.;
  const std::array<double, 3> v0 = next ? vectors[next - 1] : std::array<double, 3>{0, 0, 0};
  const double s = times[next] > t0 ? (t - t0) / (times[next] - t0) : 1.;
  std::array<double, 3> v;
  for (int c = 0; c < 3; ++c) v[c] = v0[c] + s * (vectors[next][c] - v0[c]);
  return v;
}

}  // namespace hg
