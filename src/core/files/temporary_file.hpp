// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "positioned_file.hpp"

namespace lacuna {

/// The folder for temporary files: $TMPDIR, else /tmp.
std::filesystem::path temporary_folder();

/// A file without a name in the folder for temporary files ($TMPDIR, else /tmp): it is gone
/// with its last handle, however the program ends.
class TemporaryFile {
 public:
  /// @throws FileError naming the folder when none can be made there.
  TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  const std::filesystem::path& folder() const noexcept { return folder_; }

  /// Bytes in it.
  std::size_t size() const noexcept { return size_; }

  /// Writes at the end.
  /// @return false where there is no room: the disk, the quota or the limit of the process.
  /// @throws FileError when it cannot be written for another reason.
  [[nodiscard]] bool append(std::span<const char> bytes);

  /// Writes over the begin, which is there.
  /// @throws FileError when it cannot be written.
  void replace_begin(std::span<const char> bytes);

  /// What was written, to be read for as long as that lives.
  /// @throws FileError when there are no more handles.
  PositionedFile reader() const;

 private:
  std::size_t write_at(std::size_t offset, std::span<const char> bytes);

  std::filesystem::path folder_;
  int handle_ = -1;
  std::size_t size_ = 0;
};

}  // namespace lacuna
