// SPDX-License-Identifier: MIT
#include "spool.hpp"

#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "core/files/temporary_file.hpp"
#include "data/formats/npy.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

constexpr auto kActivity = "reading data";

std::string megabytes(double bytes) {
  return std::to_string(static_cast<std::uint64_t>(std::ceil(bytes / 1048576.0))) + " MB";
}

/// Writes what the fraction of a source that was read has become.
void write_part(TemporaryFile& file, std::span<const char> bytes, const std::string& source,
                std::optional<double> fraction) {
  const auto all = static_cast<double>(file.size() + bytes.size());
  if (file.append(bytes)) return;
  const std::string needed = fraction && *fraction > 0.0 ? "about " + megabytes(all / *fraction)
                                                         : "more than " + megabytes(all);
  throw FileError(file.folder().string(),
                  "there is no room for the numbers of " + source + ": they take " + needed +
                      ", and " + megabytes(static_cast<double>(file.size())) +
                      " could be written",
                  "set TMPDIR to a folder with more room");
}

std::string begin_of_rows(Index rows, Index columns) {
  constexpr bool kLittle = std::endian::native == std::endian::little;
  return npy_begin(kLittle ? "<f8" : ">f8", false, rows, columns);
}

std::span<const char> bytes_of(const RowMajorMatrix& rows) {
  return {reinterpret_cast<const char*>(rows.data()),
          static_cast<std::size_t>(rows.size()) * sizeof(double)};
}

}  // namespace

NpyFile open_rows(const std::filesystem::path& path, std::size_t memory,
                  const RunContext& context, const TimeFinder& find) {
  auto file = std::make_unique<OpenedFile>(path);
  if (file->kind != FileKind::Npy)
    return spooled(*row_blocks(std::move(file), memory, find), context);
  NpyFile rows = file->has_places() ? NpyFile(path) : unpacked(*file, context);
  if (const auto time = find(rows.columns())) rows.look_at_times(*time);
  return rows;
}

NpyFile spooled(RowBlocks& blocks, const RunContext& context) {
  const std::string& source = blocks.columns().source;
  const auto columns = static_cast<Index>(blocks.columns().columns.size());
  TemporaryFile file;
  write_part(file, begin_of_rows(0, columns), source, std::nullopt);
  Table block = blocks.columns();
  LineNumbers lines;
  Index rows = 0;
  while (blocks.next(block)) {
    context.report(kActivity, blocks.fraction().value_or(0.0));
    const RowMajorMatrix by_row = block.values;
    write_part(file, bytes_of(by_row), source, blocks.fraction());
    lines.append(block.lines);
    rows += by_row.rows();
  }
  file.replace_begin(begin_of_rows(rows, columns));
  return {file.reader(), blocks.columns(), std::move(lines)};
}

NpyFile unpacked(OpenedFile& opened, const RunContext& context) {
  constexpr std::size_t kBlock = std::size_t{1} << 20U;
  TemporaryFile file;
  std::string bytes = std::exchange(opened.begin, {});
  while (!bytes.empty()) {
    context.report(kActivity, opened.stream.fraction().value_or(0.0));
    write_part(file, bytes, opened.source, opened.stream.fraction());
    bytes.resize(kBlock);
    bytes.resize(opened.stream.read(bytes));
  }
  return {file.reader(), opened.source};
}

}  // namespace lacuna
