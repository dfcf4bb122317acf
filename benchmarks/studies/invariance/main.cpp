// SPDX-License-Identifier: MIT
// Small records in other units, scaled and shifted: `identify` gives the same structure and
// verdict, or refuses and says why.
// Usage: study_invariance [OUTPUT_FOLDER] [RECORD] [--cells FOLDER]
//                         (default build/studies/invariance, all records; else those with
//                         RECORD in their name)
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <tuple>

#include "answers.hpp"
#include "core/base/text.hpp"
#include "support/cells.hpp"
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

/// A message without the folder of the file: the table is the same wherever it is made.
std::string without_folder(std::string text, const std::filesystem::path& file) {
  const std::string folder = file.parent_path().string() + "/";
  if (const std::size_t at = text.find(folder); at != std::string::npos)
    text.erase(at, folder.size());
  return text;
}

/// A record in one of the variants.
struct Row {
  Outcome outcome = Outcome::Same;
  int status = 0;
  std::string verdict, before, structure, expected, error;

  auto fields() {
    return std::tie(outcome, status, verdict, before, structure, expected, error);
  }
};

/// All variants of a record.
std::vector<Row> rows_of(const SmallRecord& record, const std::filesystem::path& file) {
  const Answer base = identified(record.data, record.degree, file);
  std::vector<Row> rows;
  for (const Variant& variant : variants()) {
    const Answer answer = identified(in_units(record.data, variant), record.degree, file);
    const Structure expected =
        base.model ? expected_structure(*base.model, record.data, variant) : Structure{};
    rows.push_back({compared(answer, base, expected), answer.status, answer.verdict,
                    base.verdict, text_of(answer.structure), text_of(expected),
                    without_folder(first_line(answer.error), file)});
  }
  std::filesystem::remove(file);
  return rows;
}

struct Study {
  ResultTable details{{"record", "variant", "outcome", "status", "verdict", "verdict before",
                       "structure", "expected", "error"},
                      {}};
  std::map<std::string, std::map<Outcome, int>> counts;
  std::vector<std::string> order;
};

void add(const std::string& record, const std::vector<Row>& rows, Study& study) {
  const std::vector<Variant> all = variants();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    if (study.counts.find(all[i].name) == study.counts.end())
      study.order.push_back(all[i].name);
    ++study.counts[all[i].name][row.outcome];
    study.details.rows.push_back({record, all[i].name, to_string(row.outcome),
                                  std::to_string(row.status), row.verdict, row.before,
                                  row.structure, row.expected, row.error});
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
  const std::string only = arguments.at(1);
  std::vector<SmallRecord> records = small_records();
  std::erase_if(records, [&](const SmallRecord& record) {
    return record.name.find(only) == std::string::npos;
  });
  // The command is one of a process: it takes its signals and all cores.
  Cells<std::vector<Row>> cells(Pace::OneByOne);
  for (const SmallRecord& record : records)
    cells.add(record.name, [&record, file = folder / (record.name + ".csv")] {
      return rows_of(record, file);
    });
  const auto finished = run_cells(arguments.store(), cells);
  if (!finished) return 0;
  Study study;
  for (std::size_t k = 0; k < records.size(); ++k)
    add(records[k].name, finished->values[k], study);
  const ResultTable summary = summary_of(study);
  write_results(
      folder, "invariance", study.details.csv(),
      "# Records in other units\n\n`study_invariance FOLDER " + only + "`, " +
          finished->origin.day + ", " + finished->origin.machine + ", " +
          format_number(finished->origin.seconds, 3) +
          " s. Records of 400 samples of ten polynomial systems, without noise and with noise "
          "of "
          "1e-4, 1e-3, 1e-2 (twice), by `lacuna identify --degree 2` (or 3), then scaled, in "
          "other units of time, and shifted by so many standard deviations. *Same*: the same "
          "terms (of a shifted record those of the expanded polynomial, in powers of x - c "
          "those of the plain one but for a shift) and the same verdict. *Refused*: an error "
          "that says why. "
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
