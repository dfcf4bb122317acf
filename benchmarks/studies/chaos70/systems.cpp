// SPDX-License-Identifier: MIT
#include "systems.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/random.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"

namespace lacuna::chaos70 {
namespace {

OdeModel model_of(const nlohmann::json& entry) {
  std::vector<Quantity> states;
  Variables variables;
  for (const std::string name : entry.at("states")) {
    states.push_back({name, ""});
    variables.states.push_back(name);
  }
  std::vector<Equation> equations;
  for (const auto& terms : entry.at("equations")) {
    Equation equation;
    for (const auto& term : terms)
      equation.push_back(
          {Term::parse(term.at("term").get<std::string>(), variables), term.at("coefficient")});
    equations.push_back(std::move(equation));
  }
  return OdeModel(std::move(states), {}, std::move(equations));
}

/// Names of all terms of two models.
std::set<std::string> term_names(const OdeModel& a, const OdeModel& b) {
  std::set<std::string> names;
  for (const OdeModel* model : {&a, &b})
    for (const Equation& equation : model->equations())
      for (const WeightedTerm& summand : equation) names.insert(summand.term.name());
  return names;
}

Matrix matrix_of(const OdeModel& model, const std::set<std::string>& names) {
  Matrix matrix(model.dimension(), static_cast<Index>(names.size()));
  for (Index k = 0; k < matrix.rows(); ++k) {
    Index column = 0;
    for (const std::string& name : names) matrix(k, column++) = model.coefficient(k, name);
  }
  return matrix;
}

double spectral_norm(const Matrix& matrix) {
  return Eigen::JacobiSVD<Matrix>(matrix).singularValues()[0];
}

}  // namespace

std::vector<System> read_systems(const std::string& folder) {
  std::ifstream file(folder + "/systems.json");
  if (!file) throw FileError(folder + "/systems.json", "cannot be opened", "check the folder");
  std::vector<System> systems;
  const nlohmann::json document = nlohmann::json::parse(file);
  for (const auto& entry : document.at("systems")) {
    const std::string name = entry.at("name");
    systems.push_back({name, model_of(entry), folder + "/train/" + name + ".csv.gz"});
  }
  return systems;
}

Dataset noisy_records(const System& system, double percent, std::uint64_t seed) {
  Random random(seed);
  Dataset data = read_dataset({system.records}, {.trajectory = "trajectory"});
  for (Trajectory& record : data.trajectories) {
    const double rms =
        std::sqrt(record.states.squaredNorm() / static_cast<double>(record.states.size()));
    for (double& value : record.states.reshaped())
      value += 0.01 * percent * rms * random.normal();
  }
  return data;
}

double coefficient_error(const OdeModel& truth, const OdeModel& found) {
  const std::set<std::string> names = term_names(truth, found);
  const Matrix expected = matrix_of(truth, names);
  return spectral_norm(matrix_of(found, names) - expected) / spectral_norm(expected);
}

Structure compare(const OdeModel& truth, const OdeModel& found) {
  const std::set<std::string> names = term_names(truth, found);
  Structure difference;
  for (Index k = 0; k < truth.dimension(); ++k)
    for (const std::string& name : names) {
      const bool there = truth.coefficient(k, name) != 0.0;
      const bool here = found.coefficient(k, name) != 0.0;
      difference.missing += there && !here;
      difference.extra += here && !there;
    }
  return difference;
}

}  // namespace lacuna::chaos70
