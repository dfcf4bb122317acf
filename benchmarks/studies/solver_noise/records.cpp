// SPDX-License-Identifier: MIT
#include "records.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>

#include "core/base/text.hpp"
#include "dense_solution.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"

namespace lacuna::benchmarks {
namespace {

struct Summand {
  double coefficient;
  const char* term;
};
using Equations = std::initializer_list<std::initializer_list<Summand>>;

Flow flow(const std::string& name, std::initializer_list<const char*> states,
          const Equations& equations, std::initializer_list<double> start, double step,
          Index samples, bool driven = false) {
  std::vector<Quantity> quantities, inputs;
  for (const char* state : states) quantities.push_back({state, ""});
  if (driven) inputs.push_back({"u", ""});
  Variables variables;
  for (const Quantity& state : quantities) variables.states.push_back(state.name);
  for (const Quantity& input : inputs) variables.inputs.push_back(input.name);
  std::vector<Equation> parsed;
  for (const auto& summands : equations) {
    Equation& equation = parsed.emplace_back();
    for (const Summand& summand : summands)
      equation.push_back({Term::parse(summand.term, variables), summand.coefficient});
  }
  const std::vector<double> values(start);
  return {name, OdeModel(std::move(quantities), std::move(inputs), std::move(parsed)),
          Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size())), step,
          samples};
}

std::vector<Flow> planar_flows() {
  return {
      flow("van der Pol", {"x", "y"}, {{{1, "y"}}, {{2, "y"}, {-2, "x^2*y"}, {-1, "x"}}},
           {1, 0}, 0.02, 1501),
      flow("FitzHugh-Nagumo", {"v", "w"},
           {{{1, "v"}, {-1.0 / 3, "v^3"}, {-1, "w"}, {0.5, "1"}},
            {{0.08, "v"}, {0.056, "1"}, {-0.064, "w"}}},
           {-1, 1}, 0.05, 3001),
      flow("Duffing", {"x", "v"},
           {{{1, "v"}}, {{1, "x"}, {-1, "x^3"}, {-0.3, "v"}, {0.5, "u"}}}, {1, 0}, 0.02, 3001,
           true),
      flow("Lotka-Volterra", {"x", "y"}, {{{1.5, "x"}, {-1, "x*y"}}, {{-3, "y"}, {1, "x*y"}}},
           {10.0 / 3, 1}, 0.02, 1001),
      flow("Brusselator", {"x", "y"},
           {{{1, "1"}, {1, "x^2*y"}, {-4, "x"}}, {{3, "x"}, {-1, "x^2*y"}}}, {1.5, 3}, 0.02,
           1501),
      flow("SIR", {"S", "I"}, {{{-0.5, "S*I"}}, {{0.5, "S*I"}, {-0.1, "I"}}}, {0.99, 0.01}, 0.1,
           801),
  };
}

std::vector<Flow> spatial_flows() {
  return {
      flow("Lorenz", {"x", "y", "z"},
           {{{-10, "x"}, {10, "y"}},
            {{28, "x"}, {-1, "y"}, {-1, "x*z"}},
            {{-8.0 / 3, "z"}, {1, "x*y"}}},
           {1, 1, 20}, 0.01, 2001),
      flow("Rossler", {"x", "y", "z"},
           {{{-1, "y"}, {-1, "z"}},
            {{1, "x"}, {0.2, "y"}},
            {{0.2, "1"}, {-5.7, "z"}, {1, "x*z"}}},
           {1, 1, 0}, 0.025, 4001),
      flow("memristor", {"x", "y", "z"},
           {{{1, "y"}},
            {{-1.0 / 3, "x"}, {0.5, "y"}, {-0.5, "y*z^2"}},
            {{1, "y"}, {-0.6, "z"}, {-1, "y*z"}}},
           {0.1, 0.1, 0.1}, 0.05, 4001),
      flow("Chua cubic", {"x", "y", "z"},
           {{{10, "y"}, {-10, "x^3"}, {2, "x"}}, {{1, "x"}, {-1, "y"}, {1, "z"}}, {{-15, "y"}}},
           {0.1, 0.1, -0.1}, 0.02, 2501),
      flow("linear chain", {"a", "b", "c", "d"},
           {{{-1, "a"}, {0.5, "b"}},
            {{0.5, "a"}, {-1, "b"}, {0.5, "c"}},
            {{0.5, "b"}, {-1, "c"}, {0.5, "d"}},
            {{0.5, "c"}, {-1, "d"}}},
           {1, 0, -1, 2}, 0.02, 751),
      flow("Sprott A", {"x", "y", "z"},
           {{{1, "y"}}, {{-1, "x"}, {1, "y*z"}}, {{1, "1"}, {-1, "y^2"}}}, {0, 5, 0}, 0.02,
           2501),
  };
}

