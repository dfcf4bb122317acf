// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/base/text.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

std::string kind_name(hidden::Kind kind) {
  switch (kind) {
    case hidden::Kind::Nothing:
      return "nothing missing";
    case hidden::Kind::Coefficients:
      return "wrong coefficients";
    case hidden::Kind::Effects:
      return "effects";
    case hidden::Kind::Inexpressible:
      break;
  }
  return "inexpressible";
}

std::string group_of(const Trial& trial) {
  if (trial.hidden.effects.size() > 1) return "two effects";
  return kind_name(trial.hidden.kind);
}

std::string family_of(const Trial& trial) {
  const auto& effects = trial.hidden.effects;
  if (effects.empty() || effects[0].names.empty()) return to_string(trial.hidden.noise);
  return effects[0].names[0];
}

/// "held-input" of a case that is made so; else the kind of the noise.
std::string ordinary_of(const Trial& trial) {
  const std::string& name = trial.hidden.name;
  const std::size_t space = name.find(' ');
  return space == std::string::npos ? to_string(trial.hidden.noise) : name.substr(space + 1);
}

std::string percent(double fraction) { return format_number(100.0 * fraction, 3) + " %"; }

/// Gaps: near that of the true model; not claimed better than it is.
constexpr double kNear = 1.5, kHonest = 1.2;

std::string number_or_blank(const std::optional<double>& value) {
  return value ? format_number(*value, 4) : "";
}

/// Counts of one group of trials.
struct Tally {
  double trials = 0.0, verdict = 0.0, equation = 0.0, name = 0.0, listed = 0.0, spurious = 0.0;
  double sized = 0.0, size_right = 0.0, seconds = 0.0;
  double gauged = 0.0, gap_right = 0.0, recomputed = 0.0, honest = 0.0;

  void add(const Outcome& outcome) {
    const hidden::Score& score = outcome.score;
    ++trials;
    verdict += score.verdict;
    equation += score.equation;
    name += score.name;
    listed += score.listed;
    spurious += score.spurious > 0;
    if (score.size) {
      ++sized;
      size_right += std::abs(*score.size - 1.0) <= 0.1;
    }
    if (outcome.true_gap) {
      ++gauged;
      gap_right += outcome.gap <= kNear * *outcome.true_gap;
    }
    if (outcome.real_gap) {
      ++recomputed;
      honest += outcome.gap >= *outcome.real_gap / kHonest;
    }
    seconds = std::max(seconds, outcome.seconds);
  }

  std::vector<std::string> cells(const std::string& label) const {
    return {label,
            format_number(trials),
            percent(verdict / trials),
            percent(equation / trials),
            percent(name / trials),
            percent(listed / trials),
            sized > 0.0 ? percent(size_right / sized) : "",
            gauged > 0.0 ? percent(gap_right / gauged) : "",
            recomputed > 0.0 ? percent(honest / recomputed) : "",
            percent(spurious / trials),
            format_number(seconds, 3)};
  }
};

using Grouping = std::function<std::string(const Trial&)>;

std::string grouped(const std::vector<Trial>& trials, const std::vector<Outcome>& outcomes,
                    const std::string& heading, const Grouping& group) {
  std::map<std::string, Tally> tallies;
  for (std::size_t i = 0; i < trials.size(); ++i) tallies[group(trials[i])].add(outcomes[i]);
  ResultTable table{{heading, "trials", "verdict", "equation", "name first", "name listed",
                     "size within 10 %", "gap within 1.5 x true", "gap true within 20 %",
                     "names too many", "slowest, s"},
                    {}};
  for (const auto& [label, tally] : tallies) table.rows.push_back(tally.cells(label));
  return table.markdown() + "\n";
}

ResultTable all_trials(const std::vector<Trial>& trials, const std::vector<Outcome>& outcomes) {
  ResultTable table{{"case", "kind", "family", "noise", "level", "strength", "seed", "verdict",
                     "equation", "name", "listed", "too many", "size", "gap", "floor",
                     "true gap", "real gap", "seconds", "answer"},
                    {}};
  const auto flag = [](bool value) { return std::string(value ? "1" : "0"); };
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Trial& t = trials[i];
    const hidden::Score& s = outcomes[i].score;
    std::string answer = s.answer + outcomes[i].failure;
    std::replace(answer.begin(), answer.end(), ',', ' ');
    table.rows.push_back(
        {t.hidden.name, group_of(t), family_of(t), to_string(t.hidden.noise),
         format_number(t.level), format_number(t.strength), std::to_string(t.seed),
         flag(s.verdict), flag(s.equation), flag(s.name), flag(s.listed),
         std::to_string(s.spurious), number_or_blank(s.size), format_number(outcomes[i].gap, 4),
         number_or_blank(outcomes[i].floor), number_or_blank(outcomes[i].true_gap),
         number_or_blank(outcomes[i].real_gap), format_number(outcomes[i].seconds, 3), answer});
  }
  return table;
}

}  // namespace

void write_tables(const std::filesystem::path& folder, const std::string& name,
                  const std::vector<Trial>& trials, const Finished<Outcome>& finished) {
  const std::vector<Outcome>& outcomes = finished.values;
  const Origin& origin = finished.origin;
  const auto level = [](const Trial& t) { return format_number(100.0 * t.level) + " %"; };
  std::string text = "# Hidden effects: " + name + "\n\n`study_hidden " + name + "`, " +
                     origin.day + ", " + origin.machine + ", " +
                     format_number(origin.seconds, 3) + " s.\n\n";
  text += grouped(trials, outcomes, "kind, noise",
                  [&](const Trial& t) { return group_of(t) + ", " + level(t); });
  if (name == "power")
    text += grouped(trials, outcomes, "strength, noise", [&](const Trial& t) {
      return format_number(t.strength) + ", " + level(t);
    });
  text += grouped(trials, outcomes, name == "alarm" ? "kind of noise" : "family", family_of);
  if (name == "reality" || name == "ordinary")
    text += grouped(trials, outcomes, "kind of record", ordinary_of);
  if (name == "alarm")
    text += grouped(trials, outcomes, "system", [](const Trial& t) { return t.hidden.name; });
  write_results(folder, name, all_trials(trials, outcomes).csv(), text);
}

}  // namespace lacuna::benchmarks
