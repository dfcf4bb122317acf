// SPDX-License-Identifier: MIT
#include "data/records/split.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.hpp"
#include "core/statistics/robust_statistics.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// Keeps the first notes of a kind and counts the others.
class NoteList {
 public:
  explicit NoteList(std::string source) : source_(std::move(source)) {}

  void add(std::string note) {
    if (notes_.size() < kShown)
      notes_.push_back(std::move(note));
    else
      ++hidden_;
  }

  std::vector<std::string> take() {
    if (hidden_ > 0)
      notes_.push_back(source_ + ": " + std::to_string(hidden_) + " more places like these");
    return std::move(notes_);
  }

 private:
  // For people.
  static constexpr std::size_t kShown = 10;
  std::string source_;
  std::vector<std::string> notes_;
  std::size_t hidden_ = 0;
};

std::string rows_text(Index count) {
  return std::to_string(count) + (count == 1 ? " row" : " rows");
}

constexpr Index kNone = std::numeric_limits<Index>::max();

/// A table with what its columns are for and where values are missing.
struct Rows {
  const Table& table;
  const ColumnIndices& columns;
  std::vector<Index> missing;  ///< column whose value is missing, per row; empty if none is

  const std::string& name(Index column) const {
    return table.columns[static_cast<std::size_t>(column)].name;
  }

  double time(Index row) const { return table.values(row, *columns.time); }

  bool is_missing(Index row) const {
    return !missing.empty() && missing[static_cast<std::size_t>(row)] != kNone;
  }

  bool new_trajectory(Index row) const {
    if (!columns.trajectory) return false;
    return table.values(row, *columns.trajectory) != table.values(row - 1, *columns.trajectory);
  }
};

/// Rows [begin, end) with one number in the trajectory column.
struct NumberedRows {
  Index begin, end;
};

[[noreturn]] void fail_infinite(const Rows& rows, Index row, Index column) {
  throw DataError(place(rows.table, row, column),
                  "the value in column '" + rows.name(column) + "' is infinite",
                  "leave the field empty when the value is missing, or remove the line");
}

[[noreturn]] void fail_number(const Rows& rows, Index row) {
  const Index column = *rows.columns.trajectory;
  throw DataError(place(rows.table, row, column),
                  "the number of the record is missing in column '" + rows.name(column) + "'",
                  "give every line the number of its record");
}

/// Numbers of records are compared as whole doubles.
void check_numbers(const Rows& rows) {
  constexpr double kLargestExact = 9007199254740992.0;  // 2^53, a fact of doubles
  if (!rows.columns.trajectory) return;
  const auto numbers = rows.table.values.col(*rows.columns.trajectory);
  Index row = 0;
  if (numbers.size() == 0 || numbers.cwiseAbs().maxCoeff(&row) < kLargestExact) return;
  const Index column = *rows.columns.trajectory;
  throw DataError(place(rows.table, row, column),
                  "the number of the record in column '" + rows.name(column) +
                      "' has more digits than doubles hold",
                  "number the records from 1");
}

[[noreturn]] void fail_no_value(const Rows& rows, Index column) {
  throw DataError(rows.table.source + ", column " + std::to_string(column + 1),
                  "column '" + rows.name(column) + "' has no values",
                  "remove it, or name the columns to be used as states and inputs");
}

[[noreturn]] void fail_time(const Rows& rows, Index before, Index row) {
  const double now = rows.time(row), earlier = rows.time(before);
  const bool same = now == earlier;
  std::string remedy = same ? "remove the repeated line, or give the step (--dt 0.01)"
                            : "sort the lines by time; number records that follow each other "
                              "in a column and name it (--trajectory NAME)";
  if (rows.columns.time_by_position)
    remedy =
        "the first column was taken as the time: name the time column (--time NAME) or give the "
        "step (--dt 0.01)";
  throw DataError(place(rows.table, row, *rows.columns.time),
                  "time in column '" + rows.name(*rows.columns.time) + "' " +
                      (same ? "stands still at " + format_number(now)
                            : "goes backwards, from " + format_number(earlier) + " to " +
                                  format_number(now)),
                  remedy);
}

[[noreturn]] void fail_empty(const Table& table) {
  const std::string only = table.values.rows() == 1
                               ? "there is only one line of numbers"
                               : "no two lines that follow each other are complete";
  throw DataError(table.source, only, "give at least two samples in a row");
}

/// Marks the rows in which a value is missing.
Rows with_missing(const Table& table, const ColumnIndices& columns) {
  Rows rows{table, columns, {}};
  for (const Index column : columns.used()) {
    const auto values = table.values.col(column);
    if (values.allFinite()) continue;
    if (rows.missing.empty())
      rows.missing.assign(static_cast<std::size_t>(values.size()), kNone);
    bool any = false;
    for (Index row = 0; row < values.size(); ++row) {
      if (std::isinf(values[row])) fail_infinite(rows, row, column);
      if (std::isnan(values[row]) && column == columns.trajectory) fail_number(rows, row);
      Index& missing = rows.missing[static_cast<std::size_t>(row)];
      if (std::isnan(values[row]) && missing == kNone) missing = column;
      any = any || !std::isnan(values[row]);
    }
    if (!any) fail_no_value(rows, column);
  }
  return rows;
}

