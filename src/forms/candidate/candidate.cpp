// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>

#include "lacuna/core/base/error.hpp"
#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {
namespace {

using Names = std::map<std::string, Expression>;

template <class Range, class Value>
bool is_among(const Range& range, const Value& value) {
  return std::find(range.begin(), range.end(), value) != range.end();
}

/// Own names of one candidate, in the order of another one's.
Names names_of_other(const Candidate& from, const Candidate& to) {
  Names names;
  for (std::size_t i = 0; i < from.shapes.size(); ++i)
    names.emplace(from.shapes[i].name, Expression::variable(to.shapes[i].name));
  for (std::size_t i = 0; i < from.memory.size(); ++i)
    names.emplace(from.memory[i].name, Expression::variable(to.memory[i].name));
  return names;
}

void rename(Candidate& candidate, const std::string& old, const std::string& name) {
  const Names names{{old, Expression::variable(name)}};
  candidate.form = substitute(candidate.form, names);
  for (MemoryState& memory : candidate.memory) {
    if (memory.name == old) memory.name = name;
    memory.rate = substitute(memory.rate, names);
    memory.start = substitute(memory.start, names);
  }
}

void widen(ShapeParameter& shape, const ShapeParameter& other) {
  shape.low = std::min(shape.low, other.low);
  shape.high = std::max(shape.high, other.high);
  shape.logarithmic = (shape.logarithmic || other.logarithmic) && shape.low > 0.0;
}

void merge_into(Candidate& candidate, const Candidate& other) {
  for (std::size_t i = 0; i < candidate.shapes.size(); ++i)
    widen(candidate.shapes[i], other.shapes[i]);
  for (const Vector& start : other.starts)
    if (!is_among(candidate.starts, start)) candidate.starts.push_back(start);
  for (const std::string& family : other.families)
    if (!is_among(candidate.families, family)) candidate.families.push_back(family);
  candidate.least = std::min(candidate.least, other.least);
  candidate.most = std::max(candidate.most, other.most);
  candidate.repeats = candidate.repeats || other.repeats;
}

}  // namespace

bool Candidate::is_driven() const {
  return std::any_of(memory.begin(), memory.end(),
                     [](const MemoryState& state) { return state.driven; });
}

bool Candidate::depends_on(const std::string& variable) const {
  return form.variables().contains(variable) ||
         std::any_of(memory.begin(), memory.end(), [&](const MemoryState& state) {
           return state.rate.variables().contains(variable);
         });
}

Index Candidate::intricacy() const {
  return static_cast<Index>(shapes.size() + 2 * memory.size());
}

bool has_ranges(const Candidate& candidate) {
  return std::all_of(
      candidate.shapes.begin(), candidate.shapes.end(), [](const ShapeParameter& shape) {
        return std::isfinite(shape.low) && std::isfinite(shape.high) &&
               shape.low <= shape.high && (!shape.logarithmic || shape.low > 0.0);
      });
}

Expression bind_formula(const Candidate& candidate, const Expression& formula,
                        std::span<const double> values) {
  if (values.size() != candidate.shapes.size())
    throw ArgumentError("candidate " + candidate.form.to_string(),
                        std::to_string(values.size()) + " values for " +
                            std::to_string(candidate.shapes.size()) + " shape parameters",
                        "give one value for each");
  Names numbers;
  for (std::size_t i = 0; i < values.size(); ++i)
    numbers.emplace(candidate.shapes[i].name, Expression::number(values[i]));
  return substitute(formula, numbers);
}

Expression bind_form(const Candidate& candidate, std::span<const double> values) {
  return bind_formula(candidate, candidate.form, values);
}

Candidate without_clash(Candidate candidate, const std::vector<std::string>& taken) {
  for (std::size_t i = 0; i < candidate.memory.size(); ++i) {
    const std::string old = candidate.memory[i].name;
    std::string name = old;
    for (int number = 2; is_among(taken, name); ++number) name = old + std::to_string(number);
    if (name != old) rename(candidate, old, name);
  }
  return candidate;
}

bool in_one_place(const Candidate& a, const Candidate& b) {
  return a.equation == b.equation && a.place == b.place && a.argument == b.argument &&
         a.within == b.within;
}

bool are_one_form(const Candidate& a, const Candidate& b) {
  if (!in_one_place(a, b) || a.shapes.size() != b.shapes.size() ||
      a.memory.size() != b.memory.size())
    return false;
  const Names names = names_of_other(b, a);
  const auto same = [&](const MemoryState& one, const MemoryState& other) {
    return one.driven == other.driven && one.rate == substitute(other.rate, names) &&
           one.start == substitute(other.start, names);
  };
  return a.form == substitute(b.form, names) &&
         std::equal(a.memory.begin(), a.memory.end(), b.memory.begin(), same);
}

std::vector<Candidate> merged(const std::vector<Candidate>& candidates) {
  std::vector<Candidate> result;
  for (const Candidate& candidate : candidates) {
    const auto known = std::find_if(result.begin(), result.end(), [&](const Candidate& other) {
      return are_one_form(other, candidate);
    });
    if (known == result.end() || candidate.repeats)
      result.push_back(candidate);
    else
      merge_into(*known, candidate);
  }
  return result;
}

}  // namespace lacuna
