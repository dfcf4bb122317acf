// SPDX-License-Identifier: MIT
#include "zip_writer.hpp"

#include <zlib.h>

#include <cstdint>
#include <initializer_list>
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

/// A number of so many bytes, the lowest first.
struct Field {
  std::uint64_t value;
  unsigned bytes;
};

std::string fields(std::initializer_list<Field> all) {
  std::string text;
  for (const Field& field : all)
    for (unsigned i = 0; i < field.bytes; ++i)
      text += static_cast<char>(static_cast<unsigned char>(field.value >> (8U * i)));
  return text;
}

/// From the version up to the lengths of name and extra field, which both headers share.
std::string facts(const ZippedFile& entry) {
  const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(entry.bytes.data()),
                            entry.bytes.size());
  return fields({{kVersion, 2}, {kNamesAreUtf8, 2}, {0, 2}, {0, 2}, {kFirstDay, 2}, {sum, 4},
                 {entry.bytes.size(), 4}, {entry.bytes.size(), 4}, {entry.name.size(), 2},
                 {0, 2}});
}

void check_size(std::size_t size, const std::string& name) {
  if (size > std::numeric_limits<std::uint32_t>::max() / 2)
    throw FileError(name, "it is too large for a ZIP archive", "write it as a file of its own");
}

}  // namespace

std::string zip_of(const std::vector<ZippedFile>& entries) {
  std::string files, directory;
  for (const ZippedFile& entry : entries) {
    check_size(entry.bytes.size() + files.size(), entry.name);
    const std::string shared = facts(entry);
    directory += fields({{kCentralHeader, 4}, {kMadeBy, 2}}) + shared +
                 fields({{0, 2}, {0, 2}, {0, 2}, {kMode, 4}, {files.size(), 4}}) + entry.name;
    files += fields({{kLocalHeader, 4}}) + shared + entry.name + entry.bytes;
  }
  return files + directory +
         fields({{kEnd, 4}, {0, 2}, {0, 2}, {entries.size(), 2}, {entries.size(), 2},
                 {directory.size(), 4}, {files.size(), 4}, {0, 2}});
}

}  // namespace lacuna
