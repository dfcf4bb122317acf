// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lacuna {

/// A file that is no record, and what to do with it.
struct KnownFile {
  std::string what;    ///< "an Excel workbook"
  std::string remedy;  ///< "save the sheet as .csv"
};

/// What a file looks like by its first bytes, where it is one that cannot be read.
std::optional<KnownFile> known_file(std::string_view bytes);

}  // namespace lacuna
