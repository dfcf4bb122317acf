// SPDX-License-Identifier: MIT
#include "lacuna/data/read_text.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <vector>

#include "dialects.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/data/text_field.hpp"
#include "text_layout.hpp"

namespace lacuna {
namespace {

/// Reads the lines of numbers into a table whose columns are known.
///
/// Each line is first read by a plain loop over std::from_chars; a line that is anything but
/// numbers and single delimiters is read again, field by field, with all the exceptions.
class RowReader {
 public:
  RowReader(std::string_view text, const TextLayout& layout, Table& table)
      : cursor_(text.data() + layout.data_begin),
        end_(text.data() + text.size()),
        layout_(layout),
        delimiter_(layout.delimiter),
        line_end_(layout.line_end),
        table_(table),
        columns_(static_cast<Index>(layout.columns())),
        line_(layout.data_line) {}

  void read() {
    const Index bound = count_lines();
    table_.values.resize(bound, columns_);
    table_.lines.resize(static_cast<std::size_t>(bound));
    stride_ = bound;
    while (cursor_ < end_) {
      read_line();
      ++line_;
    }
    if (row_ < bound) table_.values.conservativeResize(row_, columns_);
    table_.lines.resize(static_cast<std::size_t>(row_));
  }

 private:
  Index count_lines() const {
    const auto ends = std::count(cursor_, end_, line_end_);
    return ends + (end_ > cursor_ && end_[-1] != line_end_ ? 1 : 0);
  }

  void read_line() {
    const char* begin = cursor_;
    const bool read = delimiter_ == ' ' ? read_numbers<true>() : read_numbers<false>();
    if (!read) {
      const char* stop = std::find(begin, end_, line_end_);
      cursor_ = stop == end_ ? end_ : stop + 1;
      if (!read_exceptional({begin, static_cast<std::size_t>(stop - begin)})) return;
    }
    table_.lines[static_cast<std::size_t>(row_)] = line_;
    ++row_;
  }

  /// The plain case; false leaves the line to be read again.
  template <bool kBlanks>
  bool read_numbers() {
    const char* const end = end_;
    const char delimiter = delimiter_;
    const char* p = skip_spaces<kBlanks>(cursor_, end);
    double* value = table_.values.data() + row_;
    for (Index column = 0; column < columns_; ++column, value += stride_) {
      if (column > 0) {
        const char* next = skip_spaces<kBlanks>(p, end);
        if (kBlanks ? next == p : next == end || *next != delimiter) return false;
        p = kBlanks ? next : skip_spaces<kBlanks>(next + 1, end);
      }
      if (end - p > 1 && *p == '+' && p[1] != '-') ++p;
      const auto [stop, error] = std::from_chars(p, end, *value);
      if (error != std::errc()) return false;
      p = stop;
    }
    return finish_line(skip_spaces<kBlanks>(p, end));
  }

  /// Blanks around numbers; a tab may be the delimiter and is left to the exceptions then.
  template <bool kBlanks>
  static const char* skip_spaces(const char* p, const char* end) {
    while (p < end && (*p == ' ' || (kBlanks && *p == '\t'))) ++p;
    return p;
  }

  bool finish_line(const char* p) {
    if (p < end_ && *p == '\r' && line_end_ == '\n') ++p;
    if (p < end_ && *p != line_end_) return false;
    cursor_ = p < end_ ? p + 1 : end_;
    return true;
  }

  /// A line with missing values, quotes, decimal commas; false when it is a comment or empty.
  /// @throws DataError for a ragged line or text.
  bool read_exceptional(std::string_view line) {
    const std::string_view content = strip(line);
    if (content.empty() || content.front() == '#') return false;
    split_fields(line, delimiter_, fields_);
    const bool open = layout_.trailing_delimiter && fields_.back().empty();
    if (open && fields_.size() == layout_.columns() + 1) fields_.pop_back();
    if (fields_.size() != layout_.columns()) fail_ragged();
    for (Index column = 0; column < columns_; ++column) {
      const std::string_view field = fields_[static_cast<std::size_t>(column)];
      const TextField found = read_field(field);
      if (found.kind == TextField::Kind::Text) fail_text(field, column);
      table_.values(row_, column) = found.value;
    }
    return true;
  }

  std::string line_place() const { return table_.source + ":" + std::to_string(line_); }

  [[noreturn]] void fail_ragged() const {
    const std::size_t shared = std::min(fields_.size(), layout_.columns());
    throw DataError(line_place() + ":" + std::to_string(shared + 1),
                    "the line has " + std::to_string(fields_.size()) +
                        (fields_.size() == 1 ? " field" : " fields") + ", the others have " +
                        std::to_string(layout_.columns()),
                    "give every line the same number of fields (an empty one is a missing "
                    "value) or remove this line");
  }

  [[noreturn]] void fail_text(std::string_view field, Index column) const {
    constexpr std::size_t kShown = 40;
    const std::string shown(field.substr(0, kShown));
    const std::string& name = table_.columns[static_cast<std::size_t>(column)].name;
    throw DataError(
        line_place() + ":" + std::to_string(column + 1),
        "'" + shown + "' in column '" + name + "' is not a number",
        "write a number, leave the field empty when the value is missing, or remove "
        "a column of text");
  }

  const char* cursor_;
  const char* end_;
  const TextLayout& layout_;
  char delimiter_;
  char line_end_;
  Table& table_;
  Index columns_;
  std::size_t line_;
  Index row_ = 0;
  Index stride_ = 0;  ///< between the columns of the table
  std::vector<std::string_view> fields_;
};

void check_is_text(std::string_view text, const std::string& source) {
  constexpr std::size_t kLooked = 4096;
  const std::string_view mark = text.substr(0, 2);
  if (mark == "\xFF\xFE" || mark == "\xFE\xFF")
    throw DataError(source, "the text is encoded as UTF-16", "save it as UTF-8 or plain text");
  if (text.substr(0, kLooked).find('\0') != std::string_view::npos)
    throw DataError(source, "the file is binary, not text",
                    "give delimited text (.csv, .txt, .gz) or NumPy's .npy");
}

Table parse_delimited(std::string_view text, const std::string& source) {
  const TextLayout layout = find_layout(text, source);
  Table table;
  table.source = source;
  if (layout.note) table.notes.push_back(*layout.note);
  name_columns(table, layout.headers, layout.header_line);
  RowReader(text, layout, table).read();
  return table;
}

/// A text of an instrument or a program.
Table parse_plain(const PlainText& plain, const std::string& source) {
  Table table = parse_delimited(plain.text, source);
  table.notes.insert(table.notes.begin(), source + ": " + plain.note);
  table.run_column = plain.run_column;
  const auto shift =
      static_cast<std::size_t>(std::count(plain.shift.begin(), plain.shift.end(), '\n'));
  for (std::size_t& line : table.lines) line -= shift;
  return table;
}

}  // namespace

Table parse_text_table(std::string_view text, const std::string& source) {
  check_is_text(text, source);
  if (const auto plain = plain_text(text)) return parse_plain(*plain, source);
  return parse_delimited(text, source);
}

}  // namespace lacuna
