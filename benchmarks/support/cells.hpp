// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
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

enum class Pace {
  AllCores,  ///< a cell for each core
  OneByOne,  ///< for cells that measure time, or use all cores themselves
};

/// Cells of one study: cell k is called names[k], and work(k) computes it.
template <class Value>
struct CellWork {
  std::vector<std::string> names;
  std::function<Value(std::size_t)> work;
  Pace pace = Pace::AllCores;
};

/// What there is to say of the making of cells. It depends on the cells only, so that every
/// process that writes the table writes the same.
struct Origin {
  std::string machine;   ///< machine_description(); several by "; "
  std::string day;       ///< of the cell that was finished last
  double seconds = 0.0;  ///< sum of Finished::seconds
};

/// All cells in the order of their names.
template <class Value>
struct Finished {
  std::vector<Value> values;
  std::vector<double>
      seconds;  ///< of the machine: by the clock, over the cells it has at a time
  Origin origin;

  /// Values of the cells first, ..., first + count - 1.
  std::span<const Value> part(std::size_t first, std::size_t count) const {
    return std::span(values).subspan(first, count);
  }
};

/// A cell as it is kept.
struct CellRecord {
  nlohmann::json value;
  std::string machine, day;
  double seconds = 0.0;
};

/// run_cells() without types.
std::optional<std::vector<CellRecord>> finish_cells(const CellStore& store,
                                                    const CellWork<nlohmann::json>& cells);

/// @throws DataError always.
[[noreturn]] void tell_other_values(const CellStore& store, const std::string& cell);

Origin origin_of(const std::vector<CellRecord>& records);

/// Takes finished cells from the folder of the store, computes and keeps what is missing of
/// this process's share, and then looks for those of the others.
/// @return nothing where another process has not finished all of its cells yet: whoever
/// finishes
///   last finds them all.
/// @throws ConfigError when there are several processes and no folder; DataError when a file is
///   in the place of a cell that is none of this study; FileError when a cell cannot be kept;
///   ArgumentError when two cells have the same name; and what the work throws.
template <class Value>
std::optional<Finished<Value>> run_cells(const CellStore& store, const CellWork<Value>& cells) {
  const auto work = [&](std::size_t cell) {
    Value value = cells.work(cell);
    return json_of(value);
  };
  const auto records = finish_cells(store, {cells.names, work, cells.pace});
  if (!records) return {};
  Finished<Value> finished{std::vector<Value>(records->size()), {}, origin_of(*records)};
  for (std::size_t k = 0; k < records->size(); ++k) {
    try {
      read_value((*records)[k].value, finished.values[k]);
    } catch (const nlohmann::json::exception&) {
      tell_other_values(store, cells.names[k]);
    }
    finished.seconds.push_back((*records)[k].seconds);
  }
  return finished;
}

}  // namespace lacuna::benchmarks
