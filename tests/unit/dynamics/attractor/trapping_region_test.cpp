// SPDX-License-Identifier: MIT
// Certificates against closed forms, published models and integrated paths.
#include "lacuna/dynamics/attractor/trapping_region.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

/// sum_k w_k (x_k - c_k)^2 over the radius squared: at most 1 inside.
double depth(const TrappingRegion& region, const Vector& x) {
  const Vector y = x - region.centre;
  return y.cwiseAbs2().dot(region.weights) / (region.radius * region.radius);
}

/// The nine modes of a sinusoidal shear flow (Moehlis, Faisst and Eckhardt, New J. Phys. 6 (2004)
/// 56, eq. 21) in a box of Lx = 4 pi, Lz = 2 pi, Reynolds number 400.
OdeModel shear_flow() {
  return parse_ode(
      "param al = 0.5 fixed\n"
      "param be = 1.5707963267948966 fixed\n"
      "param ga = 1 fixed\n"
      "param Re = 400 fixed\n"
      "param kag = 1.118033988749895 fixed\n"
      "param kbg = 1.862095889118587 fixed\n"
      "param kabg = 1.9280574254120867 fixed\n"
      "param s32 = 1.224744871391589 fixed\n"
      "param s6 = 2.449489742783178 fixed\n"
      "da1/dt = be^2/Re - be^2/Re*a1 - s32*be*ga/kabg*a6*a8"
      " + s32*be*ga/kbg*a2*a3\n"
      "da2/dt = -(4*be^2/3 + ga^2)/Re*a2 + 5*sqrt(2)/(3*sqrt(3))*ga^2/kag*a4*a6"
      " - ga^2/(s6*kag)*a5*a7 - al*be*ga/(s6*kag*kabg)*a5*a8"
      " - s32*be*ga/kbg*a1*a3 - s32*be*ga/kbg*a3*a9\n"
      "da3/dt = -(be^2 + ga^2)/Re*a3 + 2/s6*al*be*ga/(kag*kbg)*a4*a7"
      " + 2/s6*al*be*ga/(kag*kbg)*a5*a6 + (be^2*(3*al^2 + ga^2) - 3*ga^2*(al^2"
      " + ga^2))/(s6*kag*kbg*kabg)*a4*a8\n"
      "da4/dt = -(3*al^2 + 4*be^2)/(3*Re)*a4 - al/s6*a1*a5"
      " - 10/(3*s6)*al^2/kag*a2*a6 - s32*al*be*ga/(kag*kbg)*a3*a7"
      " - s32*al^2*be^2/(kag*kbg*kabg)*a3*a8 - al/s6*a5*a9\n"
      "da5/dt = -(al^2 + be^2)/Re*a5 + al/s6*a1*a4 + al^2/(s6*kag)*a2*a7"
      " - al*be*ga/(s6*kag*kabg)*a2*a8 + al/s6*a4*a9"
      " + 2/s6*al*be*ga/(kag*kbg)*a3*a6\n"
      "da6/dt = -(3*al^2 + 4*be^2 + 3*ga^2)/(3*Re)*a6 + al/s6*a1*a7"
      " + s32*be*ga/kabg*a1*a8 + 10/(3*s6)*(al^2 - ga^2)/kag*a2*a4"
      " - 2*sqrt(2/3)*al*be*ga/(kag*kbg)*a3*a5 + al/s6*a7*a9"
      " + s32*be*ga/kabg*a8*a9\n"
      "da7/dt = -(al^2 + be^2 + ga^2)/Re*a7 - al/s6*a1*a6 - al/s6*a6*a9 + (ga^2"
      " - al^2)/(s6*kag)*a2*a5 + al*be*ga/(s6*kag*kbg)*a3*a4\n"
      "da8/dt = -(al^2 + be^2 + ga^2)/Re*a8 + 2/s6*al*be*ga/(kag*kabg)*a2*a5"
      " + ga^2*(3*al^2 - be^2 + 3*ga^2)/(s6*kag*kbg*kabg)*a3*a4\n"
      "da9/dt = -9*be^2/Re*a9 + s32*be*ga/kbg*a2*a3 - s32*be*ga/kabg*a6*a8\n",
      "modes.ode");
}

