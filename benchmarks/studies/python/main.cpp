// SPDX-License-Identifier: MIT
// What calls of the Python package cost in C++: calls.py, beside this file, runs both in turn.
// Usage: study_python identify|evaluate RECORD.npy
//        (t, x, y, z in its columns) prints seconds, seconds of all threads, and MB above those
//        before the call.
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "cli/commands/answers.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "support/meter.hpp"

namespace lacuna::benchmarks {
namespace {

/// Records as a call has them: in memory, the answer as the text of its JSON.
Reading identify_record(Table table) {
  const Registry registry = default_registry();
  cli::IdentifyRequest request;
  request.data.states = "x,y,z";
  request.data.tables.push_back(std::move(table));
  RunContext context;
  context.threads = 1;
  const Meter meter;
  const std::string text = format_json(cli::answer(registry, request, context).report);
  const Reading reading = meter.read();
  if (text.empty()) throw Error("identify", "there is no answer", "");
  return reading;
}

/// Rates of Lorenz' system at every sample.
Reading evaluate_rows(const Table& table) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Rows states = table.values.rightCols(3);
  CompiledModel model = test_system("lorenz").model.compile();
  const Meter meter;
  Vector rates(states.size());
  for (Index i = 0; i < states.rows(); ++i)
    model.evaluate(0.0, &states(i, 0), nullptr, nullptr, rates.data() + 3 * i);
  const Reading reading = meter.read();
  if (!std::isfinite(rates[0])) throw Error("evaluate", "a rate is not finite", "");
  return reading;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  using namespace lacuna::benchmarks;
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool identifies = arguments.at(0) == "identify";
    lacuna::Table table = lacuna::read_table(arguments.at(1));
    const Reading reading =
        identifies ? identify_record(std::move(table)) : evaluate_rows(table);
    std::cout << reading.wall << ' ' << reading.cpu << ' ' << reading.megabytes << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "study_python: " << error.what() << '\n';
    return 2;
  }
}
