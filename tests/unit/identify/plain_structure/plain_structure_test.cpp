// SPDX-License-Identifier: MIT
#include "identify/plain_structure/plain_structure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "identify/plain_structure/plain_equations.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/embedding.hpp"

namespace lacuna {
namespace {

constexpr double kStep = 0.01;

/// A record of one channel and an input that is held.
Dataset record_of(const char* channel, const Vector& samples, const Vector& input) {
  Trajectory record;
  record.time =
      Vector::LinSpaced(samples.size(), 0.0, kStep * static_cast<double>(samples.size() - 1));
  record.states = samples;
  record.inputs = input;
  Dataset data;
  data.states = {{channel, ""}};
  data.inputs = {{"u", "", Hold::Zero}};
  data.trajectories = {record};
  data.rate_of = {std::nullopt};
  return data;
}

/// The place of a carriage behind an encoder, pushed by levels that change every 40 samples.
/// @param acceleration of the speed and the input at a time in steps of kStep / kFine.
constexpr int kFine = 100;
Dataset carriage(double lattice,
                 const std::function<double(double v, double u)>& acceleration) {
  constexpr Index kSamples = 600;
  Vector path(kSamples), force(kSamples);
  Random random(5);
  double x = 0.0, v = 0.0, u = 0.0;
  for (Index i = 0; i < kSamples; ++i) {
    if (i % 40 == 0) u = random.normal();
    force[i] = u;
    path[i] = lattice * std::round(x / lattice);
    for (int s = 0; s < kFine; ++s) {
      v += kStep / kFine * acceleration(v, u);
      x += kStep / kFine * v;
    }
  }
  return embed(record_of("x", path, force), {{"x", 2}}, FiniteDifferences{});
}

/// A level with three samples below 0, which means over many samples do not show.
TEST(PlainStructure, RootsOfSamplesBelowZeroAreNoCandidates) {
  constexpr Index kSamples = 400;
  Vector level(kSamples), inflow(kSamples);
  double y = 1.0;
  for (Index i = 0; i < kSamples; ++i) {
    inflow[i] = i / 50 % 2 == 0 ? 1.0 : 2.0;
    level[i] = i / 3 == 33 ? -1.0 : y;
    y = inflow[i] + (y - inflow[i]) * std::exp(-2.0 * kStep);
  }
  const Dataset data = record_of("y", level, inflow);
  const OdeModel found = parse_ode("input u\ndy/dt = u - y\n", "made");
  const Variables variables = found.variables();
  const TermLibrary library{variables, {Term::parse("1", variables), Term::parse("y", variables)}};
  EXPECT_TRUE(plain_structure(data, library, found, 0.0, std::nullopt, {}).has_value());
}

/// Friction that is sharper than the narrowest width: the fit ends at that, which is written to
/// three digits, more or less than it is.
TEST(PlainStructure, AWidthAtItsBoundIsWritten) {
  for (const double strength : {4.3, 5.0}) {
    const Dataset data = carriage(1e-4, [&](double v, double u) {
      return strength * u - 2.0 * v - 1.2 * std::tanh(v / 1e-4);
    });
    const IdentificationResult found{
        parse_ode("input u\ndx/dt = x_d1\ndx_d1/dt = 3*u - 2*x_d1\n", "made"), {}, {}, {}, {},
        {}};
    const auto plain = plain_equations(data, IdentificationTask{}.pipeline, {},
                                       {found, Vector::Zero(1), false, 0.2}, std::nullopt, {});
    ASSERT_TRUE(plain.has_value()) << strength;
    EXPECT_THAT(to_text(plain->result.model, 5), ::testing::HasSubstr("tanh(x_d1/0.002"));
  }
}

/// A force that is stronger one way, 2.4 samples late, beside equations without that, whose
/// dead time of 2.7 makes up for it.
TEST(PlainStructure, DeadTimesAreThoseOfTheNewTerms) {
  constexpr std::size_t kLate = 240;  // fine steps
  std::vector<double> acting(kLate, 0.0);
  const Dataset data = carriage(1e-5, [&](double v, double u) {
    acting.push_back(7.5 * u + 0.5 * std::abs(u));
    return acting[acting.size() - 1 - kLate] - 4.0 * v;
  });
  const IdentificationResult found{
      parse_ode("input u hold zero\ndx/dt = x_d1\ndx_d1/dt = 7.4*u - 4*x_d1\n", "made"),
      {},
      {},
      {},
      {},
      {}};
  const auto plain =
      plain_equations(data, IdentificationTask{}.pipeline, {},
                      {found, Vector::Constant(1, 2.7 * kStep), false, 0.2}, std::nullopt, {});
  ASSERT_TRUE(plain.has_value());
  EXPECT_NEAR(plain->times[0], 2.4 * kStep, 0.1 * kStep) << to_text(plain->result.model, 5);
  EXPECT_NEAR(plain->result.model.coefficient(1, "abs(u)"), 0.5, 0.02);
}

}  // namespace
}  // namespace lacuna
