// SPDX-License-Identifier: MIT
#include "find_records.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

#include "core/base/parts.hpp"
#include "is_plain.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

constexpr Index kPiece = Index{1} << 14;  // a fact of the machines: a piece stays in cache
constexpr Index kOverlap = 2;             // a fact of steps: none lies between pieces

/// Whether two rows that follow each other are complete. What is infinite counts: it is an
/// error.
bool has_record(const Matrix& values, const ColumnIndices& columns) {
  const Matrix used = values(Eigen::all, columns.used());
  bool before = false;
  for (Index row = 0; row < used.rows(); ++row) {
    const bool complete = !used.row(row).array().isNaN().any();
    if ((before && complete) || used.row(row).array().isInf().any()) return true;
    before = complete;
  }
  return false;
}

/// Its ranges count from the first row of the piece; none where all of it is missing.
Records records_of_piece(const NpyFile& file, const ColumnIndices& columns, Index first,
                         Index count) {
  const bool can_be = count >= 2;
  if (const auto rows = file.plain_rows(first, count);
      can_be && rows && is_plain(*rows, columns))
    return {{{0, count, 0}}, {}};
  Table piece = file.columns();
  piece.values = file.values(first, count);
  if (can_be && is_plain(piece.values, columns)) return {{{0, count, 0}}, {}};
  piece.lines = file.lines(first, count);
  piece.rows_before = first;
  if (!has_record(piece.values, columns))
    return {{},
            {piece.source + ", rows from " + std::to_string(first + 1) +
             ": values are missing in all " + std::to_string(count) + " rows"}};
  return split_records(piece, columns);
}

/// A line for each range, an empty one, then the notes.
std::string as_text(const Records& records) {
  std::ostringstream text;
  for (const TableRows& range : records.ranges)
    text << range.first << ' ' << range.count << ' ' << range.offset << '\n';
  text << '\n';
  for (const std::string& note : records.notes) text << note << '\n';
  return text.str();
}

Records from_text(const std::string& text) {
  Records records;
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line) && !line.empty()) {
    TableRows range;
    std::istringstream(line) >> range.first >> range.count >> range.offset;
    records.ranges.push_back(range);
  }
  while (std::getline(lines, line)) records.notes.push_back(line);
  return records;
}

/// Gives all members of a team what each has found in its pieces.
void exchange_records(std::vector<Records>& found, const RunContext& context) {
  if (context.team == nullptr) return;
  std::vector<std::string> texts;
  for (const Records& records : found) texts.push_back(as_text(records));
  exchange_texts(texts, context);
  std::transform(texts.begin(), texts.end(), found.begin(), from_text);
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
  constexpr std::size_t kShown = 12;  // for people
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
  exchange_records(found, context);
  Records all;
  for (std::size_t i = 0; i < pieces; ++i) {
    join_ranges(found[i].ranges, std::max<Index>(static_cast<Index>(i) * kPiece - kOverlap, 0),
                all.ranges);
    add_notes(std::move(found[i].notes), all.notes);
  }
  if (all.ranges.empty())
    throw DataError(file.columns().source,
                    file.rows() == 1 ? "there is only one line of numbers"
                                     : "no two lines that follow each other are complete",
                    "give at least two samples in a row; where channels have rates of their "
                    "own, leave out --memory");
  return all;
}

}  // namespace lacuna
