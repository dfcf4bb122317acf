// SPDX-License-Identifier: MIT
#include "data/formats/read_text.hpp"

#include "core/base/utf16.hpp"
#include "text_rows.hpp"

namespace lacuna {
namespace {

/// Looked for in so much of the text as shows it.
TextFormat format_of(std::string_view text, const std::string& source) {
  for (std::size_t size = TextFormat::kBegin; size < text.size(); size *= 2)
    if (auto format = find_format(text.substr(0, size), false, source)) return *format;
  return *find_format(text, true, source);
}

}  // namespace

Table parse_text_table(std::string_view text, const std::string& source) {
  return parse_text(text, source, no_time);
}

Table parse_text(std::string_view text, const std::string& source, const TimeFinder& find) {
  if (auto decode = Utf16Decoder::for_text(text)) return parse_text((*decode)(text), source, find);
  TextRows rows(format_of(text, source), source, find);
  Table table = rows.columns();
  rows.read(text, table, true);
  rows.finish();
  table.notes = rows.columns().notes;
  return table;
}

}  // namespace lacuna
