// SPDX-License-Identifier: MIT
#include "variants.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/text.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr Index kSamples = 400;

struct System {
  std::string name, text;
  std::vector<double> start;
  double step = 0.0;
  int degree = 2;
};

std::vector<System> systems() {
  return {
      {"decay", "dx/dt = 0.5 - 0.4*x\n", {3.0}, 0.03, 2},
      {"logistic", "dx/dt = 0.9*x - 0.3*x^2\n", {0.1}, 0.03, 3},
      {"oscillator", "dx/dt = y\ndy/dt = -4*x - 0.1*y\n", {1.0, 0.0}, 0.03, 2},
      {"spiral", "dx/dt = -0.1*x + 2*y\ndy/dt = -2*x - 0.1*y\n", {2.0, 0.0}, 0.03, 3},
      {"van-der-pol", "dx/dt = y\ndy/dt = -x + y - x^2*y\n", {1.0, 1.0}, 0.05, 3},
      {"lotka-volterra",
       "dx/dt = 0.7*x - 0.5*x*y\ndy/dt = -0.6*y + 0.4*x*y\n",
       {1.0, 1.0},
       0.05,
       2},
      {"cubic-spring", "dx/dt = y\ndy/dt = -x - x^3 - 0.1*y\n", {1.5, 0.0}, 0.03, 3},
      {"fitzhugh-nagumo",
       "dx/dt = 0.5 + x - y - 0.3333*x^3\ndy/dt = 0.056 + 0.08*x - 0.064*y\n",
       {1.0, 0.0},
       0.2,
       3},
      {"lorenz",
       "dx/dt = -10*x + 10*y\ndy/dt = 28*x - y - x*z\ndz/dt = -2.6667*z + x*y\n",
       {1.0, 2.0, 20.0},
       0.01,
       2},
      {"rossler",
       "dx/dt = -y - z\ndy/dt = x + 0.2*y\ndz/dt = 0.2 - 5.7*z + x*z\n",
       {1.0, 1.0, 0.0},
       0.05,
       2},
  };
}

Vector deviations_of(const Dataset& data) {
  const Matrix& x = data.trajectories.front().states;
  return (x.rowwise() - x.colwise().mean()).colwise().norm().transpose() /
         std::sqrt(static_cast<double>(x.rows()));
}

using Powers = std::vector<int>;
using Polynomial = std::map<Powers, double>;

/// "x" of "x", of "x-1031" and of "(x-1031)".
std::string variable_of(const std::string& factor) {
  const std::size_t begin = factor.front() == '(' ? 1 : 0;
  return factor.substr(begin, std::min(factor.find_first_of("+-"), factor.size()) - begin);
}

/// "x^2*y", or "(x-1031)^2*y", in the states of a model.
Powers powers_of(const std::string& monomial, const OdeModel& model) {
  Powers powers(static_cast<std::size_t>(model.dimension()), 0);
  if (monomial == "1") return powers;
  for (std::size_t begin = 0; begin <= monomial.size();) {
    const std::size_t end = std::min(monomial.find('*', begin), monomial.size());
    const std::string factor = monomial.substr(begin, end - begin);
    const std::size_t hat = factor.find('^');
    const int power = hat == std::string::npos ? 1 : std::stoi(factor.substr(hat + 1));
    const std::string name = variable_of(factor.substr(0, hat));
    powers[static_cast<std::size_t>(model.state_index(name))] += power;
    begin = end + 1;
  }
  return powers;
}

std::string monomial_of(const Powers& powers, const OdeModel& model) {
  std::vector<std::string> factors;
  for (std::size_t k = 0; k < powers.size(); ++k)
    if (powers[k] > 0)
      factors.push_back(model.states()[k].name +
                        (powers[k] > 1 ? "^" + std::to_string(powers[k]) : ""));
  return factors.empty() ? "1" : join(factors, "*");
}

double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value *= static_cast<double>(n - k + i) / i;
  return value;
}

/// Adds coefficient * prod (x_k - shift_k)^powers_k, states from `first` on being expanded.
void expand(const Powers& powers, double coefficient, const Vector& shift, std::size_t first,
            Polynomial& sum) {
  if (first == powers.size()) {
    sum[powers] += coefficient;
    return;
  }
  for (int left = 0; left <= powers[first]; ++left) {
    const double factor = std::pow(-shift[static_cast<Index>(first)], powers[first] - left);
    if (factor == 0.0) continue;
    Powers lower = powers;
    lower[first] = left;
    expand(lower, coefficient * binomial(powers[first], left) * factor, shift, first + 1, sum);
  }
}

}  // namespace

