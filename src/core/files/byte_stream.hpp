// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gzip_member.hpp"
#include "stdio_file.hpp"

namespace lacuna {

/// The bytes of a file or a pipe in their order, unpacked where they are compressed by gzip
/// (seen by the first bytes, whatever the name). Several members one after the other are
/// joined; behind the last one there may be zeros (which tapes and disks add), nothing else.
class ByteStream {
 public:
  /// @throws FileError when the file cannot be opened or read.
  explicit ByteStream(std::filesystem::path path);
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  /// Fills `bytes`; with fewer only where the file ends.
  /// @return number of bytes.
  /// @throws FileError when it cannot be read; DataError when the packing is damaged.
  std::size_t read(std::span<char> bytes);

  bool is_packed() const noexcept { return is_packed_; }

  /// Size of the file in bytes, packed as it is; nothing for a pipe.
  std::optional<std::size_t> file_size() const noexcept { return file_size_; }

  /// Fraction of the file that has been read, 0..1; nothing for a pipe.
  std::optional<double> fraction() const;

 private:
  std::size_t read_file(std::span<char> bytes);
  std::size_t read_packed(std::span<char> bytes);
  void check_rest();
  void refill();

  std::filesystem::path path_;
  File file_;
  std::optional<std::size_t> file_size_;
  std::size_t position_ = 0;  ///< in the file
  bool has_ended_ = false;    ///< the file
  bool is_packed_ = false;
  std::string buffer_;
  std::string_view waiting_;  ///< bytes in the buffer that come next
  std::optional<GzipMember> member_;
};

}  // namespace lacuna
