// SPDX-License-Identifier: MIT
#include "systems.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::odebench {
namespace {

constexpr Index kSamples = 512;

Vector vector_of(const nlohmann::json& list) {
  const auto values = list.get<std::vector<double>>();
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

System system_of(const nlohmann::json& entry) {
  System system{std::to_string(entry.at("id").get<int>()) + " " +
                    entry.at("eq_description").get<std::string>(),
                {},
                {}};
  for (std::size_t s = 0; s < 2; ++s) {
    const nlohmann::json& solution = entry.at("solutions").at(0).at(s);
    system.time = vector_of(solution.at("t"));
    const nlohmann::json& states = solution.at("y");
    system.states[s].resize(system.time.size(), static_cast<Index>(states.size()));
    for (std::size_t k = 0; k < states.size(); ++k)
      system.states[s].col(static_cast<Index>(k)) = vector_of(states[k]);
  }
  return system;
}

/// A block of text before it is solved.
struct Block {
  std::string name, model;
  double span = 0.0;
  std::vector<Vector> starts;
};

Vector numbers_of(const std::string& list) {
  std::vector<double> numbers;
  std::istringstream items(list);
  for (std::string item; std::getline(items, item, ',');) numbers.push_back(std::stod(item));
  return Eigen::Map<const Vector>(numbers.data(), static_cast<Index>(numbers.size()));
}

/// What follows a keyword; empty where a line begins otherwise.
std::string after(const std::string& line, const std::string& keyword) {
  return line.starts_with(keyword + " ") ? line.substr(keyword.size() + 1) : "";
}

std::vector<Block> blocks_of(const std::string& text) {
  std::vector<Block> blocks;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (const std::string name = after(line, "system"); !name.empty())
      blocks.push_back({name.substr(0, name.find(" / ")), "", 0.0, {}});
    else if (blocks.empty() || line.starts_with("#"))
      continue;
    else if (const std::string span = after(line, "span"); !span.empty())
      blocks.back().span = std::stod(span);
    else if (const std::string start = after(line, "start"); !start.empty())
      blocks.back().starts.push_back(numbers_of(start));
    else
      blocks.back().model += line + "\n";
  }
  return blocks;
}

System solved(const Block& block, std::size_t number) {
  const OdeModel model = parse_ode(block.model, block.name);
  if (block.starts.size() != 2)
    throw DataError(block.name, "it does not have two starts", "write two lines `start`");
  System system{std::to_string(number) + " " + block.name,
                Vector::LinSpaced(kSamples, 0.0, block.span),
                {}};
  for (std::size_t s = 0; s < 2; ++s) {
    const Solution orbit = simulate(model, dopri87(), block.starts[s], system.time);
    if (orbit.status != IntegrationStatus::Completed)
      throw DataError(block.name, "it cannot be solved: " + orbit.message, "change its span");
    system.states[s] = orbit.states;
  }
  return system;
}

}  // namespace

std::vector<System> read_systems(const std::filesystem::path& path) {
  std::vector<System> systems;
  const FileBytes bytes = read_bytes(path);
  if (path.extension() == ".txt")
    for (const Block& block : blocks_of(std::string(bytes.view())))
      systems.push_back(solved(block, systems.size() + 1));
  else
    for (const auto& entry : nlohmann::json::parse(bytes.view()))
      systems.push_back(system_of(entry));
  return systems;
}

}  // namespace lacuna::odebench
