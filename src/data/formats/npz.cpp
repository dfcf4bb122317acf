// SPDX-License-Identifier: MIT
#include "npz.hpp"

#include <zlib.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "lacuna/core/base/error.hpp"
#include "named_arrays.hpp"
#include "npy.hpp"

namespace lacuna {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 34U;  // of one array: nobody's record

[[noreturn]] void fail(const std::string& source, const std::string& problem) {
  throw DataError(source, problem, "save it again with numpy.savez, or the columns as .csv");
}

/// Little-endian number of so many bytes.
std::size_t number_at(std::string_view bytes, std::size_t at, std::size_t size,
                      const std::string& source) {
  if (at + size > bytes.size()) fail(source, "the archive is cut short");
  std::size_t value = 0;
  for (std::size_t i = size; i-- > 0;)
    value = (value << 8U) | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::string inflated(std::string_view packed, std::size_t size, const std::string& source) {
  std::string result(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) fail(source, "the archive cannot be unpacked");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const int status = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  if (status != Z_STREAM_END || stream.avail_out != 0) fail(source, "the archive is damaged");
  return result;
}

std::size_t checksum_of(std::string_view bytes) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

/// One array of the archive.
struct Entry {
  std::string name;
  std::string bytes;
};

/// The entry that the central directory lists at `at`, which moves on.
Entry entry_at(std::string_view bytes, std::size_t& at, const std::string& source) {
  const auto number = [&](std::size_t place, std::size_t size) {
    return number_at(bytes, place, size, source);
  };
  const std::size_t method = number(at + 10, 2), packed = number(at + 20, 4);
  const std::size_t checksum = number(at + 16, 4);
  const std::size_t size = number(at + 24, 4), name_size = number(at + 28, 2);
  const std::size_t local = number(at + 42, 4);
  if (at + 46 + name_size > bytes.size()) fail(source, "the archive is cut short");
  Entry entry{std::string(bytes.substr(at + 46, name_size)), {}};
  at += 46 + name_size + number(at + 30, 2) + number(at + 32, 2);
  const std::size_t begin = local + 30 + number(local + 26, 2) + number(local + 28, 2);
  if (packed == 0xFFFFFFFFU || size > kMostBytes) fail(source, "an array has more than 4 GB");
  if (begin > bytes.size() || packed > bytes.size() - begin)
    fail(source, "the archive is cut short");
  const std::string_view content = bytes.substr(begin, packed);
  if (method == 0)
    entry.bytes = std::string(content);
  else if (method == 8)
    entry.bytes = inflated(content, size, source);
  else
    fail(source, "the packing of '" + entry.name + "' is not known");
  if (entry.bytes.size() != size || checksum_of(entry.bytes) != checksum)
    fail(source, "'" + entry.name + "' is damaged: it is not what its checksum says");
  return entry;
}

std::vector<Entry> entries_of(std::string_view bytes, const std::string& source) {
  const std::size_t end = bytes.rfind("PK\x05\x06");
  if (end == std::string_view::npos) fail(source, "the archive is cut short");
  const std::size_t count = number_at(bytes, end + 10, 2, source);
  std::size_t at = number_at(bytes, end + 16, 4, source);
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < count; ++i) {
    if (at > bytes.size() || bytes.substr(at, 4) != "PK\x01\x02")
      fail(source, "the archive is damaged");
    entries.push_back(entry_at(bytes, at, source));
  }
  return entries;
}

std::string name_of(const std::string& file) {
  const std::size_t end = file.rfind(".npy");
  return end == std::string::npos ? file : file.substr(0, end);
}

/// The array of an entry, or the fields of a structured one ("run.t").
/// @throws NoMatrix where it is none.
void add_arrays(Entry entry, const std::string& source, std::vector<NamedArray>& arrays) {
  const std::string place = source + ", " + entry.name;
  if (!entry.name.ends_with(".npy")) throw NoMatrix(place, "this is no array", "leave it out");
  const auto bytes = std::make_shared<const std::string>(std::move(entry.bytes));
  const auto header =
      std::make_shared<const NpyHeader>(parse_npy_header(*bytes, bytes->size(), place));
  const std::string_view data = std::string_view(*bytes).substr(header->data_begin);
  const Matrix values = npy_values(*header, data);
  const Index parts = header->structured ? values.cols() : 1;
  for (Index part = 0; part < parts; ++part) {
    NamedArray array{name_of(entry.name), header->structured ? values.col(part) : values};
    if (header->structured)
      array.name += "." + header->fields[static_cast<std::size_t>(part)].name;
    array.unit = header->fields[static_cast<std::size_t>(part)].unit;
    const WrittenNumbers written = npy_written(*header, data.data(), part);
    array.epsilon = written.epsilon;
    if (written.stamp)
      array.stamp = [bytes, header, part, at = data.data()](Index row, Index column) {
        return npy_stamp(*header, at, row, part + column);
      };
    arrays.push_back(std::move(array));
  }
}

}  // namespace

Table parse_npz(std::string_view bytes, const std::string& source, const TimeFinder& find) {
  std::vector<NamedArray> arrays;
  std::vector<std::string> others;
  for (Entry& entry : entries_of(bytes, source)) {
    const std::string name = name_of(entry.name);
    try {
      add_arrays(std::move(entry), source, arrays);
    } catch (const NoMatrix&) {
      others.push_back(name);
    }
  }
  Table table = table_of_arrays(arrays, source, find);
  for (const std::string& name : others)
    table.notes.push_back(source + ": '" + name +
                          "' is neither a vector nor a matrix of real numbers and is left out");
  return table;
}

}  // namespace lacuna
