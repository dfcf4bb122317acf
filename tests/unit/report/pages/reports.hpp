// SPDX-License-Identifier: MIT
// A small identification with everything in it that a report tells of.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/report/reports.hpp"

namespace lacuna::testing {

inline SyncReport sample_sync() {
  SyncReport report;
  report.result.coupling = Eigen::Vector2d(0.5, 0.0).asDiagonal();
  report.result.median = 0.001;
  report.result.mean = 0.002;
  report.result.relative = 0.0005;
  report.result.settled = true;
  report.states = {{"x", "V"}, {"y", ""}};
  report.time_unit = "ms";
  report.integrator = "rk4";
  return report;
}

/// dx/dt = y (known), dy/dt = -2 x with an error, one term removed.
inline IdentificationReport sample_report() {
  const Variables variables{{"x", "y"}, {}};
  WeightedTerm fitted{Term::parse("x", variables), -2.0, 0.01, std::array{-2.02, -1.98}};
  OdeModel model({{"x", "V"}, {"y", ""}}, {}, {{{Term::parse("y", variables), 1.0}}, {fitted}},
                 "ms");
  IdentificationResult result{std::move(model), Eigen::Vector2d(0.003, 0.0), {}, {}, {}, {}};
  result.fit = {{.equation = "x", .identity = true},
                {.equation = "y",
                 .rows = 100,
                 .residual_rms = 0.1,
                 .target_rms = 2.0,
                 .noise_floor = 0.09,
                 .fits_to_noise = true,
                 .iterations = 1}};
  result.trail = {
      {.equation = "x", .term = "y", .kept = true, .quantity = "known identity", .value = 1.0},
      {.equation = "y", .term = "x", .kept = true, .quantity = "coefficient", .value = -2.0},
      {.equation = "y",
       .term = "x^2",
       .stage = "pruner minor-terms",
       .quantity = "residual",
       .value = 0.11,
       .threshold = 0.12,
       .step = 3}};
  result.adequacy = {Adequate::Yes, {}};
  result.warnings = {"be careful"};
  return {std::move(result), algorithm1(), R"({"preset":"algorithm1"})", sample_sync()};
}

/// An error of 0.05 beside a noise of 0.03, where the motion is sqrt(0.03^2 + 0.75^2).
inline Validation sample_validation() {
  Validation validation{.verdict = ValidationVerdict::Approximation,
                        .sentence = "An approximation: it is 5.3 % of the motion of x.",
                        .records = {"run.csv"},
                        .time_unit = "ms",
                        .samples = 100,
                        .refitted = true};
  const double motion = std::sqrt(0.03 * 0.03 + 0.75 * 0.75);
  validation.one_step = {0.1, 50, 0, {{"x", 0.03, 0.03, true, 0.05, 50.0}}};
  validation.windows = {2.0, 5, 0, {{"x", 0.05, 0.03, true, motion, 90.0}}};
  validation.advice = {"try sin(x)"};
  return validation;
}

inline Relation sample_relation() {
  return {{{"x^2", 1.0, 0.0}, {"y^2", 1.0, 0.001}}, 4.0, 0.01, 0.01};
}

}  // namespace lacuna::testing
