// SPDX-License-Identifier: MIT
#include "data/sheets/workbook.hpp"

#include <vector>

#include "core/base/text.hpp"
#include "data/sheets/ods.hpp"
#include "data/sheets/xlsx.hpp"
#include "core/files/zip_reader.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {

bool is_workbook(std::string_view bytes) {
  const auto has = [&](std::string_view name) {
    return bytes.find(name) != std::string_view::npos;
  };
  return bytes.starts_with("PK\x03\x04") &&
         (has("xl/workbook") || has("opendocument.spreadsheet"));
}

std::size_t chosen_sheet(const std::vector<std::string>& names,
                         const std::optional<std::string>& sheet, const std::string& source) {
  if (names.empty()) throw DataError(source, "there is no sheet in it", "save it as .csv");
  if (!sheet) return 0;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == *sheet) return i;
  throw DataError(source, "there is no sheet '" + *sheet + "'", suggestion(*sheet, names));
}

std::string sheet_text(std::string_view bytes, const std::optional<std::string>& sheet,
                       const std::string& source) {
  const ZipArchive archive =
      open_zip(bytes, source, "save it again, or the sheet as .csv");
  return find_entry(archive, "xl/workbook.xml") != nullptr ? xlsx_text(archive, sheet)
                                                           : ods_text(archive, sheet);
}

}  // namespace lacuna
