// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lacuna {

/// The whole content of a file, unpacked when it is compressed by gzip (seen by its first
/// bytes, whatever its name).
/// @throws FileError when it cannot be opened or read; DataError when the packing is damaged.
std::string read_bytes(const std::filesystem::path& path);

/// Unpacks gzip data; several members one after the other are joined.
/// @param source name for messages.
/// @throws DataError when the data are damaged or cut short.
std::string gunzip(std::string_view packed, const std::string& source);

/// Packs by gzip; the same bytes for the same content (no name, no date inside).
std::string gzip(std::string_view content);

}  // namespace lacuna
