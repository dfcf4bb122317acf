// SPDX-License-Identifier: MIT
#include "text_layout.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "data/records/text_field.hpp"
#include "data/times/time_names.hpp"
#include "data/units/units.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {
namespace {

constexpr std::array<char, 4> kDelimiters{',', ';', '\t', ' '};

/// Line of a text that is neither empty nor a comment.
struct Line {
  std::string_view text;
  std::size_t offset = 0;
  std::size_t number = 0;
};

/// Walks over the lines that are neither empty nor comments.
class LineCursor {
 public:
  LineCursor(std::string_view text, std::size_t offset, char line_end)
      : text_(text), offset_(offset), line_end_(line_end) {}

  std::optional<Line> next() {
    while (offset_ < text_.size()) {
      const std::size_t begin = offset_;
      const std::size_t end = std::min(text_.find(line_end_, begin), text_.size());
      offset_ = end + 1;
      ++number_;
      const std::string_view line = strip(text_.substr(begin, end - begin));
      if (line.empty() || line.front() == '#') continue;
      return Line{text_.substr(begin, end - begin), begin, number_};
    }
    return std::nullopt;
  }

 private:
  std::string_view text_;
  std::size_t offset_;
  std::size_t number_ = 0;
  char line_end_;
};

/// What the fields of a line are, taken together.
struct LineKind {
  std::size_t fields = 0;
  std::size_t numbers = 0;
  std::size_t texts = 0;
  bool filled = false;  ///< some field is neither empty nor a dash, which lines of names have too

