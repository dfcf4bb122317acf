// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden::plants {

Plant two_tanks() {
  return {model_of("min", {{"h1", "dm"}, {"h2", "dm"}}, {{"u", "dm/min"}},
                   {{{"u", 1.0}, {"sqrt(h1)", -0.6}}, {{"sqrt(h1)", 0.6}, {"sqrt(h2)", -0.5}}}),
          Vector{{2.5, 3.0}},
          Vector{{0.5, 0.5}},
          0.05,
          6000,
          20.0,
          {{.shape = SignalSpec::Shape::Steps,
            .mean = 1.0,
            .size = 0.35,
            .low = 0.1,
            .high = 0.5}}};
}

Plant linear_tanks() {
  return {
      model_of("min", {{"h1", "dm"}, {"h2", "dm"}}, {{"u", "dm/min"}},
               {{{"u", 1.0}, {"h1", -0.5}, {"h2", 0.5}}, {{"h1", 0.5}, {"h2", -0.9}}}),
      Vector{{3.0, 2.0}},
      Vector{{0.5, 0.5}},
      0.05,
      6000,
      20.0,
      {{.shape = SignalSpec::Shape::Steps, .mean = 1.6, .size = 0.7, .low = 0.1, .high = 0.6}}};
}

Plant heater() {
  return {model_of("min", {{"T1", "K"}, {"T2", "K"}}, {{"u", "kW"}},
                   {{{"u", 5.0}, {"T1", -0.5}, {"T2", 0.3}}, {{"T1", 0.25}, {"T2", -0.35}}}),
          Vector{{10.0, 8.0}},
          Vector{{3.0, 3.0}},
          0.05,
          5000,
          10.0,
          {{.mean = 2.0, .size = 1.0, .low = 0.02, .high = 0.4}}};
}

Plant prey_predator() {
  return {model_of("d", {{"x", "g/l"}, {"y", "g/l"}}, {{"u", ""}},
                   {{{"x", 1.2}, {"x^2", -0.12}, {"x*y", -0.6}, {"u*x", 1.0}},
                    {{"x*y", 0.3}, {"y", -0.6}}}),
          Vector{{2.0, 1.6}},
          Vector{{0.5, 0.4}},
          0.03,
          6000,
          20.0,
          {{.size = 0.35, .low = 0.03, .high = 0.4}}};
}

Plant enzyme() {
  return {model_of("min", {{"s", "mmol/l"}, {"p", "mmol/l"}}, {{"u", "mmol/l/min"}},
                   {{{"u", 1.0}, {"s", -0.4}}, {{"s", 0.4}, {"p", -0.3}}}),
          Vector{{2.0, 2.0}},
          Vector{{0.5, 0.5}},
          0.03,
          6000,
          10.0,
          {{.mean = 1.6, .size = 0.7, .low = 0.03, .high = 0.4}}};
}

Plant nerve() {
  return {model_of("ms", {{"v", ""}, {"w", ""}}, {{"u", ""}},
                   {{{"v", 1.0}, {"v^3", -1.0 / 3.0}, {"w", -1.0}, {"u", 1.0}},
                    {{"v", 0.16}, {"w", -0.128}, {"1", 0.112}}}),
          Vector{{-1.0, -0.5}},
          Vector{{0.5, 0.3}},
          0.05,
          6000,
          20.0,
          {{.mean = 0.5, .size = 0.25, .low = 0.01, .high = 0.15}}};
}

}  // namespace lacuna::hidden::plants
