// SPDX-License-Identifier: MIT
#include "byte_stream.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "near_file.hpp"

namespace lacuna {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBuffer = std::size_t{1} << 18U;  // a fact of cost

constexpr const char* kRemedy = "check the name and the permissions";

[[noreturn]] void refuse(const fs::path& path, const std::string& reason,
                         const std::string& remedy = kRemedy) {
  throw FileError(path.string(), "cannot be read: " + reason, remedy);
}

File open_file(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    refuse(path, "it is a folder",
           "give a file or a pattern such as '" + (path / "*.csv").string() + "'");
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    const std::string reason = std::strerror(errno);
    refuse(path, reason, remedy_of_missing(path, kRemedy));
  }
  return file;
}

}  // namespace

ByteStream::ByteStream(fs::path path) : path_(std::move(path)), file_(open_file(path_)) {
  std::error_code no_size;
  const auto size = fs::file_size(path_, no_size);
  if (!no_size) file_size_ = static_cast<std::size_t>(size);
  refill();
  is_packed_ = is_gzip(waiting_);
}

std::size_t ByteStream::read(std::span<char> bytes) {
  if (is_packed_) return read_packed(bytes);
  const std::size_t before = std::min(waiting_.size(), bytes.size());
  std::copy_n(waiting_.data(), before, bytes.data());
  waiting_.remove_prefix(before);
  return before + read_file(bytes.subspan(before));
}

std::optional<double> ByteStream::fraction() const {
  if (!file_size_ || *file_size_ == 0) return std::nullopt;
  const std::size_t used = position_ - waiting_.size();
  return std::min(1.0, static_cast<double>(used) / static_cast<double>(*file_size_));
}

std::size_t ByteStream::read_file(std::span<char> bytes) {
  if (has_ended_ || bytes.empty()) return 0;
  const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file_.get());
  if (std::ferror(file_.get()) != 0) refuse(path_, std::strerror(errno));
  has_ended_ = count < bytes.size();
  position_ += count;
  return count;
}

std::size_t ByteStream::read_packed(std::span<char> bytes) {
  std::size_t count = 0;
  while (count < bytes.size()) {
    if (waiting_.size() < 2) refill();
    if (!member_ && !is_gzip(waiting_)) {
      check_rest();
      break;
    }
    if (!member_) member_.emplace(path_.string());
    count += member_->unpack(waiting_, bytes.subspan(count), has_ended_);
    if (member_->has_ended()) member_.reset();
  }
  return count;
}

void ByteStream::check_rest() {
  while (!waiting_.empty()) {
    check_padding(waiting_, path_.string());
    waiting_ = {};
    refill();
  }
}

void ByteStream::refill() {
  std::string next(waiting_);  // a byte at most
  const std::size_t before = next.size();
  next.resize(before + kBuffer);
  next.resize(before + read_file({next.data() + before, kBuffer}));
  buffer_ = std::move(next);
  waiting_ = buffer_;
}

}  // namespace lacuna
