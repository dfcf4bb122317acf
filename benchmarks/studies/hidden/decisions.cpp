// SPDX-License-Identifier: MIT
#include "decisions.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <set>

#include "lacuna/config/diagnosis_configuration.hpp"
#include "lacuna/core/atomic_file.hpp"
#include "lacuna/core/text.hpp"
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

DecisionOptions with_change(const Change& change) {
  DecisionOptions options;
  NumberVisitor set([&](const FieldInfo& info, double value) {
    return info.name == change.name ? change.value : value;
  });
  options.describe(set);
  return options;
}

std::vector<Trial> trials_at_one_percent(const std::string& part) {
  std::vector<Trial> trials = case_trials();
  std::erase_if(trials, [&](const Trial& trial) {
    return trial.level != 0.01 || trial.hidden.name.find(part) == std::string::npos;
  });
  return trials;
}

/// What counts as the same answer.
std::string answer_of(const Outcome& outcome) {
  const hidden::Score& score = outcome.score;
  return std::to_string(score.verdict) + std::to_string(score.equation) +
         std::to_string(score.name) + std::to_string(score.spurious);
}

/// Names of the cases with another answer.
std::vector<std::string> changed(const std::vector<Trial>& trials,
                                 const std::vector<Outcome>& before,
                                 const std::vector<Outcome>& after) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (answer_of(before[i]) != answer_of(after[i])) names.push_back(trials[i].hidden.name);
  return names;
}

std::vector<std::vector<std::string>> read_rows(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) rows.push_back(split_list(line));
  return rows;
}

void write_markdown(const std::filesystem::path& folder, std::size_t cases) {
  auto rows = read_rows(folder / "decisions.csv");
  if (rows.empty()) return;
  ResultTable table{rows.front(), {rows.begin() + 1, rows.end()}};
  write_file_atomically(folder / "decisions.md",
                        "# Decisions at half and at double\n\n`study_hidden decisions`, " +
                            today() + ", " + machine_description() + ". Of " +
                            std::to_string(cases) +
                            " hidden cases at 1 % noise those whose answer (verdict, equation, "
                            "name, names too many) is another one than with the default.\n\n" +
                            table.markdown());
}

}  // namespace

int run_decisions(const std::filesystem::path& folder, const std::string& part) {
  const std::filesystem::path csv = folder / "decisions.csv";
  std::filesystem::create_directories(folder);
  std::set<std::string> done;
  for (const auto& row : read_rows(csv))
    if (row.size() > 1) done.insert(row[0] + row[1]);
  if (done.empty()) std::ofstream(csv) << "decision,factor,value,changed,cases\n";
  const std::vector<Trial> trials = trials_at_one_percent(part);
  DiagnosisOptions options = diagnosis_options({}, default_registry());
  const std::vector<Outcome> before = run_trials(trials, options);
  for (const Change& change : all_changes()) {
    const std::string factor = format_number(change.factor);
    if (done.contains(change.name + factor)) continue;
    options.decision = with_change(change);
    const auto names = changed(trials, before, run_trials(trials, options));
    std::ofstream(csv, std::ios::app)
        << change.name << ',' << factor << ',' << format_number(change.value) << ','
        << names.size() << ',' << (names.empty() ? "-" : join(names, " ")) << '\n';
  }
  write_markdown(folder, trials.size());
  std::cout << "table in " << folder << '\n';
  return 0;
}

}  // namespace lacuna::benchmarks
