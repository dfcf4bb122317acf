// SPDX-License-Identifier: MIT
// A regressor of one's own: Huber's function of the residuals, minimised by NLopt.
#include <iostream>
#include <lacuna/lacuna.hpp>
#include <nlopt.hpp>

using namespace lacuna;

constexpr StageInfo kHuber{"huber", "Huber's function of the residuals, by NLopt", ""};
struct Huber final : Configured<Regressor, NoOptions<kHuber>> {
  Regression do_fit(const LeastSquaresSystem& system, const Subproblem& problem, Effort,
                    const RunContext&) const override {
    const double corner = 0.01 * problem.target_norm() / std::sqrt(problem.rows());
    const auto weights = [&](const Eigen::Ref<const Vector>& rest, Eigen::Ref<Vector> weight) {
      weight = corner / rest.array().abs().max(corner);
    };
    // z = h |theta|: NLopt moves numbers of one unit, and of one size.
    const Vector& norms = problem.column_norms();
    const auto unscaled = [&](const std::vector<double>& z) -> Vector {
      return Eigen::Map<const Vector>(z.data(), norms.size()).cwiseQuotient(norms);
    };
    auto loss = [&](const std::vector<double>& z, std::vector<double>& gradient) {
      const Vector h = unscaled(z);
      const Vector size = system.residuals(problem.target(), problem.active(), h).cwiseAbs();
      const Vector capped = size.cwiseMin(corner);
      const double sum = capped.dot(size - 0.5 * capped);
      if (gradient.empty()) return sum;
      // The slope is that of least squares in which a row beyond the corner weighs less.
      const Subproblem rows = system.reweighted(problem, h, weights);
      const Vector& scale = rows.column_norms();
      const Vector rest = rows.triangle() * scale.cwiseProduct(h) - rows.projected_target();
      const Vector slope = (rows.triangle().transpose() * rest).cwiseProduct(scale);
      Eigen::Map<Vector>(gradient.data(), h.size()) = slope.cwiseQuotient(norms);
      return sum;
    };
    const auto call = [](const std::vector<double>& z, std::vector<double>& gradient, void* f) {
      return (*static_cast<decltype(loss)*>(f))(z, gradient);
    };
    nlopt::opt search(nlopt::LD_SLSQP, static_cast<unsigned>(norms.size()));
    search.set_min_objective(call, &loss);
    search.set_xtol_rel(1e-8);
    const Vector h = unscaled(search.optimize(std::vector<double>(problem.active().size())));
    return {problem.active(), h, problem.residual_norm(h)};
  }
};

int main() {
  const TestSystem lorenz = test_system("lorenz");
  Dataset record = record_of(lorenz.model, rk4(), lorenz.start, 0.01, 2000);
  // The rates came with the record; every 20th time the meter of dy/dt shows nothing.
  for (Index i = 0; i < 2000; i += 20) record.trajectories[0].derivatives(i, 1) = 0.0;
  for (const Stage<Regressor>& regressor : {ols(), Stage<Regressor>(Huber{})}) {
    Pipeline pipeline = sindy();
    pipeline.basis = monomials({.max_degree = 2});
    pipeline.pruner = sequential_thresholding();
    pipeline.regressor = regressor;
    std::cout << regressor->info().name << ":\n"
              << to_text(identify(record, pipeline).model, 3) << '\n';
  }
}
