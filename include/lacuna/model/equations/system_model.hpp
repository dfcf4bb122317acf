// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/equations/parametrised_model.hpp"

namespace lacuna {

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
  /// @param symbolic its last inputs are the parameters, in their order.
  /// @throws ModelError when they are not; for a value that is not finite or not in its range,
  ///   a range that is upside down, and a unit that is none (unit_fault()).
  SystemModel(OdeModel symbolic, std::vector<Parameter> parameters = {});

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

}  // namespace lacuna