  bool is_data() const { return texts == 0 && filled; }
  bool is_mixed() const { return texts > 0 && numbers > 0; }
};

LineKind kind_of(std::string_view line, char delimiter) {
  std::vector<std::string_view> fields;
  split_fields(line, delimiter, fields);
  LineKind kind;
  kind.fields = fields.size();
  for (const std::string_view field : fields) {
    const TextField::Kind found = read_field(field).kind;
    kind.numbers += found == TextField::Kind::Number ? 1U : 0U;
    kind.texts += found == TextField::Kind::Text ? 1U : 0U;
    kind.filled = kind.filled || (!field.empty() && field != "-");
  }
  return kind;
}

/// The delimiter under which every field of the line is a number or missing.
std::optional<char> data_delimiter(std::string_view line) {
  for (const char delimiter : kDelimiters) {
    const bool has_it = delimiter == ' ' || line.find(delimiter) != std::string_view::npos;
    const LineKind kind = kind_of(line, delimiter);
    // A single column has no delimiter; with the comma its name may contain blanks.
    if (has_it && kind.is_data()) return kind.fields == 1 ? ',' : delimiter;
  }
  return std::nullopt;
}

/// Names such as "time,1,2" show a header although numbers stand in it.
bool starts_with_time(std::string_view line, char delimiter) {
  std::vector<std::string_view> fields;
  split_fields(line, delimiter, fields);
  const std::string name = lower_case(split_header(fields[0]).name);
  return name == "t" || name == "time";
}

/// The delimiter under which the line is so many names, nothing when there is none.
std::optional<char> header_delimiter(std::string_view line, std::size_t columns,
                                     char preferred) {
  const auto fits = [&](char delimiter) {
    const LineKind kind = kind_of(line, delimiter);
    if (kind.fields != columns || kind.texts == 0) return false;
    return kind.numbers == 0 || starts_with_time(line, delimiter);
  };
  if (fits(preferred)) return preferred;
  for (const char delimiter : kDelimiters)
    if (columns > 1 && fits(delimiter)) return delimiter;
  return std::nullopt;
}

/// The lines around the start of the data.
struct Start {
  Line first;  ///< first line of numbers
  char delimiter = ',';
  std::vector<Line> before;  ///< lines in front of it, the last one at the end
};

/// A lone number in a preamble looks like data; it is not when names and numbers that fit each
/// other follow at once.
bool is_lone_number(const Start& start, LineCursor cursor) {
  const auto names = cursor.next();
  const auto numbers = cursor.next();
  if (!names || !numbers) return false;
  const auto delimiter = data_delimiter(numbers->text);
  if (!delimiter) return false;
  const std::size_t columns = kind_of(numbers->text, *delimiter).fields;
  if (columns == kind_of(start.first.text, *delimiter).fields) return false;
  return header_delimiter(names->text, columns, *delimiter).has_value();
}

[[noreturn]] void fail_no_numbers(const std::vector<Line>& lines, const std::string& source) {
  for (std::size_t i = 1; i < lines.size(); ++i) {
    for (const char delimiter : kDelimiters) {
      std::vector<std::string_view> fields;
      split_fields(lines[i].text, delimiter, fields);
      const LineKind kind = kind_of(lines[i].text, delimiter);
      if (!kind.is_mixed() || kind.fields != kind_of(lines[i - 1].text, delimiter).fields)
        continue;
      const auto text = std::find_if(fields.begin(), fields.end(), [](std::string_view field) {
        return read_field(field).kind == TextField::Kind::Text;
      });
      const auto column = text - fields.begin() + 1;
      throw DataError(
          source + ":" + std::to_string(lines[i].number) + ":" + std::to_string(column),
          "'" + std::string(*text) + "' is not a number",
          "remove the column of text or leave missing values empty");
    }
  }
  throw DataError(source, lines.empty() ? "the file is empty" : "there is no line of numbers",
                  "give a file with a header line and lines of numbers");
}

Start find_start(std::string_view text, std::size_t offset, char line_end,
                 const std::string& source) {
  LineCursor cursor(text, offset, line_end);
  std::vector<Line> before;
  while (const auto line = cursor.next()) {
    if (const auto delimiter = data_delimiter(line->text)) {
      Start start{*line, *delimiter, before};
      const std::size_t columns = kind_of(line->text, *delimiter).fields;
      const bool has_header =
          !before.empty() && header_delimiter(before.back().text, columns, *delimiter);
      if (has_header || !is_lone_number(start, cursor)) return start;
    }
    before.push_back(*line);
  }
  fail_no_numbers(before, source);
}

/// Whether the line below the names has a unit of time where these have the time; what stands
/// beside it is units then, known or not.
bool has_unit_of_time(const std::vector<std::string_view>& fields,
                      const std::vector<Quantity>& headers) {
  std::size_t time = 0;
  while (time < headers.size() && !names_time(headers[time].name)) ++time;
  const bool named = time < headers.size();
  if (!named) time = 0;
  return time_unit_symbol(fields[time]) && (named || fields[time].size() > 1);
}

std::vector<Quantity> read_names(std::string_view line, char delimiter) {
  std::vector<std::string_view> fields;
  split_fields(line, delimiter, fields);
  std::vector<Quantity> headers;
  for (const std::string_view field : fields) headers.push_back(split_header(field));
  return headers;
}

/// Whether the last two lines in front of the data are names and units.
bool take_names_and_units(const Start& start, std::size_t columns, TextLayout& layout) {
  if (start.before.size() < 2) return false;
  const Line& names = start.before[start.before.size() - 2];
  const LineKind kind = kind_of(names.text, start.delimiter);
  if (kind.fields != columns || kind.texts == 0) return false;
  layout.headers = read_names(names.text, start.delimiter);
  if (read_field(layout.headers[0].name).kind == TextField::Kind::Number) return false;
  layout.header_line = names.number;
  std::vector<std::string_view> units;
  split_fields(start.before.back().text, start.delimiter, units);
  return take_units(units, layout.headers);
}

void check_line_before(const Start& start, std::size_t columns, const std::string& source) {
  if (start.before.empty()) return;
  const Line& line = start.before.back();
  const LineKind kind = kind_of(line.text, start.delimiter);
  if (kind.fields < 2) return;  // prose
  const std::string place = source + ":" + std::to_string(line.number);
  if (kind.fields == columns && kind.is_mixed())
    throw DataError(place, "numbers and text stand in one line in front of the data",
                    "give numbers only, or start the line with # when it is a comment");
  throw DataError(place,
                  "the header has " + std::to_string(kind.fields) + " names, the data have " +
                      std::to_string(columns) + " columns",
                  "name every column, or start the line with # when it is no header");
}

/// Finds the names for data of so many columns in the lines in front of them.
bool take_header(const Start& start, std::size_t columns, TextLayout& layout) {
  if (take_names_and_units(start, columns, layout)) return true;
  layout.header_line.reset();
  layout.headers.assign(columns, Quantity{});
  if (start.before.empty()) return false;
  const Line& line = start.before.back();
  const auto delimiter = header_delimiter(line.text, columns, start.delimiter);
  if (!delimiter) return false;
  layout.headers = read_names(line.text, *delimiter);
  layout.header_line = line.number;
  return true;
}

/// Some instruments end each line with a delimiter: the last column has no name and no value.
void drop_trailing_column(const Start& start, TextLayout& layout) {
  std::vector<std::string_view> fields;
  split_fields(start.first.text, start.delimiter, fields);
  if (!layout.header_line || !fields.back().empty()) return;
  layout.trailing_delimiter =
      layout.headers.size() < fields.size() || layout.headers.back().name.empty();
  if (layout.headers.size() == fields.size() && layout.trailing_delimiter)
    layout.headers.pop_back();
}

void note_preamble(const Start& start, TextLayout& layout, const std::string& source) {
  const std::size_t header_number = layout.header_line.value_or(layout.data_line);
  const auto skipped =
      std::count_if(start.before.begin(), start.before.end(),
                    [&](const Line& line) { return line.number < header_number; });
  if (skipped == 0) return;
  layout.note = source + ":" + std::to_string(start.before.front().number) + ": " +
                std::to_string(skipped) +
                (skipped == 1 ? " preamble line skipped" : " preamble lines skipped");
}

}  // namespace

