// SPDX-License-Identifier: MIT
#include "temporary_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

[[noreturn]] void refuse_temporary(const std::filesystem::path& folder,
                                   const std::string& reason) {
  throw FileError(folder.string(), "no temporary file can be written there: " + reason,
                  "set TMPDIR to a folder that can be written to and has space");
}

/// A file whose name is taken away before there is anything in it.
int open_without_name(const std::filesystem::path& folder) {
  std::string name = (folder / "lacuna-XXXXXX").string();
  const int handle = mkostemp(name.data(), O_CLOEXEC);
  if (handle < 0) refuse_temporary(folder, std::strerror(errno));
  unlink(name.c_str());
  return handle;
}

}  // namespace

std::filesystem::path temporary_folder() {
  const char* given = std::getenv("TMPDIR");
  return given != nullptr && *given != '\0' ? given : "/tmp";
}

TemporaryFile::TemporaryFile()
    : folder_(temporary_folder()), handle_(open_without_name(folder_)) {}

TemporaryFile::~TemporaryFile() { close(handle_); }

bool TemporaryFile::append(std::span<const char> bytes) {
  const std::size_t written = write_at(size_, bytes);
  size_ += written;
  return written == bytes.size();
}

void TemporaryFile::replace_begin(std::span<const char> bytes) {
  if (write_at(0, bytes) < bytes.size()) refuse_temporary(folder_, std::strerror(ENOSPC));
}

PositionedFile TemporaryFile::reader() const {
  const int handle = fcntl(handle_, F_DUPFD_CLOEXEC, 0);
  if (handle < 0) refuse_temporary(folder_, std::strerror(errno));
  return {handle, folder_};
}

/// @return number of bytes for which there was room.
std::size_t TemporaryFile::write_at(std::size_t offset, std::span<const char> bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count = pwrite(handle_, bytes.data() + written, bytes.size() - written,
                                 static_cast<off_t>(offset + written));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)) break;
    if (count < 0) refuse_temporary(folder_, std::strerror(errno));
    written += static_cast<std::size_t>(count);
  }
  return written;
}

}  // namespace lacuna
