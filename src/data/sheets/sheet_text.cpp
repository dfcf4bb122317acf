// SPDX-License-Identifier: MIT
#include "data/sheets/sheet_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

// Facts of the formats: a sheet has at most so many rows and columns (Excel 2007 on).
constexpr std::size_t kMostRows = 1048576, kMostColumns = 16384;

/// A sheet with more is no record: a full sheet of Excel with 19 columns takes 1 GB here.
constexpr std::size_t kMostCells = 20'000'000;

/// Fields of all lines, empty ones too, of which each takes a byte and more of text: a stray cell
/// in the last column makes 16 384 of every line. A fact of memory.
constexpr std::size_t kMostFields = 10 * kMostCells;

std::string in_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  std::replace(text.begin(), text.end(), '"', ' ');
  return text;
}

/// "10:00:00.25" of hundred-thousandths of a second of a day.
std::string time_text(std::int64_t ticks, std::int64_t ticks_of_second) {
  const std::int64_t seconds = ticks / ticks_of_second;
  const auto part = [](std::int64_t number) {
    return (number < 10 ? "0" : "") + std::to_string(number);
  };
  std::string text =
      part(seconds / 3600) + ":" + part(seconds / 60 % 60) + ":" + part(seconds % 60);
  const std::int64_t rest = ticks % ticks_of_second;
  if (rest == 0) return text;
  std::string digits = std::to_string(ticks_of_second + rest).substr(1);
  digits.erase(digits.find_last_not_of('0') + 1);
  return text + "." + digits;
}

/// Year, month, day of days since 1 January 1970 (Hinnant, civil_from_days).
std::string date_text(std::int64_t days) {
  days += 719468;
  const std::int64_t era = (days >= 0 ? days : days - 146096) / 146097;
  const std::int64_t of_era = days - era * 146097;
  const std::int64_t year =
      (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
  const std::int64_t of_year = of_era - (365 * year + year / 4 - year / 100);
  const std::int64_t shifted = (5 * of_year + 2) / 153;
  const auto day = static_cast<int>(of_year - (153 * shifted + 2) / 5 + 1);
  const auto month = static_cast<int>(shifted < 10 ? shifted + 3 : shifted - 9);
  const auto full_year = static_cast<int>(year + era * 400 + (month <= 2 ? 1 : 0));
  char text[40];
  std::snprintf(text, sizeof text, "%04d-%02d-%02d", full_year, month, day);
  return text;
}

}  // namespace

void SheetRows::expect(std::size_t cells) const {
  if (cells > kMostCells - std::min(cells_, kMostCells)) refuse();
}

void SheetRows::refuse() const {
  throw DataError(source_, "the sheet has more cells than any record",
                  "check that it is one, and save it as .csv");
}

void SheetRows::put(std::size_t row, std::size_t column, std::string text) {
  if (text.empty()) return;
  expect(row < kMostRows && column < kMostColumns ? 1 : kMostCells + 1);
  ++cells_;
  if (rows_.size() <= row) rows_.resize(row + 1);
  if (rows_[row].size() <= column) rows_[row].resize(column + 1);
  rows_[row][column] = in_one_line(std::move(text));
}

std::string SheetRows::text() const {
  std::size_t columns = 0;
  std::size_t lines = 0;
  for (const auto& row : rows_) {
    columns = std::max(columns, row.size());
    if (!row.empty()) ++lines;
  }
  if (lines * columns > kMostFields) refuse();
  std::string text;
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < columns && !row.empty(); ++i) {
      if (i > 0) text += '\t';
      if (i < row.size()) text += row[i];
    }
    text += '\n';
  }
  return text;
}

std::string date_of_serial(double days, bool since_1904) {
  // Doubles hold days of this century to a microsecond; a hundred-thousandth is left of it.
  constexpr std::int64_t kTicks = 100'000, kDay = 86400 * kTicks;
  constexpr std::int64_t kFrom1899 = -25569, kFrom1904 = -24107;  // days to 1 January 1970
  const auto ticks = static_cast<std::int64_t>(std::llround(days * static_cast<double>(kDay)));
  const std::int64_t whole = ticks >= 0 ? ticks / kDay : (ticks - kDay + 1) / kDay;
  const std::string time = time_text(ticks - whole * kDay, kTicks);
  if (whole == 0) return time;
  return date_text(whole + (since_1904 ? kFrom1904 : kFrom1899)) + "T" + time;
}

bool is_date_format(const std::string& format) {
  bool quoted = false, bracketed = false;
  for (std::size_t i = 0; i < format.size(); ++i) {
    const char c = static_cast<char>(std::tolower(static_cast<unsigned char>(format[i])));
    if (c == '"') quoted = !quoted;
    if (c == '\\') ++i;
    if (quoted || c == '\\') continue;
    if (c == ';') return false;  // the first section decides
    if (c == '[') {
      const auto next = static_cast<char>(
          i + 1 < format.size() ? std::tolower(static_cast<unsigned char>(format[i + 1])) : ' ');
      if (next == 'h' || next == 'm' || next == 's') return true;
      bracketed = true;
    }
    if (c == ']') bracketed = false;
    if (!bracketed && (c == 'y' || c == 'd' || c == 'h' || c == 's' || c == 'm')) return true;
  }
  return false;
}

}  // namespace lacuna
