// SPDX-License-Identifier: MIT
#include "lacuna/forms/candidate/effect.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

[[noreturn]] void fail(const Candidate& candidate, const std::string& problem) {
  throw ModelError("effect " + candidate.families.front(),
                   "'" + candidate.form.to_string() + "': " + problem,
                   "mend the effect's candidates");
}

/// Names that the formulas of a candidate may use, shape parameters not among them.
std::set<std::string> known_names(const Candidate& candidate, const Scope& scope) {
  const std::vector<std::string> names = scope.model.variables().names();
  std::set<std::string> known(names.begin(), names.end());
  for (const MemoryState& memory : candidate.memory)
    if (!known.insert(memory.name).second)
      fail(candidate, "'" + memory.name + "' is a name of the model already");
  for (const ShapeParameter& shape : candidate.shapes)
    if (known.contains(shape.name))
      fail(candidate, "'" + shape.name + "' is a name of the model already");
  return known;
}

void check_formula(const Candidate& candidate, const Expression& formula,
                   const std::set<std::string>& known) {
  const Vector& start = candidate.starts.front();
  const Expression bound =
      bind_formula(candidate, formula, {start.data(), static_cast<std::size_t>(start.size())});
  for (const std::string& name : bound.variables())
    if (!known.contains(name)) fail(candidate, "there is no variable '" + name + "'");
}

void check_start(const Candidate& candidate, const Vector& start) {
  if (start.size() != static_cast<Index>(candidate.shapes.size()))
    fail(candidate, "a starting point has another number of entries than there are shapes");
  for (std::size_t i = 0; i < candidate.shapes.size(); ++i) {
    const ShapeParameter& shape = candidate.shapes[i];
    const double value = start[static_cast<Index>(i)];
    if (!(shape.low <= value && value <= shape.high))
      fail(candidate, "the starting point leaves the range of '" + shape.name + "'");
  }
}

void check_candidate(const Candidate& candidate, const Scope& scope) {
  if (candidate.starts.empty()) fail(candidate, "there is no starting point");
  for (const Vector& start : candidate.starts) check_start(candidate, start);
  const std::set<std::string> known = known_names(candidate, scope);
  check_formula(candidate, candidate.form, known);
  for (const MemoryState& memory : candidate.memory) {
    check_formula(candidate, memory.rate, known);
    check_formula(candidate, memory.start, known);
  }
}

/// Shape parameters and memory states under names that the model has not.
void name_apart(Candidate& candidate, const Scope& scope) {
  for (ShapeParameter& shape : candidate.shapes) shape.name = scope.free_name(shape.name);
  for (MemoryState& memory : candidate.memory) memory.name = scope.free_name(memory.name);
}

}  // namespace

std::vector<Candidate> Effect::candidates(const Scope& scope, Index equation) const {
  if (equation < 0 || equation >= scope.model.dimension())
    throw ArgumentError("effect " + std::string(info().name),
                        "there is no equation " + std::to_string(equation),
                        "give a number below " + std::to_string(scope.model.dimension()));
  std::vector<Candidate> result = do_candidates(scope, equation);
  std::erase_if(result, [](const Candidate& candidate) { return !has_ranges(candidate); });
  for (Candidate& candidate : result) {
    candidate.families = {std::string(info().name)};
    candidate.equation = equation;
    name_apart(candidate, scope);
    if (candidate.shapes.empty() && candidate.starts.empty())
      candidate.starts.emplace_back(Vector(0));
    check_candidate(candidate, scope);
  }
  return result;
}

std::optional<Reading> Effect::reading(const FittedForm& fitted) const {
  if (fitted.shapes.size() != static_cast<Index>(fitted.candidate.shapes.size()))
    throw ArgumentError("effect " + std::string(info().name),
                        std::to_string(fitted.shapes.size()) + " values for " +
                            std::to_string(fitted.candidate.shapes.size()) +
                            " shape parameters",
                        "give one value for each");
  return do_reading(fitted);
}

std::optional<Reading> Effect::do_reading(const FittedForm& fitted) const {
  const std::vector<std::string>& families = fitted.candidate.families;
  if (std::find(families.begin(), families.end(), info().name) == families.end())
    return std::nullopt;
  return Reading{std::string(info().summary)};
}

}  // namespace lacuna
