// SPDX-License-Identifier: MIT
#include "lacuna/data/split.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "lacuna/core/error.hpp"
#include "lacuna/core/text.hpp"

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
  static constexpr std::size_t kShown = 10;
  std::string source_;
  std::vector<std::string> notes_;
  std::size_t hidden_ = 0;
};

double quantile(std::vector<double>& values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

std::string rows_text(Index count) {
  return std::to_string(count) + (count == 1 ? " row" : " rows");
}

/// Cuts one table; the state of the walk over its rows.
class Splitter {
 public:
  Splitter(const Table& table, const ColumnIndices& columns)
      : table_(table), columns_(columns), used_(columns.used()), notes_(table.source) {}

  Records split() {
    find_gaps();
    Index first = 0;
    for (Index row = 1; row <= table_.values.rows(); ++row) {
      if (row < table_.values.rows() && !new_trajectory(row)) continue;
      split_numbered(first, row);
      first = row;
    }
    note_trajectories();
    if (ranges_.empty()) fail_empty();
    return {std::move(ranges_), notes_.take()};
  }

 private:
  const std::string& name(Index column) const {
    return table_.columns[static_cast<std::size_t>(column)].name;
  }

  double time(Index row) const { return table_.values(row, *columns_.time); }

  /// Marks the rows in which a value is missing.
  void find_gaps() {
    for (const Index column : used_) {
      const auto values = table_.values.col(column);
      if (values.allFinite()) continue;
      if (missing_.empty()) missing_.assign(static_cast<std::size_t>(values.size()), kNone);
      bool any = false;
      for (Index row = 0; row < values.size(); ++row) {
        if (std::isinf(values[row])) fail_infinite(row, column);
        if (std::isnan(values[row]) && column == columns_.trajectory) fail_number(row);
        Index& missing = missing_[static_cast<std::size_t>(row)];
        if (std::isnan(values[row]) && missing == kNone) missing = column;
        any = any || !std::isnan(values[row]);
      }
      if (!any) fail_no_value(column);
    }
  }

  bool is_missing(Index row) const {
    return !missing_.empty() && missing_[static_cast<std::size_t>(row)] != kNone;
  }

  bool new_trajectory(Index row) const {
    if (!columns_.trajectory) return false;
    return table_.values(row, *columns_.trajectory) !=
           table_.values(row - 1, *columns_.trajectory);
  }

  /// Rows [first, last) have one number: cuts them where values are missing and time jumps.
  void split_numbered(Index first, Index last) {
    ++numbered_;
    number_begin_ = first;
    check_time(first, last);
    const std::optional<double> threshold = threshold_of(first, last);
    Index begin = first;
    for (Index row = first; row < last; ++row) {
      if (is_missing(row)) {
        const Index end = missing_end(row, last);
        note_missing(row, end, row > first && end < last);
        add(begin, row);
        begin = end;
        row = end - 1;
      } else if (row > begin && threshold && time(row) - time(row - 1) > *threshold) {
        note_jump(row);
        add(begin, row);
        begin = row;
      }
    }
    add(begin, last);
  }

  Index missing_end(Index row, Index last) const {
    while (row < last && is_missing(row)) ++row;
    return row;
  }

  /// Time must rise from each row to the next that has one.
  void check_time(Index first, Index last) const {
    if (!columns_.time) return;
    std::optional<Index> before;
    for (Index row = first; row < last; ++row) {
      if (!missing_.empty() && std::isnan(time(row))) continue;
      if (before && !(time(row) > time(*before))) fail_time(*before, row);
      before = row;
    }
  }

  std::optional<double> threshold_of(Index first, Index last) const {
    if (!columns_.time || last - first < 2) return std::nullopt;
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (Index row = first + 1; row < last; ++row) {
      const double step = time(row) - time(row - 1);
      if (is_missing(row) || is_missing(row - 1)) continue;
      smallest = std::min(smallest, step);
      largest = std::max(largest, step);
    }
    // No step can exceed any threshold then; spares the quantiles in the usual case.
    if (largest <= 1.5 * smallest) return std::nullopt;
    return gap_threshold(steps_of(first, last));
  }

  std::vector<double> steps_of(Index first, Index last) const {
    std::vector<double> steps;
    for (Index row = first + 1; row < last; ++row)
      if (!is_missing(row) && !is_missing(row - 1)) steps.push_back(time(row) - time(row - 1));
    return steps;
  }

  void add(Index begin, Index end) {
    if (end - begin >= 2) ranges_.push_back({begin, end - begin, begin - number_begin_});
    if (end - begin != 1) return;
    notes_.add(place(table_, begin, used_[0]) + ": a single row between two cuts is left out");
  }

  void note_missing(Index row, Index end, bool inside) {
    const Index column = missing_[static_cast<std::size_t>(row)];
    notes_.add(place(table_, row, column) + ": value of '" + name(column) + "' missing, " +
               rows_text(end - row) + " left out" + (inside ? ", record split" : ""));
  }

  void note_jump(Index row) {
    notes_.add(place(table_, row, *columns_.time) + ": record split, time jumps from " +
               format_number(time(row - 1)) + " to " + format_number(time(row)));
  }

  void note_trajectories() {
    if (numbered_ < 2) return;
    notes_.add(table_.source + ": " + std::to_string(numbered_) + " records by column '" +
               name(*columns_.trajectory) + "'");
  }

  [[noreturn]] void fail_infinite(Index row, Index column) const {
    throw DataError(place(table_, row, column),
                    "the value in column '" + name(column) + "' is infinite",
                    "leave the field empty when the value is missing, or remove the line");
  }

  [[noreturn]] void fail_number(Index row) const {
    throw DataError(
        place(table_, row, *columns_.trajectory),
        "the number of the record is missing in column '" + name(*columns_.trajectory) + "'",
        "give every line the number of its record");
  }

  [[noreturn]] void fail_no_value(Index column) const {
    throw DataError(table_.source + ", column " + std::to_string(column + 1),
                    "column '" + name(column) + "' has no values",
                    "remove it, or name the columns to be used as states and inputs");
  }

  [[noreturn]] void fail_time(Index before, Index row) const {
    const bool same = time(row) == time(before);
    std::string remedy = same ? "remove the repeated line"
                              : "sort the lines by time; number records that follow each other "
                                "in a column and name it as the trajectory column";
    if (columns_.time_by_position)
      remedy = "the first column was taken as the time: name the time column or give the step";
    throw DataError(place(table_, row, *columns_.time),
                    "time in column '" + name(*columns_.time) + "' " +
                        (same ? "stands still at " + format_number(time(row))
                              : "goes backwards, from " + format_number(time(before)) + " to " +
                                    format_number(time(row))),
                    remedy);
  }

  [[noreturn]] void fail_empty() const {
    const Index rows = table_.values.rows();
    const std::string only = rows == 1 ? "there is only one line of numbers"
                                       : "no two lines that follow each other are complete";
    throw DataError(table_.source, only, "give at least two samples in a row");
  }

  static constexpr Index kNone = std::numeric_limits<Index>::max();
  const Table& table_;
  const ColumnIndices& columns_;
  std::vector<Index> used_;
  std::vector<Index> missing_;  ///< column whose value is missing, per row; empty if none is
  std::vector<RowRange> ranges_;
  NoteList notes_;
  std::size_t numbered_ = 0;  ///< records by the trajectory column so far
  Index number_begin_ = 0;    ///< first row of the present one
};

}  // namespace

std::optional<double> gap_threshold(std::vector<double> steps) {
  constexpr double kUniform = 1.1, kJitter = 3.0;
  constexpr double kUniformGap = 1.5, kJitterGap = 5.0;
  if (steps.size() < 4) return std::nullopt;
  const double low = quantile(steps, 0.1);
  const double high = quantile(steps, 0.8);
  if (high <= kUniform * low) return kUniformGap * quantile(steps, 0.5);
  if (high <= kJitter * low) return kJitterGap * high;
  return std::nullopt;
}

Records split_records(const Table& table, const ColumnIndices& columns) {
  return Splitter(table, columns).split();
}

}  // namespace lacuna
