// SPDX-License-Identifier: MIT
#include "decisions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <span>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "support/table.hpp"
#include "trials.hpp"

namespace lacuna::benchmarks {
namespace {

/// Calls a function for every number among options.
class NumberVisitor final : public OptionVisitor {
 public:
  using Function = std::function<double(const FieldInfo&, double)>;
  explicit NumberVisitor(Function function) : function_(std::move(function)) {}

  void field(const FieldInfo& info, double& value) override { value = function_(info, value); }
  void field(const FieldInfo& info, int& value) override {
    value = static_cast<int>(std::lround(function_(info, static_cast<double>(value))));
  }
  void field(const FieldInfo&, bool&) override {}
  void field(const FieldInfo&, std::string&) override {}
  void field(const FieldInfo&, std::optional<double>&) override {}
  void field(const FieldInfo&, std::optional<int>&) override {}
  void field(const FieldInfo&, std::vector<std::string>&) override {}

 protected:
  void choice(const FieldInfo&, std::span<const std::string_view>, int&) override {}
  void nested_stage(const FieldInfo&, std::string_view,
                    std::shared_ptr<const StageInterface>&) override {}

 private:
  Function function_;
};

/// A threshold with another value; nothing where its range ends before.
struct Change {
  std::string name;
  double factor = 1.0;
  double value = 0.0;

