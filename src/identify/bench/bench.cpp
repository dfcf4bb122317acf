// SPDX-License-Identifier: MIT
#include "lacuna/identify/bench/bench.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/base/check.hpp"
#include "core/base/text.hpp"
#include "core/base/user_text.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {
namespace {

std::optional<double> median_of(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  if (values.size() % 2 == 1 || !std::isfinite(values[half])) return values[half];
  return 0.5 * (values[half - 1] + values[half]);
}

void check_task(const BenchTask& task) {
  constexpr const char* kWhere = "bench";
  check_argument(!task.compositions.empty() && !task.noise.empty() && task.draws >= 1, kWhere,
                 "there is nothing to compare", "give compositions, noise and draws");
  for (const BenchComposition& one : task.compositions)
    check_argument(one.parts.size() == task.kinds.size(), kWhere,
                   "a composition has not one name for each kind of part");
  for (const double level : task.noise)
    check_argument(level >= 0.0 && std::isfinite(level), kWhere,
                   "a noise is negative or not finite", "give fractions such as 0.01");
  check_dataset(task.data);
}

/// Noisy copies for one deviation: one without noise.
std::vector<Dataset> copies_of(const BenchTask& task, double noise, std::uint64_t seed) {
  std::vector<Dataset> copies;
  const int draws = noise > 0.0 ? task.draws : 1;
  for (int draw = 0; draw < draws; ++draw)
    copies.push_back(add_relative_noise(
        task.data, noise, seed + static_cast<std::uint64_t>(draw), NoisyRates::Kept));
  return copies;
}

BenchCell cell_of(const BenchTask& task, std::size_t composition, double noise,
                  const std::vector<Dataset>& copies, const RunContext& context) {
  BenchCell cell{.composition = composition, .noise = noise, .scores = {}, .failures = {}};
  for (const Dataset& copy : copies) {
    try {
      context.check_stop();
      cell.scores.push_back(bench_score(task.compositions[composition].pipeline, copy,
                                        task.data, task.truth, context));
    } catch (const OutOfTime&) {
      cell.done = false;
      break;
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      cell.failures.push_back(user_text(error));
    }
  }
  return cell;
}

}  // namespace

bool BenchResult::complete() const {
  return std::all_of(cells.begin(), cells.end(),
                     [](const BenchCell& cell) { return cell.done; });
}

const BenchCell& BenchResult::cell(std::size_t composition, std::size_t level) const {
  const std::size_t place = composition * noise.size() + level;
  check_argument(composition < parts.size() && level < noise.size() && place < cells.size(),
                 "BenchResult", "there is no such cell");
  return cells[place];
}

BenchSummary summary_of(const BenchCell& cell) {
  BenchSummary summary;
  std::vector<double> errors, terms, sync, seconds;
  double exact = 0.0;
  bool known = false;
  for (const BenchScore& score : cell.scores) {
    known = known || score.exact_structure.has_value();
    exact += score.exact_structure.value_or(false) ? 1.0 : 0.0;
    if (score.coefficient_error) errors.push_back(*score.coefficient_error);
    terms.push_back(static_cast<double>(score.terms));
    sync.push_back(score.sync.value_or(std::numeric_limits<double>::infinity()));
    seconds.push_back(score.seconds);
  }
  if (known)
    summary.exact_rate = exact / static_cast<double>(cell.scores.size() + cell.failures.size());
  summary.coefficient_error = median_of(std::move(errors));
  summary.terms = median_of(std::move(terms));
  summary.sync = median_of(std::move(sync));
  summary.seconds = median_of(std::move(seconds));
  return summary;
}

BenchScore bench_score(const Pipeline& pipeline, const Dataset& noisy, const Dataset& clean,
                       const std::optional<OdeModel>& truth, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  const IdentificationResult result = identify(noisy, pipeline, context);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  context.check_stop();
  BenchScore score;
  score.seconds = time.count();
  for (const Equation& equation : result.model.equations())
    score.terms += static_cast<Index>(equation.size());
  if (truth) {
    const ModelAccuracy accuracy = compare_models(result.model, *truth);
    score.exact_structure = accuracy.exact_structure;
    score.coefficient_error = accuracy.largest_error;
  }
  const SyncResult sync = synchronise(result.model, clean, Rk4{}, {}, context);
  if (sync.status == IntegrationStatus::Completed) score.sync = sync.relative;
  return score;
}

BenchResult bench(const BenchTask& task, const RunContext& context) {
  check_task(task);
  BenchResult result{task.kinds, {}, task.noise, {}, task.truth.has_value()};
  for (const BenchComposition& one : task.compositions) result.parts.push_back(one.parts);
  std::vector<std::vector<Dataset>> copies;
  for (const double level : task.noise) copies.push_back(copies_of(task, level, context.seed));
  const double count = static_cast<double>(task.compositions.size() * task.noise.size());
  for (std::size_t c = 0; c < task.compositions.size(); ++c)
    for (std::size_t level = 0; level < task.noise.size(); ++level) {
      const std::string activity = join(task.compositions[c].parts, " + ") + ", noise " +
                                   format_number(100.0 * task.noise[level]) + " %";
      context.unhurried().report(activity, static_cast<double>(result.cells.size()) / count);
      RunContext inner = context;
      inner.progress = nullptr;
      result.cells.push_back(cell_of(task, c, task.noise[level], copies[level], inner));
    }
  const bool any = std::any_of(result.cells.begin(), result.cells.end(), [](const auto& cell) {
    return !cell.scores.empty() || !cell.failures.empty();
  });
  if (!any) throw OutOfTime();
  return result;
}

}  // namespace lacuna
