// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace lacuna {

/// A fact of texts: how many times its packed size one often takes.
inline constexpr std::size_t kUnpackedSize = 4;

/// Bytes in memory, not written before they are filled (a std::string would write them twice).
class FileBytes {
 public:
  FileBytes() = default;

  std::string_view view() const noexcept { return {data_.get(), size_}; }

  /// Room for so many bytes; those that are there stay.
  void reserve(std::size_t capacity);

  /// Appends what `fill(pointer, room)` puts into the room that is left.
  /// @return number of bytes that it reports.
  template <class Fill>
  std::size_t append(Fill&& fill) {
    const std::size_t added = fill(data_.get() + size_, capacity_ - size_);
    size_ += added;
    return added;
  }

  std::size_t room() const noexcept { return capacity_ - size_; }

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// The whole content of a file, unpacked when it is compressed by gzip (seen by its first
/// bytes, whatever its name).
/// @throws FileError when it cannot be opened or read; DataError when the packing is damaged or
///   the memory does not hold what is in it.
FileBytes read_bytes(const std::filesystem::path& path);

/// Most that a model or a configuration takes, in bytes: 64 MiB are 10^6 lines of one.
inline constexpr std::size_t kLargestText = std::size_t{1} << 26U;

/// The whole content of a text that somebody wrote, not unpacked.
/// @param what it is, for messages: "model file".
/// @throws FileError when it cannot be read, or is larger than kLargestText, as /dev/zero.
std::string read_text_file(const std::filesystem::path& path, const std::string& what);

/// Whether a file is compressed by gzip, by its first bytes. A pipe is not looked into.
bool is_packed(const std::filesystem::path& path);

/// Unpacks gzip data; several members one after the other are joined.
/// @param source name for messages.
/// @throws DataError when the data are damaged or cut short.
FileBytes gunzip(std::string_view packed, const std::string& source);

/// Packs by gzip; the same bytes for the same content (no name, no date inside).
std::string gzip(std::string_view content);

}  // namespace lacuna
