// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::benchmarks {

/// A system whose right-hand side is no polynomial, and how it is measured.
struct RationalSystem {
  std::string name;
  std::string reference;  ///< where the equations come from
  OdeModel model;
  std::vector<Vector> starts;  ///< of its records
  double step = 0.0;
  Index samples = 0;                    ///< of each record
  int degree = 3;                       ///< of the monomials in the library
  std::vector<std::string> known = {};  ///< rate laws that stand in the library beside them
  bool slow = false;                    ///< minutes a record, many more where it is noisy
};

/// All systems; that of yeast a second time with its published rate law in the library.
const std::vector<RationalSystem>& rational_systems();

/// @throws ArgumentError when there is no such system.
const RationalSystem& rational_system(const std::string& name);

/// The default with the monomials and the rate laws of the system's library.
Pipeline pipeline_for(const RationalSystem& system);

/// Its records with white noise of a fraction of each state's standard deviation.
Dataset records_of(const RationalSystem& system, double noise, std::uint64_t seed);

/// Whether a model has the structure of the system: each right-hand side is a fraction of the
/// same monomials, with no more numbers.
bool has_structure(const OdeModel& found, const OdeModel& truth);

/// |f_found - f| / |f| over the samples of clean records, the largest of the equations.
double rate_error(const OdeModel& found, const RationalSystem& system);

/// The least coefficient of determination over records, pooled over states by variance, of the
/// model's solution from the true start; -1 where it has none.
double determination(const OdeModel& found, const RationalSystem& system);

}  // namespace lacuna::benchmarks
