// SPDX-License-Identifier: MIT
#include "studies/scaling/pieces.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <stdexcept>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "lacuna/data/long_records.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "studies/scaling/records.hpp"
#include "support/meter.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRepeats = 5;

/// A file as it lies on the disk.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path)
      : handle_(open(path.c_str(), O_RDONLY)), size_(fs::file_size(path)) {
    if (handle_ < 0) throw std::runtime_error("cannot open " + path.string());
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() { close(handle_); }

  /// Takes the file out of the cache of the system.
  void forget() const {
    fsync(handle_);
    if (posix_fadvise(handle_, 0, 0, POSIX_FADV_DONTNEED) != 0)
      throw std::runtime_error("the file cannot be taken out of the cache");
  }

  /// The sum of its numbers through a mapping, with a thread for each part.
  double sum(int threads) const {
    void* memory = mmap(nullptr, size_, PROT_READ, MAP_SHARED, handle_, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("the file cannot be mapped");
    const auto count = static_cast<Index>(size_ / sizeof(double));
    const Eigen::Map<const Vector> numbers(static_cast<const double*>(memory), count);
    const Index part = count / threads;
    Vector sums(threads);
    parallel_for(static_cast<std::size_t>(threads), threads, [&](std::size_t i) {
      const auto k = static_cast<Index>(i);
      sums[k] = numbers.segment(k * part, part).sum();
    });
    munmap(memory, size_);
    return sums.sum();
  }

 private:
  int handle_;
  std::size_t size_;
};

/// One way to pass over the file, from the disk and from the cache.
struct Way {
  std::string name;
  std::vector<Reading> disk = {}, cache = {};
};

double median_wall(std::vector<Reading> readings) {
  std::sort(readings.begin(), readings.end(),
            [](const Reading& a, const Reading& b) { return a.wall < b.wall; });
  return readings[readings.size() / 2].wall;
}

template <class Pass>
void take(const OpenFile& file, Way& way, const Pass& pass) {
  for (std::vector<Reading>* readings : {&way.disk, &way.cache}) {
    if (readings == &way.disk) file.forget();
    const Meter meter;
    pass();
    readings->push_back(meter.read());
  }
}

void identify_file(const fs::path& path, const RecordProblem& problem) {
  RunContext context;
  context.threads = 2;
  const auto files = open_records({path.string()}, file_roles(problem), context);
  with_stream(*files, context, [&](const RecordStream& records) {
    return identify(records, preset("sindy"), context).model.dimension();
  });
}

std::string table_of(const std::vector<Way>& ways) {
  const Way& identified = ways.back();
  ResultTable table;
  table.header = {"", "from the disk / s", "from the cache / s", "identification takes", "MB"};
  for (const Way& way : ways) {
    double most = 0.0;
    for (const Reading& reading : way.disk) most = std::max(most, reading.megabytes);
    const double ratio = median_wall(identified.disk) / median_wall(way.disk);
    const bool is_rival = &way != &identified;
    table.rows.push_back({way.name, format_number(median_wall(way.disk), 3),
                          format_number(median_wall(way.cache), 3),
                          is_rival ? format_number(ratio, 3) + " times" : "",
                          is_rival ? "" : format_number(most, 3)});
  }
  return table.markdown();
}

}  // namespace

int run_pieces(const fs::path& folder, Index rows) {
  fs::create_directories(folder);
  const fs::path path = folder / "pieces.npy";
  const RecordProblem problem{"lorenz", test_system("lorenz").model, 0.001, rows, 0.0, true};
  write_record(problem, path);
  const OpenFile file(path);
  std::vector<Way> ways{{"mapping, 1 thread"}, {"mapping, 2 threads"}, {"identification"}};
  double sums = 0.0;
  for (std::size_t repeat = 0; repeat < kRepeats; ++repeat) {
    for (const int threads : {1, 2})
      take(file, ways[static_cast<std::size_t>(threads) - 1],
           [&] { sums += file.sum(threads); });
    take(file, ways.back(), [&] { identify_file(path, problem); });
  }
  std::cout << "sum of all: " << sums << '\n';
  write_file_atomically(
      folder / "pieces.md",
      "# A file that is read in pieces\n\n" + std::to_string(rows) +
          " rows of Lorenz' system with derivatives given (" +
          format_number(static_cast<double>(fs::file_size(path)) * 1e-9, 3) +
          " GB), preset `sindy` on two threads inside the process, beside the sum of all "
          "numbers through a\nmapping; medians of " +
          std::to_string(kRepeats) +
          " that take turns, the file taken out of the cache of the system before each that "
          "reads the disk.\n\nMade by `study_scaling pieces FOLDER " +
          std::to_string(rows) + "` on " + today() + ", " + machine_description() + ".\n\n" +
          table_of(ways));
  fs::remove(path);
  return 0;
}

}  // namespace lacuna::benchmarks