TEST(TrappingRegion, OfLorenzIsTheBallAboutSigmaPlusRho) {
  // K = (x^2 + y^2 + (z - sigma - rho)^2) / 2: dK/dt = -10 x^2 - y^2 - 8/3 z (z - 38).
  const TrappingAnswer answer = trapping_region(test_system("lorenz").model);
  ASSERT_EQ(answer.verdict, Boundedness::Trapped);
  const TrappingRegion& region = *answer.region;
  EXPECT_LT((region.centre - Vector{{0.0, 0.0, 38.0}}).norm(), 1e-2);
  EXPECT_LT((region.weights - Vector::Ones(3)).norm(), 1e-9);
  EXPECT_NEAR(region.decay, 1.0, 1e-5);
  EXPECT_NEAR(region.radius, 8.0 / 3.0 * 38.0, 1e-1);
}

TEST(TrappingRegion, PathsComeInAndStay) {
  // Lorenz' equations in other units of y and z, so that weights are not 1.
  const OdeModel model = parse_ode("dx/dt = 10*(0.5*y - x)\n"
                                   "dy/dt = 2*x*(28 - 4*z) - y\n"
                                   "dz/dt = 0.25*0.5*x*y - 8/3*z\n",
                                   "lorenz.ode");
  const TrappingAnswer answer = trapping_region(model);
  ASSERT_EQ(answer.verdict, Boundedness::Trapped);
  Random random(3);
  for (int draw = 0; draw < 5; ++draw) {
    Vector start(3);
    for (Index k = 0; k < 3; ++k)
      start[k] = answer.region->centre[k] + 3.0 * answer.region->radius * random.normal();
    const Matrix path =
        simulate(model, Dopri8{}, start, Vector::LinSpaced(20001, 0.0, 20.0)).states;
    bool inside = false;
    for (Index i = 0; i < path.rows(); ++i) {
      const bool now = depth(*answer.region, path.row(i).transpose()) <= 1.0;
      EXPECT_TRUE(now || !inside) << "left at " << i;
      inside = inside || now;
    }
    EXPECT_TRUE(inside);
  }
}

TEST(TrappingRegion, OfAShearFlowOfNineModes) {
  const TrappingAnswer answer = trapping_region(shear_flow());
  ASSERT_EQ(answer.verdict, Boundedness::Trapped);
  EXPECT_LT((answer.region->weights - Vector::Ones(9)).norm(), 1e-9);
  // About 0 the energy falls with the least damping, that of the first mode, outside |a| = 1;
  // no centre makes more than that mode's damping of the largest eigenvalue.
  const double damping = std::pow(1.5707963267948966, 2) / 400.0;
  EXPECT_GE(answer.region->decay, damping * (1.0 - 1e-6));
  EXPECT_LE(depth(*answer.region, Vector::Unit(9, 0)), 1.0 + 1e-9) << "the laminar flow is inside";
}

TEST(TrappingRegion, NothingIsKnownWhereThereIsNoCertificate) {
  EXPECT_EQ(trapping_region(test_system("rossler").model).verdict, Boundedness::ProducesEnergy);
  EXPECT_EQ(trapping_region(test_system("van-der-pol").model).verdict,
            Boundedness::NotQuadratic);
  const auto verdict_of = [](const std::string& text) {
    return trapping_region(parse_ode(text, "a.ode")).verdict;
  };
  EXPECT_EQ(verdict_of("dx/dt = x - x^2\n"), Boundedness::ProducesEnergy) << "escapes from -1";
  EXPECT_EQ(verdict_of("dx/dt = y\ndy/dt = -x\n"), Boundedness::NoCentre) << "keeps its size";
  EXPECT_EQ(verdict_of("dx/dt = 0.1*x - y*x\ndy/dt = x^2\n"), Boundedness::NoCentre)
      << "y grows without end where x rests";
  EXPECT_EQ(verdict_of("input u\ndx/dt = u - x\n"), Boundedness::NotQuadratic);
  EXPECT_EQ(verdict_of("dx/dt = sin(x) - x\n"), Boundedness::NotQuadratic);
  EXPECT_EQ(verdict_of("dx/dt = 1 - 2*x\n"), Boundedness::Trapped);
}

}  // namespace
}  // namespace lacuna
