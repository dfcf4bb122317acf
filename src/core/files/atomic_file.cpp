// SPDX-License-Identifier: MIT
#include "core/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "stdio_file.hpp"

namespace lacuna {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw FileError(path.string(), "cannot be written: " + reason,
                  "check that the folder exists, is writable and has space");
}

/// Locked from the creation of a temporary file to its end.
std::mutex& files() {
  static std::mutex mutex;
  return mutex;
}

/// Removes the temporary file unless it has become the real one.
class Temporary {
 public:
  explicit Temporary(fs::path path) : path_(std::move(path)) {}
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove(path_, ignored);
  }

  const fs::path& path() const { return path_; }
  void keep() { path_.clear(); }

 private:
  fs::path path_;
};

fs::path temporary_name(const fs::path& target) {
  std::random_device source;
  std::array<char, 24> suffix{};
  std::snprintf(suffix.data(), suffix.size(), ".%08x.tmp", static_cast<unsigned>(source()));
  fs::path name = target;
  return name += suffix.data();
}

bool is_regular(std::FILE* file) {
  struct stat status {};
  return fstat(fileno(file), &status) == 0 && S_ISREG(status.st_mode);
}

void write_all(File file, const fs::path& path, std::string_view content) {
  if (!file) fail(path, std::strerror(errno));
  const bool written =
      std::fwrite(content.data(), 1, content.size(), file.get()) == content.size() &&
      std::fflush(file.get()) == 0;
  if (!written) fail(path, std::strerror(errno));
  // On the disk before the name is: after a power cut there is the old file or the new one.
  if (is_regular(file.get()) && fsync(fileno(file.get())) != 0)
    fail(path, std::strerror(errno));
  if (std::fclose(file.release()) != 0) fail(path, std::strerror(errno));
}

/// Gives the new file the owner, where that is allowed, and the permissions of the one it
/// replaces, before there is anything in it to read.
void take_over_rights(const File& file, const fs::path& target) {
  struct stat old {};
  if (!file || stat(target.c_str(), &old) != 0) return;
  const int descriptor = fileno(file.get());
  const mode_t mode = old.st_mode & 07777;
  if (fchown(descriptor, old.st_uid, old.st_gid) != 0) {
    // Somebody else's file: the permissions are what can be kept.
  }
  if (fchmod(descriptor, mode) != 0) fail(target, std::strerror(errno));
}

/// Writes the names in a folder to the disk; a file system that cannot is no error.
void sync_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

/// A new file beside the target. "x": never write into one that somebody else has opened under
/// the same name.
File open_new(const fs::path& temporary) { return File(std::fopen(temporary.c_str(), "wbx")); }

void check_target(const fs::path& path) {
  std::error_code none;
  if (path.empty()) fail(path, "no file name given");
  if (fs::is_directory(path, none)) fail(path, "it is a folder");
}

}  // namespace

bool is_stream(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::is_character_file(status) || fs::is_fifo(status) || fs::is_socket(status);
}

fs::path written_file(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as in the kernel
  fs::path target = path;
  std::error_code error;
  for (int links = 0; links < kMostLinks; ++links) {
    if (!fs::is_symlink(fs::symlink_status(target, error))) return target;
    target = target.parent_path() / fs::read_symlink(target, error);
  }
  fail(path, "its links lead in a circle");
}

void check_writable(const fs::path& path) {
  check_target(path);
  if (is_stream(path)) {
    if (access(path.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
    return;
  }
  const std::lock_guard one_at_a_time(files());
  const Temporary temporary(temporary_name(written_file(path)));
  if (!open_new(temporary.path())) fail(path, std::strerror(errno));
}

void write_file_atomically(const fs::path& path, std::string_view content) {
  check_target(path);
  if (is_stream(path)) {
    write_all(File(std::fopen(path.c_str(), "wb")), path, content);
    return;
  }
  const fs::path target = written_file(path);
  const std::lock_guard one_at_a_time(files());
  Temporary temporary(temporary_name(target));
  File file = open_new(temporary.path());
  take_over_rights(file, target);
  write_all(std::move(file), path, content);
  std::error_code error;
  fs::rename(temporary.path(), target, error);
  if (error) fail(path, error.message());
  temporary.keep();
  sync_folder(target);
}

std::unique_lock<std::mutex> try_to_hold_files() { return {files(), std::try_to_lock}; }

}  // namespace lacuna
