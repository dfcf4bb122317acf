// SPDX-License-Identifier: MIT
#include "zip_archive.hpp"

#include <zlib.h>

#include <cstdint>
#include <limits>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

constexpr std::uint32_t kLocalHeader = 0x04034b50, kCentralHeader = 0x02014b50,
                        kEnd = 0x06054b50;
constexpr std::uint16_t kVersion = 20, kNamesAreUtf8 = 0x0800, kFirstDay = 0x0021;

/// Unix, and a file that its owner may run and all may read.
constexpr std::uint16_t kMadeBy = 0x0314;
constexpr std::uint32_t kMode = 0100755U << 16U;

std::string number(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i)
    text += static_cast<char>(static_cast<unsigned char>(value >> (8U * static_cast<unsigned>(i))));
  return text;
}

/// From the version up to the lengths of name and extra field, which both headers share.
std::string facts(const ZipEntry& entry) {
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(entry.bytes.data()),
                            entry.bytes.size());
  return number(kVersion, 2) + number(kNamesAreUtf8, 2) + number(0, 2) + number(0, 2) +
         number(kFirstDay, 2) + number(sum, 4) + number(entry.bytes.size(), 4) +
         number(entry.bytes.size(), 4) + number(entry.name.size(), 2) + number(0, 2);
}

void check_size(std::size_t size, const std::string& name) {
  if (size > std::numeric_limits<std::uint32_t>::max() / 2)
    throw FileError(name, "it is too large for a ZIP archive", "write it as a file of its own");
}

}  // namespace

std::string zip_archive(const std::vector<ZipEntry>& entries) {
  std::string files, directory;
  for (const ZipEntry& entry : entries) {
    check_size(entry.bytes.size() + files.size(), entry.name);
    const std::string shared = facts(entry);
    directory += number(kCentralHeader, 4) + number(kMadeBy, 2) + shared + number(0, 2) +
                 number(0, 2) + number(0, 2) + number(kMode, 4) + number(files.size(), 4) +
                 entry.name;
    files += number(kLocalHeader, 4) + shared + entry.name + entry.bytes;
  }
  return files + directory + number(kEnd, 4) + number(0, 2) + number(0, 2) +
         number(entries.size(), 2) + number(entries.size(), 2) + number(directory.size(), 4) +
         number(files.size(), 4) + number(0, 2);
}

}  // namespace lacuna
