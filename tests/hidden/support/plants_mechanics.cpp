// SPDX-License-Identifier: MIT
#include "hidden/support/case_builder.hpp"
#include "hidden/support/plants.hpp"

namespace lacuna::hidden::plants {

Plant pendulum() {
  return {model_of("s", {{"th", "rad"}, {"w", "rad/s"}}, {{"u", "rad/s^2"}},
                   {{{"w", 1.0}}, {{"sin(th)", -24.5}, {"w", -0.3}, {"u", 1.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.5, 1.0}},
          0.01,
          5000,
          5.0,
          {{.size = 4.0, .low = 0.2, .high = 1.8}}};
}

Plant oscillator() {
  return {model_of("s", {{"x", "m"}, {"v", "m/s"}}, {{"u", "N/kg"}},
                   {{{"v", 1.0}}, {{"x", -30.0}, {"v", -0.6}, {"u", 1.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.3, 1.0}},
          0.01,
          5000,
          5.0,
          {{.size = 4.0, .low = 0.2, .high = 2.0}}};
}

Plant double_well() {
  return {model_of("s", {{"q", "mm"}, {"v", "mm/s"}}, {{"u", "N/g"}},
                   {{{"v", 1.0}}, {{"q", 1.0}, {"q^3", -1.0}, {"v", -0.25}, {"u", 1.0}}}),
          Vector{{1.0, 0.0}},
          Vector{{0.3, 0.3}},
          0.04,
          6000,
          20.0,
          {{.size = 0.4, .low = 0.05, .high = 0.4}}};
}

Plant stage() {
  return {model_of("s", {{"x", "cm"}, {"v", "cm/s"}}, {{"u", "cm/s^2"}},
                   {{{"v", 1.0}}, {{"x", -9.0}, {"v", -1.5}, {"u", 1.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.3, 0.5}},
          0.01,
          6000,
          5.0,
          {{.size = 6.0, .low = 0.1, .high = 1.5}}};
}

Plant motor() {
  return {model_of("s", {{"w", "rad/s"}, {"i", "A"}}, {{"u", "V"}},
                   {{{"i", 50.0}, {"w", -1.5}}, {{"u", 10.0}, {"i", -40.0}, {"w", -5.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{2.0, 0.2}},
          0.004,
          6000,
          1.0,
          {{.size = 4.0, .low = 0.2, .high = 4.0}}};
}

Plant servo_arm() {
  return {model_of("s", {{"th", "rad"}, {"w", "rad/s"}}, {{"u", "rad"}},
                   {{{"w", 1.0}}, {{"th", -60.0}, {"u", 60.0}, {"w", -3.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{0.2, 0.2}},
          0.005,
          6000,
          2.0,
          {{.size = 0.3, .low = 0.1, .high = 2.5}}};
}

Plant geared_drive() {
  return {model_of("s", {{"w1", "rad/s"}, {"d", "rad"}, {"w2", "rad/s"}}, {{"u", "rad/s^2"}},
                   {{{"u", 1.0}, {"d", -200.0}, {"w1", -1.0}},
                    {{"w1", 1.0}, {"w2", -1.0}},
                    {{"d", 150.0}, {"w2", -2.0}}}),
          Vector{{0.0, 0.0, 0.0}},
          Vector{{0.5, 0.01, 0.5}},
          0.004,
          6000,
          2.0,
          {{.size = 60.0, .low = 0.3, .high = 4.0}}};
}

Plant rigid_body() {
  const SignalSpec torque{.size = 1.2, .low = 0.05, .high = 0.5};
  return {model_of("s", {{"w1", "rad/s"}, {"w2", "rad/s"}, {"w3", "rad/s"}},
                   {{"u1", "rad/s^2"}, {"u2", "rad/s^2"}, {"u3", "rad/s^2"}},
                   {{{"w2*w3", -0.6}, {"w1", -0.4}, {"u1", 1.0}},
                    {{"w1*w3", 0.6}, {"w2", -0.4}, {"u2", 1.0}},
                    {{"w3", -0.3}, {"u3", 1.0}}}),
          Vector{{0.5, 0.5, 0.5}},
          Vector{{0.5, 0.5, 0.5}},
          0.02,
          5000,
          5.0,
          {torque, torque, torque}};
}

Plant two_oscillators() {
  return {model_of("s", {{"x1", "m"}, {"v1", "m/s"}, {"x2", "m"}, {"v2", "m/s"}}, {},
                   {{{"v1", 1.0}},
                    {{"x1", -4.0}, {"v1", 0.8}, {"x1^2*v1", -0.8}},
                    {{"v2", 1.0}},
                    {{"x2", -1.7}, {"v2", 0.5}, {"x2^2*v2", -0.5}}}),
          Vector{{1.0, 0.0, 1.0, 0.0}},
          Vector{{0.8, 1.0, 0.8, 1.0}},
          0.02,
          6000,
          2.0,
          {}};
}

Plant coupled_masses() {
  return {
      model_of("s", {{"x1", "m"}, {"v1", "m/s"}, {"x2", "m"}, {"v2", "m/s"}}, {{"u", "N/kg"}},
               {{{"v1", 1.0}},
                {{"x1", -14.0}, {"x2", 9.0}, {"v1", -0.5}, {"u", 1.0}},
                {{"v2", 1.0}},
                {{"x1", 6.0}, {"x2", -10.0}, {"v2", -0.4}}}),
      Vector{{0.0, 0.0, 0.0, 0.0}},
      Vector{{0.5, 1.0, 0.5, 1.0}},
      0.01,
      5000,
      5.0,
      {{.size = 6.0, .low = 0.1, .high = 1.2}}};
}

Plant turntable() {
  return {model_of("s", {{"th", "rad"}, {"w", "rad/s"}}, {{"u", "rad/s^2"}},
                   {{{"w", 1.0}}, {{"w", -3.0}, {"u", 1.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{1.0, 2.0}},
          0.004,
          5000,
          2.0,
          {{.size = 25.0, .low = 0.05, .high = 0.8}}};
}

Plant hydraulic() {
  return {model_of("s", {{"v", "cm/s"}, {"p", "bar"}}, {{"u", "mm"}},
                   {{{"p", 8.0}, {"v", -3.0}}, {{"u", 30.0}, {"v", -10.0}, {"p", -2.0}}}),
          Vector{{0.0, 0.0}},
          Vector{{1.0, 1.0}},
          0.005,
          6000,
          2.0,
          {{.size = 0.8, .low = 0.2, .high = 3.0}}};
}

}  // namespace lacuna::hidden::plants
