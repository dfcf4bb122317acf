// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "core/base/text.hpp"
#include "core/statistics/robust_statistics.hpp"
#include "data/records/check_record.hpp"
#include "data/records/piece_name.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/data/records/noise.hpp"
#include "records/channels/outliers.hpp"
#include "seams.hpp"

namespace lacuna {
namespace {

/// The matrices one below the other.
Matrix stacked(std::span<const Trajectory> pieces, const Matrix Trajectory::*values) {
  Index rows = 0;
  for (const Trajectory& piece : pieces) rows += (piece.*values).rows();
  Matrix all(rows, (pieces.front().*values).cols());
  Index row = 0;
  for (const Trajectory& piece : pieces) {
    all.middleRows(row, (piece.*values).rows()) = piece.*values;
    row += (piece.*values).rows();
  }
  return all;
}

Matrix stacked_marks(std::span<const Trajectory> pieces) {
  const bool any = std::any_of(pieces.begin(), pieces.end(),
                               [](const Trajectory& piece) { return piece.marks.size() > 0; });
  if (!any) return {};
  std::vector<Trajectory> marked(pieces.begin(), pieces.end());
  for (Trajectory& piece : marked) piece.marks = marks_of(piece);
  return stacked(marked, &Trajectory::marks);
}

Vector times_of(std::span<const Trajectory> pieces) {
  Index samples = 0;
  for (const Trajectory& piece : pieces) samples += piece.samples();
  Vector time(samples);
  Index row = 0;
  for (const Trajectory& piece : pieces) {
    time.segment(row, piece.samples()) = piece.time;
    row += piece.samples();
  }
  return time;
}

Trajectory joined(std::span<const Trajectory> pieces) {
  if (pieces.size() == 1) return pieces.front();
  return {record_of(pieces.front().source),
          times_of(pieces),
          stacked(pieces, &Trajectory::states),
          stacked(pieces, &Trajectory::inputs),
          stacked(pieces, &Trajectory::derivatives),
          stacked_marks(pieces)};
}

/// Times are not exact multiples of the step: half of one more is still the same gap.
double longest_time(const GapOptions& options, double step) {
  return (options.longest_gap + 0.5) * step;
}

bool belongs_to(const Trajectory& before, const Trajectory& after, double longest_gap) {
  return before.has_derivatives() == after.has_derivatives() &&
         goes_on(before, after, longest_gap);
}

/// Per sample of a record whether no measured state has one that says anything.
std::vector<bool> blank_samples(const Dataset& data, const Trajectory& record) {
  std::vector<bool> blank(static_cast<std::size_t>(record.samples()), true);
  for (Index k = 0; k < data.state_count(); ++k)
    for (Index i = 0; i < record.samples() && data.is_measured(k); ++i)
      if (says_something(mark_of(record.marks, i, k)))
        blank[static_cast<std::size_t>(i)] = false;
  return blank;
}

/// The usual step between samples that are not blank: inputs may have many more.
double step_of_known(const Trajectory& record, const std::vector<bool>& blank) {
  std::vector<double> steps;
  std::optional<double> last;
  for (Index i = 0; i < record.samples(); ++i) {
    if (blank[static_cast<std::size_t>(i)]) continue;
    if (last) steps.push_back(record.time[i] - *last);
    last = record.time[i];
  }
  return steps.empty() ? 0.0 : upper_median(std::move(steps));
}

/// The parts of a record between blank stretches of more time than `longest`; blank ends
/// belong to no part.
std::vector<Trajectory> known_parts(const Trajectory& record, const std::vector<bool>& blank,
                                    double longest) {
  std::vector<Trajectory> parts;
  Index begin = -1, last = -1;
  const auto add = [&] {
    if (begin >= 0 && last > begin) parts.push_back(rows_of(record, begin, last + 1 - begin));
    begin = -1;
  };
  for (Index i = 0; i < record.samples(); ++i) {
    if (blank[static_cast<std::size_t>(i)]) continue;
    if (begin >= 0 && record.time[i] - record.time[last] > longest) add();
    if (begin < 0) begin = i;
    last = i;
  }
  add();
  return parts;
}

using NameOf = std::string (*)(const std::string&);

std::string file_name_of(const std::string& source) {
  return source.substr(0, end_of_file_name(source));
}

/// Numbers anew the parts of those that were cut, by what they are of.
void number_parts(const std::set<std::string>& cut, NameOf whole,
                  std::string (*name)(const std::string&, std::size_t),
                  std::vector<Trajectory>& records) {
  std::map<std::string, std::size_t> counts;
  for (Trajectory& record : records)
    if (const std::string of = whole(record.source); cut.contains(of))
      record.source = name(of, ++counts[of]);
}

/// Records without stretches in which no channel shows anything for longer than a model is
/// carried on.
Dataset without_blank_stretches(Dataset data, const GapOptions& options) {
  std::vector<Trajectory> records;
  std::set<std::string> cut;
  for (const Trajectory& record : data.trajectories) {
    if (record.marks.size() == 0) {
      records.push_back(record);
      continue;
    }
    const std::vector<bool> blank = blank_samples(data, record);
    const double longest = longest_time(options, step_of_known(record, blank));
    std::vector<Trajectory> parts = known_parts(record, blank, longest);
    if (parts.size() > 1) cut.insert(record_of(record.source));
    std::move(parts.begin(), parts.end(), std::back_inserter(records));
  }
  number_parts(cut, record_of, piece_name, records);
  data.trajectories = std::move(records);
  return data;
}

}  // namespace

Dataset join_across_gaps(const Dataset& data, const GapOptions& options) {
  check_columns(data, "join_across_gaps");
  if (longest_record(data).samples() < 2) return data;  // there is no step to measure gaps by
  const double longest_gap = longest_time(options, median_step(data));
  const std::vector<Trajectory>& pieces = data.trajectories;
  Dataset result{data.time_unit, data.states,        data.inputs, {},
                 data.rate_of,   data.reconstructed, data.notes};
  for (std::size_t first = 0, end = 1; first < pieces.size(); first = end++) {
    while (end < pieces.size() && belongs_to(pieces[end - 1], pieces[end], longest_gap)) ++end;
    result.trajectories.push_back(joined({&pieces[first], end - first}));
  }
  return result;
}

namespace {

/// Jumps in the times of a record.
struct Jumps {
  Index count = 0;
  Index longest = 0;   ///< sample in front of the longest
  double steps = 0.0;  ///< usual steps that the longest has
};

std::string jump_note(const Trajectory& record, const Jumps& jumps, bool has_inputs) {
  const bool is_one = jumps.count == 1;
  const double from = record.time[jumps.longest], to = record.time[jumps.longest + 1];
  // Four digits, or as many as separate the two where times are large (seconds since 1970).
  const double size = std::max(std::abs(from), std::abs(to)) / (to - from);
  const int digits = std::max(4, static_cast<int>(std::ceil(std::log10(size))) + 2);
  return "time jumps " +
         (is_one ? "" : std::to_string(jumps.count) + " times, farthest ") + "from " +
         format_number(from, digits) + " to " + format_number(to, digits) + " (" +
         record.source + ", " + format_number(jumps.steps, 3) +
         " steps), and the model is carried on in between" +
         (has_inputs ? ", its inputs by their hold" : "") + "; where another record begins " +
         (is_one ? "there" : "at one of them") + ", number the records in a column (--trajectory)";
}

}  // namespace

std::vector<std::string> notes_on_jumps(const Dataset& data, const GapOptions& options) {
  // Decisions (docs/decisions.md): of the steps, and of the median.
  constexpr double kRegular = 0.9, kAlike = 0.1;
  check_columns(data, "notes_on_jumps");
  std::vector<std::string> notes;
  for (const Trajectory& record : data.trajectories) {
    const Index n = record.samples() - 1;
    if (n < 2) continue;
    const Vector steps = record.time.tail(n) - record.time.head(n);
    const double usual = median({steps.begin(), steps.end()});
    Jumps jumps;
    const double longest = steps.maxCoeff(&jumps.longest);
    const auto alike = ((steps.array() - usual).abs() <= kAlike * usual).count();
    if (static_cast<double>(alike) < kRegular * static_cast<double>(n) ||
        longest <= longest_time(options, usual))
      continue;
    jumps.count = (steps.array() > longest_time(options, usual)).count();
    jumps.steps = longest / usual;
    notes.push_back(jump_note(record, jumps, data.input_count() > 0));
  }
  return notes;
}

namespace {

/// What cutting records at their seams came to.
struct Cuts {
  std::vector<std::string> times;  ///< at which others begin
  std::size_t in_gaps = 0;         ///< of them those behind missing samples
};

Cuts cut_at_seams(Dataset& data) {
  Cuts cuts;
  std::vector<Trajectory> records;
  std::set<std::string> files;
  for (const Trajectory& record : data.trajectories) {
    Index begin = 0;
    std::vector<Index> ends = seams(data, record);
    ends.push_back(record.samples());
    if (ends.size() > 1) files.insert(file_of(record));
    for (const Index end : ends) {
      records.push_back(rows_of(record, begin, end - begin));
      if (begin > 0) {
        cuts.times.push_back(format_number(record.time[begin], 6));
        cuts.in_gaps += record.time[begin] - record.time[begin - 1] > 1.5 * median_step(data);
      }
      begin = end;
    }
  }
  number_parts(files, file_name_of, record_name, records);
  data.trajectories = std::move(records);
  return cuts;
}

}  // namespace

UsableRecords usable_records(const Dataset& data, const GapOptions& options) {
  check_dataset(data);
  const Dataset known = without_blank_stretches(data, options);
  if (known.trajectories.empty())
    throw DataError(data.trajectories.front().source, "no two samples show anything",
                    "give records with values");
  UsableRecords result{join_across_gaps(known, options), {}};
  std::vector<Trajectory>& records = result.data.trajectories;
  const std::size_t joints = known.trajectories.size() - records.size();
  const Cuts cuts = cut_at_seams(result.data);
  const std::size_t gaps = joints - std::min(joints, cuts.in_gaps);
  const std::size_t left_out = std::erase_if(records, [&](const Trajectory& record) {
    return record.samples() < options.shortest_record;
  });
  const std::string shortest = std::to_string(options.shortest_record);
  if (records.empty())
    throw DataError(data.trajectories.front().source,
                    "no record has " + shortest + " samples or more in a row",
                    "give longer records, or compare models that you write down: `lacuna fit "
                    "ONE.ode TWO.ode DATA`");
  if (!cuts.times.empty())
    result.notes.push_back("all channels jump at once at t = " + join(cuts.times, ", ") +
                           ": another record begins there");
  if (gaps > 0)
    result.notes.push_back(std::to_string(gaps) + " short gaps in the records are bridged");
  if (left_out > 0)
    result.notes.push_back(std::to_string(left_out) + " pieces of less than " + shortest +
                           " samples were left out");
  return result;
}

SplitRecords split_in_time(const Dataset& data) {
  check_columns(data, "split_in_time");
  SplitRecords parts{data, data};
  parts.find.trajectories.clear();
  parts.check.trajectories.clear();
  // At the end of a part nothing distinguishes an outlier from a motion: that is seen in the
  // whole.
  const std::vector<Matrix> seen =
      mark_outliers(data, analyse_noise(data), kOutlyingDeviations);
  for (std::size_t r = 0; r < data.trajectories.size(); ++r) {
    Trajectory record = data.trajectories[r];
    const Index kept = record.samples() - record.samples() / 4;
    const Index end = std::min(kept + kLongestRun, record.samples());
    for (Index i = std::max<Index>(0, kept - kLongestRun); i < end; ++i)
      for (Index k = 0; k < data.state_count(); ++k)
        if (mark_of(seen[r], i, k) == Mark::Outlier) set_mark(record, i, k, Mark::Outlier);
    parts.find.trajectories.push_back(rows_of(record, 0, kept));
    Trajectory last = rows_of(record, kept, record.samples() - kept);
    last.source += last.source.empty() ? "last quarter" : ", last quarter";
    parts.check.trajectories.push_back(std::move(last));
  }
  return parts;
}

}  // namespace lacuna
