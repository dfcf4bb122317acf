// SPDX-License-Identifier: MIT
// Numbers and units for people.
#pragma once

#include <optional>
#include <string>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// Significant digits of a number that an error of it allows: two of the error's own; 4 where
/// there is no error.
int digits_of(double value, double error);

/// The number and its error, to the digits that the error allows: "-0.398 +- 0.005"; "3e-12 (not
/// determined)" where it is not (is_determined()).
std::string with_error(double value, double error);

/// A coefficient to the digits of its interval; without one 6, or all with `full`.
std::string coefficient_text(const WeightedTerm& summand, bool full = false);

/// "12 %", "0.34 %".
std::string percent(double fraction);

/// Unit of a rate of change: "V" per "s" is V/s, "rad/s" per "s" is rad/s^2, "" per "s" is 1/s.
std::string rate_unit(const std::string& unit, const std::string& time_unit);

/// Unit of what an equation gives: of a rate of change, or of a map the state's own.
std::string target_unit(const OdeModel& model, Index equation);

/// "x [V]", or the name alone where there is no unit.
std::string with_unit(const std::string& name, const std::string& unit);

/// A file without its folders: "run.csv, record 2" of "data/run.csv, record 2".
std::string short_name(const std::string& source);

/// Equations, one per line, with coefficients by coefficient_text().
std::string equations_text(const OdeModel& model, bool full = false);

}  // namespace lacuna
