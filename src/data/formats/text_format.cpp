// SPDX-License-Identifier: MIT
// How a text is to be read.
#include <algorithm>
#include <set>
#include <vector>

#include "data/logs/damage.hpp"
#include "data/records/text_field.hpp"
#include "lacuna/core/base/error.hpp"
#include "text_rows.hpp"

namespace lacuna {
namespace {

/// A few stray bytes are damage of their lines; more are no text.
void check_is_text(std::string_view text, const std::string& source) {
  constexpr std::size_t kLooked = 4096;
  // A decision, of all bytes: a tenth of those of packed files are stray (a fact of bytes that are
  // all as frequent), of a logger that was cut off a few.
  constexpr double kMost = 0.01;
  const std::string_view looked = text.substr(0, kLooked);
  const auto stray =
      static_cast<double>(std::count_if(looked.begin(), looked.end(), is_stray_byte));
  if (looked.find('\0') != std::string_view::npos &&
      stray > kMost * static_cast<double>(looked.size()))
    throw DataError(source, "the file is binary, not text: it has bytes of zero",
                    "give delimited text (.csv, .txt, .gz) or NumPy's .npy; save UTF-16 with "
                    "its byte order mark, or as UTF-8");
}

/// So many lines, or all.
std::string first_of(std::string_view lines, Index count, char line_end) {
  std::size_t end = 0;
  for (Index i = 0; i < count && end < lines.size(); ++i)
    end = std::min(lines.find(line_end, end), lines.size() - 1) + 1;
  return std::string(lines.substr(0, end));
}

/// Whether no two columns have one name.
bool has_distinct_names(const TextLayout& layout) {
  std::set<std::string> seen;
  return std::all_of(layout.headers.begin(), layout.headers.end(), [&](const Quantity& header) {
    return header.name.empty() || seen.insert(header.name).second;
  });
}

/// Whether the first lines are those of a plain table: nine in ten are numbers.
bool reads_plainly(std::string_view begin, const std::string& source) {
  constexpr double kUsual = 0.9;  // as in find_log_layout()
  TextLayout layout;
  try {
    layout = find_layout(begin, source);
  } catch (const DataError&) {
    return false;
  }
  if (!has_distinct_names(layout)) return false;
  std::string lines =
      first_of(begin.substr(layout.data_begin), kFirstTimes, layout.line_end);
  std::replace(lines.begin(), lines.end(), layout.line_end, '\n');
  Lines rest(lines);
  std::vector<std::string_view> fields;
  double all = 0.0, good = 0.0;
  while (const auto line = rest.next()) {
    const std::string_view content = strip(*line);
    if (is_summary(content)) break;
    if (content.empty() || content.front() == '#') continue;
    split_fields(*line, layout.delimiter, fields);
    all += 1.0;
    good += std::none_of(fields.begin(), fields.end(),
                         [](std::string_view field) {
                           return read_field(field).kind == TextField::Kind::Text;
                         })
                ? 1.0
                : 0.0;
  }
  return good >= kUsual * all;
}

/// An instrument's, or a logger's where the text is no plain table.
std::optional<TextDialect> dialect_for(std::string_view begin, const std::string& source) {
  if (auto dialect = dialect_of(begin)) return dialect;
  if (reads_plainly(begin, source)) return std::nullopt;
  return dialects::log_of_device(begin);
}

}  // namespace

std::string_view whole_lines(std::string_view text, char line_end) {
  // A '\r' at the end may be half of a line end.
  if (line_end == '\r' && text.ends_with('\r')) text.remove_suffix(1);
  const std::size_t end = text.rfind(line_end);
  return text.substr(0, end == std::string_view::npos ? 0 : end + 1);
}

std::optional<TextFormat> find_format(std::string_view begin, bool is_all,
                                      const std::string& source) {
  check_is_text(begin, source);
  const bool is_short = is_all && begin.size() <= TextFormat::kBegin;
  const std::string_view looked = begin.substr(0, TextFormat::kBegin);
  TextFormat format{dialect_for(is_short ? begin : whole_lines(looked, '\n'), source), {}};
  if (!is_all) begin = whole_lines(begin, line_end_of(begin));
  std::string plain;
  if (format.dialect) {
    TextDialect dialect = *format.dialect;  // which begins anew when rows are read
    plain = dialect.header + translated(dialect, begin, source);
    begin = plain;
  }
  try {
    format.layout = find_layout(begin, source);
  } catch (const DataError&) {
    if (is_all) throw;
    return std::nullopt;
  }
  if (!is_all && !shows_layout(begin, format.layout)) return std::nullopt;
  format.first_lines =
      first_of(begin.substr(format.layout.data_begin), kFirstTimes, format.layout.line_end);
  return format;
}

}  // namespace lacuna