/// A number as it is read back from so many significant digits.
double printed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

Matrix solve(const DrivenModel& driven, const Flow& flow, const Making& making,
             const Vector& times) {
  using Solver = Making::Solver;
  switch (making.solver) {
    case Solver::Quartic:
    case Solver::Cubic:
      return dense_solution(
          driven, flow.start, times, making.tolerance,
          making.solver == Solver::Quartic ? Between::Quartic : Between::Cubic);
    case Solver::Fixed:
      return simulate(driven, rk4({.substeps = making.substeps}), flow.start, times).states;
    default:
      return simulate(driven, dopri87(), flow.start, times).states;
  }
}

}  // namespace

std::vector<Flow> flows() {
  std::vector<Flow> all = spatial_flows();
  for (Flow& planar : planar_flows()) all.push_back(std::move(planar));
  return all;
}

std::vector<Flow> flows_beyond_polynomials() {
  std::vector<Flow> all;
  for (const double amplitude : {0.5, 1.0, 2.0})
    all.push_back(flow("pendulum, amplitude " + format_number(amplitude), {"th", "w"},
                       {{{1, "w"}}, {{-1, "sin(th)"}}}, {amplitude, 0}, 0.03, 1501));
  all.push_back(flow("softening spring", {"x", "v"}, {{{1, "v"}}, {{-1.5, "x/(1+x^2/1.21)"}}},
                     {1.5, 0}, 0.03, 1501));
  all.push_back(flow("Holling II", {"x", "y"},
                     {{{1.1, "x"}, {-0.4, "x^2"}, {-1.2, "x*y/(0.45+x)"}},
                      {{0.9, "x*y/(0.45+x)"}, {-0.5, "y"}}},
                     {0.5, 1}, 0.05, 1501));
  return all;
}

std::vector<Making> makings() {
  using Solver = Making::Solver;
  std::vector<Making> all;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12})
    all.push_back({"adaptive, rtol " + format_number(tolerance), Solver::Quartic, tolerance, 1,
                   17, tolerance < 5e-5});
  for (const double tolerance : {1e-6, 1e-8})
    all.push_back({"adaptive, rtol " + format_number(tolerance) + ", cubic between steps",
                   Solver::Cubic, tolerance});
  for (const int substeps : {1, 4})
    all.push_back(
        {"RK4, " + std::to_string(substeps) + " steps a sample", Solver::Fixed, 0.0, substeps});
  for (const int digits : {6, 8, 10, 12, 17})
    all.push_back(
        {"order 8, " + std::to_string(digits) + " digits", Solver::Exact, 0.0, 1, digits});
  return all;
}

Dataset solver_record(const Flow& flow, const Making& making) {
  const auto force = [](double time, double* u) { *u = std::cos(1.2 * time); };
  const Vector times = sample_times(0.0, flow.step, flow.samples);
  Dataset record;
  record.states = flow.model.states();
  record.inputs = flow.model.inputs();
  Trajectory orbit;
  orbit.time = times;
  orbit.states = solve({flow.model, force}, flow, making, times);
  orbit.inputs.resize(times.size(), static_cast<Index>(record.inputs.size()));
  for (Index i = 0; i < times.size() && orbit.inputs.cols() > 0; ++i)
    force(times[i], &orbit.inputs(i, 0));
  const auto print = [&](double value) { return printed(value, making.digits); };
  orbit.states = orbit.states.unaryExpr(print).eval();
  orbit.inputs = orbit.inputs.unaryExpr(print).eval();
  record.trajectories.push_back(std::move(orbit));
  return record;
}

}  // namespace lacuna::benchmarks
