// SPDX-License-Identifier: MIT
// Models with parameters, outputs and initial states.
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// What is known of a parameter before the fit: value +- tolerance (one standard deviation).
struct Prior {
  double value = 0.0;
  double tolerance = 1.0;    ///< > 0
  bool logarithmic = false;  ///< of the logarithm of the parameter: log(value) +- tolerance
};

/// A coefficient of a model that is to be estimated.
struct FreeCoefficient {
  Index equation = 0;
  Index summand = 0;  ///< position in the equation
  std::optional<Prior> prior = {};
};

/// A number inside a term that is to be estimated: a breakpoint, a frequency, a width.
/// The terms name it like a variable: `b` in "max(0,x-b)".
struct FreeShape {
  std::string name;
  double value = 0.0;  ///< to start from
  std::optional<Prior> prior = {};
  std::optional<double> lower = {};  ///< smallest admissible value
  std::optional<double> upper = {};  ///< largest admissible value
};

/// A model of which some numbers are free: P parameters, first the free coefficients, then the
/// shape parameters. All other coefficients stay exactly as they are. A value.
///
/// A shape parameter is a further, constant input of the model: the last inputs of `symbolic`
/// are the shape parameters, in their order, so that derivatives with respect to them come from
/// the same symbolic differentiation as those with respect to states.
class ParametrisedModel {
 public:
  /// @throws ArgumentError when a free coefficient does not exist or is named twice, when a
  ///   prior or a bound is unusable; ModelError when the last inputs of the model are not the
  ///   shape parameters.
  ParametrisedModel(OdeModel symbolic, std::vector<FreeCoefficient> coefficients,
                    std::vector<FreeShape> shapes = {});

  /// The model in which shape parameters are inputs.
  const OdeModel& symbolic() const noexcept { return symbolic_; }

  /// The coefficients that are free; they are the first parameters.
  const std::vector<FreeCoefficient>& coefficients() const noexcept { return coefficients_; }

  /// The shape parameters, which follow them.
  const std::vector<FreeShape>& shapes() const noexcept { return shapes_; }

  Index size() const noexcept;  ///< P

  /// Inputs that come from the record: those of `symbolic` without the shape parameters.
  Index record_inputs() const noexcept;

  /// The present values, P entries.
  Vector values() const;

  /// "w: sin(th)" for a coefficient, the name for a shape parameter.
  std::vector<std::string> names() const;

  /// The prior of each parameter, where there is one.
  std::vector<std::optional<Prior>> priors() const;

  /// The values (P) with shape parameters moved into their bounds.
  Vector admissible(Vector values) const;

  /// The same parametrisation with other present values (P).
  /// @throws ArgumentError on a wrong size.
  ParametrisedModel with_values(const Vector& values) const;

  /// The plain model at the present values: shape parameters are numbers in its terms.
  OdeModel model() const;

 private:
  OdeModel symbolic_;
  std::vector<FreeCoefficient> coefficients_;
  std::vector<FreeShape> shapes_;
};

/// The model with every coefficient free, except fixed ones and those in equations marked exact
/// (identities such as dq/dt = v).
/// @param exact one entry per equation, or empty.
ParametrisedModel with_free_coefficients(OdeModel model, const std::vector<bool>& exact = {},
                                         std::vector<FreeShape> shapes = {});

/// How far a parameter differs from record to record (individuals of a population).
struct ParameterSpread {
  double size = 0.0;       ///< standard deviation over the records, > 0; or a factor, > 1
  bool by_factor = false;  ///< the logarithm is normal with the deviation log(size)
};

/// A number with a name, which may stand anywhere in terms and outputs.
struct Parameter {
  std::string name;
  double value = 0.0;
  std::string unit = {};
  bool free = true;                ///< to be estimated
  std::optional<double> min = {};  ///< smallest admissible value
  std::optional<double> max = {};  ///< largest admissible value
  bool per_record = false;         ///< free for each record by itself
  /// Standard deviation, > 0, of what is known of the value before any record is seen.
  std::optional<double> deviation = {};
  /// The same of a positive value by a factor, > 1: its logarithm is normal with the deviation
  /// log(factor).
  std::optional<double> factor = {};
  /// Its value is that of a typical record; that of each record differs by a random amount.
  std::optional<ParameterSpread> varies = {};
  std::optional<double> standard_error = {};
  std::optional<std::array<double, 2>> ci95 = {};
};

/// A model file: equations and outputs in states, inputs and named parameters. A value.
class SystemModel {
 public:
  // NOLINTBEGIN(google-explicit-constructor): a model is a system without parameters
  /// @param symbolic its last inputs are the parameters, in their order.
  /// @throws ModelError when they are not; for a value that is not finite or not in its range,
  ///   a range that is upside down, and a unit that is none (unit_fault()).
  SystemModel(OdeModel symbolic, std::vector<Parameter> parameters = {});
  // NOLINTEND(google-explicit-constructor)

  const OdeModel& symbolic() const noexcept { return symbolic_; }  ///< with their names
  const std::vector<Parameter>& parameters() const noexcept { return parameters_; }  ///< all

  /// The inputs without the parameters.
  std::vector<Quantity> inputs() const;

  /// Whether a term has a factor of parameters alone, which gives its size.
  bool gives_size(const Expression& term) const;

  /// The same model with numbers for its parameters: their products are multiplied out over
  /// sums, and a factor of numbers in front of a term becomes part of its coefficient, which is
  /// fixed where all of them are. Terms without parameters stay as they are.
  OdeModel model() const;

  /// What is to be estimated: coefficients that are not fixed, and free parameters. Fixed
  /// parameters become numbers. The equation of an identity (dq/dt = v) is exact, and so is the
  /// coefficient of a term that has a factor of parameters alone, which gives its size already.
  /// Terms that are one once fixed parameters have numbers become one.
  /// @throws ModelError for a free parameter on which a delay depends.
  ParametrisedModel parametrised() const;

  /// Free parameters on which a delay depends, by their numbers: fit() alone estimates them.
  std::vector<std::size_t> delay_parameters() const;

  /// Which summand of parametrised() each summand of each equation has become.
  std::vector<std::vector<Index>> places_in_parametrised() const;

 private:
  OdeModel symbolic_;
  std::vector<Parameter> parameters_;
  std::set<std::string> names_;  ///< of the parameters
};

/// What is wrong with the value, the range and the deviation of a parameter; empty where
/// nothing is.
std::string range_problem(const Parameter& parameter);

/// A model that was estimated from the numbers of a system, in the parameters and formulas of
/// that system. Each term of `given.model()` has an estimated and a given coefficient, and
/// their ratio stands as a number in front of what was written:
///
///   di/dt = (u - R i)/L,  1/L = 10 -> 10.2,  R/L = 5 -> 5   gives   1.02 u/L - R i/L
///
/// A summand whose terms all have one ratio (1 is left out) stays as it was written, others are
/// multiplied out. Terms and states that the system does not have are added as they are; an
/// equation that cannot be written so that model() gives its estimated coefficients back to
/// rounding is the estimated one, in numbers. Errors and intervals become those of the ratio.
/// @param estimated `given.model()` with other coefficients, more terms and, behind its own,
///   more states; a state that is called as a parameter makes the answer one in numbers.
SystemModel with_parameters_of(const SystemModel& given, const OdeModel& estimated);

}  // namespace lacuna
