// SPDX-License-Identifier: MIT
// Drives a fuzz target. With libFuzzer: its entry points. Without: random changes of the seeds.
// Usage: fuzz_NAME [SECONDS [SEED]], or libFuzzer's options and folders of inputs.
#include "fuzz/target.hpp"

#ifdef LACUNA_LIBFUZZER

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>

/// Puts the seeds into the folders of inputs, before libFuzzer reads them.
extern "C" int LLVMFuzzerInitialize(const int* argc, char*** argv) {
  const std::vector<std::string> good = lacuna::fuzz::seeds();
  for (int i = 1; i < *argc; ++i) {
    const std::filesystem::path folder = (*argv)[i];
    if (!std::filesystem::is_directory(folder)) continue;
    for (std::size_t k = 0; k < good.size(); ++k)
      std::ofstream(folder / ("seed" + std::to_string(k)), std::ios::binary) << good[k];
  }
  return 0;
}

/// An input that takes longer is a finding. libFuzzer's own limit counts by the clock, on which
/// others are too.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double kLongest = 20.0;  // seconds of a core
  const std::clock_t begin = std::clock();
  lacuna::fuzz::take({reinterpret_cast<const char*>(data), size});
  const double taken = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (taken > kLongest) {
    std::fprintf(stderr, "an input takes %.0f s of a core\n", taken);
    std::abort();
  }
  return 0;
}

#else

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "unit/data/formats/mutate.hpp"

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10.0;
  lacuna::Random random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  const std::vector<std::string> good = lacuna::fuzz::seeds();
  std::string alphabet = "0123456789.,;eE+-*/^()[]{}\"': \t\n\rnaixyt";
  for (int byte = 0; byte < 256; byte += 5) alphabet += static_cast<char>(byte);
  long runs = 0;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (std::string input; Clock::now() < end; ++runs) {
    if (runs % 50 == 0 || input.empty()) input = good[random.below(good.size())];
    input = lacuna::testing::mutated(input, alphabet, random);
    lacuna::fuzz::take(input);
  }
  std::printf("%ld inputs\n", runs);
}

#endif
