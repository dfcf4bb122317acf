// SPDX-License-Identifier: MIT
// What is estimated where parameters vary over records: the individuals of a population.
#pragma once

#include <vector>

#include "lacuna/model/equations/system_model.hpp"
#include "trajectories/fit/fit_solver.hpp"

namespace lacuna {

/// A parameter that varies over records. With the deviation z of a record, in spreads, its value
/// there is typical + spread z, or typical exp(spread z) where it varies by a factor.
struct VaryingParameter {
  Index parameter = 0;  ///< its place among the P of the parametrised model
  bool by_factor = false;
  double start = 0.0;  ///< spread as given: a standard deviation, of the logarithm by a factor

  double value(double typical, double spread, double deviation) const;
  double by_deviation(double typical, double spread, double deviation) const;  ///< d value / dz
  double by_typical(double spread, double deviation) const;  ///< d value / d typical

  /// The deviation at which the value is a bound of its range; infinite where there is none.
  double deviation_at(double bound, double typical, double spread) const;
};

/// A size of noise that is estimated.
struct NoiseSize {
  enum class Kind { Sigma, Constant, Fraction };
  Index channel = 0;
  Kind kind = Kind::Sigma;
};

/// Which numbers of a population are estimated, and what is known of them.
struct PopulationProblem {
  FitUnknowns unknowns;  ///< global: with those that vary
  std::vector<VaryingParameter> varying;
  std::vector<NoiseSize> sizes;
  std::vector<Index> free_starts;  ///< states whose initial values each record has for itself

  /// Numbers that each record has for itself: free initial values, its own parameters, and
  /// deviations, in this order.
  Index own() const;
  Index first_deviation() const;  ///< place of the first deviation among them
};

/// @param unknowns with the varying parameters among the global ones.
PopulationProblem population_problem(const SystemModel& system, const FitEngine& engine,
                                     FitUnknowns unknowns);

/// What all records of a population have in common.
struct PopulationValues {
  Vector parameters;  ///< P: of a typical record; not of what each has for itself
  Vector spreads;     ///< one for each that varies
  Vector sizes;       ///< > 0, one for each NoiseSize
};

/// The sizes of noise that an engine has at present.
Vector noise_sizes(const FitEngine& engine, const std::vector<NoiseSize>& sizes);

/// Gives an engine sizes of noise.
void set_noise_sizes(const std::vector<NoiseSize>& sizes, const Vector& values,
                     FitEngine& engine);

/// Log-likelihood of the values of one record along a path; infinite values where it diverges.
double record_log_likelihood(const FitEngine& engine, const FitPath& path, Index record);

}  // namespace lacuna