std::string unit_symbol(std::string_view field) {
  const bool bracketed = field.size() > 2 && ((field.front() == '(' && field.back() == ')') ||
                                              (field.front() == '[' && field.back() == ']'));
  if (bracketed) return std::string(strip(field.substr(1, field.size() - 2)));
  constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kWords{
      {{"second", "s"},
       {"seconds", "s"},
       {"sec", "s"},
       {"s", "s"},
       {"ms", "ms"},
       {"us", "us"},
       {"volt", "V"},
       {"volts", "V"},
       {"v", "V"},
       {"mv", "mV"},
       {"ampere", "A"},
       {"a", "A"}}};
  const std::string word = lower_case(field);
  for (const auto& [name, symbol] : kWords)
    if (word == name) return std::string(symbol);
  // One letter may be a name as well.
  return field.size() > 1 && read_unit(field) ? std::string(field) : "";
}

bool take_units(const std::vector<std::string_view>& fields, std::vector<Quantity>& headers) {
  if (fields.size() < headers.size()) return false;
  const bool any = has_unit_of_time(fields, headers);
  std::vector<std::string> units;
  for (const std::string_view field : fields) {
    units.push_back(unit_symbol(field));
    if (!units.back().empty() || field.empty() || field == "-") continue;
    if (!any) return false;
    units.back() = field;
  }
  for (std::size_t i = 0; i < headers.size(); ++i) headers[i].unit = units[i];
  return true;
}

char line_end_of(std::string_view text) {
  return text.find('\n') == std::string_view::npos ? '\r' : '\n';
}

TextLayout find_layout(std::string_view text, const std::string& source) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  TextLayout layout;
  layout.line_end = line_end_of(text);
  const std::size_t begin = text.substr(0, 3) == kByteOrderMark ? 3 : 0;
  const Start start = find_start(text, begin, layout.line_end, source);
  layout.delimiter = start.delimiter;
  layout.data_begin = start.first.offset;
  layout.data_line = start.first.number;
  std::vector<std::string_view> fields;
  split_fields(start.first.text, start.delimiter, fields);
  const std::size_t columns = fields.size();
  const bool open_end = columns > 1 && fields.back().empty();
  const bool named = take_header(start, columns, layout) ||
                     (open_end && take_header(start, columns - 1, layout));
  if (!named) {
    check_line_before(start, columns, source);
    layout.headers.assign(columns, Quantity{});
  }
  drop_trailing_column(start, layout);
  note_preamble(start, layout, source);
  return layout;
}

bool shows_layout(std::string_view begin, const TextLayout& layout) {
  constexpr int kLooked = 3;  // the first line of numbers, and two for is_lone_number()
  LineCursor cursor(begin, layout.data_begin, layout.line_end);
  for (int i = 0; i < kLooked; ++i)
    if (!cursor.next()) return false;
  return true;
}

}  // namespace lacuna
