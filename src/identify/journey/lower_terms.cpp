// SPDX-License-Identifier: MIT
#include "lower_terms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "identify/pipeline/equation_terms.hpp"
#include "restricted_results.hpp"

namespace lacuna {
namespace {

using Exponents = std::vector<int>;
using Places = std::set<std::size_t>;  ///< of terms in the library

/// The terms of a centred library, with their exponents in what is centred and in the rest.
class ShiftedLibrary {
 public:
  ShiftedLibrary(const Pipeline& plain, const Pipeline& centred, const Dataset& data) {
    const Variables variables = variables_of(data);
    const TermLibrary before = plain.basis->library(variables);
    for (const Term& term : centred.basis->library(variables).terms)
      names_.push_back(term.name());
    for (std::size_t i = 0; i < before.terms.size(); ++i) {
      exponents_.push_back(before.terms[i].exponents().value_or(Exponents{}));
      shifted_.resize(exponents_.back().size(), false);
      for (std::size_t k = 0; k < shifted_.size(); ++k)
        if (before.terms[i].name() != names_[i] && exponents_[i][k] > 0 &&
            is_alone(exponents_[i], k))
          shifted_[k] = true;
    }
  }

  const std::string& name(std::size_t place) const { return names_[place]; }

  /// Places of an equation's terms; nothing where one of them is not of the library.
  std::optional<Places> places_of(const Equation& equation) const {
    Places places;
    for (const WeightedTerm& summand : equation) {
      const auto at = std::find(names_.begin(), names_.end(), summand.term.name());
      if (at == names_.end()) return std::nullopt;
      places.insert(static_cast<std::size_t>(at - names_.begin()));
    }
    return places;
  }

  /// Whether a shift of one term makes another one of it.
  bool is_lower(std::size_t lower, std::size_t term) const {
    if (lower == term) return false;
    for (std::size_t k = 0; k < shifted_.size(); ++k) {
      const int a = exponents_[lower][k], b = exponents_[term][k];
      if (shifted_[k] ? a > b : a != b) return false;
    }
    return true;
  }

  /// All terms that a shift of some has.
  Places all_of(const Places& terms) const {
    Places all = terms;
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (std::any_of(terms.begin(), terms.end(),
                      [&](std::size_t term) { return is_lower(i, term); }))
        all.insert(i);
    return all;
  }

  /// Terms of some that are lower than no other and lack lower ones themselves.
  std::vector<std::size_t> doubtful(const Places& terms) const {
    std::vector<std::size_t> found;
    for (const std::size_t term : terms) {
      const Places all = all_of({term});
      const bool is_highest = std::none_of(
          terms.begin(), terms.end(), [&](std::size_t other) { return is_lower(term, other); });
      if (is_highest && !std::includes(terms.begin(), terms.end(), all.begin(), all.end()))
        found.push_back(term);
    }
    return found;
  }

 private:
  static bool is_alone(const Exponents& exponents, std::size_t k) {
    for (std::size_t other = 0; other < exponents.size(); ++other)
      if (other != k && exponents[other] != 0) return false;
    return true;
  }

  std::vector<std::string> names_;
  std::vector<Exponents> exponents_;
  std::vector<bool> shifted_;  ///< of the variables, whether they are counted from elsewhere
};

/// Terms of every equation of a result by their places.
using Structure = std::vector<Places>;

std::optional<Structure> structure_of(const ShiftedLibrary& library, const OdeModel& model) {
  Structure structure;
  for (const Equation& equation : model.equations()) {
    auto places = library.places_of(equation);
    if (!places) return std::nullopt;
    structure.push_back(std::move(*places));
  }
  return structure;
}

/// The pipeline with all lower terms of some, but without one of them.
Pipeline without_term(const Pipeline& centred, const ShiftedLibrary& library,
                      const IdentificationResult& found, const Structure& structure,
                      std::size_t equation, std::size_t term) {
  Pipeline other = centred;
  for (std::size_t k = 0; k < structure.size(); ++k) {
    if (found.fit[k].identity || structure[k].empty()) continue;
    Places terms = library.all_of(structure[k]);
    if (k == equation) terms.erase(term);
    EquationTerms own{found.model.states()[k].name, {}};
    for (const std::size_t place : terms) own.terms.push_back(library.name(place));
    other.equations.push_back(std::move(own));
  }
  return other;
}

/// The model without one doubtful term, where it is as good a one; nothing where none is.
std::optional<IdentificationResult> without_a_doubtful_term(const Pipeline& centred,
                                                            const ShiftedLibrary& library,
                                                            const RecordStream& records,
                                                            const IdentificationResult& found,
                                                            const RunContext& context) {
  const auto structure = structure_of(library, found.model);
  if (!structure) return std::nullopt;
  for (std::size_t k = 0; k < structure->size(); ++k) {
    if (found.fit[k].identity) continue;
    for (const std::size_t term : library.doubtful((*structure)[k])) {
      Places rest = library.all_of((*structure)[k]);
      rest.erase(term);
      if (rest.empty()) continue;
      if (context.is_late()) return std::nullopt;  // a model in a hurry is no better one
      IdentificationResult other = identify(
          records, without_term(centred, library, found, *structure, k, term), context);
      if (context.is_late()) return std::nullopt;
      const auto less = structure_of(library, other.model);
      if (!less) continue;
      const double fewer = static_cast<double>(library.all_of((*structure)[k]).size()) -
                           static_cast<double>(library.all_of((*less)[k]).size());
      const double most =
          fewer * std::log(static_cast<double>(std::max<Index>(found.fit[k].rows, 1)));
      const double more = chi_squared_over(other, found);
      if (!(fewer > 0.0) || !(more <= most)) continue;
      take_over_trail(found.trail, found.fit[k].equation, library.name(term), {more, most},
                      other.trail);
      return other;
    }
  }
  return std::nullopt;
}

}  // namespace

IdentificationResult with_lower_terms(const Pipeline& plain, const Pipeline& centred,
                                      const RecordStream& records, IdentificationResult found,
                                      const RunContext& context) {
  if (found.library_alone) return found;
  const ShiftedLibrary library(plain, centred, records.excerpt());
  while (auto other = without_a_doubtful_term(centred, library, records, found, context))
    found = std::move(*other);
  return found;
}

}  // namespace lacuna
