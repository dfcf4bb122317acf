// SPDX-License-Identifier: MIT
#include "bases/axis.hpp"

#include <cmath>

#include "core/base/text.hpp"

namespace lacuna {

std::vector<std::string> axis_names(const Variables& variables, bool with_inputs) {
  std::vector<std::string> names = variables.states;
  if (with_inputs)
    names.insert(names.end(), variables.inputs.begin(), variables.inputs.end());
  return names;
}

std::vector<Term> linear_terms(const std::vector<std::string>& names,
                               const Variables& variables) {
  std::vector<Term> terms{Term::parse("1", variables)};
  for (const std::string& name : names) terms.push_back(Term::parse(name, variables));
  return terms;
}

std::string shifted_axis(const std::string& name, double centre) {
  if (centre == 0.0) return name;
  return "(" + name + (centre > 0.0 ? "-" : "+") + format_number(std::abs(centre)) + ")";
}

std::string scaled_axis(const std::string& name, double low, double high) {
  const double half = 0.5 * (high - low);
  const std::string shifted = shifted_axis(name, 0.5 * (low + high));
  return half == 1.0 ? shifted : "(" + shifted + "/" + format_number(half) + ")";
}

std::vector<double> places_between(double low, double high, int count) {
  if (count == 1) return {0.5 * (low + high)};
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(low + (high - low) * i / (count - 1));
  return places;
}

void check_range_of_axis(const std::string& basis, double low, double high) {
  if (low < high && std::isfinite(low) && std::isfinite(high)) return;
  throw ConfigError(basis + ".low",
                    "the range from " + format_number(low) + " to " + format_number(high) +
                        " is empty",
                    "give the values between which the variables lie");
}

void check_number_of_terms(const std::string& basis, std::size_t terms) {
  constexpr std::size_t kMost = 100000;
  if (terms > kMost)
    throw ConfigError(basis, "there are more than 100000 terms",
                      "lower the degree or the number of functions");
}

}  // namespace lacuna
