/// @file
/// Options of a run. PETSc's option database is the only parser; this adds defaults, help text and checks in one call.
///
///     OptionGroup group(comm, "sinker_", "Material sinker");
///     double nu = group.real("nu", "Poisson's ratio", 0.3, {.min = -1, .max = 0.5, .min_open = true, .max_open =
///     true});
///
/// With -help every option is printed with its default and its text. A value out of its range throws hg::Error with the
/// option's full name, the value, and what was expected.
#pragma once

#include <petscsys.h>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hg {

/// The values that a number may take; an end is part of the range unless it is open.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false;
  bool max_open = false;

  static constexpr Range positive() { return {.min = 0, .min_open = true}; }
  static constexpr Range at_least(double least) { return {.min = least}; }
  bool contains(double value) const;
  /// For messages: "a number > 0", "a number >= -1 and < 0.5".
  std::string text() const;
};

/// One titled group of options that share a prefix: option `name` of prefix `sinker_` is `-sinker_name`. Names are
/// given without the leading dash. Collective: every rank reads the same database and gets the same values or the same
/// Error.
class OptionGroup {
 public:
  OptionGroup(MPI_Comm comm, std::string prefix, std::string title);

  double real(const char *name, const char *help, double fallback, Range range = {});
  /// A real without a default: an Error that names the option if it is missing.
  double required_real(const char *name, const char *help, Range range = {});
  PetscInt integer(const char *name, const char *help, PetscInt fallback, Range range = {});
  bool boolean(const char *name, const char *help, bool fallback);
  std::string string(const char *name, const char *help, const std::string &fallback);
  /// One of `choices`; anything else is an Error that lists them.
  std::string choice(const char *name, const char *help, const std::vector<std::string> &choices,
                     const std::string &fallback);
  /// A list of reals; `count` is the length it must have, or a negative number for any length.
  std::vector<double> reals(const char *name, const char *help, const std::vector<double> &fallback, int count);
  std::vector<PetscInt> integers(const char *name, const char *help, const std::vector<PetscInt> &fallback,
                                 int count = -1);
  std::vector<std::string> strings(const char *name, const char *help, const std::vector<std::string> &fallback);

  /// Whether the option is in the database.
  bool given(const char *name) const;
  /// "-sinker_nu" for name "nu".
  std::string full(const char *name) const;
  const std::string &prefix() const { return prefix_; }
  /// Whether -help was given: options are printed and none is required.
  bool helping() const { return help_; }

 private:
  void describe(const char *name, const std::string &fallback, const char *help);

  MPI_Comm comm_;
  std::string prefix_, title_;
  bool help_ = false, title_printed_ = false;
};

enum class Method { fem, mpm };

/// A part of the body with its own material. At most one region has neither label nor box: it takes the rest.
struct Region {
  std::string name = {};        ///< as given in -material; "" for the only region of a run without -material
  std::string prefix = {};      ///< of its options: "sinker_", or "" for the only region of a run without -material
  std::string label_name = {};  ///< mesh label that selects its cells; "" when not selected by label
  std::vector<PetscInt> label_values = {};
  std::optional<std::array<double, 6>> box = {};  ///< x0,y0,z0,x1,y1,z1, both ends inside [m]

  bool takes_rest() const { return label_name.empty() && !box; }
};

/// How a load goes from one given time to the next; see vector_at.
enum class Ramp { step, linear };

/// Body force per unit of mass, ρ₀ g(t), g in m/s².
struct BodyForce {
  enum class Kind { none, body, mms } kind = Kind::none;
  std::vector<double> times;                   ///< [s], ascending; -ts_max_time when not given
  std::vector<std::array<double, 3>> vectors;  ///< one for each time
  Ramp ramp = Ramp::linear;
};

/// What a run is made of, apart from what each room reads for itself (mesh, materials, points, boundary, output).
struct RunOptions {
  Method method = Method::fem;
  std::string ceed;             ///< CEED resource
  PetscInt order = 1;           ///< polynomial order p of the displacement, 1 to 8
  PetscInt q_extra = 0;         ///< quadrature points in each direction: order + 1 + q_extra
  std::vector<Region> regions;  ///< at least one, in the order of -material
  BodyForce forcing;

  static RunOptions read(MPI_Comm comm);
};

/// A 3-vector given at ascending times, at time t. Linear: through zero at t = 0 and the vectors at their times. Step:
/// the vector of the first time that is not before t. After the last time both keep its vector.
std::array<double, 3> vector_at(const std::vector<double> &times, const std::vector<std::array<double, 3>> &vectors,
                                Ramp ramp, double t);

}  // namespace hg
