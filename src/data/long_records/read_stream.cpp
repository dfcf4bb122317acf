// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <utility>

#include "data/formats/joined_files.hpp"
#include "data/records/columns/derivative_columns.hpp"
#include "data/records/piece_name.hpp"
#include "data/records/same_columns.hpp"
#include "find_records.hpp"
#include "is_plain.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/long_records.hpp"
#include "npy_file.hpp"
#include "spool.hpp"

namespace lacuna {

/// What is the same for all records of a file.
struct RecordFile {
  NpyFile file;
  ColumnIndices columns;
  std::optional<double> step;
};

namespace {

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
    Trajectory record = take_record(table, file_->columns, file_->step, {before, count, first});
    record.source = table.source;
    return record;
  }

 private:
  std::shared_ptr<const RecordFile> file_;
};

/// What a dataset has beside its samples.
Dataset described(Table table, const ColumnIndices& columns, ColumnRoles roles) {
  roles.names.clear();  // the columns are called so already
  // Two rows with which nothing is wrong.
  table.values = Matrix::Zero(2, static_cast<Index>(table.columns.size()));
  if (columns.time) table.values(1, *columns.time) = 1.0;
  Dataset data = assign_roles(table, roles);
  data.trajectories.clear();
  return data;
}

void add_records(const std::shared_ptr<const RecordFile>& file, Records found,
                 std::vector<std::shared_ptr<const SampleSource>>& records) {
  const std::optional<Index> numbered = file->columns.trajectory;
  std::vector<double> numbers;
  for (const TableRows& rows : found.ranges)
    numbers.push_back(numbered ? file->file.values(rows.first, 1)(0, *numbered) : 0.0);
  const std::vector<std::string> names =
      names_of_parts(file->file.columns().source, numbers);
  for (std::size_t i = 0; i < found.ranges.size(); ++i)
    records.push_back(std::make_shared<const RecordInFile>(file, found.ranges[i], names[i]));
}

/// The same roles, or with states that are no derivatives of others by the first rows.
/// @param notes gets a sentence on those.
ColumnRoles with_own_states(const NpyFile& file, ColumnRoles roles,
                            std::vector<std::string>& notes) {
  constexpr Index kRows = 20000;  // a fact of cost: as many as returns are sought among
  if (!roles.states.empty() || !roles.derivatives.empty() ||
      named_derivatives(file.columns().columns).empty())
    return roles;
  ColumnRoles called = roles;
  called.names.clear();  // the columns are called so already
  const Dataset all = assign_roles(file.read(0, std::min(kRows, file.rows())), called);
  const Dataset own = without_derivative_columns(all);
  if (own.state_count() == all.state_count()) return roles;
  notes.push_back(own.notes.back());
  roles.states = names_of(own.states);
  return roles;
}

void append_notes(const std::vector<std::string>& notes, Dataset& data) {
  data.notes.insert(data.notes.end(), notes.begin(), notes.end());
}

}  // namespace

/// Files, and what a dataset has of them beside its samples.
struct RecordFiles {
  std::vector<std::shared_ptr<const RecordFile>> files;
  Dataset description;
};

std::shared_ptr<const RecordFiles> open_records(const std::vector<std::string>& paths,
                                                const ColumnRoles& roles,
                                                const RunContext& context, std::size_t memory) {
  RecordFiles all;
  ColumnRoles fixed = roles;
  for (const std::string& path : expand_patterns(paths)) {
    if (joined_files(path).size() > 1)
      throw DataError(path, "joined files cannot be read in pieces", "leave out --memory");
    NpyFile file = open_rows(path, memory, context, time_finder(fixed));
    for (const auto& [name, column] : roles.names) rename_column(file.columns(), name, column);
    name_in_order(file.columns(), fixed);
    const Table& first = all.files.empty() ? file.columns() : all.files[0]->file.columns();
    check_same_columns(first, file.columns());
    std::vector<std::string> notes;
    if (all.files.empty()) fixed = with_own_states(file, std::move(fixed), notes);
    ColumnIndices columns = find_columns(file.columns(), fixed);
    Dataset description = described(file.columns(), columns, fixed);
    if (all.files.empty()) {
      fixed = fixed_roles(first, fixed);
      all.description = std::move(description);
      append_notes(notes, all.description);
    } else {
      check_same_units(all.description, description, file.columns().source, first.source);
      append_notes(description.notes, all.description);
    }
    all.files.push_back(std::make_shared<const RecordFile>(
        RecordFile{std::move(file), std::move(columns), roles.step}));
  }
  return std::make_shared<const RecordFiles>(std::move(all));
}

RecordStream read_stream(const RecordFiles& all, const RunContext& context) {
  Dataset description = all.description;
  std::vector<std::shared_ptr<const SampleSource>> records;
  for (const auto& file : all.files) {
    Records found = find_records(file->file, file->columns, context);
    append_notes(found.notes, description);
    add_records(file, std::move(found), records);
  }
  return {std::move(description), std::move(records)};
}

std::optional<RecordStream> read_hopeful_stream(const RecordFiles& all,
                                                const RunContext& context) {
  if (context.team != nullptr || all.files[0]->columns.trajectory) return std::nullopt;
  std::vector<std::shared_ptr<const SampleSource>> records;
  Index rows = 0;
  for (const auto& file : all.files) {
    if (file->file.rows() < 2) return std::nullopt;
    records.push_back(std::make_shared<const HopefulRecord>(file));
    rows += file->file.rows();
  }
  RecordStream stream(all.description, std::move(records));
  const bool all_are_read = stream.is_long() && stream.samples() == rows;
  return all_are_read ? std::optional<RecordStream>(std::move(stream)) : std::nullopt;
}

RecordStream read_stream(const std::vector<std::string>& paths, const ColumnRoles& roles,
                         const RunContext& context) {
  return read_stream(*open_records(paths, roles, context), context);
}

}  // namespace lacuna
