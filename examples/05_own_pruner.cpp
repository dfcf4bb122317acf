// SPDX-License-Identifier: MIT
// A pruner of one's own: an equation may have so many terms, and the smallest leave first.
#include <iomanip>
#include <iostream>
#include <lacuna/lacuna.hpp>

using namespace lacuna;

struct BudgetOptions {
  static constexpr StageInfo kInfo{"budget", "So many terms; the smallest leave first", ""};

  int terms = 3;

  void describe(OptionVisitor& visitor) {
    visitor.field({"terms", "", "Terms that an equation may have.", 1.0, 1000.0}, terms);
  }
};

class Budget final : public Configured<TermPruner, BudgetOptions> {
 public:
  using Configured::Configured;

 private:
  PruneResult do_prune(const LeastSquaresSystem& system, Index target, const TermSet& active,
                       const Regressor& regressor, const RunContext& context) const override {
    PruneResult result;
    Subproblem problem = system.subproblem(target, active);
    for (int step = 1; problem.size() > options().terms; ++step) {
      const Regression fit = regressor.fit(system, problem, Effort::Selection, context);
      // What a term contributes has the unit of the target, whatever the unit of the term.
      Vector size = fit.coefficients.cwiseAbs().cwiseProduct(problem.column_norms()) /
                    problem.target_norm();
      Index least = 0;
      const double smallest = size.minCoeff(&least);
      size[least] = size.maxCoeff();
      result.removed.push_back({problem.active()[static_cast<std::size_t>(least)],
                                "|h theta| / |y|", smallest, size.minCoeff(), step});
      problem.remove(least);
    }
    result.kept = problem.active();
    return result;
  }
};

int main() {
  const TestSystem rossler = test_system("rossler");
  const Dataset record = add_relative_noise(
      record_of(rossler.model, rk4(), rossler.start, rossler.step, 5000), 1e-4, 1);
  Pipeline pipeline = algorithm1();
  pipeline.basis = monomials({.max_degree = 2});
  pipeline.pruner = Budget{{.terms = 3}};
  pipeline.refiner = no_refiner();  // which would choose the terms again
  const IdentificationResult found = identify(record, pipeline);
  std::cout << to_text(found.model, 2) << "\n\n" << std::setprecision(2);
  for (const TrailEntry& entry : found.trail)
    if (entry.equation == "z" && !entry.kept)
      std::cout << "step " << entry.step << ", " << entry.term << ": " << entry.quantity
                << " = " << entry.value << ", the next " << entry.threshold << '\n';
}
