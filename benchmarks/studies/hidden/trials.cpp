// SPDX-License-Identifier: MIT
#include "trials.hpp"

#include <algorithm>
#include <set>

#include "benches.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/null_benches.hpp"
#include "hidden/support/ordinary.hpp"
#include "hidden/support/sensor_benches.hpp"
#include "hidden/support/twins.hpp"

namespace lacuna::benchmarks {

std::vector<Trial> case_trials() {
  std::vector<Trial> trials;
  for (const hidden::HiddenCase& hidden : hidden::all_cases())
    for (const double level : {0.0, 0.001, 0.01, 0.05})
      trials.push_back({hidden, 1.0, level, 1});
  return trials;
}

std::vector<Trial> power_trials() {
  std::vector<Trial> trials;
  for (const double strength : {0.1, 0.3, 1.0}) {
    std::set<std::string> seen;
    for (const hidden::HiddenCase& hidden : hidden::all_cases(strength)) {
      if (hidden.kind != hidden::Kind::Effects) continue;
      if (!seen.insert(hidden.effects[0].names[0]).second) continue;
      for (const double level : {0.001, 0.01, 0.05})
        trials.push_back({hidden, strength, level, 11});
    }
  }
  return trials;
}

std::vector<Trial> alarm_trials(int count) {
  const std::vector<hidden::HiddenCase> systems = hidden::null_cases();
  const std::vector<hidden::NoiseKind> kinds{
      hidden::NoiseKind::White, hidden::NoiseKind::Coloured, hidden::NoiseKind::Outliers,
      hidden::NoiseKind::Quantised, hidden::NoiseKind::Drifting};
  const std::vector<double> levels{0.001, 0.01, 0.05};
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    Trial trial{systems[i % systems.size()], 1.0, 0.0, 1000 + i};
    const std::size_t turn = i / systems.size();
    trial.hidden.noise = kinds[turn % kinds.size()];
    trial.level = levels[turn / kinds.size() % levels.size()];
    trials.push_back(std::move(trial));
  }
  return trials;
}

namespace {

/// Cases with one effect, one of each family.
std::vector<hidden::HiddenCase> effect_cases() {
  std::vector<hidden::HiddenCase> cases;
  std::set<std::string> seen;
  for (const hidden::HiddenCase& hidden : hidden::all_cases())
    if (hidden.kind == hidden::Kind::Effects && hidden.effects.size() == 1 &&
        seen.insert(hidden.effects[0].names[0]).second)
      cases.push_back(hidden);
  return cases;
}

/// The cases, each with the next kind that it can be.
void add_in_turn(const std::vector<hidden::HiddenCase>& cases, std::size_t count,
                 std::vector<Trial>& trials) {
  const std::vector<hidden::Ordinary> kinds = hidden::all_ordinary();
  std::size_t kind = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const hidden::HiddenCase& hidden = cases[i % cases.size()];
    while (!hidden::can_be(hidden, kinds[kind % kinds.size()])) ++kind;
    trials.push_back({hidden::made(hidden, kinds[kind++ % kinds.size()]), 1.0, 0.005, 21 + i});
  }
}

}  // namespace

std::vector<Trial> reality_trials() {
  constexpr std::size_t kOfEach = 40;
  std::vector<Trial> trials;
  add_in_turn(effect_cases(), kOfEach, trials);
  add_in_turn(hidden::null_cases(), kOfEach, trials);
  return trials;
}

std::vector<Trial> smoothed_trials() {
  std::vector<hidden::HiddenCase> cases = effect_cases();
  for (hidden::HiddenCase& hidden : hidden::null_cases()) cases.push_back(std::move(hidden));
  std::vector<Trial> trials;
  for (hidden::HiddenCase& hidden : cases) {
    hidden.noise =
        trials.size() % 2 == 0 ? hidden::NoiseKind::Averaged : hidden::NoiseKind::Parabolas;
    hidden.name += " " + hidden::to_string(hidden.noise);
    trials.push_back({std::move(hidden), 1.0, 0.01, 41 + trials.size()});
  }
  return trials;
}

std::vector<Trial> ordinary_trials(int count) {
  const std::vector<hidden::HiddenCase> systems = hidden::null_cases();
  const std::vector<double> levels{0.002, 0.005, 0.01};
  std::vector<Trial> trials;
  std::uint64_t seed = 3000;
  while (static_cast<int>(trials.size()) < count)
    for (const hidden::HiddenCase& system : systems)
      for (const hidden::Ordinary kind : hidden::all_ordinary()) {
        if (!hidden::can_be(system, kind) || static_cast<int>(trials.size()) == count) continue;
        trials.push_back({hidden::made(system, kind), 1.0, levels[seed % levels.size()], seed});
        ++seed;
      }
  return trials;
}

