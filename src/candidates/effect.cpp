// SPDX-License-Identifier: MIT
#include "lacuna/candidates/effect.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "lacuna/core/error.hpp"

namespace lacuna {
namespace {

[[noreturn]] void fail(const Candidate& candidate, const std::string& problem) {
  throw ModelError("effect " + candidate.effect, "'" + candidate.form + "': " + problem,
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

void check_formula(const Candidate& candidate, const std::string& text,
                   const std::set<std::string>& known) {
  const Vector& start = candidate.starts.front();
  const Expression bound =
      bind_formula(candidate, text, {start.data(), static_cast<std::size_t>(start.size())});
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
    if (shape.logarithmic && shape.low <= 0.0)
      fail(candidate, "'" + shape.name + "' is logarithmic and reaches 0");
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

/// An identifier that no variable of the model has.
std::string fresh_name(std::string name, const std::vector<std::string>& taken) {
  while (std::find(taken.begin(), taken.end(), name) != taken.end()) name += '_';
  return name;
}

/// `$old` becomes the new name, as a whole word.
std::string renamed(const std::string& text, const std::string& old, const std::string& name) {
  const std::string marked = "$" + old;
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = i + marked.size();
    const bool whole =
        end >= text.size() ||
        (std::isalnum(static_cast<unsigned char>(text[end])) == 0 && text[end] != '_');
    if (text.compare(i, marked.size(), marked) == 0 && whole) {
      result += name;
      i = end;
    } else {
      result += text[i++];
    }
  }
  return result;
}

/// Gives shape parameters and memory states that are written `$name` names of their own.
void name_apart(Candidate& candidate, const Scope& scope) {
  const std::vector<std::string> taken = scope.model.variables().names();
  const auto rename = [&](std::string& own) {
    const std::string name = fresh_name(own, taken);
    candidate.form = renamed(candidate.form, own, name);
    for (MemoryState& memory : candidate.memory) {
      memory.rate = renamed(memory.rate, own, name);
      memory.start = renamed(memory.start, own, name);
    }
    return name;
  };
  const auto marked = [&](const std::string& own) {
    bool found = renamed(candidate.form, own, "") != candidate.form;
    for (const MemoryState& memory : candidate.memory)
      found = found || renamed(memory.rate, own, "") != memory.rate;
    return found;
  };
  for (ShapeParameter& shape : candidate.shapes)
    if (marked(shape.name)) shape.name = rename(shape.name);
  for (MemoryState& memory : candidate.memory)
    if (marked(memory.name)) memory.name = rename(memory.name);
}

}  // namespace

std::vector<Candidate> Effect::candidates(const Scope& scope, Index equation) const {
  if (equation < 0 || equation >= scope.model.dimension())
    throw ArgumentError("effect " + std::string(info().name),
                        "there is no equation " + std::to_string(equation),
                        "give a number below " + std::to_string(scope.model.dimension()));
  std::vector<Candidate> result = do_candidates(scope, equation);
  for (Candidate& candidate : result) {
    candidate.effect = info().name;
    candidate.equation = equation;
    if (!candidate.plainer && plainer()) candidate.plainer = *plainer();
    name_apart(candidate, scope);
    if (candidate.shapes.empty() && candidate.starts.empty())
      candidate.starts.emplace_back(Vector(0));
    check_candidate(candidate, scope);
  }
  return result;
}

bool Effect::plausible(const Scope& scope, const Candidate& candidate,
                       const FittedCandidate& fitted) const {
  if (fitted.shapes.size() != static_cast<Index>(candidate.shapes.size()))
    throw ArgumentError("effect " + candidate.effect,
                        std::to_string(fitted.shapes.size()) + " values for " +
                            std::to_string(candidate.shapes.size()) + " shape parameters",
                        "give one value for each");
  return do_plausible(scope, candidate, fitted);
}

}  // namespace lacuna
