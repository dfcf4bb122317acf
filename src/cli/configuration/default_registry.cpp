// SPDX-License-Identifier: MIT
#include "bases/compositions.hpp"
#include "bases/expressions.hpp"
#include "bases/fourier.hpp"
#include "bases/monomials.hpp"
#include "bases/orthogonal_polynomials.hpp"
#include "bases/piecewise_linear.hpp"
#include "bases/radial.hpp"
#include "bases/real_powers.hpp"
#include "cli/configuration/identification_configuration.hpp"
#include "data/derivatives/automatic_differentiator.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "data/derivatives/kalman.hpp"
#include "data/derivatives/local_polynomial.hpp"
#include "data/derivatives/savitzky_golay.hpp"
#include "data/derivatives/smoothing_spline.hpp"
#include "data/derivatives/spectral.hpp"
#include "data/derivatives/trend_filter.hpp"
#include "data/derivatives/whittaker.hpp"
#include "diagnose/criterion/extended_bic.hpp"
#include "diagnose/hypotheses/broken_identity.hpp"
#include "diagnose/hypotheses/coloured_noise.hpp"
#include "diagnose/hypotheses/named_effects.hpp"
#include "diagnose/hypotheses/residual_function.hpp"
#include "diagnose/hypotheses/sensor_fault.hpp"
#include "diagnose/hypotheses/shared_process.hpp"
#include "diagnose/hypotheses/unmeasured_input.hpp"
#include "dynamics/integration/automatic.hpp"
#include "dynamics/integration/cvode.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "effects/families.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "regression/filters/abm.hpp"
#include "regression/filters/none.hpp"
#include "regression/filters/svd_filter.hpp"
#include "regression/filters/vca.hpp"
#include "regression/formulations/integral_form.hpp"
#include "regression/formulations/next_sample.hpp"
#include "regression/formulations/strong_form.hpp"
#include "regression/formulations/weak_form.hpp"
#include "regression/pruners/cross_validation.hpp"
#include "regression/pruners/information_criterion.hpp"
#include "regression/pruners/keep_all.hpp"
#include "regression/pruners/minor_terms.hpp"
#include "regression/pruners/sequential_thresholding.hpp"
#include "solvers/best_subset.hpp"
#include "solvers/elastic_net.hpp"
#include "solvers/ensemble.hpp"
#include "solvers/entropic.hpp"
#include "solvers/frols.hpp"
#include "solvers/gls.hpp"
#include "solvers/irls.hpp"
#include "solvers/irls_l1.hpp"
#include "solvers/l1/l1_ceres.hpp"
#include "solvers/l1/l1_coordinate_descent.hpp"
#include "solvers/l1/l1_nlopt.hpp"
#include "solvers/ols.hpp"
#include "solvers/ridge.hpp"
#include "solvers/sr3.hpp"
#include "solvers/stlsq.hpp"
#include "trajectories/refiners/no_refiner.hpp"
#include "trajectories/refiners/trajectory_selection.hpp"

namespace lacuna {
namespace {

void add_formulations(Registry& registry) {
  registry.add<Monomials>();
  registry.add<Expressions>();
  registry.add<Fourier>();
  registry.add<OrthogonalPolynomials<kChebyshev>>();
  registry.add<OrthogonalPolynomials<kLegendre>>();
  registry.add<OrthogonalPolynomials<kHermite>>();
  registry.add<PiecewiseLinear>();
  registry.add<RadialFunctions>();
  registry.add<RealPowers>();
  registry.add<SumOfBases>({.first = Monomials{}, .second = Fourier{}});
  registry.add<ProductOfBases>(
      {.first = Monomials{{.max_degree = 1}}, .second = Fourier{{.harmonics = 1}}});
  registry.add<FiniteDifferences>();
  registry.add<SavitzkyGolay>();
  registry.add<SmoothingSpline>();
  registry.add<Whittaker>();
  registry.add<TrendFilter>();
  registry.add<KalmanSmoother>();
  registry.add<LocalPolynomial>();
  registry.add<Spectral>();
  registry.add<AutomaticDifferentiator>();
  registry.add<StrongForm>({.differentiator = FiniteDifferences{}});
  registry.add<WeakForm>();
  registry.add<IntegralForm>();
  registry.add<NextSample>();
}

void add_selection(Registry& registry) {
  registry.add<Abm>();
  registry.add<SvdFilter>();
  registry.add<Vca>();
  registry.add<NoFilter>();
  registry.add<MinorTerms>();
  registry.add<SequentialThresholding>();
  registry.add<InformationCriterion>();
  registry.add<CrossValidation>();
  registry.add<KeepAll>();
  registry.add<NoRefiner>();
  registry.add<TrajectorySelection>();
}

void add_solvers(Registry& registry) {
  registry.add<CoordinateDescent>();
  registry.add<CeresL1>();
  registry.add<NloptL1>();
  registry.add<Ols>();
  registry.add<Irls>();
  registry.add<IrlsL1>({.inner = CoordinateDescent{}});
  registry.add<Stlsq>();
  registry.add<Ridge>();
  registry.add<BestSubset>();
  registry.add<ElasticNet>();
  registry.add<Frols>();
  registry.add<Entropic>();
  registry.add<Sr3>();
  registry.add<Ensemble>();
  registry.add<Gls>();
}

void add_integrators(Registry& registry) {
  registry.add<Rk4>();
  registry.add<Dopri5>();
  registry.add<RungeKutta>();
  registry.add<Dopri8>();
  registry.add<Dopri87>();
  registry.add<Cvode>();
  registry.add<Automatic>();
}

template <const EffectFamily&... Families>
void add_families(Registry& registry, FamilyList<Families...>) {
  (registry.add<FamilyEffect<Families>>(), ...);
}

void add_identification(Registry& registry) {
  registry.add<Rules<LibraryOptions>>();
  registry.add<Rules<FormOptions>>();
  registry.add<Rules<DeadTimeOptions>>();
  registry.add<Rules<PlainStructureOptions>>();
  registry.add<Rules<ValidationOptions>>();
  registry.add<Rules<RelationOptions>>();
  registry.add<Rules<AdviceOptions>>();
  registry.add<Rules<MapHintOptions>>();
  registry.add<Rules<SyncVerdictOptions>>();
}

void add_diagnosis(Registry& registry) {
  registry.add<StandardDecision>();
  registry.add<ExtendedBic>();
  registry.add<NamedEffects>();
  registry.add<OtherChoices>();
  registry.add<SensorTiming>();
  registry.add<SensorPickup>();
  registry.add<SensorFault>();
  registry.add<UnmeasuredInput>();
  registry.add<ColouredNoiseHypothesis>();
  registry.add<BrokenIdentity>();
  registry.add<HeldCoefficients>();
  registry.add<SensorCalibration>();
  registry.add<InputSkew>();
  registry.add<InputInterpolation>();
  registry.add<InputSmoothing>();
  registry.add<ResidualFunction>();
  registry.add<SharedProcess>();
}

}  // namespace

Registry default_registry() {
  Registry registry;
  add_formulations(registry);
  add_selection(registry);
  add_solvers(registry);
  add_integrators(registry);
  add_families(registry, StandardFamilies{});
  add_identification(registry);
  add_diagnosis(registry);
  return registry;
}

}  // namespace lacuna