std::vector<SmallRecord> small_records() {
  std::vector<SmallRecord> records;
  for (const System& system : systems()) {
    const OdeModel model = parse_ode(system.text, system.name);
    const Eigen::Map<const Vector> start(system.start.data(),
                                         static_cast<Index>(system.start.size()));
    Dataset clean = record_of(model, dopri5(), start, system.step, kSamples);
    for (Trajectory& run : clean.trajectories) run.derivatives.resize(0, 0);
    records.push_back({system.name + ", noise 0", model, system.degree, clean});
    std::uint64_t seed = 0;
    for (const double noise : {1e-4, 1e-3, 1e-2, 1e-2})
      records.push_back(
          {system.name + ", noise " + format_number(noise) + ", seed " + std::to_string(++seed),
           model, system.degree, add_relative_noise(clean, noise, seed)});
  }
  return records;
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const double scale : {1e-200, 1e-100, 1e-30, 1e-9, 1e-3, 1e3, 1e9, 1e30, 1e100, 1e200})
    all.push_back({"x " + format_number(scale), {scale}});
  for (const double time : {1e-200, 1e-9, 1e9, 1e200})
    all.push_back({"t " + format_number(time), {1.0}, time});
  all.push_back({"x, y, z 1e-9, 1e6, 1e3; t 1e-3", {1e-9, 1e6, 1e3}, 1e-3});
  for (const double offset : {1.0, 1e3, 1e6, 1e9, 1e12})
    all.push_back({"x + " + format_number(offset) + " deviations", {1.0}, 1.0, offset});
  return all;
}

Dataset in_units(const Dataset& data, const Variant& variant) {
  Dataset other = data;
  const Vector deviation = deviations_of(data);
  for (Trajectory& run : other.trajectories) {
    run.time *= variant.time;
    for (Index k = 0; k < run.states.cols(); ++k)
      run.states.col(k) = (run.states.col(k).array() + variant.offset * deviation[k]) *
                          variant.scale[static_cast<std::size_t>(k) % variant.scale.size()];
  }
  return other;
}

Structure structure_of(const OdeModel& model) {
  Structure terms;
  for (const Equation& equation : model.equations()) {
    terms.emplace_back();
    for (const WeightedTerm& summand : equation)
      terms.back().push_back(monomial_of(powers_of(summand.term.name(), model), model));
    std::sort(terms.back().begin(), terms.back().end());
  }
  return terms;
}

Structure shifted_structure(const OdeModel& model) {
  Structure terms;
  const auto states = static_cast<Index>(model.states().size());
  for (const Equation& equation : model.equations()) {
    Polynomial sum;
    for (const WeightedTerm& summand : equation)
      expand(powers_of(summand.term.name(), model), 1.0, Vector::Constant(states, -1.0), 0,
             sum);
    terms.emplace_back();
    for (const auto& [powers, value] : sum) terms.back().push_back(monomial_of(powers, model));
    std::sort(terms.back().begin(), terms.back().end());
  }
  return terms;
}

bool has_shifted_terms(const OdeModel& model) {
  for (const Equation& equation : model.equations())
    for (const WeightedTerm& summand : equation)
      if (summand.term.name().find_first_of("+-") != std::string::npos) return true;
  return false;
}

Structure expected_structure(const OdeModel& model, const Dataset& data,
                             const Variant& variant) {
  constexpr double kCancelled = 1e-9;
  const Vector shift = variant.offset * deviations_of(data);
  Structure terms;
  for (const Equation& equation : model.equations()) {
    Polynomial sum, sizes;
    for (const WeightedTerm& summand : equation) {
      Polynomial one;
      expand(powers_of(summand.term.name(), model), summand.coefficient, shift, 0, one);
      for (const auto& [powers, value] : one) {
        sum[powers] += value;
        sizes[powers] += std::abs(value);
      }
    }
    terms.emplace_back();
    for (const auto& [powers, value] : sum)
      if (std::abs(value) > kCancelled * sizes[powers])
        terms.back().push_back(monomial_of(powers, model));
    std::sort(terms.back().begin(), terms.back().end());
  }
  return terms;
}

}  // namespace lacuna::benchmarks