std::vector<NumberedRows> numbered_rows(const Rows& rows) {
  std::vector<NumberedRows> numbered;
  Index begin = 0;
  for (Index row = 1; row <= rows.table.values.rows(); ++row) {
    if (row < rows.table.values.rows() && !rows.new_trajectory(row)) continue;
    numbered.push_back({begin, row});
    begin = row;
  }
  return numbered;
}

/// Time must rise from each row to the next that has one.
void check_time(const Rows& rows, NumberedRows part) {
  if (!rows.columns.time) return;
  std::optional<Index> before;
  for (Index row = part.begin; row < part.end; ++row) {
    if (!rows.missing.empty() && std::isnan(rows.time(row))) continue;
    if (before && !(rows.time(row) > rows.time(*before))) fail_time(rows, *before, row);
    before = row;
  }
}

std::vector<double> steps_of(const Rows& rows, NumberedRows part) {
  std::vector<double> steps;
  for (Index row = part.begin + 1; row < part.end; ++row)
    if (!rows.is_missing(row) && !rows.is_missing(row - 1))
      steps.push_back(rows.time(row) - rows.time(row - 1));
  return steps;
}

std::optional<double> threshold_of(const Rows& rows, NumberedRows part) {
  if (!rows.columns.time || part.end - part.begin < 2) return std::nullopt;
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (Index row = part.begin + 1; row < part.end; ++row) {
    const double step = rows.time(row) - rows.time(row - 1);
    if (rows.is_missing(row) || rows.is_missing(row - 1)) continue;
    smallest = std::min(smallest, step);
    largest = std::max(largest, step);
  }
  // No step can exceed any threshold then; spares the quantiles in the usual case.
  if (largest <= 1.5 * smallest) return std::nullopt;
  return gap_threshold(steps_of(rows, part));
}

std::string missing_note(const Rows& rows, Index row, Index end, bool inside) {
  const Index column = rows.missing[static_cast<std::size_t>(row)];
  return place(rows.table, row, column) + ": value of '" + rows.name(column) + "' missing, " +
         rows_text(end - row) + " left out" + (inside ? ", record split" : "");
}

std::string jump_note(const Rows& rows, Index row) {
  return place(rows.table, row, *rows.columns.time) + ": record split, time jumps from " +
         format_number(rows.time(row - 1)) + " to " + format_number(rows.time(row));
}

std::string single_row_note(const Rows& rows, Index row) {
  return place(rows.table, row, rows.columns.used()[0]) +
         ": a single row between two cuts is left out";
}

Index missing_end(const Rows& rows, Index row, Index last) {
  while (row < last && rows.is_missing(row)) ++row;
  return row;
}

/// Cuts rows of one number where values are missing and time jumps.
std::vector<TableRows> cut(const Rows& rows, NumberedRows part, bool jumps_stay,
                           NoteList& notes) {
  std::vector<TableRows> ranges;
  const auto add = [&](Index begin, Index end) {
    if (end - begin >= 2) ranges.push_back({begin, end - begin, begin - part.begin});
    if (end - begin == 1) notes.add(single_row_note(rows, begin));
  };
  const std::optional<double> threshold =
      jumps_stay ? std::nullopt : threshold_of(rows, part);
  Index begin = part.begin;
  for (Index row = part.begin; row < part.end; ++row) {
    if (rows.is_missing(row)) {
      const Index end = missing_end(rows, row, part.end);
      notes.add(missing_note(rows, row, end, row > part.begin && end < part.end));
      add(begin, row);
      begin = end;
      row = end - 1;
    } else if (row > begin && threshold && rows.time(row) - rows.time(row - 1) > *threshold) {
      notes.add(jump_note(rows, row));
      add(begin, row);
      begin = row;
    }
  }
  add(begin, part.end);
  return ranges;
}

}  // namespace

std::optional<double> gap_threshold(std::vector<double> steps) {
  // Decisions, as the header says.
  constexpr double kUniform = 1.1, kJitter = 3.0;
  constexpr double kUniformGap = 1.5, kJitterGap = 5.0;
  if (steps.size() < 4) return std::nullopt;
  const double low = quantile(steps, 0.1);
  const double high = quantile(steps, 0.8);
  if (high <= kUniform * low) return kUniformGap * quantile(steps, 0.5);
  if (high <= kJitter * low) return kJitterGap * high;
  return std::nullopt;
}

Records split_records(const Table& table, const ColumnIndices& columns, bool jumps_stay) {
  const Rows rows = with_missing(table, columns);
  check_numbers(rows);
  const std::vector<NumberedRows> numbered = numbered_rows(rows);
  NoteList notes(table.source);
  std::vector<TableRows> ranges;
  for (const NumberedRows part : numbered) {
    check_time(rows, part);
    const std::vector<TableRows> cuts = cut(rows, part, jumps_stay, notes);
    ranges.insert(ranges.end(), cuts.begin(), cuts.end());
  }
  if (numbered.size() > 1)
    notes.add(table.source + ": " + std::to_string(numbered.size()) + " records by column '" +
              rows.name(*columns.trajectory) + "'");
  if (ranges.empty()) fail_empty(table);
  return {std::move(ranges), notes.take()};
}

}  // namespace lacuna
