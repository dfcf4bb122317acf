// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {
namespace {

const Variables kVariables{{"x", "y", "z"}, {}};

/// All monomials in x, y, z up to the degree: 20 terms for 3, 56 for 5.
TermLibrary monomials(int degree) {
  TermLibrary library{kVariables, {}};
  for (int total = 0; total <= degree; ++total)
    for (int i = total; i >= 0; --i)
      for (int j = total - i; j >= 0; --j)
        library.terms.push_back(Term::monomial({i, j, total - i - j, 0}, kVariables));
  return library;
}

/// Tiles of the monomial library; arguments are degree and rows of a tile.
void evaluate_tile(benchmark::State& state) {
  const Program program = monomials(static_cast<int>(state.range(0))).compile();
  const Matrix slots = Matrix::Random(state.range(1), program.slots());
  Matrix out(slots.rows(), program.outputs());
  Program::Workspace workspace;
  for (auto _ : state) {
    program.evaluate(slots, out, workspace);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * out.size());
}
BENCHMARK(evaluate_tile)->ArgsProduct({{3, 5}, {64, 128, 256, 4096}});

/// The library compiled from its terms; the argument is the degree.
void compile_library(benchmark::State& state) {
  const TermLibrary library = monomials(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(library.compile());
}
BENCHMARK(compile_library)->Arg(3)->Arg(5);

OdeModel rossler() {
  const auto term = [](const std::string& text, double coefficient) {
    return WeightedTerm{Term::parse(text, kVariables), coefficient};
  };
  return OdeModel({{"x", ""}, {"y", ""}, {"z", ""}}, {},
                  {{term("y", -1.0), term("z", -1.0)},
                   {term("x", 1.0), term("y", 0.2)},
                   {term("1", 0.2), term("z", -5.7), term("x*z", 1.0)}});
}

/// Every monomial up to the degree in every equation: 60 coefficients for degree 3.
OdeModel dense(int degree) {
  Equation equation;
  for (const Term& term : monomials(degree).terms)
    equation.push_back({term, 0.01 * static_cast<double>(equation.size() + 1)});
  return OdeModel({{"x", ""}, {"y", ""}, {"z", ""}}, {}, {equation, equation, equation});
}

void evaluate_rates(benchmark::State& state, const OdeModel& model) {
  CompiledModel compiled = model.compile();
  double x[3] = {0.1, 0.2, 0.3};
  double rate[3];
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    compiled.evaluate(0.0, x, nullptr, nullptr, rate);
    benchmark::DoNotOptimize(rate);
  }
}
BENCHMARK_CAPTURE(evaluate_rates, rossler, rossler());
BENCHMARK_CAPTURE(evaluate_rates, dense_degree_3, dense(3));
BENCHMARK_CAPTURE(evaluate_rates, dense_degree_5, dense(5));

void evaluate_jacobian(benchmark::State& state, const OdeModel& model) {
  CompiledModel compiled = model.compile();
  double x[3] = {0.1, 0.2, 0.3};
  Matrix derivative(3, 3);
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    compiled.jacobian(0.0, x, nullptr, nullptr, derivative);
    benchmark::DoNotOptimize(derivative.data());
  }
}
BENCHMARK_CAPTURE(evaluate_jacobian, rossler, rossler());
BENCHMARK_CAPTURE(evaluate_jacobian, dense_degree_3, dense(3));

}  // namespace
}  // namespace lacuna
