// SPDX-License-Identifier: MIT
#include "lacuna/core/atomic_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include "lacuna/core/error.hpp"

namespace lacuna {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw FileError(path.string(), "cannot be written: " + reason,
                  "check that the folder exists, is writable and has space");
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

void write_all(File file, const fs::path& path, std::string_view content) {
  if (!file) fail(path, std::strerror(errno));
  const bool written =
      std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
  const int write_error = errno;
  if (std::fclose(file.release()) != 0) fail(path, std::strerror(errno));
  if (!written) fail(path, std::strerror(write_error));
}

/// A pipe or a device (/dev/stdout) has no content that could be left half replaced.
bool is_stream(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::is_character_file(status) || fs::is_fifo(status) || fs::is_socket(status);
}

/// The file behind a symbolic link, so that the link stays one.
fs::path real_target(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
  fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view content) {
  std::error_code error;
  if (path.empty()) fail(path, "no file name given");
  if (fs::is_directory(path, error)) fail(path, "it is a folder");
  if (is_stream(path)) {
    write_all(File(std::fopen(path.c_str(), "wb")), path, content);
    return;
  }
  const fs::path target = real_target(path);
  Temporary temporary(temporary_name(target));
  // "x": never write into a file that somebody else has opened under the same name.
  write_all(File(std::fopen(temporary.path().c_str(), "wbx")), path, content);
  fs::rename(temporary.path(), target, error);
  if (error) fail(path, error.message());
  temporary.keep();
}

}  // namespace lacuna
