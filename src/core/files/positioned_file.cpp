// SPDX-License-Identifier: MIT
#include "positioned_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "near_file.hpp"

namespace lacuna {
namespace {

[[noreturn]] void refuse_place(const std::filesystem::path& path, const std::string& reason) {
  throw FileError(path.string(), "cannot be read in pieces: " + reason,
                  remedy_of_missing(path, "check the name and the permissions"));
}

}  // namespace

PositionedFile::PositionedFile(const std::filesystem::path& path)
    : PositionedFile(open(path.c_str(), O_RDONLY | O_CLOEXEC), path) {}

PositionedFile::PositionedFile(int handle, std::filesystem::path path)
    : path_(std::move(path)), handle_(handle) {
  struct stat status {};
  if (handle_ < 0 || fstat(handle_, &status) != 0) refuse_place(path_, std::strerror(errno));
  size_ = static_cast<std::size_t>(status.st_size);
  if (S_ISREG(status.st_mode)) return;
  close(handle_);
  refuse_place(path_, "it is no regular file");
}

PositionedFile::PositionedFile(PositionedFile&& other) noexcept
    : path_(std::move(other.path_)),
      handle_(std::exchange(other.handle_, -1)),
      size_(other.size_) {}

PositionedFile::~PositionedFile() {
  if (handle_ >= 0) close(handle_);
}

void PositionedFile::read(std::size_t offset, std::span<char> bytes) const {
  while (!bytes.empty()) {
    const ssize_t count =
        pread(handle_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse_place(path_, std::strerror(errno));
    if (count == 0) refuse_place(path_, "it has become shorter");
    offset += static_cast<std::size_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

}  // namespace lacuna
