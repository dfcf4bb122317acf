// SPDX-License-Identifier: MIT
// Binary files made byte by byte, as the descriptions of their formats say.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::testing {

/// The low bytes of each number, least or most significant first.
inline std::string bytes_of(const std::vector<std::uint64_t>& numbers, unsigned size = 8,
                            bool big = false) {
  std::string bytes;
  for (const std::uint64_t number : numbers)
    for (unsigned i = 0; i < size; ++i)
      bytes += static_cast<char>((number >> (8 * (big ? size - 1 - i : i))) & 0xFFU);
  return bytes;
}

/// A .npy of version 1.
/// @param type as it stands in the header, with quotes or as a list of fields.
inline std::string npy_file(const std::string& type, const std::string& shape,
                            const std::string& data, bool fortran = false) {
  const std::string header = "{'descr': " + type +
                             ", 'fortran_order': " + (fortran ? "True" : "False") +
                             ", 'shape': " + shape + ", }\n";
  return std::string("\x93NUMPY\x01\x00", 8) + bytes_of({header.size()}, 2) + header + data;
}

/// A raw deflate stream (RFC 1951).
inline std::string deflated(const std::string& content) {
  std::string packed(content.size() + 100, '\0');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// A zip archive (APPNOTE 6.3.9, sections 4.3.7, 4.3.12, 4.3.16).
inline std::string zip_archive(const std::vector<std::pair<std::string, std::string>>& files,
                               bool pack = false) {
  std::string content, directory;
  for (const auto& [name, bytes] : files) {
    const std::string stored = pack ? deflated(bytes) : bytes;
    const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    const std::string common = bytes_of({pack ? 8U : 0U}, 2) + bytes_of({0}, 4) +
                               bytes_of({crc}, 4) + bytes_of({stored.size()}, 4) +
                               bytes_of({bytes.size()}, 4) + bytes_of({name.size()}, 2);
    directory += "PK\x01\x02" + bytes_of({20, 20, 0}, 2) + common + bytes_of({0, 0}, 2) +
                 bytes_of({0}, 8) + bytes_of({content.size()}, 4) + name;
    content += "PK\x03\x04" + bytes_of({20, 0}, 2) + common + bytes_of({0}, 2) + name + stored;
  }
  return content + directory + "PK\x05\x06" + bytes_of({0}, 4) +
         bytes_of({files.size(), files.size()}, 2) + bytes_of({directory.size()}, 4) +
         bytes_of({content.size()}, 4) + bytes_of({0}, 2);
}

/// A column of 64-bit words in a MATLAB 5 file.
struct MatColumn {
  std::string name;
  bool is_double = false;  ///< else whole numbers
  bool has_sign = false;
  std::vector<std::uint64_t> words;
};

/// A MATLAB 5 file of columns that are not packed (the format's public description).
inline std::string mat_file(const std::vector<MatColumn>& columns) {
  constexpr std::uint64_t kInt8 = 1, kInt32 = 5, kUint32 = 6, kDouble = 9, kInt64 = 12;
  constexpr std::uint64_t kUint64 = 13, kMatrix = 14;
  constexpr std::uint64_t kDoubleClass = 6, kInt64Class = 14, kUint64Class = 15;
  std::string file = "MATLAB 5.0 MAT-file";
  file.resize(124, ' ');
  file += std::string("\x00\x01IM", 4);
  for (const MatColumn& column : columns) {
    const std::uint64_t kind = column.is_double  ? kDoubleClass
                               : column.has_sign ? kInt64Class
                                                 : kUint64Class;
    const std::uint64_t type = column.is_double ? kDouble : column.has_sign ? kInt64 : kUint64;
    std::string name = column.name;
    name.resize((name.size() + 7) / 8 * 8, '\0');
    const std::string matrix =
        bytes_of(
            {kUint32, 8, kind, 0, kInt32, 8, column.words.size(), 1, kInt8, column.name.size()},
            4) +
        name + bytes_of({type, 8 * column.words.size()}, 4) + bytes_of(column.words);
    file += bytes_of({kMatrix, matrix.size()}, 4) + matrix;
  }
  return file;
}

}  // namespace lacuna::testing
