// SPDX-License-Identifier: MIT
#include "dialects.hpp"

#include "data/records/text_field.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {

std::optional<std::string_view> Lines::next() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::vector<std::string_view> fields_of(std::string_view line, char delimiter) {
  std::vector<std::string_view> fields;
  split_fields(line, delimiter, fields);
  return fields;
}

std::string joined_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : ";") + field;
  return line + "\n";
}

namespace {

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  return text.starts_with(kByteOrderMark) ? text.substr(kByteOrderMark.size()) : text;
}

}  // namespace

std::optional<TextDialect> dialect_of(std::string_view begin) {
  begin = without_byte_order_mark(begin);
  for (const auto dialect :
       {dialects::rigol, dialects::tektronix, dialects::labview, dialects::ngspice_raw,
        dialects::stepped_ltspice, dialects::ngspice_print, dialects::ngspice_wrdata})
    if (auto found = dialect(begin)) return found;
  return std::nullopt;
}

std::string translated(TextDialect& dialect, std::string_view lines,
                       const std::string& source) {
  std::string text;
  text.reserve(lines.size() + lines.size() / 8);
  Lines rest(without_byte_order_mark(lines));
  try {
    while (const auto line = rest.next()) dialect.translate(*line, text);
  } catch (const LineProblem& found) {
    throw DataError(
        source + ":" + std::to_string(found.line) + ":" + std::to_string(found.column),
        found.problem, found.remedy);
  }
  return text;
}

}  // namespace lacuna
