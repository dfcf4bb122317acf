// SPDX-License-Identifier: MIT
#include "support/table.hpp"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <thread>

#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"

namespace lacuna::benchmarks {
namespace {

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0)
      return std::string(trim(line.substr(line.find(':') + 1)));
  return "unknown processor";
}

std::string markdown_row(const std::vector<std::string>& cells) {
  return "| " + join(cells, " | ") + " |\n";
}

/// Cells with commas in quotes.
std::string csv_row(std::vector<std::string> cells) {
  for (std::string& cell : cells)
    if (cell.find(',') != std::string::npos) cell = "\"" + cell + "\"";
  return join(cells, ",") + "\n";
}

}  // namespace

std::string ResultTable::csv() const {
  std::string text = csv_row(header);
  for (const auto& row : rows) text += csv_row(row);
  return text;
}

std::string ResultTable::markdown() const {
  std::string text = markdown_row(header);
  text += markdown_row(std::vector<std::string>(header.size(), "---"));
  for (const auto& row : rows) text += markdown_row(row);
  return text;
}

void write_results(const std::filesystem::path& folder, const std::string& name,
                   const std::string& csv, const std::string& markdown) {
  std::filesystem::create_directories(folder);
  write_file_atomically(folder / (name + ".csv"), csv);
  write_file_atomically(folder / (name + ".md"), markdown);
}

void write_page(const std::filesystem::path& folder, const std::string& name,
                const std::string& text) {
  std::filesystem::create_directories(folder);
  write_file_atomically(folder / (name + ".md"), text);
  std::cout << text;
}

std::string machine_description() {
  return processor_name() + ", " + std::to_string(std::thread::hardware_concurrency()) +
         " cores, " + LACUNA_COMPILER;
}

std::string today() {
  const std::time_t now =
      std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm day{};
  gmtime_r(&now, &day);  // cells ask on threads of their own
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &day);
  return text;
}

bool render_with_gnuplot(const std::filesystem::path& script) {
  const std::string command = "cd '" + script.parent_path().string() + "' && gnuplot '" +
                              script.filename().string() + "' 2>/dev/null";
  return std::system(command.c_str()) == 0;
}

}  // namespace lacuna::benchmarks
