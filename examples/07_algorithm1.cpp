// SPDX-License-Identifier: MIT
// Algorithm 1 of Karimov et al. 2023 by hand, and the first row of their Table 5.
#include <iomanip>
#include <iostream>
#include <lacuna/lacuna.hpp>

using namespace lacuna;

OdeModel by_hand(const Dataset& record, const TermLibrary& library, const Formulation& form,
                 const TermFilter& filter, const TermPruner& pruner) {
  const LeastSquaresSystem system = form.assemble(record, library);
  const FilterResult filtered = filter.filter(system);
  const Stage<Regressor> regressor = ols();
  std::vector<Equation> equations;
  for (Index k = 0; k < system.targets(); ++k) {
    const PruneResult pruned = pruner.prune(system, k, filtered.kept, regressor);
    const Regression fit = regressor->fit(system, system.subproblem(k, pruned.kept));
    Equation& equation = equations.emplace_back();
    for (std::size_t i = 0; i < fit.active.size(); ++i)
      equation.push_back({library.terms[static_cast<std::size_t>(fit.active[i])],
                          fit.coefficients[static_cast<Index>(i)]});
    std::cout << library.size() << " terms, " << filtered.kept.size() << " filtered, "
              << equation.size() << " in d" << record.states[static_cast<std::size_t>(k)].name
              << "/dt\n";
  }
  return {record.states, {}, equations, record.time_unit};
}

int main() {
  const OdeModel& rossler = test_system("rossler").model;
  Dataset record = record_of(rossler, dopri8(), Vector::Constant(3, 0.1), 0.1, 10000);
  record.trajectories[0].derivatives.resize(0, 0);  // nobody measured them
  const TermLibrary library = monomials({.max_degree = 3})->library(rossler.variables());

  // As printed: differences of order 4, and 1e-5 in the units of the record.
  const OdeModel printed =
      by_hand(record, library, strong_form({finite_differences({.order = 4})}),
              abm({.tolerances = AbmOptions::Tolerances::Paper}),
              minor_terms({.tolerances = MinorTermsOptions::Tolerances::Paper}));
  // Without units: the order, and the end of the pruning, follow from the record.
  const OdeModel repaired =
      by_hand(record, library, strong_form({finite_differences()}), abm(), minor_terms());
  std::cout << to_text(repaired, 5) << '\n';

  // Driven by x alone, as in the article; y and z have to follow by themselves.
  const SyncOptions by_x{.coupling = Matrix(Vector{{1.0, 0.0, 0.0}}.asDiagonal())};
  std::cout << std::fixed << std::setprecision(2);
  for (const OdeModel& model : {printed, repaired, rossler})
    std::cout << 100.0 * synchronise(model, record, rk4(), by_x).relative << " %\n";
}
