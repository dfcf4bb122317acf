// SPDX-License-Identifier: MIT
// Effects become terms of the model; their memory becomes states.
#include "diagnose/candidates/candidate_column.hpp"
#include "lacuna/diagnose/candidates/explanation.hpp"

namespace lacuna {
namespace {

/// Variables of the nominal model and all memory states.
Variables all_variables(const OdeModel& nominal, const std::vector<FittedEffect>& effects) {
  Variables variables = nominal.variables();
  for (const FittedEffect& effect : effects)
    for (const MemoryState& memory : effect.candidate.memory)
      variables.states.push_back(memory.name);
  return variables;
}

OdeModel augmented_model(const OdeModel& nominal, const std::vector<FittedEffect>& effects) {
  std::vector<Quantity> states = nominal.states();
  std::vector<Equation> equations = nominal.equations();
  const Variables variables = all_variables(nominal, effects);
  for (const FittedEffect& effect : effects) {
    const auto shapes = as_span(effect.shapes);
    const Candidate& candidate = effect.candidate;
    if (candidate.place == Place::Rate)
      equations[static_cast<std::size_t>(candidate.equation)].push_back(
          {Term(bind_form(candidate, shapes), variables), effect.coefficient});
    for (const MemoryState& memory : candidate.memory) {
      states.push_back({memory.name, ""});
      equations.push_back(
          {{Term(bind_formula(candidate, memory.rate, shapes), variables), 1.0}});
    }
  }
  return {std::move(states), nominal.inputs(), std::move(equations), nominal.time_unit()};
}

/// Memory states of one effect on one record's samples.
Matrix memory_samples(const OdeModel& nominal, const FittedEffect& effect,
                      const Trajectory& record, const Matrix& path) {
  const LinearisedRecord grid = grid_of(nominal.inputs(), record, path);
  const Matrix fine =
      memory_along(effect.candidate, as_span(effect.shapes), nominal.variables(), grid);
  return fine(grid.sample_rows(), Eigen::all);
}

void add_memory(const OdeModel& nominal, const FittedEffect& effect,
                const std::vector<Matrix>& paths, Dataset& data) {
  if (effect.candidate.memory.empty()) return;
  data.reconstructed.resize(data.states.size(), false);
  for (const MemoryState& memory : effect.candidate.memory) {
    data.states.push_back({memory.name, ""});
    data.reconstructed.push_back(true);
  }
  for (std::size_t r = 0; r < data.trajectories.size(); ++r) {
    Trajectory& record = data.trajectories[r];
    const Matrix memory = memory_samples(nominal, effect, record, paths[r]);
    Matrix states(record.samples(), record.states.cols() + memory.cols());
    states << record.states, memory;
    record.states = std::move(states);
    if (record.marks.size() > 0) {
      record.marks.conservativeResize(Eigen::NoChange, record.states.cols());
      record.marks.rightCols(memory.cols()).setZero();
    }
  }
}

}  // namespace

AugmentedProblem augment(const OdeModel& nominal, const Dataset& data,
                         const std::vector<CoefficientPlace>& free,
                         const std::vector<FittedEffect>& effects,
                         const std::vector<Matrix>& paths) {
  AugmentedProblem problem{augmented_model(nominal, effects), data, free, {}, {}};
  std::vector<Index> next;
  for (const Equation& equation : nominal.equations())
    next.push_back(static_cast<Index>(equation.size()));
  for (const FittedEffect& effect : effects) {
    const Candidate& candidate = effect.candidate;
    if (candidate.place == Place::Rate) {
      problem.effect_places.push_back(
          {candidate.equation, next[static_cast<std::size_t>(candidate.equation)]++});
      if (!candidate.is_driven()) problem.free.push_back(problem.effect_places.back());
    } else {
      problem.channel_terms.push_back({candidate.equation,
                                       bind_form(candidate, as_span(effect.shapes)),
                                       effect.coefficient});
    }
    add_memory(nominal, effect, paths, problem.data);
  }
  return problem;
}

}  // namespace lacuna
