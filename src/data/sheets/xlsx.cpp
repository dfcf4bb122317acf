// SPDX-License-Identifier: MIT
// Office Open XML (ECMA-376, part 1, chapter 18).
#include "data/sheets/xlsx.hpp"

#include <charconv>
#include <map>

#include "core/base/text.hpp"
#include "data/sheets/sheet_text.hpp"
#include "data/sheets/xml.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

std::string attribute(const XmlAttributes& attributes, const std::string& name) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? "" : found->second;
}

std::size_t whole_number(std::string_view text) {
  std::size_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

void nothing_at_end(std::string_view) {}
void nothing_of_text(std::string_view) {}

void read_part(const ZipArchive& archive, const std::string& name, const XmlHandler& handler) {
  if (const ZipEntry* entry = find_entry(archive, name))
    read_xml(unpacked(archive, *entry, kMostSheetBytes), handler, archive.source + ", " + name);
}

/// What the workbook says of its sheets.
struct Book {
  std::vector<std::string> names, relations;
  bool since_1904 = false;
};

Book read_book(const ZipArchive& archive) {
  Book book;
  const auto begin = [&](std::string_view name, const XmlAttributes& attributes) {
    if (name == "sheet") {
      book.names.push_back(attribute(attributes, "name"));
      book.relations.push_back(attribute(attributes, "r:id"));
    }
    const std::string date = attribute(attributes, "date1904");
    if (name == "workbookPr") book.since_1904 = date == "1" || date == "true";
  };
  read_part(archive, "xl/workbook.xml", {begin, nothing_at_end, nothing_of_text});
  return book;
}

/// The file of a sheet by its relation; the usual name where nothing says it.
std::string file_of_sheet(const ZipArchive& archive, const Book& book, std::size_t sheet) {
  std::string file = "worksheets/sheet" + std::to_string(sheet + 1) + ".xml";
  const auto begin = [&](std::string_view name, const XmlAttributes& attributes) {
    if (name == "Relationship" && attribute(attributes, "Id") == book.relations[sheet])
      file = attribute(attributes, "Target");
  };
  read_part(archive, "xl/_rels/workbook.xml.rels", {begin, nothing_at_end, nothing_of_text});
  return file.starts_with('/') ? file.substr(1) : "xl/" + file;
}

/// Texts that cells name by their numbers; what is written by sound is left out.
std::vector<std::string> shared_texts(const ZipArchive& archive) {
  std::vector<std::string> texts;
  bool is_text = false, is_sound = false;
  const auto begin = [&](std::string_view name, const XmlAttributes&) {
    if (name == "si") texts.emplace_back();
    if (name == "rPh") is_sound = true;
    is_text = name == "t" && !is_sound;
  };
  const auto end = [&](std::string_view name) {
    is_text = false;
    if (name == "rPh") is_sound = false;
  };
  const auto text = [&](std::string_view part) {
    if (is_text && !texts.empty()) texts.back() += part;
  };
  read_part(archive, "xl/sharedStrings.xml", {begin, end, text});
  return texts;
}

/// Formats of numbers that are dates without being written out (18.8.30).
bool is_built_in_date(std::size_t format) {
  return (format >= 14 && format <= 22) || (format >= 27 && format <= 36) ||
         (format >= 45 && format <= 47) || (format >= 50 && format <= 58);
}

/// Whether cells of each style are dates.
std::vector<bool> date_styles(const ZipArchive& archive) {
  std::map<std::size_t, bool> own;
  std::vector<bool> styles;
  bool in_cells = false;
  const auto begin = [&](std::string_view name, const XmlAttributes& attributes) {
    const std::size_t format = whole_number(attribute(attributes, "numFmtId"));
    if (name == "numFmt") own[format] = is_date_format(attribute(attributes, "formatCode"));
    if (name == "cellXfs") in_cells = true;
    if (name != "xf" || !in_cells) return;
    const auto found = own.find(format);
    styles.push_back(found != own.end() ? found->second : is_built_in_date(format));
  };
  const auto end = [&](std::string_view name) {
    if (name == "cellXfs") in_cells = false;
  };
  read_part(archive, "xl/styles.xml", {begin, end, nothing_of_text});
  return styles;
}

/// Column of a reference such as "AB12", from 0; nothing where it has no letters.
std::optional<std::size_t> column_of_reference(std::string_view reference) {
  constexpr std::size_t kLetters = 26, kLongest = 4;
  std::size_t column = 0, count = 0;
  while (count < reference.size() && count < kLongest && reference[count] >= 'A' &&
         reference[count] <= 'Z')
    column = column * kLetters + static_cast<std::size_t>(reference[count++] - 'A') + 1;
  if (count == 0) return std::nullopt;
  return column - 1;
}

/// A cell while it is read.
struct OpenCell {
  std::size_t row = 0, column = 0;
  std::string kind, text;
  std::size_t style = 0;
};

/// What cells need beside their sheet.
struct CellTables {
  std::vector<std::string> texts;
  std::vector<bool> is_date;
  bool since_1904 = false;
};

/// @throws DataError where it names a text that there is not.
std::string text_of(const OpenCell& cell, const CellTables& tables, const std::string& source) {
  if (cell.kind == "e") return "";
  if (cell.kind == "s") {
    const std::size_t number = whole_number(cell.text);
    if (number < tables.texts.size()) return tables.texts[number];
    throw DataError(source, "a cell in row " + std::to_string(cell.row + 1) +
                                " names a text that is not there",
                    "the file is damaged; save the sheet again, or as .csv");
  }
  const bool is_number = cell.kind.empty() || cell.kind == "n";
  if (!is_number || cell.style >= tables.is_date.size() || !tables.is_date[cell.style])
    return cell.text;
  const auto days = parse_number(cell.text);
  constexpr double kMostDays = 1e7;  // beyond the last year that there is in a sheet
  if (!days || !(std::abs(*days) < kMostDays)) return cell.text;
  return date_of_serial(*days, tables.since_1904);
}

SheetRows read_cells(const ZipArchive& archive, const std::string& file,
                     const CellTables& tables) {
  SheetRows rows(archive.source);
  OpenCell cell;
  std::size_t next_row = 0, next_column = 0;
  bool is_value = false;
  const auto begin = [&](std::string_view name, const XmlAttributes& attributes) {
    if (name == "row") {
      const std::size_t number = whole_number(attribute(attributes, "r"));
      cell.row = number > 0 ? number - 1 : next_row;
      next_row = cell.row + 1;
      next_column = 0;
    } else if (name == "c") {
      const auto column = column_of_reference(attribute(attributes, "r"));
      cell.column = column.value_or(next_column);
      next_column = cell.column + 1;
      cell.kind = attribute(attributes, "t");
      cell.style = whole_number(attribute(attributes, "s"));
      cell.text.clear();
    }
    is_value = name == "v" || (name == "t" && cell.kind == "inlineStr");
  };
  const auto end = [&](std::string_view name) {
    is_value = false;
    if (name == "c") rows.put(cell.row, cell.column, text_of(cell, tables, archive.source));
  };
  const auto text = [&](std::string_view part) {
    if (is_value) cell.text += part;
  };
  read_part(archive, file, {begin, end, text});
  return rows;
}

}  // namespace

std::string xlsx_text(const ZipArchive& archive, const std::optional<std::string>& sheet) {
  const Book book = read_book(archive);
  const std::size_t chosen = chosen_sheet(book.names, sheet, archive.source);
  const std::string file = file_of_sheet(archive, book, chosen);
  if (find_entry(archive, file) == nullptr)
    throw DataError(archive.source, "the sheet '" + book.names[chosen] + "' has no cells",
                    archive.remedy);
  return read_cells(archive, file,
                    {shared_texts(archive), date_styles(archive), book.since_1904})
      .text();
}

}  // namespace lacuna
