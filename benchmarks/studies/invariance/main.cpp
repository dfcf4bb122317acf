// SPDX-License-Identifier: MIT
// Small records in other units, scaled and shifted: `identify` gives the same structure and
// verdict, or refuses and says why.
// Usage: study_invariance [OUTPUT_FOLDER] [RECORD]
//                         (default build/studies/invariance, all records; else those with
//                         RECORD in their name)
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>

#include "answers.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

std::string text_of(const Structure& structure) {
  std::string text;
  for (const auto& terms : structure) {
    text += text.empty() ? "" : "; ";
    for (std::size_t i = 0; i < terms.size(); ++i) text += (i > 0 ? " " : "") + terms[i];
  }
  return text;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

struct Study {
  ResultTable details{{"record", "variant", "outcome", "status", "verdict", "verdict before",
                       "structure", "expected", "error"},
                      {}};
  std::map<std::string, std::map<Outcome, int>> counts;
  std::vector<std::string> order;
};

void add(const SmallRecord& record, const std::filesystem::path& file, Study& study) {
  const Answer base = identified(record.data, record.degree, file);
  for (const Variant& variant : variants()) {
    const Answer answer = identified(in_units(record.data, variant), record.degree, file);
    const Structure expected =
        base.model ? expected_structure(*base.model, record.data, variant) : Structure{};
    const Outcome outcome = compared(answer, base, expected);
    if (study.counts.find(variant.name) == study.counts.end())
      study.order.push_back(variant.name);
    ++study.counts[variant.name][outcome];
    study.details.rows.push_back({record.name, variant.name, to_string(outcome),
                                  std::to_string(answer.status), answer.verdict, base.verdict,
                                  text_of(answer.structure), text_of(expected),
                                  first_line(answer.error)});
  }
}

ResultTable summary_of(Study& study) {
  ResultTable summary{{"units", "records", "same", "refused", "doubtful", "other"}, {}};
  std::map<Outcome, int> sums;
  const auto row = [](const std::string& name, std::map<Outcome, int>& counts) {
    int all = 0;
    std::vector<std::string> cells{name, ""};
    for (const Outcome one :
         {Outcome::Same, Outcome::Refused, Outcome::Doubtful, Outcome::Other}) {
      cells.push_back(std::to_string(counts[one]));
      all += counts[one];
    }
    cells[1] = std::to_string(all);
    return cells;
  };
  for (const std::string& name : study.order) {
    for (const auto& [outcome, count] : study.counts[name]) sums[outcome] += count;
    summary.rows.push_back(row(name, study.counts[name]));
  }
  summary.rows.push_back(row("all", sums));
  return summary;
}

int run_study(const StudyArguments& arguments) {
  const std::filesystem::path folder = arguments.folder_at(0);
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "record.csv";
  const std::string only = arguments.at(1);
  Study study;
  for (const SmallRecord& record : small_records())
    if (record.name.find(only) != std::string::npos) add(record, file, study);
  std::filesystem::remove(file);
  const ResultTable summary = summary_of(study);
  write_results(
      folder, "invariance", study.details.csv(),
      "# Records in other units\n\n`study_invariance FOLDER " + only + "`, " + today() + ", " +
          machine_description() +
          ". Records of 400 samples of ten polynomial systems, without noise and with noise of "
          "1e-4, 1e-3, 1e-2 (twice), by `lacuna identify --degree 2` (or 3), then scaled, in "
          "other units of time, and shifted by so many standard deviations. *Same*: the same "
          "terms (of a shifted record those of the expanded polynomial, where the plain one "
          "was "
          "found as it is) and the same verdict. *Refused*: an error that says why. "
          "*Doubtful*: "
          "other terms or a weaker verdict, without a claim that it fits to the noise. "
          "*Other*: "
          "what should not be.\n\n" +
          summary.markdown());
  std::cout << summary.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"invariance", "[OUTPUT_FOLDER] [RECORD]", lacuna::benchmarks::run_study, 0, false}, argc,
      argv);
}