  std::string label() const { return name + " x " + format_number(factor); }
};

std::vector<Change> all_changes() {
  std::vector<Change> changes;
  DecisionOptions options;
  NumberVisitor list([&](const FieldInfo& info, double value) {
    for (const double factor : {0.5, 2.0}) {
      const double next =
          std::clamp(factor * value, info.min.value_or(-INFINITY), info.max.value_or(INFINITY));
      changes.push_back({std::string(info.name), factor, next});
    }
    return value;
  });
  options.describe(list);
  return changes;
}

DecisionOptions with_changes(std::span<const Change> changes) {
  DecisionOptions options;
  NumberVisitor set([&](const FieldInfo& info, double value) {
    for (const Change& change : changes)
      if (info.name == change.name) return change.value;
    return value;
  });
  options.describe(set);
  return options;
}

/// Groups of at most so many changes that neither are neighbours nor of the same threshold.
std::vector<std::vector<Change>> in_groups(const std::vector<Change>& changes) {
  constexpr std::size_t kMembers = 8;
  std::vector<std::vector<Change>> groups;
  for (const double factor : {0.5, 2.0}) {
    std::vector<Change> alike;
    for (const Change& change : changes)
      if (change.factor == factor) alike.push_back(change);
    const std::size_t count = (alike.size() + kMembers - 1) / kMembers, first = groups.size();
    groups.resize(first + count);
    for (std::size_t i = 0; i < alike.size(); ++i)
      groups[first + i % count].push_back(alike[i]);
  }
  return groups;
}

/// Trials on which thresholds are tried: the hidden cases at 1 % noise and, for thresholds of
/// smoothed records, such records.
std::vector<Trial> trials_of(bool of_smoothing, const std::string& part) {
  std::vector<Trial> trials = case_trials();
  if (of_smoothing)
    for (Trial& trial : smoothed_trials()) trials.push_back(std::move(trial));
  std::erase_if(trials, [&](const Trial& trial) {
    return trial.level != 0.01 || trial.hidden.name.find(part) == std::string::npos;
  });
  return trials;
}

bool is_of_smoothing(const Change& change) { return change.name.starts_with("smoothing_"); }

/// What counts as the same answer.
std::string answer_of(const Outcome& outcome) {
  const hidden::Score& score = outcome.score;
  return std::to_string(score.verdict) + std::to_string(score.equation) +
         std::to_string(score.name) + std::to_string(score.spurious);
}

/// Labels of those of the changes that alone give another answer. Changes that, made together,
/// leave the answer as it was to the letter count as changing nothing; else each half of them
/// is tried.
std::vector<std::string> altering(std::span<const Change> changes, const Trial& trial,
                                  const Outcome& before) {
  DiagnosisOptions options = diagnosis_options({}, default_registry());
  options.decision = with_changes(changes);
  const Outcome after = run_trial(trial, options);
  const bool same = answer_of(after) == answer_of(before);
  if (changes.size() == 1)
    return same ? std::vector<std::string>{} : std::vector{changes[0].label()};
  if (same && after.score.answer == before.score.answer) return {};
  const std::size_t half = changes.size() / 2;
  auto names = altering(changes.first(half), trial, before);
  const auto others = altering(changes.subspan(half), trial, before);
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

/// Changes of thresholds of smoothing, or of the others.
std::vector<std::vector<Change>> groups_of(bool of_smoothing) {
  std::vector<Change> changes = all_changes();
  std::erase_if(changes,
                [&](const Change& change) { return is_of_smoothing(change) != of_smoothing; });
  return in_groups(changes);
}

/// Labels of all changes that alter the answer to a trial.
std::vector<std::string> altered(const Trial& trial,
                                 const std::vector<std::vector<Change>>& groups) {
  const Outcome before = run_trial(trial, diagnosis_options({}, default_registry()));
  std::vector<std::string> labels;
  for (const std::vector<Change>& group : groups)
    for (std::string& label : altering(group, trial, before))
      labels.push_back(std::move(label));
  return labels;
}

/// Names of the trials that a change alters. @param labels of each of them, by altered().
std::vector<std::string> altered_by(const Change& change, const std::vector<Trial>& trials,
                                    std::span<const std::vector<std::string>> labels) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (std::ranges::count(labels[i], change.label()) > 0)
      names.push_back(trials[i].hidden.name);
  return names;
}

void write_markdown(const std::filesystem::path& folder, ResultTable table,
                    const Origin& origin, std::size_t cases, std::size_t smoothed) {
  std::sort(table.rows.begin(), table.rows.end());
  write_file_atomically(folder / "decisions.md",
                        "# Decisions at half and at double\n\n`study_hidden decisions`, " +
                            origin.day + ", " + origin.machine + ". Of " +
                            std::to_string(cases) +
                            " hidden cases at 1 % noise (for thresholds of smoothing, these "
                            "and smoothed ones, " +
                            std::to_string(smoothed) +
                            " in all) those whose answer (verdict, equation, "
                            "name, names too many) is another one than with the default. "
                            "Thresholds are moved in groups, "
                            "and one by one where a group changes an answer.\n\n" +
                            table.markdown());
}

}  // namespace

int run_decisions(const std::filesystem::path& folder, const std::string& part,
                  const CellStore& store) {
  const std::array groups{groups_of(false), groups_of(true)};
  const std::array trials{trials_of(false, part), trials_of(true, part)};
  Cells<std::vector<std::string>> cells;
  for (const std::size_t kind : {0, 1}) {
    cells.begin_group(kind == 0 ? "" : "smoothing");
    for (const Trial& trial : trials[kind])
      cells.add(name_of(trial), [&, kind] { return altered(trial, groups[kind]); });
  }
  const auto finished = run_cells(store, cells);
  if (!finished) return 0;
  ResultTable table{{"decision", "factor", "value", "changed", "cases"}, {}};
  for (const std::size_t kind : {0, 1})
    for (const std::vector<Change>& group : groups[kind])
      for (const Change& change : group) {
        const auto names = altered_by(change, trials[kind], finished->group(kind));
        table.rows.push_back({change.name, format_number(change.factor),
                              format_number(change.value), std::to_string(names.size()),
                              names.empty() ? "-" : join(names, " ")});
      }
  std::filesystem::create_directories(folder);
  write_file_atomically(folder / "decisions.csv", table.csv());
  write_markdown(folder, std::move(table), finished->origin, trials[0].size(),
                 trials[1].size());
  std::cout << "table in " << folder << '\n';
  return 0;
}

}  // namespace lacuna::benchmarks
