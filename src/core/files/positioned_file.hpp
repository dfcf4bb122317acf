// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace lacuna {

/// A file that is read at any place by any thread. Not mapped into memory: where a mapped file
/// gets shorter while it is read, the program dies.
class PositionedFile {
 public:
  /// @throws FileError when it cannot be opened or is no file with places.
  explicit PositionedFile(const std::filesystem::path& path);

  /// A file that is open.
  /// @param handle of it, which is closed with this.
  /// @param path for messages.
  PositionedFile(int handle, std::filesystem::path path);
  ~PositionedFile();
  PositionedFile(PositionedFile&& other) noexcept;
  PositionedFile& operator=(PositionedFile&&) = delete;

  const std::filesystem::path& path() const noexcept { return path_; }
  std::size_t size() const noexcept { return size_; }

  /// Fills `bytes` with what is in the file from `offset` on.
  /// @throws FileError when there is less or it cannot be read.
  void read(std::size_t offset, std::span<char> bytes) const;

 private:
  std::filesystem::path path_;
  int handle_ = -1;
  std::size_t size_ = 0;
};

}  // namespace lacuna
