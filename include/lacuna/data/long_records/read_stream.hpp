// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/long_records/record_stream.hpp"
#include "lacuna/data/records/roles.hpp"

namespace lacuna {

/// Files that are open as rows on the disk, with their columns. What is read from them keeps
/// them open.
struct RecordFiles;

/// What reading takes in blocks where nothing else is said, in bytes: a fact of the machines.
inline constexpr std::size_t kReadingMemory = std::size_t{1} << 28U;

/// Opens files (paths or patterns). NumPy arrays (.npy) are read where they are; the rows of
/// texts, of what is packed (.gz), of HDF5 files and pipes are written to temporary files
/// without a name, in one pass.
/// @param memory that this pass may take, in bytes.
/// @throws FileError, DataError as read_dataset(); FileError where the folder for temporary
///   files has no room; DataError for kinds of files that cannot be read in pieces.
std::shared_ptr<const RecordFiles> open_records(const std::vector<std::string>& paths,
                                                const ColumnRoles& roles = {},
                                                const RunContext& context = {},
                                                std::size_t memory = kReadingMemory);

/// Records that are read in pieces: one pass over the files checks them and finds where records
/// end, as split_records() does; what is kept is the excerpt.
/// @throws FileError, DataError as read_dataset() does.
RecordStream read_stream(const RecordFiles& files, const RunContext& context = {});

/// The same with open_records().
RecordStream read_stream(const std::vector<std::string>& paths, const ColumnRoles& roles = {},
                         const RunContext& context = {});

/// What was taken for one record is none: a value is missing or time does not go on evenly.
class InterruptedRecord : public Error {
 public:
  using Error::Error;
};

/// What read_stream() gives where every file is one record without interruption, and without
/// its pass: rows are checked when they are read, so whoever passes over all of them has
/// checked them all. Nothing where that is known not to be enough: records are numbered by a
/// column, thinned (rows are passed over), or divided among a team (only one member would
/// see it).
/// @throws as read_stream(); and as its records do, which throw InterruptedRecord from read().
std::optional<RecordStream> read_hopeful_stream(const RecordFiles& files,
                                                const RunContext& context = {});

/// use(records) for records that are read in pieces, in one pass less where every file is one
/// record: `use`, which passes over all rows, begins again with read_stream() where it is not.
template <class Use>
auto with_stream(const RecordFiles& files, const RunContext& context, const Use& use) {
  try {
    if (auto records = read_hopeful_stream(files, context)) return use(std::move(*records));
  } catch (const InterruptedRecord&) {
    // The pass of read_stream() finds out where records end, or what is wrong.
  }
  return use(read_stream(files, context));
}

}  // namespace lacuna
