// SPDX-License-Identifier: MIT
#include "core/files/zip_reader.hpp"

#include <zlib.h>

#include <algorithm>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

constexpr std::size_t kSaidElsewhere = 0xFFFFFFFFU;  // a fact of the format: zip64

[[noreturn]] void fail(const ZipArchive& archive, const std::string& problem) {
  throw DataError(archive.source, problem, archive.remedy);
}

/// Little-endian number of so many bytes.
std::size_t number_at(const ZipArchive& archive, std::size_t at, std::size_t size) {
  if (at + size > archive.bytes.size()) fail(archive, "the archive is cut short");
  std::size_t value = 0;
  for (std::size_t i = size; i-- > 0;)
    value = (value << 8U) | static_cast<unsigned char>(archive.bytes[at + i]);
  return value;
}

std::string inflated(const ZipArchive& archive, std::string_view packed, std::size_t size) {
  std::string result(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
    fail(archive, "the archive cannot be unpacked");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const int status = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  if (status != Z_STREAM_END || stream.avail_out != 0) fail(archive, "the archive is damaged");
  return result;
}

std::size_t checksum_of(std::string_view bytes) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

/// The entry that the central directory lists at `at`, which moves on.
ZipEntry entry_at(const ZipArchive& archive, std::size_t& at) {
  const auto number = [&](std::size_t place, std::size_t size) {
    return number_at(archive, at + place, size);
  };
  if (archive.bytes.substr(std::min(at, archive.bytes.size()), 4) != "PK\x01\x02")
    fail(archive, "the archive is damaged");
  const std::size_t name_size = number(28, 2);
  ZipEntry entry{{}, number(24, 4), number(20, 4), number(42, 4), number(16, 4), number(10, 2)};
  const std::size_t next = 46 + name_size + number(30, 2) + number(32, 2);
  if (at + 46 + name_size > archive.bytes.size()) fail(archive, "the archive is cut short");
  entry.name = std::string(archive.bytes.substr(at + 46, name_size));
  if (entry.packed == kSaidElsewhere || entry.size == kSaidElsewhere)
    fail(archive, "'" + entry.name + "' has more than 4 GB");
  at += next;
  return entry;
}

/// Where what is packed begins, behind the entry's own header.
std::size_t content_of(const ZipArchive& archive, const ZipEntry& entry) {
  return entry.local + 30 + number_at(archive, entry.local + 26, 2) +
         number_at(archive, entry.local + 28, 2);
}

/// No two entries have bytes in common: of each byte at most a thousand are unpacked then, and
/// so much work a small file cannot ask for (Fifield, A better zip bomb, WOOT 2019).
void check_apart(const ZipArchive& archive) {
  std::vector<const ZipEntry*> entries;
  for (const ZipEntry& entry : archive.entries) entries.push_back(&entry);
  std::sort(entries.begin(), entries.end(),
            [](const ZipEntry* a, const ZipEntry* b) { return a->local < b->local; });
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const ZipEntry& before = *entries[i - 1];
    if (content_of(archive, before) + before.packed > entries[i]->local)
      fail(archive, "'" + before.name + "' and '" + entries[i]->name +
                        "' stand in the same bytes of the archive");
  }
}

}  // namespace

ZipArchive open_zip(std::string_view bytes, const std::string& source,
                    const std::string& remedy) {
  ZipArchive archive{bytes, source, remedy, {}};
  const std::size_t end = bytes.rfind("PK\x05\x06");
  if (end == std::string_view::npos) fail(archive, "the archive is cut short");
  const std::size_t count = number_at(archive, end + 10, 2);
  std::size_t at = number_at(archive, end + 16, 4);
  for (std::size_t i = 0; i < count; ++i) archive.entries.push_back(entry_at(archive, at));
  check_apart(archive);
  return archive;
}

const ZipEntry* find_entry(const ZipArchive& archive, std::string_view name) {
  const auto found =
      std::find_if(archive.entries.begin(), archive.entries.end(),
                   [&](const ZipEntry& entry) { return entry.name == name; });
  return found == archive.entries.end() ? nullptr : &*found;
}

std::string unpacked(const ZipArchive& archive, const ZipEntry& entry, std::size_t most) {
  if (entry.size > most)
    fail(archive, "'" + entry.name + "' has more than " + std::to_string(most >> 20U) + " MB");
  const std::size_t begin = content_of(archive, entry);
  if (begin > archive.bytes.size() || entry.packed > archive.bytes.size() - begin)
    fail(archive, "the archive is cut short");
  const std::string_view content = archive.bytes.substr(begin, entry.packed);
  if (entry.method != 0 && entry.method != 8)
    fail(archive, "the packing of '" + entry.name + "' is not known");
  // Nothing is packed to less than a thousandth (zlib's documentation: 1032).
  if (entry.method == 8 && entry.size / 1032 > content.size())
    fail(archive, "'" + entry.name + "' cannot be as large as it says");
  std::string bytes = entry.method == 0 ? std::string(content)
                                        : inflated(archive, content, entry.size);
  if (bytes.size() != entry.size || checksum_of(bytes) != entry.checksum)
    fail(archive, "'" + entry.name + "' is damaged: it is not what its checksum says");
  return bytes;
}

}  // namespace lacuna
