// SPDX-License-Identifier: MIT
// Flows identified from two of their three channels: how often the structure is the true one,
// up to the scale of the state that was not measured. Usage: study_hidden_channel
// [OUTPUT_FOLDER] [SEEDS] [--cells FOLDER]
//                      (default build/studies/hidden_channel, 32)
#include <algorithm>
#include <iostream>
#include <set>
#include <span>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "identify/hidden_state/identify_hidden.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

/// A flow of which some channels were measured.
struct Case {
  std::string system;
  std::vector<Index> measured;
  double step = 0.0;
  double noise = 0.0;                        ///< of each channel's standard deviation
  std::vector<std::set<std::string>> terms;  ///< true ones, the hidden state h last
};

const std::vector<Case>& cases() {
  using Terms = std::vector<std::set<std::string>>;
  static const Terms lorenz{{"h", "x"}, {"z", "x*h"}, {"h", "x", "x*z"}};
  static const Terms rossler{{"h", "y"}, {"x", "y"}, {"1", "h", "x*h"}};
  static const std::vector<Case> all{{"lorenz", {0, 2}, 0.02, 0.01, lorenz},
                                     {"lorenz", {0, 2}, 0.02, 0.05, lorenz},
                                     {"rossler", {0, 1}, 0.1, 0.01, rossler},
                                     {"rossler", {0, 1}, 0.1, 0.05, rossler}};
  return all;
}

Dataset record_of(const Case& one, std::uint64_t seed) {
  constexpr Index kSamples = 501, kBefore = 1000;
  Random random(seed);
  const TestSystem& system = test_system(one.system);
  Vector start = system.start;
  for (double& value : start) value += 0.5 * random.normal();
  const Vector time =
      Vector::LinSpaced(kBefore + kSamples, 0.0, one.step * (kBefore + kSamples - 1));
  const Solution orbit = simulate(system.model, dopri8(), start, time);
  Dataset data;
  Trajectory& record = data.trajectories.emplace_back();
  record.time = time.tail(kSamples).array() - time[kBefore];
  record.states = orbit.states.bottomRows(kSamples)(Eigen::all, one.measured);
  record.inputs.resize(kSamples, 0);
  for (Index k = 0; k < record.states.cols(); ++k) {
    const auto place = static_cast<std::size_t>(one.measured[static_cast<std::size_t>(k)]);
    data.states.push_back(system.model.states()[place]);
    const Vector x = record.states.col(k);
    const double deviation = std::sqrt((x.array() - x.mean()).square().mean());
    for (Index i = 0; i < kSamples; ++i)
      record.states(i, k) += one.noise * deviation * random.normal();
  }
  return data;
}

/// What became of one record.
struct Outcome {
  bool exact = false;
  bool claims = false;  ///< says that it fits to the noise
  double seconds = 0.0;

  auto fields() { return std::tie(exact, claims, seconds); }
};

Outcome run(const Case& one, std::uint64_t seed) {
  Outcome outcome;
  const double begin = thread_seconds();
  try {
    const IdentificationResult result =
        identify_hidden(record_of(one, seed), algorithm1(), finite_differences(), "h").result;
    outcome.exact = true;
    for (std::size_t k = 0; k < one.terms.size(); ++k) {
      std::set<std::string> terms;
      for (const WeightedTerm& summand : result.model.equations()[k])
        terms.insert(summand.term.name());
      outcome.exact = outcome.exact && terms == one.terms[k];
    }
    outcome.claims =
        std::all_of(result.fit.begin(), result.fit.end(),
                    [](const EquationFit& fit) { return fit.fits_to_noise.value_or(true); });
  } catch (const Error&) {
    outcome.exact = false;
  }
  outcome.seconds = thread_seconds() - begin;
  return outcome;
}

std::string names_of(const Case& one) {
  std::vector<std::string> names;
  for (const Index k : one.measured)
    names.push_back(test_system(one.system).model.states()[static_cast<std::size_t>(k)].name);
  return join(names, ", ");
}

int run_study(const StudyArguments& arguments) {
  const std::size_t seeds = arguments.count_at(1, 32);
  Cells<Outcome> cells;
  for (const Case& one : cases())
    cells.add_draws(one.system + " " + format_number(one.noise), seeds,
                    [&](std::size_t seed) { return run(one, seed); });
  const auto finished = run_cells(arguments.store(), cells);
  if (!finished) return 0;
  ResultTable table{{"flow", "measured", "noise", "records", "exact",
                     "not exact, but said to fit", "largest CPU s"},
                    {}};
  for (std::size_t k = 0; k < cases().size(); ++k) {
    const Case& one = cases()[k];
    const std::span<const Outcome> outcomes = finished->group(k);
    const auto count = [&](auto holds) {
      return std::to_string(std::count_if(outcomes.begin(), outcomes.end(), holds));
    };
    double longest = 0.0;
    for (const Outcome& outcome : outcomes) longest = std::max(longest, outcome.seconds);
    table.rows.push_back({one.system, names_of(one), format_number(one.noise),
                          std::to_string(seeds), count([](auto& o) { return o.exact; }),
                          count([](auto& o) { return !o.exact && o.claims; }),
                          format_number(longest, 2)});
  }
  write_results(
      arguments.folder_at(0), "hidden_channel", table.csv(),
      "# A state that nobody measured\n\n`study_hidden_channel`, " + finished->origin.day +
          ", " + finished->origin.machine +
          ". 501 samples of two channels, default preset (degree 3). *Exact*: all equations "
          "have exactly the true terms, up to the scale of the hidden state.\n\n" +
          table.markdown());
  std::cout << table.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"hidden_channel", "[OUTPUT_FOLDER] [SEEDS]", lacuna::benchmarks::run_study}, argc, argv);
}
