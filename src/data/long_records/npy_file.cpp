// SPDX-License-Identifier: MIT
#include "npy_file.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "data/formats/npy.hpp"

namespace lacuna {
namespace {

NpyHeader header_of(const PositionedFile& file, const std::string& source) {
  constexpr std::size_t kLongestHeader = std::size_t{1} << 20U;
  std::string begin(std::min(file.size(), kLongestHeader), '\0');
  file.read(0, begin);
  return parse_npy_header(begin, file.size(), source);
}

}  // namespace

NpyFile::NpyFile(const std::filesystem::path& path)
    : NpyFile(PositionedFile(path), path.string()) {}

NpyFile::NpyFile(PositionedFile file, const std::string& source)
    : file_(std::move(file)),
      header_(header_of(file_, source)),
      columns_(npy_columns(header_, source)) {}

NpyFile::NpyFile(PositionedFile file, Table columns, LineNumbers lines)
    : file_(std::move(file)),
      header_(header_of(file_, columns.source)),
      columns_(std::move(columns)),
      lines_(std::move(lines)) {}

NpyFile::Bytes NpyFile::bytes_of(Index first, Index count) const {
  NpyHeader part = header_;
  part.rows = static_cast<std::size_t>(count);
  // In Fortran order each column lies by itself, else rows lie together.
  const bool by_column = !header_.structured && header_.fortran_order;
  const std::size_t blocks = by_column ? header_.columns : 1;
  const std::size_t row = header_.item_size * (by_column ? 1 : header_.columns);
  const std::size_t length = part.rows * row;
  auto bytes = std::make_unique_for_overwrite<char[]>(blocks * length);
  for (std::size_t i = 0; i < blocks; ++i)
    file_.read(header_.data_begin + (i * header_.rows + static_cast<std::size_t>(first)) * row,
               {bytes.get() + i * length, length});
  return {std::move(part), std::move(bytes), blocks * length};
}

void NpyFile::look_at_times(const TimeColumn& time) {
  Table begin = columns_;
  const Bytes first = bytes_of(0, std::min(rows(), kFirstTimes));
  begin.values = npy_values(first.header, first.view());
  const WrittenNumbers written = npy_written(first.header, first.data.get(), time.column);
  count_times(begin, time, written);
  columns_.notes = begin.notes;
  columns_.counted = begin.counted;
  if (begin.counted) origin_ = written.stamp(0);
}

Matrix NpyFile::values(Index first, Index count) const {
  const Bytes bytes = bytes_of(first, count);
  Matrix values = npy_values(bytes.header, bytes.view());
  if (!origin_) return values;
  const Index time = columns_.counted->column;
  for (Index row = 0; row < count; ++row)
    if (!std::isnan(values(row, time)))
      values(row, time) =
          value_of(npy_stamp(bytes.header, bytes.data.get(), row, time) - *origin_);
  return values;
}

std::optional<RowMajorMatrix> NpyFile::plain_rows(Index first, Index count) const {
  if (header_.structured || header_.fortran_order || !header_.fields[0].is_native_double())
    return std::nullopt;
  RowMajorMatrix rows(count, static_cast<Index>(header_.columns));
  const std::size_t row = header_.item_size * header_.columns;
  file_.read(header_.data_begin + static_cast<std::size_t>(first) * row,
             {reinterpret_cast<char*>(rows.data()), static_cast<std::size_t>(count) * row});
  return rows;
}

Table NpyFile::read(Index first, Index count) const {
  Table table = columns_;
  table.values = values(first, count);
  return table;
}

}  // namespace lacuna
