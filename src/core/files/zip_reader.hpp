// SPDX-License-Identifier: MIT
// Zip archives (PKWARE, APPNOTE 6.3): those of NumPy's .npz, .xlsx and .ods.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// One file of an archive, as the central directory lists it.
struct ZipEntry {
  std::string name;
  std::size_t size = 0;  ///< unpacked, as it is said
  std::size_t packed = 0, local = 0, checksum = 0;
  std::size_t method = 0;  ///< 0 stored, 8 deflated
};

/// A zip archive that is in memory.
struct ZipArchive {
  std::string_view bytes;
  std::string source;  ///< for messages
  std::string remedy;  ///< what to do about a damaged one
  std::vector<ZipEntry> entries;
};

/// Lists an archive. @throws DataError where it is cut short or damaged, or entries have bytes in
/// common.
ZipArchive open_zip(std::string_view bytes, const std::string& source,
                    const std::string& remedy);

/// The entry of a name; nullptr where there is none.
const ZipEntry* find_entry(const ZipArchive& archive, std::string_view name);

/// What stands in an entry.
/// @param most bytes that it may have.
/// @throws DataError for one that is larger, damaged (by its checksum too), or packed otherwise.
std::string unpacked(const ZipArchive& archive, const ZipEntry& entry, std::size_t most);

}  // namespace lacuna
