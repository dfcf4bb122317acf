// SPDX-License-Identifier: MIT
// Small records, and the same records in other units and with offsets.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::benchmarks {

/// A record of a polynomial system.
struct SmallRecord {
  std::string name;  ///< "lorenz, noise 0.01"
  OdeModel model;    ///< that made it
  int degree = 2;    ///< of its library
  Dataset data;
};

/// Ten systems of one to three states, without noise and with noise of 1e-4, 1e-3, 1e-2 (twice)
/// of each state's deviation: 50 records of 400 samples.
std::vector<SmallRecord> small_records();

/// Other units of a record: x' = scale (x + offset deviation of x), t' = time t.
struct Variant {
  std::string name;           ///< "x 1e+100", "t 1e-9", "x + 1e+06 deviations"
  std::vector<double> scale;  ///< of the states in turn
  double time = 1.0;
  double offset = 0.0;  ///< standard deviations
};

/// Twenty of them: scales 1e-200 .. 1e200, of all states or in turn, and of time; offsets up to
/// 1e12.
std::vector<Variant> variants();

/// The record in the units of a variant.
Dataset in_units(const Dataset& data, const Variant& variant);

/// Monomials of each equation by their text, "x^2*y".
using Structure = std::vector<std::vector<std::string>>;

/// The terms of a model in the order of their names.
Structure structure_of(const OdeModel& model);

/// What a shift of all states makes of them, whatever its size: all monomials that divide one
/// of the terms. Two models that are one but for where their states begin have the same.
Structure shifted_structure(const OdeModel& model);

/// Whether terms are powers of x - c instead of x.
bool has_shifted_terms(const OdeModel& model);

/// The terms that a polynomial model has in the units of a variant: those of its expansion
/// about the offset.
/// @param data in which the offset is measured.
Structure expected_structure(const OdeModel& model, const Dataset& data,
                             const Variant& variant);

}  // namespace lacuna::benchmarks
