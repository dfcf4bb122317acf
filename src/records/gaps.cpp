// SPDX-License-Identifier: MIT
#include "lacuna/records/gaps.hpp"

#include <span>

#include "lacuna/core/error.hpp"

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
  return {file_of(pieces.front()), times_of(pieces), stacked(pieces, &Trajectory::states),
          stacked(pieces, &Trajectory::inputs), stacked(pieces, &Trajectory::derivatives)};
}

bool belongs_to(const Trajectory& before, const Trajectory& after, double longest_gap) {
  return before.has_derivatives() == after.has_derivatives() &&
         goes_on(before, after, longest_gap);
}

}  // namespace

Dataset join_across_gaps(const Dataset& data, const GapOptions& options) {
  // Times are not exact multiples of the step: half of one more is still the same gap.
  const double longest_gap = (options.longest_gap + 0.5) * median_step(data);
  const std::vector<Trajectory>& pieces = data.trajectories;
  Dataset result{data.time_unit, data.states,        data.inputs, {},
                 data.rate_of,   data.reconstructed, data.notes};
  for (std::size_t first = 0, end = 1; first < pieces.size(); first = end++) {
    while (end < pieces.size() && belongs_to(pieces[end - 1], pieces[end], longest_gap)) ++end;
    result.trajectories.push_back(joined({&pieces[first], end - first}));
  }
  return result;
}

UsableRecords usable_records(const Dataset& data, const GapOptions& options) {
  check_dataset(data);
  UsableRecords result{join_across_gaps(data, options), {}};
  std::vector<Trajectory>& records = result.data.trajectories;
  const std::size_t gaps = data.trajectories.size() - records.size();
  const std::size_t left_out = std::erase_if(records, [&](const Trajectory& record) {
    return record.samples() < options.shortest_record;
  });
  const std::string shortest = std::to_string(options.shortest_record);
  if (records.empty())
    throw DataError(data.trajectories.front().source,
                    "no record has " + shortest + " samples or more in a row",
                    "give longer records");
  if (gaps > 0)
    result.notes.push_back(std::to_string(gaps) + " short gaps in the records are bridged");
  if (left_out > 0)
    result.notes.push_back(std::to_string(left_out) + " pieces of less than " + shortest +
                           " samples were left out");
  return result;
}

SplitRecords split_in_time(const Dataset& data) {
  SplitRecords parts{data, data};
  parts.find.trajectories.clear();
  parts.check.trajectories.clear();
  for (const Trajectory& record : data.trajectories) {
    const Index kept = record.samples() - record.samples() / 4;
    parts.find.trajectories.push_back(rows_of(record, 0, kept));
    Trajectory last = rows_of(record, kept, record.samples() - kept);
    last.source += last.source.empty() ? "last quarter" : ", last quarter";
    parts.check.trajectories.push_back(std::move(last));
  }
  return parts;
}

}  // namespace lacuna
