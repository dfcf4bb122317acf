// SPDX-License-Identifier: MIT
#include "row_blocks.hpp"

#include <algorithm>
#include <utility>

#include "hdf5.hpp"
#include "lacuna/core/base/error.hpp"
#include "text_rows.hpp"

namespace lacuna {
namespace {

const char* const kLeaveOut = ", or leave out --memory";

[[noreturn]] void refuse_blocks(const OpenedFile& file, const std::string& what,
                                const std::string& remedy) {
  throw DataError(file.source, what + " cannot be read in pieces", remedy + kLeaveOut);
}

}  // namespace

OpenedFile::OpenedFile(const std::filesystem::path& given)
    : path(given),
      source(given == "-" ? "standard input" : given.string()),
      stream(given == "-" ? "/dev/stdin" : given) {
  begin.resize(TextFormat::kBegin);
  begin.resize(stream.read(begin));
  kind = kind_of(path, begin, source);
}

BlockSizes block_sizes(std::size_t memory) {
  // Facts of texts and machines: the numbers of empty fields take sixteen times as much as the
  // text; larger blocks than 4 MiB are not faster.
  constexpr std::size_t kLeast = std::size_t{1} << 16U, kMost = std::size_t{1} << 22U;
  return {std::clamp(memory / 32, kLeast, kMost), std::max(memory / 16, TextFormat::kBegin)};
}

std::unique_ptr<RowBlocks> row_blocks(std::unique_ptr<OpenedFile> file, std::size_t memory,
                                      const TimeFinder& find) {
  const BlockSizes sizes = block_sizes(memory);
  switch (file->kind) {
    case FileKind::Npy:
      refuse_blocks(*file, "a NumPy array that is packed or comes through a pipe",
                    "unpack it and give its name");
    case FileKind::Npz:
      refuse_blocks(*file, "NumPy's .npz", "save its columns as one .npy array");
    case FileKind::Mat:
      refuse_blocks(*file, "a MATLAB file before version 7.3", "save it with '-v7.3'");
    case FileKind::Workbook:
      refuse_blocks(*file, "a workbook", "save the sheet as .csv");
    case FileKind::Hdf5:
      if (!file->has_places())
        refuse_blocks(*file, "an HDF5 file that is packed or comes through a pipe",
                      "unpack it and give its name");
      return hdf5_blocks(file->path, sizes, find);
    case FileKind::Text:
      break;
  }
  return text_blocks(std::move(file), sizes, find);
}

}  // namespace lacuna
