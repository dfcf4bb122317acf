// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden::plants {

Plant series_rlc() {
  return {model_of("ms", {{"i", "mA"}, {"v", "V"}}, {{"u", "V"}},
                   {{{"u", 5.0}, {"v", -5.0}, {"i", -1.2}}, {{"i", 4.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.2, 0.2}},
          0.01,
          5000,
          4.0,
          {{.size = 0.25, .low = 0.1, .high = 1.6}}};
}

Plant parallel_rlc() {
  return {model_of("ms", {{"lam", "mV s"}, {"v", "V"}}, {{"u", "V/ms"}},
                   {{{"v", 1.0}}, {{"u", 1.0}, {"v", -0.7}, {"lam", -16.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.2, 0.5}},
          0.01,
          6000,
          4.0,
          {{.size = 4.0, .low = 0.1, .high = 1.5}}};
}

Plant filter_loop() {
  return {model_of("ms", {{"x", "V"}, {"y", "V"}}, {{"u", "V"}},
                   {{{"x", -1.0}, {"y", -6.0}, {"u", 6.0}}, {{"x", 6.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.5, 0.5}},
          0.01,
          6000,
          4.0,
          {{.size = 0.6, .low = 0.1, .high = 1.8}}};
}

Plant van_der_pol() {
  return {model_of("s", {{"q", "V"}, {"v", "V/s"}}, {},
                   {{{"v", 1.0}}, {{"q", -1.0}, {"v", 1.2}, {"q^2*v", -1.2}}}),
          Vector{{1.0, 0.0}},
          Vector{{0.8, 0.8}},
          0.03,
          5000,
          5.0,
          {}};
}

Plant chua_linear() {
  return {model_of("tau", {{"x", "V"}, {"y", "V"}, {"z", "V"}}, {},
                   {{{"x", -4.457}, {"y", 15.6}},
                    {{"x", 1.0}, {"y", -1.0}, {"z", 1.0}},
                    {{"y", -28.0}}}),
          Vector{{1.6, 0.1, -2.3}},
          Vector{{0.2, 0.05, 0.2}},
          0.01,
          6000,
          10.0,
          {}};
}

Plant rossler() {
  return {model_of("tau", {{"x", "V"}, {"y", "V"}, {"z", "V"}}, {},
                   {{{"y", -1.0}, {"z", -1.0}},
                    {{"x", 1.0}, {"y", 0.2}},
                    {{"1", 0.2}, {"z", -5.7}, {"x*z", 1.0}}}),
          Vector{{1.0, 1.0, 0.1}},
          Vector{{0.5, 0.5, 0.05}},
          0.03,
          8000,
          50.0,
          {}};
}

Plant lorenz() {
  return {model_of("s", {{"x", "mm/s"}, {"y", "K"}, {"z", "K"}}, {},
                   {{{"x", -10.0}, {"y", 10.0}},
                    {{"x", 28.0}, {"y", -1.0}, {"x*z", -1.0}},
                    {{"x*y", 1.0}, {"z", -8.0 / 3.0}}}),
          Vector{{-8.0, 8.0, 27.0}},
          Vector{{3.0, 3.0, 3.0}},
          0.005,
          6000,
          5.0,
          {}};
}

}  // namespace lacuna::hidden::plants
