// SPDX-License-Identifier: MIT
// Systems whose right-hand sides are rational or logistic, identified by the default from clean
// records and from noisy ones.
// Usage: study_rational [OUTPUT_FOLDER] [DRAWS] [SYSTEM] [PATH=VALUE...] [--cells FOLDER]
//                       (default build/studies/rational, 50 draws of the noise, all systems,
//                       noisy ones of those that take minutes only by their name;
//                       options of `identify`, e.g. forms.same=0.2)
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <span>
#include <utility>

#include "core/base/text.hpp"
#include "identify/forms_beside/identify_with_forms.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"
#include "systems.hpp"

namespace lacuna::benchmarks {
namespace {

/// What became of one draw.
struct Outcome {
  bool exact = false;
  bool claims = false;  ///< says that it fits to the noise
  double error = 1.0;   ///< of the rates
  double determination = -1.0;
  double seconds = 0.0;  ///< CPU time
  std::string model;

  auto fields() { return std::tie(exact, claims, error, determination, seconds, model); }
};

/// What is sought, and how.
struct Search {
  std::vector<Stage<Effect>> effects;
  FormOptions forms;
};

Outcome run(const RationalSystem& system, double noise, std::uint64_t seed,
            const Search& search) {
  Outcome outcome;
  const Dataset data = records_of(system, noise, seed);
  const double begin = thread_seconds();
  try {
    const IdentificationResult found =
        identify_with_forms(data, pipeline_for(system), search.effects, search.forms);
    outcome.seconds = thread_seconds() - begin;
    outcome.exact = has_structure(found.model, system.model);
    outcome.claims =
        std::all_of(found.fit.begin(), found.fit.end(),
                    [](const EquationFit& fit) { return fit.fits_to_noise.value_or(true); });
    outcome.model = to_text(found.model, 4);
    std::replace(outcome.model.begin(), outcome.model.end(), '\n', ';');
    outcome.error = rate_error(found.model, system);
    outcome.determination = determination(found.model, system);
  } catch (const Error& error) {
    outcome.model = error.what();
  }
  return outcome;
}

template <class Value>
double median(std::span<const Outcome> outcomes, Value value) {
  std::vector<double> values;
  for (const Outcome& one : outcomes) values.push_back(one.*value);
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The tables as they grow.
struct Tables {
  ResultTable summary{{"system", "noise", "records", "exact", "not exact, but said to fit",
                       "error of the rates", "solutions with R2 > 0.99", "CPU s"},
                      {}};
  ResultTable details{
      {"system", "noise", "draw", "exact", "fits", "rate error", "R2", "CPU seconds", "model"},
      {}};
};

void add(const RationalSystem& system, double noise, std::span<const Outcome> outcomes,
         Tables& tables) {
  const auto count = [&](auto holds) {
    return std::to_string(std::count_if(outcomes.begin(), outcomes.end(), holds));
  };
  tables.summary.rows.push_back({system.name, format_number(noise),
                                 std::to_string(outcomes.size()),
                                 count([](const Outcome& o) { return o.exact; }),
                                 count([](const Outcome& o) { return !o.exact && o.claims; }),
                                 format_number(median(outcomes, &Outcome::error), 2),
                                 count([](const Outcome& o) { return o.determination > 0.99; }),
                                 format_number(median(outcomes, &Outcome::seconds), 2)});
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& one = outcomes[i];
    tables.details.rows.push_back(
        {system.name, format_number(noise), std::to_string(i + 1), one.exact ? "1" : "0",
         one.claims ? "1" : "0", format_number(one.error, 3),
         format_number(one.determination, 5), format_number(one.seconds, 3), one.model});
  }
}

void write(const std::filesystem::path& folder, const std::string& arguments,
           const Tables& tables, const Origin& origin) {
  write_results(
      folder, "rational", tables.details.csv(),
      "# Rational and logistic right-hand sides\n\n`study_rational FOLDER " + arguments +
          "`, " + origin.day + ", " + origin.machine +
          ". Identified by the default, without a word about the functions unless the "
          "name says so. Noise: share of "
          "each state's standard deviation. *Exact*: every right-hand side, written as one "
          "fraction, has exactly the true monomials and no more numbers. Error of the rates: "
          "rms over the clean samples, of the worst equation, median. Solutions: from the true "
          "starts, all records.\n\n" +
          tables.summary.markdown());
}

int run_study(const StudyArguments& arguments) {
  const std::size_t draws = arguments.count_at(1, 50);
  const std::string only = arguments.at(2);
  const Search search{default_registry().make_all<Effect>(), arguments.options.forms};
  std::vector<std::pair<RationalSystem, double>> groups;
  for (const RationalSystem& system : rational_systems())
    for (const double noise : {0.0, 0.01})
      if (system.name.find(only) != std::string::npos &&
          (noise == 0.0 || (draws > 0 && (!system.slow || !only.empty()))))
        groups.emplace_back(system, noise);
  Cells<Outcome> cells;
  for (const auto& group : groups)
    cells.add_draws(
        group.first.name + " " + format_number(group.second), group.second > 0.0 ? draws : 1,
        [&](std::size_t seed) { return run(group.first, group.second, seed, search); });
  const auto finished = run_cells(arguments.store(), cells);
  if (!finished) return 0;
  Tables tables;
  for (std::size_t k = 0; k < groups.size(); ++k)
    add(groups[k].first, groups[k].second, finished->group(k), tables);
  write(arguments.folder_at(0), std::to_string(draws) + settings_text(arguments), tables,
        finished->origin);
  std::cout << tables.summary.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"rational", "[OUTPUT_FOLDER] [DRAWS] [SYSTEM] [PATH=VALUE...]",
       lacuna::benchmarks::run_study, 0, true},
      argc, argv);
}
