// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <optional>
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

}  // namespace lacuna
