// SPDX-License-Identifier: MIT
#include "support/cells.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <set>
#include <sstream>
#include <string_view>

#include "core/files/atomic_file.hpp"
#include "core/files/file_bytes.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/parallel.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// FNV-1a, 16 hexadecimal digits.
std::string digest(std::string_view bytes) {
  std::uint64_t sum = 14695981039346656037u;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016" PRIx64, sum);
  return text.data();
}

/// Of the file that is run: what another build has computed is not taken for the work of this
/// one. Empty where the system does not tell which file it is; a shared library is not seen.
const std::string& program() {
  static const std::string of_file = [] {
    const fs::path self = "/proc/self/exe";
    return fs::exists(self) ? file_digest(self) : std::string();
  }();
  return of_file;
}

Json key_of(const CellStore& store, const std::string& cell) {
  return {{"study", store.study},
          {"settings", store.settings},
          {"program", program()},
          {"cell", cell}};
}

/// FOLDER/STUDY/NAME-DIGEST.json; the name is for people, the digest of the key tells cells
/// apart.
fs::path place_of(const CellStore& store, const Json& key) {
  constexpr std::size_t kReadable = 80;
  std::string name = key.at("cell").get<std::string>().substr(0, kReadable);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') c = '_';
  return *store.folder / store.study / (name + "-" + digest(key.dump()) + ".json");
}

/// A finished cell; nothing where it is missing or its file is damaged.
std::optional<CellRecord> kept_cell(const CellStore& store, const std::string& cell) {
  const Json key = key_of(store, cell);
  const fs::path path = place_of(store, key);
  if (!fs::exists(path)) return {};
  const Json file = Json::parse(read_bytes(path).view(), nullptr, false);
  if (file.is_discarded()) {
    std::cerr << path.string() + ": damaged; the cell is computed again\n";
    return {};
  }
  try {
    if (file.at("key") == key)
      return CellRecord{file.at("value"), file.at("machine"), file.at("day"),
                        file.at("seconds")};
  } catch (const Json::exception&) {
    // Told below.
  }
  throw DataError(path.string(), "is not the cell '" + cell + "' of study_" + store.study,
                  "remove the file, or give --cells another folder");
}

void keep(const CellStore& store, const std::string& cell, const CellRecord& record) {
  const Json key = key_of(store, cell);
  const Json file = {{"key", key},
                     {"machine", record.machine},
                     {"day", record.day},
                     {"seconds", record.seconds},
                     {"value", record.value}};
  write_file_atomically(place_of(store, key), file.dump() + "\n");
}

void check(const CellStore& store, const std::vector<std::string>& names) {
  if (store.share.size > 1 && !store.folder)
    throw ConfigError("study_" + store.study,
                      std::to_string(store.share.size) +
                          " processes have no folder by which to share the cells",
                      "give --cells FOLDER, a folder that all of them see");
  if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
    throw ArgumentError("study_" + store.study, "two cells have the same name",
                        "name each after all that it depends on");
  std::error_code error;
  if (store.folder) fs::create_directories(*store.folder / store.study, error);
  if (error)
    throw FileError((*store.folder / store.study).string(),
                    "cannot be made: " + error.message(), "give --cells another folder");
}

/// Says on standard error when another per cent of the cells is finished.
class Progress {
 public:
  Progress(std::string study, std::size_t count) : study_(std::move(study)), count_(count) {}

  void add() {
    const std::size_t done = ++done_, percent = 100 * done / count_;
    if (percent == 100 * (done - 1) / count_) return;
    std::cerr << study_ + ": " + std::to_string(done) + " of " + std::to_string(count_) +
                     " cells\n";
  }

 private:
  std::string study_;
  std::size_t count_;
  std::atomic<std::size_t> done_ = 0;
};

CellRecord computed(const std::function<Json()>& work, Pace pace) {
  const auto begin = std::chrono::steady_clock::now();
  CellRecord record{work(), machine_description(), today(), 0.0};
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  record.seconds = time.count() / (pace == Pace::AllCores ? cores() : 1);
  return record;
}

std::optional<int> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return {};
  int number = 0;
  const char* const end = text + std::string_view(text).size();
  const auto [stop, error] = std::from_chars(text, end, number);
  if (error != std::errc() || stop != end || number < 0)
    throw ConfigError(variable, "is '" + std::string(text) + "', no number of a process",
                      "start the study by mpirun or srun, or unset it");
  return number;
}

}  // namespace

std::string file_digest(const fs::path& path) { return digest(read_bytes(path).view()); }

void report_other_values(const CellStore& store, const std::string& cell) {
  throw DataError("cell '" + cell + "' of study_" + store.study,
                  "holds other values than this program computes",
                  "give --cells another folder");
}

Share share_of_launcher() {
  // A batch script of Slurm, not started by srun, is told SLURM_PROCID and SLURM_NTASKS too,
  // and is alone.
  constexpr std::array<std::array<const char*, 2>, 3> kLaunchers{
      {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
       {"PMI_RANK", "PMI_SIZE"},
       {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}}};
  for (const auto& [rank_name, size_name] : kLaunchers) {
    const auto rank = number_in(rank_name), size = number_in(size_name);
    if (!rank || !size) continue;
    if (*rank >= *size)
      throw ConfigError(rank_name, "is not below " + std::string(size_name),
                        "start the study by mpirun or srun, or unset both");
    return {*rank, *size};
  }
  return {};
}

Origin origin_of(const std::vector<CellRecord>& records) {
  Origin origin;
  std::set<std::string> machines;
  for (const CellRecord& record : records) {
    if (machines.insert(record.machine).second)
      origin.machine += (origin.machine.empty() ? "" : "; ") + record.machine;
    origin.day = std::max(origin.day, record.day);
    origin.seconds += record.seconds;
  }
  return origin;
}

std::optional<std::vector<CellRecord>> finish_cells(
    const CellStore& store, const std::vector<std::string>& names, Pace pace,
    const std::function<Json(std::size_t)>& work) {
  check(store, names);
  const auto kept = [&](std::size_t cell) {
    return store.folder ? kept_cell(store, names[cell]) : std::nullopt;
  };
  std::vector<std::optional<CellRecord>> records(names.size());
  std::vector<std::size_t> own;
  for (std::size_t k = 0; k < records.size(); ++k)
    if (store.share.has(k)) own.push_back(k);
  Progress progress(store.study, own.size());
  const auto finish = [&](std::size_t i) {
    std::optional<CellRecord>& record = records[own[i]];
    record = kept(own[i]);
    if (!record) {
      record = computed([&] { return work(own[i]); }, pace);
      if (store.folder) keep(store, names[own[i]], *record);
    }
    progress.add();
  };
  if (pace == Pace::AllCores)
    for_all(own.size(), finish);
  else
    for (std::size_t i = 0; i < own.size(); ++i) finish(i);

  for (std::size_t k = 0; k < records.size(); ++k)
    if (!store.share.has(k)) records[k] = kept(k);
  const auto missing =
      std::ranges::count_if(records, [](const auto& record) { return !record.has_value(); });
  if (missing > 0) {
    std::cerr << store.study + ": process " + std::to_string(store.share.rank) +
                     " has finished its cells; " + std::to_string(missing) +
                     " of other processes are missing\n";
    return {};
  }
  std::vector<CellRecord> all;
  for (auto& record : records) all.push_back(std::move(*record));
  return all;
}

}  // namespace lacuna::benchmarks
