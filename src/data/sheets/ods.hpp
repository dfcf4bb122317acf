// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "core/files/zip_reader.hpp"

namespace lacuna {

/// sheet_text() of OpenDocument.
std::string ods_text(const ZipArchive& archive, const std::optional<std::string>& sheet);

}  // namespace lacuna
