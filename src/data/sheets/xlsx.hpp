// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/files/zip_reader.hpp"

namespace lacuna {

/// A part of a workbook may unpack to so many bytes: ten million cells take less.
inline constexpr std::size_t kMostSheetBytes = std::size_t{1} << 29U;

/// Number of the sheet of a name, of the first one without.
/// @throws DataError where there is none.
std::size_t chosen_sheet(const std::vector<std::string>& names,
                         const std::optional<std::string>& sheet, const std::string& source);

/// sheet_text() of Office Open XML.
std::string xlsx_text(const ZipArchive& archive, const std::optional<std::string>& sheet);

}  // namespace lacuna
