// SPDX-License-Identifier: MIT
#include "spice.hpp"

#include <cstdlib>
#include <thread>

#include "dynamics/test_systems/spice_record.hpp"
#include "lacuna/core/base/error.hpp"
#include "sources.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr double kTau = 1e-4;    // s
constexpr double kBegin = 1e-4;  // s, after the amplifiers have settled

bool run_ngspice(const std::string& name, const std::filesystem::path& folder) {
  const std::filesystem::path netlist =
      std::filesystem::path(LACUNA_PAPER_NETLISTS) / (name + ".cir");
  const std::string command = "cd '" + folder.string() + "' && ngspice -b -r " + name +
                              ".raw '" + netlist.string() + "' > " + name + ".log 2>&1";
  return std::system(command.c_str()) == 0;
}

std::optional<Dataset> simulate_netlist(const std::string& name,
                                        const std::filesystem::path& folder) {
  const std::filesystem::path raw = folder / (name + ".raw");
  std::filesystem::remove(raw);
  if (!run_ngspice(name, folder) || !std::filesystem::exists(raw)) return {};
  try {
    const Dataset record = read_spice_output(raw);
    std::filesystem::remove(raw);  // 12 MB of text
    return resampled(record, kBegin, kTau, kStep, kSamples);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

std::vector<std::optional<Dataset>> simulate_netlists(const std::vector<std::string>& names,
                                                      Output& output) {
  std::vector<std::optional<Dataset>> records(names.size());
  if (std::system("ngspice --version > /dev/null 2>&1") != 0) {
    output.skip("rows " + names.front() + " .. " + names.back() + " of Multisim",
                "ngspice is not installed (package ngspice)");
    return records;
  }
  const std::filesystem::path folder = std::filesystem::absolute(output.folder());
  for (std::size_t i = 0; i < names.size(); i += 2) {
    std::vector<std::jthread> threads;
    for (std::size_t k = i; k < std::min(i + 2, names.size()); ++k)
      threads.emplace_back([&, k] { records[k] = simulate_netlist(names[k], folder); });
  }
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!records[k])
      output.skip("netlist " + names[k], "ngspice failed; see " + names[k] + ".log");
  return records;
}

}  // namespace lacuna::benchmarks
