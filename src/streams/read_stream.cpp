// SPDX-License-Identifier: MIT
#include "lacuna/streams/read_stream.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "find_records.hpp"
#include "is_plain.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/data/read.hpp"
#include "npy_file.hpp"

namespace lacuna {
namespace {

/// What is the same for all records of a file.
struct RecordFile {
  NpyFile file;
  ColumnIndices columns;
  std::optional<double> step;
};

class RecordInFile final : public SampleSource {
 public:
  RecordInFile(std::shared_ptr<const RecordFile> file, TableRows rows, std::string name)
      : file_(std::move(file)), rows_(rows), name_(std::move(name)) {}

  Index samples() const override { return rows_.count; }

  Trajectory read(Index first, Index count) const override {
    const Table table = file_->file.read(rows_.first + first, count);
    Trajectory record =
        take_record(table, file_->columns, file_->step, {0, count, rows_.offset + first});
    record.source = name_;
    return record;
  }

 private:
  std::shared_ptr<const RecordFile> file_;
  TableRows rows_;
  std::string name_;
};

/// All rows of a file, taken for one record until one that is read says otherwise.
class HopefulRecord final : public SampleSource {
 public:
  explicit HopefulRecord(std::shared_ptr<const RecordFile> file) : file_(std::move(file)) {}

  Index samples() const override { return file_->file.rows(); }

  Trajectory read(Index first, Index count) const override {
    const Index before = std::min<Index>(first, 1);  // the step between two reads is one, too
    const Table table = file_->file.read(first - before, before + count);
    if (!is_plain(table.values, file_->columns))
      throw InterruptedRecord(table.source, "these rows are not one record",
                              "look for where it is interrupted");
    Trajectory record =
        take_record(table, file_->columns, file_->step, {before, count, first});
    record.source = table.source;
    return record;
  }

 private:
  std::shared_ptr<const RecordFile> file_;
};

void check_columns(const Table& first, const Table& other) {
  if (names_of(first.columns) == names_of(other.columns)) return;
  throw DataError(other.source,
                  "its columns (" + join(names_of(other.columns), ", ") +
                      ") are not those of " + first.source + " (" +
                      join(names_of(first.columns), ", ") + ")",
                  "give files with the same columns in the same order, or read them apart");
}

/// What a dataset says beside its samples.
Dataset described(const NpyFile& file, const ColumnRoles& roles) {
  constexpr Index kFew = 4096;
  ColumnRoles known = roles;
  known.names.clear();  // the columns are called so already
  Dataset data = assign_roles(file.read(0, std::min(file.rows(), kFew)), known);
  data.trajectories.clear();
  return data;
}

std::shared_ptr<const RecordFile> open_file(const std::string& path, const ColumnRoles& roles) {
  NpyFile file(path);
  for (const auto& [name, column] : roles.names) rename_column(file.columns(), name, column);
  ColumnIndices columns = find_columns(file.columns(), roles);
  return std::make_shared<const RecordFile>(
      RecordFile{std::move(file), std::move(columns), roles.step});
}

void add_records(const std::shared_ptr<const RecordFile>& file, Records found,
                 std::vector<std::shared_ptr<const SampleSource>>& records) {
  for (std::size_t i = 0; i < found.ranges.size(); ++i) {
    std::string name = file->file.columns().source;
    if (found.ranges.size() > 1) name += ", record " + std::to_string(i + 1);
    records.push_back(std::make_shared<const RecordInFile>(file, found.ranges[i], name));
  }
}

/// The files and what a dataset says beside its samples.
struct Files {
  std::vector<std::shared_ptr<const RecordFile>> files;
  Dataset description;
};

Files open_files(const std::vector<std::string>& paths, const ColumnRoles& roles) {
  Files all;
  for (const std::string& path : expand_patterns(paths)) {
    all.files.push_back(open_file(path, roles));
    check_columns(all.files.front()->file.columns(), all.files.back()->file.columns());
  }
  all.description = described(all.files.front()->file, roles);
  return all;
}

}  // namespace

RecordStream read_stream(const std::vector<std::string>& paths, const ColumnRoles& roles,
                         const RunContext& context) {
  auto [files, description] = open_files(paths, roles);
  std::vector<std::shared_ptr<const SampleSource>> records;
  for (const auto& file : files) {
    Records found = find_records(file->file, file->columns, context);
    description.notes.insert(description.notes.end(), found.notes.begin(), found.notes.end());
    add_records(file, std::move(found), records);
  }
  return {std::move(description), std::move(records)};
}

std::optional<RecordStream> read_hopeful_stream(const std::vector<std::string>& paths,
                                                const ColumnRoles& roles,
                                                const RunContext& context) {
  if (context.team != nullptr || roles.trajectory) return std::nullopt;
  auto [files, description] = open_files(paths, roles);
  std::vector<std::shared_ptr<const SampleSource>> records;
  Index rows = 0;
  for (const auto& file : files) {
    if (file->file.rows() < 2) return std::nullopt;
    records.push_back(std::make_shared<const HopefulRecord>(file));
    rows += file->file.rows();
  }
  RecordStream stream(std::move(description), std::move(records));
  const bool all_are_read = stream.is_long() && stream.samples() == rows;
  return all_are_read ? std::optional<RecordStream>(std::move(stream)) : std::nullopt;
}

}  // namespace lacuna
