// SPDX-License-Identifier: MIT
#include "hidden/support/score.hpp"

#include <algorithm>

#include "core/base/text.hpp"
#include "hidden/support/records.hpp"

namespace lacuna::hidden {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool has_alternative(const NamedEffect& found, const std::string& name) {
  return std::any_of(found.alternatives.begin(), found.alternatives.end(),
                     [&](const Alternative& other) { return other.name == name; });
}

bool name_leads(const HiddenEffect& hidden, const NamedEffect& found) {
  if (contains(hidden.names, found.name)) return true;
  return contains(hidden.plain, found.name) && has_alternative(found, hidden.names[0]);
}

bool name_is_listed(const HiddenEffect& hidden, const NamedEffect& found) {
  return contains(hidden.names, found.name) || contains(hidden.plain, found.name) ||
         std::any_of(hidden.names.begin(), hidden.names.end(),
                     [&](const std::string& name) { return has_alternative(found, name); });
}

/// A skewed channel shows in every equation.
bool in_equation(const HiddenCase& hidden, const HiddenEffect& effect,
                 const NamedEffect& found) {
  const bool anywhere = contains(effect.names, "channel-skew");
  return anywhere || hidden.nominal.state_index(effect.equation) == found.equation;
}

/// How well one hidden effect was found: 0 not at all, 1 equation, 2 listed, 3 in the lead.
int quality(const HiddenCase& hidden, const HiddenEffect& effect, const NamedEffect& found) {
  if (!in_equation(hidden, effect, found)) return 0;
  if (name_leads(effect, found)) return 3;
  return name_is_listed(effect, found) ? 2 : 1;
}

void judge_effects(const HiddenCase& hidden, const Diagnosis& diagnosis, Score& result) {
  std::vector<bool> used(diagnosis.effects.size(), false);
  int worst = 3;
  for (const HiddenEffect& effect : hidden.effects) {
    int best = 0;
    std::size_t place = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const int found = used[i] ? 0 : quality(hidden, effect, diagnosis.effects[i]);
      if (found <= best) continue;
      best = found;
      place = i;
    }
    if (best > 0) used[place] = true;
    worst = std::min(worst, best);
  }
  result.equation = worst >= 1;
  result.listed = worst >= 2;
  result.name = worst >= 3;
  result.spurious = static_cast<int>(std::count(used.begin(), used.end(), false));
}

/// Whether what acts is a force that nobody measured: named at best, as the gap on other
/// records stays.
bool is_unforeseeable(const HiddenCase& hidden) {
  return std::any_of(hidden.effects.begin(), hidden.effects.end(), [](const auto& effect) {
    return contains(effect.names, "unmeasured-input");
  });
}

bool right_verdict(const HiddenCase& hidden, Verdict verdict) {
  switch (hidden.kind) {
    case Kind::Nothing:
      return verdict == Verdict::NoDiscrepancy;
    case Kind::Coefficients:
      return verdict == Verdict::CoefficientsOnly;
    case Kind::Effects:
      return verdict == Verdict::Explained ||
             (verdict == Verdict::PartlyExplained && is_unforeseeable(hidden));
    case Kind::Inexpressible:
      break;
  }
  return verdict == Verdict::UnnamedStructure || verdict == Verdict::PartlyExplained;
}

/// Whether a model can be evaluated on the columns of a record alone.
bool is_static(const OdeModel& model, const HiddenCase& hidden) {
  return model.dimension() == hidden.nominal.dimension() && model.compile().delays().empty();
}

std::optional<double> size_found(const HiddenCase& hidden, const Diagnosis& diagnosis,
                                 const Dataset& clean) {
  if (!is_static(diagnosis.augmented, hidden) || !hidden.augmented) return {};
  const Matrix truth = leftover(hidden.without_effects(), clean);
  const Matrix found = truth - leftover(diagnosis.augmented, clean);
  double product = 0.0, square = 0.0;
  for (Index k = 0; k < truth.cols(); ++k) {
    // Equations count alike, whatever their units.
    const double scale = truth.col(k).squaredNorm();
    const bool concerned = std::any_of(
        hidden.effects.begin(), hidden.effects.end(),
        [&](const auto& effect) { return hidden.nominal.state_index(effect.equation) == k; });
    if (!concerned || scale == 0.0) continue;
    product += found.col(k).dot(truth.col(k)) / scale;
    square += 1.0;
  }
  return square > 0.0 ? std::optional<double>(product / square) : std::nullopt;
}

}  // namespace

std::string in_one_line(const Diagnosis& diagnosis) {
  std::vector<std::string> parts;
  for (const NamedEffect& effect : diagnosis.effects) {
    const Quantity& state =
        diagnosis.nominal.states()[static_cast<std::size_t>(effect.equation)];
    parts.push_back(state.name + " " + effect.name + " " +
                    format_number(effect.coefficient, 4) + "*" + effect.term);
  }
  return to_string(diagnosis.verdict) + (parts.empty() ? "" : ": ") + join(parts, "; ");
}

Score score(const HiddenCase& hidden, const Diagnosis& diagnosis, const Dataset& clean) {
  Score result;
  result.answer = in_one_line(diagnosis);
  result.verdict = right_verdict(hidden, diagnosis.verdict);
  if (hidden.kind == Kind::Effects) {
    judge_effects(hidden, diagnosis, result);
    if (result.equation) result.size = size_found(hidden, diagnosis, clean);
  } else {
    result.spurious = static_cast<int>(diagnosis.effects.size());
  }
  return result;
}

}  // namespace lacuna::hidden
