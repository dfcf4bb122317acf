// SPDX-License-Identifier: MIT
#include "find_records.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "core/parts.hpp"
#include "lacuna/core/error.hpp"

namespace lacuna {
namespace {

constexpr Index kPiece = Index{1} << 17;
constexpr Index kOverlap = 2;  // so that no step of time lies between pieces

/// Whether rows are one record as far as anybody can see: all is finite, time goes on evenly.
bool is_plain(const Matrix& values, const ColumnIndices& columns) {
  if (columns.trajectory || values.rows() < 2) return false;
  for (const Index column : columns.used())
    if (!values.col(column).allFinite()) return false;
  if (!columns.time) return true;
  const auto time = values.col(*columns.time);
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (Index row = 1; row < time.size(); ++row) {
    const double step = time[row] - time[row - 1];
    smallest = std::min(smallest, step);
    largest = std::max(largest, step);
  }
  return smallest > 0.0 && largest <= 1.5 * smallest;
}

/// Its ranges count from the first row of the piece.
Records records_of_piece(const NpyFile& file, const ColumnIndices& columns, Index first,
                         Index count) {
  Table piece = file.columns();
  piece.values = file.values(first, count);
  if (is_plain(piece.values, columns)) return {{{0, count, 0}}, {}};
  piece.source += ", rows from " + std::to_string(first + 1);
  return split_records(piece, columns);
}

/// Ranges, then notes letter by letter, each with an end.
std::vector<double> as_numbers(const Records& records) {
  std::vector<double> numbers{static_cast<double>(records.ranges.size())};
  for (const TableRows& range : records.ranges)
    for (const Index number : {range.first, range.count, range.offset})
      numbers.push_back(static_cast<double>(number));
  for (const std::string& note : records.notes)
    for (const char letter : note + '\n') numbers.push_back(static_cast<double>(letter));
  return numbers;
}

Records from_numbers(const std::vector<double>& numbers) {
  Records records;
  const auto ranges = static_cast<std::size_t>(numbers[0]);
  const auto at = [&](std::size_t place) { return static_cast<Index>(numbers[place]); };
  for (std::size_t i = 0; i < ranges; ++i)
    records.ranges.push_back({at(1 + 3 * i), at(2 + 3 * i), at(3 + 3 * i)});
  std::string note;
  for (std::size_t i = 1 + 3 * ranges; i < numbers.size(); ++i) {
    const char letter = static_cast<char>(numbers[i]);
    if (letter == '\n')
      records.notes.push_back(std::exchange(note, ""));
    else
      note += letter;
  }
  return records;
}

/// Gives all members of a team what each has found in its pieces.
void share_records(std::vector<Records>& found, const RunContext& context) {
  if (context.team == nullptr) return;
  std::vector<std::vector<double>> numbers;
  std::vector<double> sizes;
  for (const Records& records : found) {
    numbers.push_back(as_numbers(records));
    sizes.push_back(static_cast<double>(numbers.back().size()));
  }
  share_parts(found.size(), context,
              [&](std::size_t i) { return std::span<double>(&sizes[i], 1); });
  for (std::size_t i = 0; i < found.size(); ++i)
    numbers[i].resize(static_cast<std::size_t>(sizes[i]));
  share_parts(found.size(), context, [&](std::size_t i) { return std::span(numbers[i]); });
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = from_numbers(numbers[i]);
}

/// Adds the ranges of a piece; one that goes on across its begin is joined with the last.
void join_ranges(const std::vector<TableRows>& ranges, Index first,
                 std::vector<TableRows>& all) {
  for (TableRows range : ranges) {
    range.first += first;
    range.offset += first;
    if (!all.empty() && range.first < all.back().first + all.back().count)
      all.back().count = range.first + range.count - all.back().first;
    else
      all.push_back(range);
  }
}

void add_notes(std::vector<std::string> notes, std::vector<std::string>& all) {
  constexpr std::size_t kShown = 12;
  for (std::string& note : notes)
    if (all.size() < kShown) all.push_back(std::move(note));
}

}  // namespace

Records find_records(const NpyFile& file, const ColumnIndices& columns,
                     const RunContext& context) {
  const auto pieces = static_cast<std::size_t>((file.rows() + kPiece - 1) / kPiece);
  std::vector<Records> found(pieces);
  for_each_own_part(pieces, context, [&](std::size_t i) {
    context.check_stop();
    const Index first = std::max<Index>(static_cast<Index>(i) * kPiece - kOverlap, 0);
    const Index end = std::min(static_cast<Index>(i + 1) * kPiece, file.rows());
    found[i] = records_of_piece(file, columns, first, end - first);
  });
  share_records(found, context);
  Records all;
  for (std::size_t i = 0; i < pieces; ++i) {
    join_ranges(found[i].ranges, std::max<Index>(static_cast<Index>(i) * kPiece - kOverlap, 0),
                all.ranges);
    add_notes(std::move(found[i].notes), all.notes);
  }
  if (all.ranges.empty())
    throw DataError(file.columns().source, "there are no two rows of numbers",
                    "give at least two samples in a row");
  return all;
}

}  // namespace lacuna
