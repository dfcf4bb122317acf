// SPDX-License-Identifier: MIT
// Short ways to look at the candidates of an effect.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "lacuna/effects/effects.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/diagnosis_scope.hpp"
#include "support/one_record.hpp"

namespace lacuna::support {

/// Candidates of a family for one equation.
template <const EffectFamily& Family>
std::vector<Candidate> candidates_of(const Scope& scope, Index equation) {
  return FamilyEffect<Family>().candidates(scope, equation);
}

/// Their forms.
template <const EffectFamily& Family>
std::set<std::string> forms_of(const Scope& scope, Index equation) {
  std::set<std::string> forms;
  for (const Candidate& candidate : candidates_of<Family>(scope, equation))
    forms.insert(candidate.form.to_string());
  return forms;
}

/// The candidate with a form. @throws std::out_of_range when there is none.
template <const EffectFamily& Family>
Candidate candidate_of(const Scope& scope, Index equation, const std::string& form) {
  std::vector<Candidate> found = candidates_of<Family>(scope, equation);
  std::erase_if(found,
                [&](const Candidate& candidate) { return candidate.form.to_string() != form; });
  return found.at(0);
}

/// What a family's row of the name table makes of a candidate with a coefficient and shapes,
/// the nominal coefficients being as they are.
template <const EffectFamily& Family>
std::optional<Reading> reading_of(const Scope& scope, const Candidate& candidate,
                                  double coefficient, const Vector& shapes) {
  const NamingOptions options;
  return FamilyEffect<Family>().reading(
      {candidate, shapes, coefficient, 0.01, scope.model, scope, options});
}

/// The same at the candidate's first starting point.
template <const EffectFamily& Family>
std::optional<Reading> reading_of(const Scope& scope, const Candidate& candidate,
                                  double coefficient) {
  return reading_of<Family>(scope, candidate, coefficient, candidate.starts.front());
}

/// Whether the row applies at the candidate's first starting point.
template <const EffectFamily& Family>
bool plausible_with(const Scope& scope, const Candidate& candidate, double coefficient) {
  return reading_of<Family>(scope, candidate, coefficient).has_value();
}

/// A model from lines of terms: {"x", {{"y", -1.0}}}.
struct LineOfTerms {
  std::string state;
  std::vector<std::pair<std::string, double>> terms;
};

inline OdeModel model_of_lines(const std::vector<LineOfTerms>& lines,
                               const std::vector<std::string>& input_names) {
  Variables names;
  std::vector<Quantity> states, inputs;
  for (const LineOfTerms& line : lines) {
    states.push_back({line.state, "m"});
    names.states.push_back(line.state);
  }
  for (const std::string& input : input_names) inputs.push_back({input, "V"});
  names.inputs = input_names;
  std::vector<Equation> equations;
  for (const LineOfTerms& line : lines) {
    Equation equation;
    for (const auto& [term, coefficient] : line.terms)
      equation.push_back({.term = Term::parse(term, names), .coefficient = coefficient});
    equations.push_back(equation);
  }
  return OdeModel(states, inputs, equations);
}

/// A scope in which every variable swings about `centre` by 1, each at a pace of its own.
inline Scope scope_of(const OdeModel& model, double centre = 0.0) {
  const Index m = model.dimension(), p = static_cast<Index>(model.inputs().size());
  Trajectory record;
  record.time = Vector::LinSpaced(2001, 0.0, 40.0);
  record.states.resize(2001, m);
  record.inputs.resize(2001, p);
  for (Index k = 0; k < m + p; ++k) {
    const Vector swing =
        centre + (record.time.array() * (1.0 + 0.37 * static_cast<double>(k))).sin();
    (k < m ? record.states.col(k) : record.inputs.col(k - m)) = swing;
  }
  Dataset data = support::one_record(model.states(), model.inputs(), record);
  return make_scope(model, data, Vector::Constant(m, 0.01));
}

}  // namespace lacuna::support