std::vector<Trial> twin_trials(int draws) {
  const std::vector<double> levels{0.002, 0.005, 0.01};
  std::vector<Trial> trials;
  std::uint64_t seed = 5000;
  for (const bool hides : {true, false})
    for (const hidden::Twin kind : hidden::all_twins())
      for (int draw = 0; draw < draws; ++draw, ++seed)
        trials.push_back({hides ? hidden::twin(kind, seed) : hidden::complete_twin(kind, seed),
                          1.0, levels[seed % levels.size()], seed});
  return trials;
}

namespace {

Outcome run_bench(hidden::Bench kind, std::uint64_t seed, const DiagnosisOptions& options) {
  const hidden::BenchCase made = hidden::bench(kind, seed);
  Outcome outcome = judge(made.hidden, made.records, made.clean, options);
  const auto forbidden = static_cast<int>(std::count_if(
      made.forbidden.begin(), made.forbidden.end(), [&](const std::string& name) {
        return outcome.score.answer.find(" " + name + " ") != std::string::npos;
      }));
  outcome.score.spurious = std::max(outcome.score.spurious, forbidden);
  return outcome;
}

}  // namespace

std::vector<Trial> bench_trials(int draws, const std::string& part,
                                const DiagnosisOptions& options, Cells<Outcome>& cells) {
  std::vector<Trial> trials;
  std::uint64_t seed = 7000;
  for (const hidden::Bench kind : hidden::all_benches())
    for (int draw = 0; draw < draws; ++draw, ++seed) {
      const Trial trial{hidden::bench(kind, seed).hidden, 1.0, hidden::kBenchNoise, seed};
      if (trial.hidden.name.find(part) == std::string::npos) continue;
      add_reported(cells, trial, [=] { return run_bench(kind, trial.seed, options); });
      trials.push_back(trial);
    }
  return trials;
}

namespace {

/// How many of the names of an answer are among some.
int count_of(const std::vector<std::string>& names, const std::string& answer) {
  int count = 0;
  for (const std::string& one : names) {
    const std::string name = " " + one + " ";
    for (auto at = answer.find(name); at != std::string::npos; at = answer.find(name, at + 1))
      ++count;
  }
  return count;
}

Outcome run_null(hidden::BenchFault fault, std::uint64_t seed, const DiagnosisOptions& options) {
  const hidden::BenchCase made = hidden::null_bench(fault, seed);
  Outcome outcome = judge(made.hidden, made.records, made.clean, options);
  if (fault == hidden::BenchFault::MovingAverage)
    outcome.score.spurious -=
        count_of({"sensor-lag", "channel-skew"}, outcome.score.answer);
  return outcome;
}

}  // namespace

std::vector<Trial> null_trials(int draws, const std::string& part,
                               const DiagnosisOptions& options, Cells<Outcome>& cells) {
  std::vector<Trial> trials;
  std::uint64_t seed = 8000;
  for (const hidden::BenchFault fault : hidden::all_bench_faults())
    for (int draw = 0; draw < draws; ++draw, ++seed) {
      const Trial trial{hidden::null_bench(fault, seed).hidden, 1.0, hidden::kBenchNoise, seed};
      if (trial.hidden.name.find(part) == std::string::npos) continue;
      add_reported(cells, trial, [=] { return run_null(fault, trial.seed, options); });
      trials.push_back(trial);
    }
  return trials;
}

namespace {

/// What is said of sensors is right on these benches.
Outcome run_sensor(const hidden::SensorBench& bench, const DiagnosisOptions& options) {
  const hidden::BenchCase made = hidden::made_bench(bench);
  Outcome outcome = judge(made.hidden, made.records, made.clean, options);
  outcome.score.spurious -= count_of(hidden::names_of_sensors(), outcome.score.answer);
  outcome.score.size.reset();
  return outcome;
}

}  // namespace

std::vector<Trial> sensor_trials(const std::string& part, const DiagnosisOptions& options,
                                 Cells<Outcome>& cells) {
  std::vector<Trial> trials;
  for (const hidden::SensorBench& bench : hidden::all_sensor_benches()) {
    const Trial trial{hidden::made_bench(bench).hidden, 1.0, hidden::kBenchNoise, bench.seed};
    if (trial.hidden.name.find(part) == std::string::npos) continue;
    add_reported(cells, trial, [=] { return run_sensor(bench, options); });
    trials.push_back(trial);
  }
  return trials;
}

}  // namespace lacuna::benchmarks
