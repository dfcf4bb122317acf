// SPDX-License-Identifier: MIT
// Reading delimited text against the least that any reader must do: get the bytes of the file
// and turn every number into a double. The aim is at most 1.5 times that.

#include <benchmark/benchmark.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/formats/write.hpp"

namespace {

using lacuna::Index;

/// A record of three states with full precision numbers, as a simulation or an averaging
/// instrument writes them: four columns with the time.
lacuna::Dataset make_record(Index rows) {
  lacuna::Random random(1);
  lacuna::Trajectory record;
  record.time.resize(rows);
  record.states.resize(rows, 3);
  for (Index i = 0; i < rows; ++i) {
    record.time[i] = 1e-3 * static_cast<double>(i);
    for (Index j = 0; j < 3; ++j)
      record.states(i, j) =
          std::sin(record.time[i] * static_cast<double>(j + 1)) + 0.01 * random.normal();
  }
  lacuna::Dataset data;
  data.states = {{"x", "V"}, {"y", "V"}, {"z", "V"}};
  data.trajectories = {record};
  return data;
}

/// A file with so many rows that lives as long as the benchmark.
class RecordFile {
 public:
  explicit RecordFile(Index rows)
      : path_(std::filesystem::temp_directory_path() /
              ("lacuna_reading_" + std::to_string(rows) + ".csv")) {
    lacuna::write_csv(path_, make_record(rows));
  }
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;
  ~RecordFile() { std::filesystem::remove(path_); }

  std::string path() const { return path_.string(); }
  std::size_t size() const { return std::filesystem::file_size(path_); }

 private:
  std::filesystem::path path_;
};

/// The rival: one read of the file, one loop over std::from_chars, no checks.
std::vector<double> read_bare(const std::string& path, std::size_t count) {
  std::string text(std::filesystem::file_size(path), '\0');
  std::FILE* file = std::fopen(path.c_str(), "rb");
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  std::vector<double> values;
  values.reserve(count);
  const char* p = text.data() + text.find('\n') + 1;
  const char* end = text.data() + text.size();
  while (p < end) {
    double value = 0.0;
    p = std::from_chars(p, end, value).ptr + 1;
    values.push_back(value);
  }
  return values;
}

void finish(benchmark::State& state, const RecordFile& file) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(file.size()));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void BareLoop(benchmark::State& state) {
  const RecordFile file(state.range(0));
  const auto count = static_cast<std::size_t>(4 * state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(read_bare(file.path(), count));
  finish(state, file);
}

void ReadTable(benchmark::State& state) {
  const RecordFile file(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(lacuna::read_table(file.path()));
  finish(state, file);
}

void ReadDataset(benchmark::State& state) {
  const RecordFile file(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(lacuna::read_dataset({file.path()}));
  finish(state, file);
}

BENCHMARK(BareLoop)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(ReadTable)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(ReadDataset)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
