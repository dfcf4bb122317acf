// SPDX-License-Identifier: MIT
// OpenDocument 1.3, part 3, chapters 9 and 19.
#include "data/sheets/ods.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include "core/base/text.hpp"
#include "data/sheets/sheet_text.hpp"
#include "data/sheets/xlsx.hpp"
#include "data/sheets/xml.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

constexpr const char* kContent = "content.xml";

std::string value_in(const XmlAttributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? "" : found->second;
}

/// How often a cell or a row stands there: 1 without the attribute.
std::size_t repeats_in(const XmlAttributes& attributes, const std::string& name) {
  const std::string text = value_in(attributes, name);
  std::size_t number = 1;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return std::max<std::size_t>(number, 1);
}

/// "PT10H00M00.5S" in seconds, with their unit; as it stands where it is none.
std::string seconds_of_span(const std::string& text) {
  double seconds = 0.0;
  bool is_time = false;
  std::string digits;
  for (const char c : text) {
    if (c == 'T') is_time = true;
    if ((c >= '0' && c <= '9') || c == '.') {
      digits += c;
      continue;
    }
    const double number = parse_number(digits).value_or(0.0);
    digits.clear();
    if (c == 'D') seconds += 86400.0 * number;
    if (c == 'H') seconds += 3600.0 * number;
    if (c == 'M' && is_time) seconds += 60.0 * number;
    if (c == 'S') seconds += number;
  }
  return format_number(text.starts_with('-') ? -seconds : seconds) + " s";
}

/// A cell while it is read.
struct OpenOdsCell {
  std::string value;  ///< by its attributes
  std::string text;   ///< as it is shown
  std::size_t repeats = 1;
  bool has_value = false;
};

OpenOdsCell cell_of(const XmlAttributes& attributes) {
  OpenOdsCell cell;
  cell.repeats = repeats_in(attributes, "table:number-columns-repeated");
  const std::string kind = value_in(attributes, "office:value-type");
  cell.has_value = !kind.empty() && kind != "string";
  if (kind == "date")
    cell.value = value_in(attributes, "office:date-value");
  else if (kind == "time")
    cell.value = seconds_of_span(value_in(attributes, "office:time-value"));
  else if (kind == "boolean")
    cell.value = value_in(attributes, "office:boolean-value") == "true" ? "1" : "0";
  else
    cell.value = value_in(attributes, "office:value");
  return cell;
}

std::vector<std::string> names_of_sheets(const std::string& content,
                                         const std::string& source) {
  std::vector<std::string> names;
  const auto begin = [&](std::string_view name, const XmlAttributes& attributes) {
    if (name == "table") names.push_back(value_in(attributes, "table:name"));
  };
  read_xml(content, {begin, [](std::string_view) {}, [](std::string_view) {}}, source);
  return names;
}

/// Cells of one row, of which blank ones at the end are none.
struct OdsRow {
  std::vector<std::pair<std::size_t, std::string>> cells;  ///< with their columns
  std::size_t columns = 0, repeats = 1;

  void add(const OpenOdsCell& cell, const std::string& source) {
    const std::string& text = cell.has_value ? cell.value : cell.text;
    constexpr std::size_t kMostColumns = 16384;  // of Calc and Excel
    if (!text.empty() && cell.repeats > kMostColumns)
      throw DataError(source, "a cell is repeated " + std::to_string(cell.repeats) + " times",
                      "check that it is a record, and save the sheet as .csv");
    for (std::size_t i = 0; i < cell.repeats && !text.empty(); ++i)
      cells.emplace_back(columns + i, text);
    columns += cell.repeats;
  }
};

SheetRows read_ods_cells(const std::string& content, std::size_t sheet,
                         const std::string& source) {
  SheetRows rows(source);
  OdsRow row;
  OpenOdsCell cell;
  std::size_t table = 0, next_row = 0;
  bool is_text = false, is_note = false;
  const auto is_cell = [](std::string_view name) {
    return name == "table-cell" || name == "covered-table-cell";
  };
  const auto begin = [&](std::string_view name, const XmlAttributes& attributes) {
    if (name == "table") ++table;
    if (table != sheet + 1) return;
    if (name == "table-row")
      row = {{}, 0, repeats_in(attributes, "table:number-rows-repeated")};
    if (is_cell(name)) cell = cell_of(attributes);
    if (name == "annotation") is_note = true;
    is_text = is_text || (name == "p" && !is_note);
  };
  const auto end = [&](std::string_view name) {
    if (table != sheet + 1) return;
    if (name == "annotation") is_note = false;
    if (name == "p") is_text = false;
    if (is_cell(name)) row.add(cell, source);
    if (name != "table-row") return;
    rows.expect(row.cells.empty() ? 0 : row.repeats);
    rows.expect(row.repeats * row.cells.size());  // no more than 2^20 times 2^14, or refused
    for (std::size_t i = 0; i < row.repeats && !row.cells.empty(); ++i)
      for (const auto& [column, text] : row.cells) rows.put(next_row + i, column, text);
    next_row += row.repeats;
  };
  const auto text = [&](std::string_view part) {
    if (is_text) cell.text += part;
  };
  read_xml(content, {begin, end, text}, source);
  return rows;
}

}  // namespace

std::string ods_text(const ZipArchive& archive, const std::optional<std::string>& sheet) {
  const ZipEntry* entry = find_entry(archive, kContent);
  if (entry == nullptr)
    throw DataError(archive.source, "there is no sheet in it", archive.remedy);
  const std::string content = unpacked(archive, *entry, kMostSheetBytes);
  const std::size_t chosen =
      chosen_sheet(names_of_sheets(content, archive.source), sheet, archive.source);
  return read_ods_cells(content, chosen, archive.source).text();
}

}  // namespace lacuna
