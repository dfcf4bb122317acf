// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lacuna {

/// Whether a zip archive is a workbook: .xlsx or .ods.
bool is_workbook(std::string_view bytes);

/// A sheet of a workbook (Office Open XML, ECMA-376; OpenDocument 1.3) as a text with tabs.
/// Dates are as in ISO 8601, spans of time seconds with their unit; what a formula gives is
/// there, an error is a blank cell.
/// @param sheet its name; the first one without.
/// @throws DataError where it is damaged, has no such sheet, or is a bomb: parts that unpack to
///   more than 512 MB, entities, cells without end.
std::string sheet_text(std::string_view bytes, const std::optional<std::string>& sheet,
                       const std::string& source);

}  // namespace lacuna
