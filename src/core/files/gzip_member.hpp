// SPDX-License-Identifier: MIT
#pragma once

#include <zlib.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace lacuna {

/// Largest window, gzip wrapper; as zlib's functions take it.
inline constexpr int kGzipWindow = 15 + 16;

/// Whether a member begins here.
bool is_gzip(std::string_view bytes);

/// Checks what stands behind the last member: zeros.
/// @throws DataError naming the source where it is anything else.
void check_padding(std::string_view bytes, const std::string& source);

/// As many bytes as zlib takes at a time.
uInt zlib_size(std::size_t size);

/// One member of gzip data, unpacked piece by piece.
class GzipMember {
 public:
  /// @param source name for messages.
  explicit GzipMember(std::string source);

  /// Unpacks from `packed`, of which what was used is taken off, into `room`.
  /// @param is_last whether there is nothing behind `packed`.
  /// @return number of bytes, 0 also where more is needed first.
  /// @throws DataError when the data are damaged or cut short.
  std::size_t unpack(std::string_view& packed, std::span<char> room, bool is_last);

  bool has_ended() const noexcept { return has_ended_; }

 private:
  struct End {
    void operator()(z_stream* stream) const;
  };

  std::string source_;
  std::unique_ptr<z_stream, End> stream_;
  bool has_ended_ = false;
};

}  // namespace lacuna
