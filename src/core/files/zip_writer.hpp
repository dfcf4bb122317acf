// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace lacuna {

/// A file of an archive.
struct ZippedFile {
  std::string name;  ///< with '/' between folders
  std::string bytes;
};

/// An archive of the format ZIP (APPNOTE 6.3.3, sections 4.3.7, 4.3.12 and 4.3.16) that holds the
/// files as they are, not compressed, of 1 January 1980: the same files give the same bytes.
/// @throws FileError for a file, or an archive, of 4 GB or more.
std::string zip_of(const std::vector<ZippedFile>& entries);

}  // namespace lacuna
