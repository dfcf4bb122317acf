// SPDX-License-Identifier: MIT
#include "text_rows.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>
#include <vector>

#include "data/logs/channel_clocks.hpp"
#include "data/records/text_field.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// A number with a decimal point; points beside a comma are between thousands.
bool has_point(std::string_view field) {
  return field.find('.') != std::string_view::npos &&
         field.find(',') == std::string_view::npos &&
         read_field(field).kind == TextField::Kind::Number;
}

/// "1,001", not "0,001" or "1,01".
bool may_be_thousands(std::string_view field) {
  constexpr std::size_t kThousands = 3;  // a fact of writing: digits of a group
  const std::size_t begin = field.find_first_not_of("+-"), comma = field.find(',');
  return field.size() - comma - 1 == kThousands && field[begin] != '0' &&
         comma - begin <= kThousands;
}

/// Whether a missing value is a word; nothing and NaN are what everybody writes for one.
bool says_missing(std::string_view field) {
  return !field.empty() && !lower_case(field).ends_with("nan");
}

/// Why a line cannot be read, which may be damage of this line alone.
class UnreadLine : public DataError {
 public:
  using DataError::DataError;
};

/// Reads lines of numbers into a table whose columns are known.
///
/// Each line is first read by a plain loop over std::from_chars; a line that is anything but
/// numbers and single delimiters is read again, field by field, with all the exceptions.
class RowReader {
 public:
  /// @param line number of the first line.
  RowReader(std::string_view lines, const TextLayout& layout, const NumberStyle& style,
            std::size_t line, Table& table, std::vector<BadLine>& bad, MissingWords& missing)
      : cursor_(lines.data()),
        end_(lines.data() + lines.size()),
        layout_(layout),
        delimiter_(layout.delimiter),
        line_end_(layout.line_end),
        style_(style),
        counted_(style.time.value_or(-1)),
        is_plain_(!style.time || style.clocks.empty()),
        table_(table),
        columns_(static_cast<Index>(layout.columns())),
        line_(line),
        bad_(bad),
        missing_(missing) {}

  /// @return number of the line behind the last one.
  std::size_t read() {
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
    return line_;
  }

 private:
  Index count_lines() const {
    const auto ends = std::count(cursor_, end_, line_end_);
    return ends + (end_ > cursor_ && end_[-1] != line_end_ ? 1 : 0);
  }

  void read_line() {
    const char* begin = cursor_;
    const bool read = is_plain_ && (delimiter_ == ' ' ? read_numbers<true>()
                                                      : read_numbers<false>());
    if (!read) {
      const char* stop = std::find(begin, end_, line_end_);
      cursor_ = stop == end_ ? end_ : stop + 1;
      const std::string_view line(begin, static_cast<std::size_t>(stop - begin));
      if (!read_or_leave_out(line, stop != end_)) return;
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
      if (column == counted_) *value = counted({p, stop}, *value);
      p = stop;
    }
    return finish_line(skip_spaces<kBlanks>(p, end));
  }

  /// A time from the first one on; as a double where it is missing or beyond all stamps.
  double counted(std::string_view field, double value) const {
    const auto stamp = read_stamp(field);
    return stamp ? value_of(*stamp - style_.origin) : value - value_of(style_.origin);
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

  /// A line that is read with all the exceptions; false when there is no sample in it.
  /// @throws DataError where too many lines cannot be read, and for a doubtful comma.
  bool read_or_leave_out(std::string_view line, bool has_end) {
    try {
      return read_exceptional(line);
    } catch (const UnreadLine& error) {
      constexpr std::size_t kShown = 40;  // for people
      if (bad_.size() >= kMostBadLines) throw DataError(bad_.front().error);
      const bool is_short = fields_.size() < layout_.columns();
      bad_.push_back({kind_of_bad_line(line, has_end, is_short), line_,
                      std::string(strip(line).substr(0, kShown)), error});
      return false;
    }
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
      if (is_doubtful(field)) fail_comma(field, column);
      if (found.kind == TextField::Kind::Missing) note_missing(field, column);
      table_.values(row_, column) =
          style_.is_counted(column) ? counted(field, found.value) : found.value;
    }
    return true;
  }

