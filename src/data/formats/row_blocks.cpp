// SPDX-License-Identifier: MIT
#include "row_blocks.hpp"

#include <algorithm>
#include <utility>

#include "data/sheets/workbook.hpp"
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

/// All rows of a table in one block.
class WholeTable final : public RowBlocks {
 public:
  explicit WholeTable(Table table) : rows_(std::move(table)), columns_(rows_) {
    columns_.values.resize(0, 0);
    columns_.lines.clear();
  }

  const Table& columns() const override { return columns_; }

  bool next(Table& block) override {
    if (has_ended_) return false;
    has_ended_ = true;
    block.values = std::move(rows_.values);
    block.lines = std::move(rows_.lines);
    return true;
  }

  std::optional<double> fraction() const override { return has_ended_ ? 1.0 : 0.0; }

 private:
  Table rows_, columns_;
  bool has_ended_ = false;
};

/// All bytes of a file whose begin has been read.
/// @throws DataError where they take more than the memory.
std::string all_bytes(OpenedFile& file, std::size_t memory) {
  std::string bytes = std::exchange(file.begin, {});
  for (std::size_t added = bytes.size(); added > 0;) {
    if (bytes.size() > memory) refuse_blocks(file, "so large a workbook", "raise --memory");
    const std::size_t before = bytes.size();
    bytes.resize(before + TextFormat::kBegin);
    added = file.stream.read({bytes.data() + before, TextFormat::kBegin});
    bytes.resize(before + added);
  }
  return bytes;
}

std::unique_ptr<RowBlocks> workbook_rows(OpenedFile& file, std::size_t memory,
                                         const TimeFinder& find) {
  const std::string text = sheet_text(all_bytes(file, memory / 2), file.sheet, file.source);
  if (text.size() > memory / 2) refuse_blocks(file, "so large a workbook", "raise --memory");
  return std::make_unique<WholeTable>(parse_text(text, file.source, find));
}

}  // namespace

OpenedFile::OpenedFile(const std::filesystem::path& given)
    : path(file_and_sheet(given).file),
      sheet(file_and_sheet(given).sheet),
      source(given == "-" ? "standard input" : given.string()),
      stream(given == "-" ? "/dev/stdin" : path) {
  begin.resize(TextFormat::kBegin);
  begin.resize(stream.read(begin));
  kind = kind_of(path, begin, source);
  check_sheet(sheet, kind, source);
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
      return workbook_rows(*file, memory, find);
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
