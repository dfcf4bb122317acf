// SPDX-License-Identifier: MIT
#include "core/files/file_bytes.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <new>
#include <system_error>
#include <utility>

#include "byte_stream.hpp"
#include "gzip_member.hpp"
#include "lacuna/core/base/error.hpp"
#include "near_file.hpp"
#include "stdio_file.hpp"

namespace lacuna {
namespace {

namespace fs = std::filesystem;

// A fact of cost: what is read at a time.
constexpr std::size_t kChunk = std::size_t{1} << 18U;

/// Appends what `read(pointer, room)` gives until it gives nothing more.
template <class Read>
void append_all(FileBytes& content, Read&& read) {
  while (content.append(read) > 0)
    if (content.room() == 0) content.reserve(2 * content.view().size() + kChunk);
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
  content.reserve(kUnpackedSize * packed.size() + kChunk);
  while (is_gzip(packed)) {
    GzipMember member(source);
    while (!member.has_ended()) {
      if (content.room() == 0) content.reserve(2 * content.view().size() + kChunk);
      content.append([&](char* at, std::size_t room) {
        return member.unpack(packed, {at, room}, true);
      });
    }
  }
  check_padding(packed, source);
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
      // zlib does not write it.
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
      stream.avail_in = zlib_size(content.size());
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
    ByteStream stream(path);
    FileBytes content;
    const std::size_t size = stream.file_size().value_or(0);
    content.reserve(stream.is_packed() ? kUnpackedSize * size + kChunk : size + 1);
    if (!stream.file_size()) content.reserve(kChunk);
    append_all(content, [&](char* at, std::size_t room) { return stream.read({at, room}); });
    return content;
  } catch (const std::bad_alloc&) {
    throw DataError(path.string(), "what is in it does not fit into the memory of this run",
                    "check that it is a record; split it, or raise --max-memory");
  }
}

std::string read_text_file(const fs::path& path, const std::string& what) {
  std::error_code unreadable;
  const File file(fs::is_directory(path, unreadable) ? nullptr
                                                     : std::fopen(path.c_str(), "rb"));
  if (!file)
    throw FileError(path.string(), "the " + what + " cannot be read",
                    remedy_of_missing(path, "check that it exists and that it may be read"));
  std::string text;
  std::size_t size = 0, added = 1;
  while (added > 0 && size <= kLargestText) {
    text.resize(size + kChunk);
    added = std::fread(text.data() + size, 1, kChunk, file.get());
    size += added;
  }
  if (std::ferror(file.get()) != 0)
    throw FileError(path.string(), "reading failed", "check the disk");
  if (size > kLargestText)
    throw FileError(
        path.string(),
        "the " + what + " is larger than " + std::to_string(kLargestText >> 20U) + " MiB",
        "check that it is the right file");
  text.resize(size);
  return text;
}

bool is_packed(const fs::path& path) {
  std::error_code none;
  if (!fs::is_regular_file(path, none)) return false;
  const File file(std::fopen(path.c_str(), "rb"));
  std::array<char, 2> begin{};
  return file && std::fread(begin.data(), 1, begin.size(), file.get()) == begin.size() &&
         is_gzip({begin.data(), begin.size()});
}

}  // namespace lacuna
