// SPDX-License-Identifier: MIT
#include "lacuna/core/file_bytes.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <system_error>
#include <utility>

#include "lacuna/core/error.hpp"
#include "stdio_file.hpp"

namespace lacuna {
namespace {

namespace fs = std::filesystem;

constexpr int kGzipWindow = 15 + 16;  // zlib: largest window, gzip wrapper
constexpr std::size_t kChunk = std::size_t{1} << 18U;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason,
                         const std::string& remedy = "check the name and the permissions") {
  throw FileError(path.string(), "cannot be read: " + reason, remedy);
}

File open_file(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    refuse(path, "it is a folder",
           "give a file or a pattern such as '" + (path / "*.csv").string() + "'");
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) refuse(path, std::strerror(errno));
  return file;
}

FileBytes read_raw(const fs::path& path) {
  const File file = open_file(path);
  std::error_code no_size;  // a pipe has none
  const auto size = fs::file_size(path, no_size);
  FileBytes content;
  content.reserve(no_size ? kChunk : static_cast<std::size_t>(size) + 1);
  const auto read = [&](char* at, std::size_t room) {
    return std::fread(at, 1, room, file.get());
  };
  while (content.append(read) > 0)
    if (content.room() == 0) content.reserve(2 * content.view().size() + kChunk);
  if (std::ferror(file.get()) != 0) refuse(path, std::strerror(errno));
  return content;
}

bool is_gzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

Bytef* input_pointer(std::string_view bytes) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib does not write it
}

uInt chunk_size(std::size_t size) {
  return static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max() / 2));
}

/// Unpacks one member at the start of `packed`, appends to `content`, returns its packed size.
std::size_t unpack_member(std::string_view packed, const std::string& source,
                          FileBytes& content) {
  z_stream stream{};
  if (inflateInit2(&stream, kGzipWindow) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> guard(&stream, &inflateEnd);
  std::size_t used = 0;
  int status = Z_OK;
  const auto unpack = [&](char* at, std::size_t room) {
    stream.next_in = input_pointer(packed.substr(used));
    stream.avail_in = chunk_size(packed.size() - used);
    stream.next_out = reinterpret_cast<Bytef*>(at);
    stream.avail_out = chunk_size(room);
    const uInt in = stream.avail_in, out = stream.avail_out;
    status = inflate(&stream, Z_NO_FLUSH);
    used += in - stream.avail_in;
    return std::size_t{out - stream.avail_out};
  };
  while (status == Z_OK) {
    if (content.room() == 0) content.reserve(2 * content.view().size() + kChunk);
    content.append(unpack);
  }
  if (status != Z_STREAM_END)
    throw DataError(source, "the compressed data are damaged or cut short",
                    "make or copy the file again; 'gzip -t' checks it");
  return used;
}

}  // namespace

void FileBytes::reserve(std::size_t capacity) {
  if (capacity <= capacity_) return;
  auto larger = std::make_unique_for_overwrite<char[]>(capacity);
  std::copy(data_.get(), data_.get() + size_, larger.get());
  data_ = std::move(larger);
  capacity_ = capacity;
}

FileBytes gunzip(std::string_view packed, const std::string& source) {
  FileBytes content;
  content.reserve(4 * packed.size() + kChunk);
  while (is_gzip(packed)) packed.remove_prefix(unpack_member(packed, source, content));
  return content;
}

std::string gzip(std::string_view content) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, 8,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, decltype(&deflateEnd)> guard(&stream, &deflateEnd);
  std::string packed;
  std::array<char, kChunk / 4> buffer;
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    if (stream.avail_in == 0) {
      stream.next_in = input_pointer(content);
      stream.avail_in = chunk_size(content.size());
      content.remove_prefix(stream.avail_in);
    }
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    status = deflate(&stream, content.empty() ? Z_FINISH : Z_NO_FLUSH);
    packed.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  return packed;
}

FileBytes read_bytes(const fs::path& path) {
  try {
    FileBytes content = read_raw(path);
    return is_gzip(content.view()) ? gunzip(content.view(), path.string()) : std::move(content);
  } catch (const std::bad_alloc&) {
    throw DataError(path.string(), "what is in it does not fit into the memory of this run",
                    "check that it is a record; split it, or raise --max-memory");
  }
}

}  // namespace lacuna
