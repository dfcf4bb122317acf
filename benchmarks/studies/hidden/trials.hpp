// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "trial.hpp"

namespace lacuna::benchmarks {

/// Every hidden case at 0, 0.1, 1 and 5 % noise.
std::vector<Trial> case_trials();

/// One case of each effect family at a tenth, a third and the whole of its strength, at 0.1, 1
/// and 5 % noise.
std::vector<Trial> power_trials();

/// Records in which nothing is missing: all complete systems in turn, with every kind of noise
/// at 0.1, 1 and 5 %.
std::vector<Trial> alarm_trials(int count);

/// Records as benches make them, at 0.5 % noise: effects of every family and as many complete
/// systems, each with the kinds of hidden::Ordinary in turn.
std::vector<Trial> reality_trials();

/// Records as benches make them in which nothing is missing: all complete systems with every
/// kind of hidden::Ordinary at 0.2, 0.5 and 1 %.
std::vector<Trial> ordinary_trials(int count);

/// Effects of every family and all complete systems, in records that were smoothed, at 1 %.
std::vector<Trial> smoothed_trials();

/// Benches on which a wrong name is likely, each kind drawn so often. @param cells gets one for
/// each of them; a name that no answer may have counts as one too many.
std::vector<Trial> bench_trials(int draws, const std::string& part,
                                const DiagnosisOptions& options, Cells<Outcome>& cells);

/// Devices that lack nothing on benches with each of hidden::BenchFault, each drawn so often. Names
/// that say what a moving average does to its channel are not counted as too many.
std::vector<Trial> null_trials(int draws, const std::string& part,
                               const DiagnosisOptions& options, Cells<Outcome>& cells);

/// Devices of hidden::all_sensor_benches(). Names that say what a sensor does are not counted as
/// too many.
std::vector<Trial> sensor_trials(const std::string& part, const DiagnosisOptions& options,
                                 Cells<Outcome>& cells);

/// Twins of devices at 0.2, 0.5 and 1 % noise: each kind drawn so often, and as often without
/// what it hides.
std::vector<Trial> twin_trials(int draws);

}  // namespace lacuna::benchmarks