  /// Whether a comma in a number may be one of decimals or of thousands. Beside decimal points
  /// it is none of decimals; in quotes between commas it may be either.
  bool is_doubtful(std::string_view field) const {
    if (field.find(',') == std::string_view::npos) return false;
    if (field.find('.') != std::string_view::npos) return false;  // groups show which is which
    const auto begin = fields_.begin() + static_cast<std::ptrdiff_t>(style_.first_own);
    const bool points = std::any_of(begin, fields_.end(), has_point);
    return style_.has_points || points || (style_.delimiter == ',' && may_be_thousands(field));
  }

  void note_missing(std::string_view field, Index column) {
    if (!says_missing(field) || missing_.count++ > 0) return;
    missing_.word = field;
    missing_.place = line_place() + ":" + std::to_string(style_.place_of(column) + 1);
  }

  std::string line_place() const { return table_.source + ":" + std::to_string(line_); }

  [[noreturn]] void fail_ragged() const {
    const std::size_t shared = std::min(fields_.size(), layout_.columns());
    throw UnreadLine(line_place() + ":" + std::to_string(shared + 1),
                    "the line has " + std::to_string(fields_.size()) +
                        (fields_.size() == 1 ? " field" : " fields") + ", the others have " +
                        std::to_string(layout_.columns()),
                    "give every line the same number of fields (an empty one is a missing "
                    "value) or remove this line");
  }

  [[noreturn]] void fail_text(std::string_view field, Index column) const {
    constexpr std::size_t kShown = 40;  // for people
    const std::string shown(field.substr(0, kShown));
    const std::string& name = table_.columns[static_cast<std::size_t>(column)].name;
    throw UnreadLine(
        line_place() + ":" + std::to_string(style_.place_of(column) + 1),
        "'" + shown + "' in column '" + name + "' is not a number",
        "write a number, leave the field empty when the value is missing, or remove "
        "a column of text");
  }

  [[noreturn]] void fail_comma(std::string_view field, Index column) const {
    const std::string& name = table_.columns[static_cast<std::size_t>(column)].name;
    throw DataError(line_place() + ":" + std::to_string(style_.place_of(column) + 1),
                    "the comma of '" + std::string(field) + "' in column '" + name +
                        "' may be one of decimals or of thousands",
                    "write numbers with a decimal point and nothing between thousands");
  }

  const char* cursor_;
  const char* end_;
  const TextLayout& layout_;
  char delimiter_;
  char line_end_;
  const NumberStyle& style_;
  Index counted_;  ///< column of times that are counted; -1 where there is none
  bool is_plain_;  ///< no more than one column is counted
  Table& table_;
  Index columns_;
  std::size_t line_;
  std::vector<BadLine>& bad_;
  MissingWords& missing_;
  Index row_ = 0;
  Index stride_ = 0;  ///< between the columns of the table
  std::vector<std::string_view> fields_;
};

std::size_t lines_in(const std::string& header) {
  return static_cast<std::size_t>(std::count(header.begin(), header.end(), '\n'));
}

/// Number in the file of a line of what a dialect has made of it; 0 for those in front of it.
std::size_t line_in_file(std::size_t line, const TextFormat& format) {
  const std::size_t added = format.dialect ? lines_in(format.dialect->header) : 0;
  return line - std::min(line, added);
}

Table columns_of(const TextFormat& format, const std::string& source) {
  Table table;
  table.source = source;
  if (format.layout.note) table.notes.push_back(*format.layout.note);
  std::optional<std::size_t> header = format.layout.header_line;
  if (header) header = line_in_file(*header, format);
  if (header == 0U) header.reset();
  name_columns(table, format.layout.headers, header);
  if (!format.dialect) return table;
  if (!format.dialect->note.empty())
    table.notes.insert(table.notes.begin(), source + ": " + format.dialect->note);
  table.run_column = format.dialect->run_column;
  table.clock_start = format.dialect->clock_start;
  return table;
}

