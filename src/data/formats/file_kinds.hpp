// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// A file that is no record, and what to do with it.
struct KnownFile {
  std::string what;    ///< "an Excel workbook"
  std::string remedy;  ///< "save the sheet as .csv"
};

/// What a file looks like by its first bytes, where it is one that cannot be read.
std::optional<KnownFile> known_file(std::string_view bytes);

/// What can be read.
enum class FileKind {
  Npy,
  Npz,
  Mat,       ///< MATLAB's of version 5 to 7
  Workbook,  ///< .xlsx, .ods
  Hdf5,      ///< also MATLAB's of version 7.3, netCDF 4
  Text,
};

/// A file, and the sheet of a workbook: "book.xlsx#Sheet".
struct FileAndSheet {
  std::filesystem::path file;
  std::optional<std::string> sheet;
};

/// Takes a name apart; what exists as it is written names no sheet.
FileAndSheet file_and_sheet(const std::filesystem::path& path);

/// Every file that is there and that a word of a command line may name: as it stands, as a
/// pattern, in front of a '#' (the sheet of a workbook), between two '+' (files that are
/// joined);
/// "-" is standard input. It may name too many, never too few.
std::vector<std::filesystem::path> files_named(std::string_view word);

/// @throws DataError where a sheet is named of what is no workbook.
void check_sheet(const std::optional<std::string>& sheet, FileKind kind,
                 const std::string& source);

/// The kind of a file by the ending of its name and by its bytes, unpacked.
/// @param begin of them, or all.
/// @param source name for messages.
/// @throws DataError for well-known kinds that cannot be read.
FileKind kind_of(const std::filesystem::path& path, std::string_view begin,
                 const std::string& source);

}  // namespace lacuna
