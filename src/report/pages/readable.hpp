// SPDX-License-Identifier: MIT
// Numbers and units for people.
#pragma once

#include <optional>
#include <string>

#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/model/equations/rounding.hpp"

namespace lacuna {

/// The number and its error, to the digits that the error allows: "-0.398 +- 0.005"; "3e-12 (not
/// determined)" where it is not (is_determined()).
std::string with_error(double value, double error);

/// A coefficient to the digits of its interval, without one 6; or as many as asked for.
std::string coefficient_text(const WeightedTerm& summand, const Digits& digits = {});

/// Half of its 95 % interval: "0.0023", "not determined" where it is more than the coefficient
/// can bear (is_determined()); empty where there is none.
std::string half_text(const WeightedTerm& summand);

/// Unit of a rate of change: "V" per "s" is V/s, "rad/s" per "s" is rad/s^2, "" per "s" is 1/s.
std::string rate_unit(const std::string& unit, const std::string& time_unit);

/// Unit of what an equation gives: of a rate of change, or of a map the state's own.
std::string target_unit(const OdeModel& model, Index equation);

/// "x [V]", or the name alone where there is no unit.
std::string with_unit(const std::string& name, const std::string& unit);

/// A file without its folders: "run.csv, record 2" of "data/run.csv, record 2".
std::string short_name(const std::string& source);

enum class Intervals { Shown, Hidden };

/// "dx/dt = -(9.98 +- 0.03)*x + 10*y" with coefficients by coefficient_text(); intervals that lie
/// behind the digits shown are left out.
std::string equation_text(const OdeModel& model, Index equation, const Digits& digits,
                          Intervals intervals);

/// "u acts 0.0100 +- 0.0001 s after it is recorded", the interval of 95 %.
std::string dead_time_sentence(const DeadTime& late, const std::string& time_unit);

}  // namespace lacuna
