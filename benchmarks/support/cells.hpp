// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/cell_values.hpp"

namespace lacuna::benchmarks {

/// The part of one process: cell k belongs to process k mod size.
struct Share {
  int rank = 0;
  int size = 1;

  bool has(std::size_t cell) const {
    return cell % static_cast<std::size_t>(size) == static_cast<std::size_t>(rank);
  }
};

/// This process's share, from what mpirun or srun tells the processes it starts
/// (OMPI_COMM_WORLD_RANK and ..._SIZE, PMI_RANK and PMI_SIZE, SLURM_PROCID and
/// SLURM_STEP_NUM_TASKS); all of it where nothing is told.
/// @throws ConfigError when the numbers are no rank and size.
Share share_of_launcher();

/// Where a study keeps its finished cells, and which of them this process computes.
struct CellStore {
  std::string study;     ///< "odebench"
  std::string settings;  ///< what, beside the program and a cell's name, decides its values
  std::optional<std::filesystem::path> folder = {};
  Share share = {};
};

/// What stands for the content of a file among settings. @throws FileError.
std::string file_digest(const std::filesystem::path& path);

enum class Pace {
  AllCores,  ///< a cell for each core
  OneByOne,  ///< for cells that measure time, or use all cores themselves
};

/// The cells of a study, each with what computes it. The names tell them apart.
template <class Value>
class Cells {
 public:
  explicit Cells(Pace pace = Pace::AllCores) : pace_(pace) {}

  /// What is added from now on is a group, whose name stands before those of its cells.
  void begin_group(const std::string& name) {
    group_ = name.empty() ? "" : name + " ";
    groups_.push_back(names_.size());
  }

  void add(const std::string& name, std::function<Value()> work) {
    names_.push_back(group_ + name);
    work_.push_back(std::move(work));
  }

  /// A group of cells draw(1), ..., draw(count).
  void add_draws(const std::string& group, std::size_t count,
                 const std::function<Value(std::size_t)>& draw) {
    begin_group(group);
    for (std::size_t k = 1; k <= count; ++k) add(std::to_string(k), [=] { return draw(k); });
  }

  Pace pace() const { return pace_; }
  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::size_t>& groups() const { return groups_; }  ///< first cell of each
  Value compute(std::size_t cell) const { return work_[cell](); }

 private:
  Pace pace_;
  std::string group_;
  std::vector<std::string> names_;
  std::vector<std::size_t> groups_;
  std::vector<std::function<Value()>> work_;
};

/// What there is to say of the making of cells. It depends on the cells only, so that every
/// process that writes the table writes the same.
struct Origin {
  std::string machine;   ///< machine_description(); several by "; "
  std::string day;       ///< of the cell that was finished last
  double seconds = 0.0;  ///< sum of Finished::seconds
};

/// All cells in the order in which they were added.
template <class Value>
struct Finished {
  std::vector<Value> values;
  /// Of the machine: by the clock, over the cells that it works on at a time.
  std::vector<double> seconds;
  std::vector<std::size_t> groups;  ///< first cell of each
  Origin origin;

  std::span<const Value> group(std::size_t k) const { return part(values, k); }

  double seconds_of_group(std::size_t k) const {
    const auto own = part(seconds, k);
    return std::accumulate(own.begin(), own.end(), 0.0);
  }

 private:
  template <class T>
  std::span<const T> part(const std::vector<T>& all, std::size_t k) const {
    const std::size_t end = k + 1 < groups.size() ? groups[k + 1] : all.size();
    return std::span(all).subspan(groups[k], end - groups[k]);
  }
};

/// A cell as it is kept.
struct CellRecord {
  nlohmann::json value;
  std::string machine, day;
  double seconds = 0.0;
};

/// run_cells() without types. @param work computes a cell.
std::optional<std::vector<CellRecord>> finish_cells(
    const CellStore& store, const std::vector<std::string>& names, Pace pace,
    const std::function<nlohmann::json(std::size_t)>& work);

/// @throws DataError always.
[[noreturn]] void report_other_values(const CellStore& store, const std::string& cell);

Origin origin_of(const std::vector<CellRecord>& records);

/// Takes finished cells from the folder of the store, computes and keeps what is missing of
/// this process's share, and then looks for those of the others.
/// @return nothing where another process has not finished all of its cells yet: who finishes
///   last finds them all.
/// @throws ConfigError when there are several processes and no folder; DataError when a file is
///   in the place of a cell that is none of this study; FileError when a cell cannot be kept;
///   ArgumentError when two cells have the same name; and what the work throws.
template <class Value>
std::optional<Finished<Value>> run_cells(const CellStore& store, const Cells<Value>& cells) {
  const auto records = finish_cells(store, cells.names(), cells.pace(), [&](std::size_t cell) {
    Value value = cells.compute(cell);
    return json_of(value);
  });
  if (!records) return {};
  Finished<Value> finished;
  finished.values.resize(records->size());
  finished.groups = cells.groups();
  finished.origin = origin_of(*records);
  for (std::size_t k = 0; k < records->size(); ++k) {
    try {
      read_value((*records)[k].value, finished.values[k]);
    } catch (const nlohmann::json::exception&) {
      report_other_values(store, cells.names()[k]);
    }
    finished.seconds.push_back((*records)[k].seconds);
  }
  return finished;
}

}  // namespace lacuna::benchmarks
