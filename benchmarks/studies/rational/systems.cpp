// SPDX-License-Identifier: MIT
#include "systems.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/bases/bases.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "structure.hpp"

namespace lacuna::benchmarks {
namespace {

using Starts = std::vector<std::vector<double>>;

RationalSystem system(const std::string& name, const std::string& reference,
                      const std::string& text, const Starts& starts, double step,
                      Index samples) {
  RationalSystem result{name, reference, parse_ode(text, name), {}, step, samples, 3};
  for (const std::vector<double>& start : starts)
    result.starts.push_back(
        Eigen::Map<const Vector>(start.data(), static_cast<Index>(start.size())));
  return result;
}

std::vector<RationalSystem> reactions() {
  return {
      system("Michaelis-Menten", "Kaheman et al., Proc. R. Soc. A 476 (2020) 20200279",
             "dx/dt = 0.6 - 1.5*x/(0.3+x)", {{3.0}, {1.2}, {0.5}, {0.01}}, 0.02, 250),
      system("Hill, n = 2", "a gene that promotes itself",
             "dx/dt = 0.1 + 1.5*x^2/(0.64+x^2) - 0.7*x", {{3.0}, {0.7}, {0.3}, {0.02}}, 0.03,
             250),
      system("gene switch, Hill", "Gardner, Cantor & Collins, Nature 403 (2000) 339",
             "dx/dt = 2.4/(1+y^2/0.81) - x\ndy/dt = 1.8/(1+x^2/0.49) - y",
             {{2.0, 1.8}, {0.1, 0.3}, {2.2, 0.05}, {0.05, 1.9}}, 0.03, 250),
      system("gene switch, logistic", "the same with logistic functions",
             "dx/dt = 2.1/(1+exp((y-0.9)/0.25)) - x\ndy/dt = 1.8/(1+exp((x-0.8)/0.2)) - y",
             {{2.0, 1.8}, {0.1, 0.3}, {2.2, 0.05}, {0.05, 1.9}}, 0.03, 250),
  };
}

std::vector<RationalSystem> oscillators() {
  return {
      system("x/(1+x^2) oscillator", "a spring that softens",
             "dx/dt = y\ndy/dt = -1.5*x/(1+x^2/1.21)", {{2.5, 0.0}, {1.0, 0.0}}, 0.04, 500),
      system("prey and predator, Holling II", "Rosenzweig & MacArthur, Am. Nat. 97 (1963) 209",
             "dx/dt = 1.1*x - 0.4*x^2 - 1.2*x*y/(0.45+x)\ndy/dt = 0.9*x*y/(0.45+x) - 0.5*y",
             {{0.5, 1.0}, {2.2, 0.3}}, 0.05, 500),
      system("prey and predator, Beddington-DeAngelis",
             "Beddington, J. Anim. Ecol. 44 (1975) 331",
             "dx/dt = 1.1*x - 0.4*x^2 - 2.6*x*y/(1+1.7*x+0.6*y)\n"
             "dy/dt = 1.9*x*y/(1+1.7*x+0.6*y) - 0.5*y",
             {{0.5, 1.0}, {2.2, 0.3}, {0.3, 2.5}, {2.0, 2.0}}, 0.05, 400),
  };
}

RationalSystem yeast() {
  Starts starts;
  // Spread over the ranges that Mangan et al. take, by the golden ratio's relatives.
  const double low[] = {0.15, 0.19, 0.04, 0.10, 0.08, 0.14, 0.05};
  const double high[] = {1.60, 2.16, 0.20, 0.35, 0.30, 2.67, 0.10};
  for (int i = 0; i < 12; ++i) {
    std::vector<double>& start = starts.emplace_back();
    for (int k = 0; k < 7; ++k) {
      const double place = std::fmod(0.5 + (i + 1) * std::pow(0.8, k + 1) * 0.6180339887, 1.0);
      start.push_back(low[k] + place * (high[k] - low[k]));
    }
  }
  RationalSystem result =
      system("yeast glycolysis",
             "Ruoff et al., Biophys. Chem. 106 (2003) 179; Mangan et al., IEEE Trans. Mol. "
             "Biol. Multi-Scale Commun. 2 (2016) 52",
             "dS1/dt = 2.5 - 100*S1*S6/(1+(S6/0.52)^4)\n"
             "dS2/dt = 200*S1*S6/(1+(S6/0.52)^4) - 6*S2*(1-S5) - 12*S2*S5\n"
             "dS3/dt = 6*S2*(1-S5) - 16*S3*(4-S6)\n"
             "dS4/dt = 16*S3*(4-S6) - 100*S4*S5 - 13*(S4-S7)\n"
             "dS5/dt = 6*S2*(1-S5) - 100*S4*S5 - 12*S2*S5\n"
             "dS6/dt = -200*S1*S6/(1+(S6/0.52)^4) + 32*S3*(4-S6) - 1.28*S6\n"
             "dS7/dt = 1.3*(S4-S7) - 1.8*S7",
             starts, 0.01, 400);
  result.degree = 2;
  result.slow = true;
  return result;
}

RationalSystem yeast_with_its_rate_law() {
  RationalSystem result = yeast();
  result.name += ", rate law in the library";
  result.known = {"S1*S6/(1+(S6/0.52)^4)"};
  result.slow = false;
  return result;
}

double squared_deviation(const Matrix& states) {
  return (states.rowwise() - states.colwise().mean()).squaredNorm();
}

}  // namespace

const std::vector<RationalSystem>& rational_systems() {
  static const std::vector<RationalSystem> all = [] {
    std::vector<RationalSystem> list = reactions();
    for (RationalSystem& one : oscillators()) list.push_back(std::move(one));
    list.push_back(yeast());
    list.push_back(yeast_with_its_rate_law());
    return list;
  }();
  return all;
}

const RationalSystem& rational_system(const std::string& name) {
  for (const RationalSystem& one : rational_systems())
    if (one.name == name) return one;
  throw ArgumentError("rational_system", "there is no system '" + name + "'", "see the list");
}

Pipeline pipeline_for(const RationalSystem& system) {
  Pipeline pipeline = algorithm1();
  pipeline.basis = monomials({.max_degree = system.degree, .include = system.known});
  return pipeline;
}

Dataset records_of(const RationalSystem& system, double noise, std::uint64_t seed) {
  Dataset all;
  for (const Vector& start : system.starts) {
    Dataset one = record_of(system.model, dopri87(), start, system.step, system.samples);
    if (all.trajectories.empty())
      all = std::move(one);
    else
      all.trajectories.push_back(std::move(one.trajectories.front()));
  }
  return add_relative_noise(all, noise, seed);
}

bool has_structure(const OdeModel& found, const OdeModel& truth) {
  for (std::size_t k = 0; k < truth.equations().size(); ++k) {
    const Equation &one = found.equations()[k], &other = truth.equations()[k];
    if (fraction_of(one) != fraction_of(other) || numbers_in(one) > numbers_in(other))
      return false;
  }
  return true;
}

double rate_error(const OdeModel& found, const RationalSystem& system) {
  CompiledModel model = found.compile(), truth = system.model.compile();
  Vector one(truth.dimension()), other(truth.dimension());
  Vector errors = Vector::Zero(truth.dimension()), squares = errors;
  for (const Trajectory& record : records_of(system, 0.0, 1).trajectories)
    for (Index i = 0; i < record.samples(); ++i) {
      const Vector x = record.states.row(i);
      model.evaluate(0.0, x.data(), nullptr, nullptr, one.data());
      truth.evaluate(0.0, x.data(), nullptr, nullptr, other.data());
      errors += (one - other).array().square().matrix();
      squares += other.array().square().matrix();
    }
  return std::sqrt((errors.array() / squares.array()).maxCoeff());
}

double determination(const OdeModel& found, const RationalSystem& system) {
  double least = 1.0;
  for (const Trajectory& record : records_of(system, 0.0, 1).trajectories) {
    const Solution orbit = simulate(found, dopri8(), record.states.row(0), record.time);
    if (orbit.status != IntegrationStatus::Completed || !orbit.states.allFinite()) return -1.0;
    const double left = (record.states - orbit.states).squaredNorm();
    least = std::min(least, 1.0 - left / squared_deviation(record.states));
  }
  return least;
}

}  // namespace lacuna::benchmarks
