// SPDX-License-Identifier: MIT
// Files that are read block by block, without being held in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/files/byte_stream.hpp"
#include "data/times/counted_times.hpp"
#include "file_kinds.hpp"
#include "lacuna/data/records/table.hpp"

namespace lacuna {

/// The rows of a file, which come in blocks, in their order.
class RowBlocks {
 public:
  virtual ~RowBlocks() = default;

  /// The table without rows, as read_table() gives it.
  virtual const Table& columns() const = 0;

  /// Puts the next rows, and their lines in a text, in the place of those of a table with these
  /// columns.
  /// @return false where there are no more.
  /// @throws FileError, DataError as read_table() does.
  virtual bool next(Table& block) = 0;

  /// Fraction of the file that has been read, 0..1; nothing where nobody knows how long it is.
  virtual std::optional<double> fraction() const = 0;
};

/// A file, or standard input ("-"), whose begin has been looked at.
struct OpenedFile {
  /// @throws FileError, DataError as read_table().
  explicit OpenedFile(const std::filesystem::path& path);

  std::filesystem::path path;
  std::optional<std::string> sheet;  ///< of a workbook
  std::string source;  ///< name for messages
  ByteStream stream;
  std::string begin;  ///< what has been read from the stream: 1 MiB, or all where there is less
  FileKind kind = FileKind::Text;

  /// Whether it can be read at any place by its name, as it is.
  bool has_places() const {
    return path != "-" && stream.file_size().has_value() && !stream.is_packed();
  }
};

/// How much memory the blocks of a reader may take, in bytes.
struct BlockSizes {
  std::size_t block = 0;    ///< of text, or of numbers
  std::size_t longest = 0;  ///< line of a text, or what is packed together
};

/// Blocks for a reader that may take so many bytes in all.
BlockSizes block_sizes(std::size_t memory);

/// The rows of a text or of an HDF5 file; of a workbook, which is packed, all of them at once,
/// where its text takes no more than half of the memory.
/// @param memory that reading may take, in bytes.
/// @param find the time, which is counted from its first value where doubles do not hold it.
/// @throws FileError, DataError as read_table(); DataError for what cannot be read in blocks.
std::unique_ptr<RowBlocks> row_blocks(std::unique_ptr<OpenedFile> file, std::size_t memory,
                                      const TimeFinder& find = no_time);

/// Those of a text, packed or not, from a file or a pipe.
std::unique_ptr<RowBlocks> text_blocks(std::unique_ptr<OpenedFile> file, BlockSizes sizes,
                                       const TimeFinder& find = no_time);

}  // namespace lacuna
