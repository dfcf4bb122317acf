// SPDX-License-Identifier: MIT
#include "gzip_member.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

bool is_gzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

void check_padding(std::string_view bytes, const std::string& source) {
  if (bytes.find_first_not_of('\0') == std::string_view::npos) return;
  throw DataError(source, "something that is not compressed stands behind the compressed data",
                  "unpack the file ('gzip -d') and pack all of it again");
}

uInt zlib_size(std::size_t size) {
  return static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max() / 2));
}

void GzipMember::End::operator()(z_stream* stream) const {
  inflateEnd(stream);
  delete stream;
}

GzipMember::GzipMember(std::string source)
    : source_(std::move(source)), stream_(new z_stream{}) {
  if (inflateInit2(stream_.get(), kGzipWindow) != Z_OK) throw std::bad_alloc();
}

std::size_t GzipMember::unpack(std::string_view& packed, std::span<char> room, bool is_last) {
  const uInt in = zlib_size(packed.size()), out = zlib_size(room.size());
  stream_->next_in =
      reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));  // zlib does not write it
  stream_->avail_in = in;
  stream_->next_out = reinterpret_cast<Bytef*>(room.data());
  stream_->avail_out = out;
  const int status = inflate(stream_.get(), Z_NO_FLUSH);
  has_ended_ = status == Z_STREAM_END;
  packed.remove_prefix(in - stream_->avail_in);
  const std::size_t added = out - stream_->avail_out;
  // Z_BUF_ERROR: nothing could be done with what there is.
  const bool goes_on = status == Z_OK || status == Z_BUF_ERROR;
  const bool is_stuck = added == 0 && packed.empty() && is_last;
  if (!has_ended_ && (!goes_on || is_stuck))
    throw DataError(source_, "the compressed data are damaged or cut short",
                    "make or copy the file again; 'gzip -t' checks it");
  return added;
}

}  // namespace lacuna
