// SPDX-License-Identifier: MIT
// The tables and figures of Karimov et al. 2023, made anew beside the printed numbers. Usage:
// lacuna-paper [OUTPUT_FOLDER]      (default build/paper)
#include <chrono>
#include <exception>
#include <iostream>

#include "core/base/text.hpp"
#include "parts.hpp"

namespace lacuna::benchmarks {
namespace {

int run(const std::filesystem::path& folder) {
  const auto start = std::chrono::steady_clock::now();
  Output output(folder);
  write_figure_1(output);
  write_table_1(output);
  const std::vector<Source> sources = make_sources(output);
  write_table_2(output, sources);
  write_figures_3_4(output, sources);
  const std::vector<Identified> identified = identify_all(sources);
  write_table_3(output, identified);
  write_table_4(output, sources);
  write_table_5(output, identified);
  write_figure_5(output, identified);
  write_figure_6(output, identified);
  write_measures(output, identified);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  for (const std::string& text : output.finish(time.count()))
    std::cout << "skipped: " << text << '\n';
  std::cout << "tables and pictures in " << folder.string() << " (report.md), made in "
            << format_number(time.count(), 3) << " s\n";
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  try {
    return lacuna::benchmarks::run(argc > 1 ? argv[1] : "build/paper");
  } catch (const std::exception& error) {
    std::cerr << "lacuna-paper: " << error.what() << '\n';
    return 2;
  }
}