/// Calls use(fields) for each of the first lines of numbers.
template <class Use>
void for_each_line(const TextFormat& format, const Use& use) {
  std::string_view rest = format.first_lines;
  std::vector<std::string_view> fields;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(format.layout.line_end), rest.size());
    const std::string_view line = strip(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty() || line.front() == '#') continue;
    split_fields(line, format.layout.delimiter, fields);
    use(fields);
  }
}

/// Looks at the first lines; what is worth saying of the times becomes notes of the table.
NumberStyle style_of(const TextFormat& format, const TimeFinder& find, Table& table) {
  NumberStyle style;
  style.delimiter = format.layout.delimiter;
  if (format.dialect) {
    style.first_own = format.dialect->makes_first ? 1 : 0;
    style.places = format.dialect->places;
    style.clocks = format.dialect->clocks;
    if (format.dialect->delimiter != '\0') style.delimiter = format.dialect->delimiter;
  }
  std::vector<Stamp> times;
  const auto time = find(table);
  for_each_line(format, [&](const std::vector<std::string_view>& fields) {
    for (std::size_t i = style.first_own; i < fields.size(); ++i)
      style.has_points = style.has_points || has_point(fields[i]);
    if (!time || static_cast<std::size_t>(time->column) >= fields.size()) return;
    if (const auto stamp = read_stamp(fields[static_cast<std::size_t>(time->column)]))
      times.push_back(*stamp);
  });
  if (!time) return style;
  if (const auto origin = look_at_times(table, *time, times)) {
    style.time = time->column;
    style.origin = *origin;
  }
  return style;
}

}  // namespace

TextRows::TextRows(TextFormat format, const std::string& source, const TimeFinder& find)
    : format_(std::move(format)),
      columns_(columns_of(format_, source)),
      skipped_(format_.layout.data_begin),
      line_(line_in_file(format_.layout.data_line, format_)),
      style_(style_of(format_, find, columns_)) {
  file_columns_ = columns_;
  if (!style_.clocks.empty())
    columns_ = without_further_clocks(std::move(columns_), style_.clocks);
}

void TextRows::read(std::string_view lines, Table& table, bool is_all) {
  if (style_.clocks.empty()) return read_lines(lines, table);
  Table rows = file_columns_;
  read_lines(lines, rows);
  const bool is_one = are_one_clock(rows, style_.clocks);
  if (!is_one && !is_all)
    throw DataError(columns_.source,
                    "channels with times of their own cannot be read in pieces",
                    "leave out --memory");
  rows = with_one_clock(rows, style_.clocks);
  table.values = std::move(rows.values);
  table.lines = std::move(rows.lines);
  table.own_times = !is_one;
  clocks_note_ = is_one ? "all channels have the same times"
                        : "channels have times of their own; there is a row for each of the " +
                              std::to_string(table.values.rows()) + " times";
}

void TextRows::read_lines(std::string_view lines, Table& table) {
  std::string plain;
  if (format_.dialect) {
    if (skipped_ > 0) plain = format_.dialect->header;
    plain += translated(*format_.dialect, lines, columns_.source);
    lines = plain;
  }
  lines.remove_prefix(std::exchange(skipped_, 0));
  line_ = RowReader(lines, format_.layout, style_, line_, table, bad_, missing_).read();
  ends_.take(lines, table);
  samples_ += table.lines.size();
  if (!table.lines.empty()) last_sample_ = table.lines.back();
}

void TextRows::finish() {
  std::vector<std::string> notes =
      notes_of_damage(bad_, samples_, last_sample_, columns_.source);
  std::vector<std::string> ends = ends_.notes(file_columns_);
  std::move(notes.begin(), notes.end(), std::back_inserter(columns_.notes));
  std::move(ends.begin(), ends.end(), std::back_inserter(columns_.notes));
  if (missing_.count > 0)
    columns_.notes.push_back(missing_.place + ": " + std::to_string(missing_.count) +
                             (missing_.count == 1 ? " cell says" : " cells say") +
                             " that a value is missing, here '" + missing_.word + "'");
  if (!clocks_note_.empty())
    columns_.notes.push_back(columns_.source + ": " + clocks_note_);
}

}  // namespace lacuna
