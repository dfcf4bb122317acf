// SPDX-License-Identifier: MIT
#include "pairs.hpp"

namespace lacuna::benchmarks {
namespace {

/// First order in x: parameters, then the rate.
std::string scalar(const std::string& parameters, const std::string& rate,
                   const std::string& start = "0") {
  return "input u hold zero\n" + parameters + "dx/dt = " + rate + "\ny = x\ninitial x = " +
         start + " fixed\n";
}

/// Second order in q, measured: parameters, then the acceleration.
std::string mechanical(const std::string& parameters, const std::string& acceleration) {
  return "input u hold zero\n" + parameters + "dq/dt = v\ndv/dt = " + acceleration +
         "\ny = q\ninitial q = 0 fixed\ninitial v = 0 fixed\n";
}

const char* kViscous = "param d = 0.8 in 0.01..10\n";
const char* kDry = "param c = 0.3 in 0.001..5\n";

std::vector<RivalCase> friction() {
  const std::string viscous = scalar(kViscous, "-d*x + u");
  const std::string dry = scalar(kDry, "-c*tanh(30*x) + u");
  const std::string quadratic = scalar("param b = 1 in 0.01..20\n", "-b*x*abs(x) + u");
  const std::string both = "param d = 0.6 in 0.01..10\nparam c = 0.2 in 0.001..5\n";
  return {{"viscous, dry", {viscous, dry}, -1.0, 1.0, 8.0, 0.04, {0.9}},
          {"viscous, quadratic", {viscous, quadratic}, -1.0, 1.0, 8.0, 0.04, {0.8}},
          {"dry and viscous, Stribeck",
           {scalar(both, "-d*x - c*tanh(30*x) + u"),
            scalar(both + "param s = 0.15 in 0.001..5\n",
                   "-d*x - (c + s*exp(-25*x^2))*tanh(30*x) + u")},
           -1.0,
           1.0,
           8.0,
           0.04,
           {0.9, 0.95}},
          {"viscous and quadratic, viscous and cubic",
           {scalar("param d = 0.5 in 0.01..10\nparam b = 0.6 in 0.01..20\n",
                   "-d*x - b*x*abs(x) + u"),
            scalar("param d = 0.6 in 0.01..10\nparam b = 0.6 in 0.01..20\n",
                   "-d*x - b*x^3 + u")},
           -2.0,
           2.0,
           8.0,
           0.04,
           {0.7, 0.75}},
          {"viscous, dry, quadratic", {viscous, dry, quadratic}, -1.0, 1.0, 8.0, 0.04, {0.85}}};
}

std::vector<RivalCase> rates() {
  const std::string linear = scalar("param k = 0.5 in 0.01..10\n", "u - k*x");
  const std::string saturating = scalar(
      "param V = 1 in 0.05..20\nparam K = 1.5 in 0.05..20\n", "u - V*x/(K + x)");
  const std::string hill = scalar("param V = 0.8 in 0.05..20\nparam K = 0.9 in 0.05..20\n",
                                  "u - V*x^2/(K^2 + x^2)");
  return {{"Michaelis-Menten, linear", {saturating, linear}, 0.0, 0.8, 20.0, 0.1, {0.1, 0.15}},
          {"Michaelis-Menten, Hill", {saturating, hill}, 0.0, 0.7, 20.0, 0.1, {0.4, 0.5}},
          {"Michaelis-Menten, Hill, linear",
           {saturating, hill, linear},
           0.0,
           0.7,
           20.0,
           0.1,
           {0.4, 0.5}},
          {"logistic, Gompertz",
           {scalar("param r = 0.8 in 0.05..5\nparam K = 2 in 0.2..20\n",
                   "r*x*(1 - x/K) - u*x", "0.8"),
            scalar("param r = 0.5 in 0.05..5\nparam K = 2 in 0.2..20\n",
                   "r*x*log(K/x) - u*x", "0.8")},
           0.0,
           0.6,
           15.0,
           0.1,
           {0.2, 0.25}}};
}

std::vector<RivalCase> tanks() {
  return {{"square root, linear outflow",
           {scalar("param k = 0.4 in 0.01..5\n", "u - k*sqrt(abs(x) + 1e-6)", "1"),
            scalar("param k = 0.4 in 0.01..5\n", "u - k*x", "1")},
           0.0,
           1.0,
           15.0,
           0.1,
           {0.4, 0.42}},
          {"outflow, outflow and leak",
           {scalar("param k = 0.4 in 0.01..5\n", "u - k*sqrt(abs(x) + 1e-6)", "1"),
            scalar("param k = 0.35 in 0.01..5\nparam l = 0.05 in 0.001..2\n",
                   "u - k*sqrt(abs(x) + 1e-6) - l*x", "1")},
           0.0,
           1.0,
           15.0,
           0.1,
           {0.4, 0.45}}};
}

std::vector<RivalCase> actuators() {
  const std::string gain = scalar("param a = 0.7 in 0.05..5\nparam b = 1 in 0.05..10\n",
                                  "-a*x + b*u");
  return {{"linear, clipped actuator",
           {gain, scalar("param a = 0.7 in 0.05..5\nparam b = 1 in 0.05..10\n"
                         "param s = 1.3 in 0.2..1.9\n",
                         "-a*x + b*clip(u,-s,s)")},
           -2.0,
           2.0,
           10.0,
           0.05,
           {0.7, 0.3, 0.6}},
          {"tanh, cubic actuator",
           {scalar("param a = 0.7 in 0.05..5\nparam b = 1.2 in 0.05..10\n",
                   "-a*x + b*tanh(u)"),
            scalar("param a = 0.7 in 0.05..5\nparam b = 1.1 in 0.05..10\n"
                   "param c = 0.1 in 0..1\n",
                   "-a*x + b*u - c*u^3")},
           -2.0,
           2.0,
           10.0,
           0.05,
           {0.6, 0.4, 0.65}},
          {"delay, lag",
           {scalar("param a = 0.7 in 0.05..5\nparam b = 1 in 0.05..10\n",
                   "-a*x + b*delay(u,0.2)"),
            "input u hold zero\nparam a = 0.7 in 0.05..5\nparam b = 1 in 0.05..10\n"
            "param w = 5 in 0.5..50\ndx/dt = -a*x + b*z\ndz/dt = w*(u - z)\ny = x\n"
            "initial x = 0 fixed\ninitial z = 0 fixed\n"},
           -2.0,
           2.0,
           10.0,
           0.05,
           {0.6}}};
}

std::vector<RivalCase> oscillators() {
  const std::string parameters = "param k = 4 in 0.2..40\nparam d = 0.5 in 0.01..5\n";
  const std::string linear = mechanical(parameters, "-k*q - d*v + u");
  return {{"linear, cubic stiffness",
           {linear, mechanical(parameters + "param e = 1.5 in 0.01..20\n",
                               "-k*q - e*q^3 - d*v + u")},
           -3.0,
           3.0,
           10.0,
           0.05,
           {0.6, 0.4}},
          {"cubic, quadratic stiffness",
           {mechanical(parameters + "param e = 1.5 in 0.01..20\n", "-k*q - e*q^3 - d*v + u"),
            mechanical(parameters + "param e = 1 in 0.01..20\n", "-k*q - e*q*abs(q) - d*v + u")},
           -3.0,
           3.0,
           10.0,
           0.05,
           {0.65, 0.6}},
          {"pendulum, linear", {mechanical(parameters, "-k*sin(q) - d*v + u"), linear}, -3.0, 3.0,
           10.0, 0.05, {0.6, 0.45}},
          {"hysteresis, dead zone",
           {"input u hold zero\nparam k = 3 in 0.2..40\nparam d = 0.5 in 0.01..5\n"
            "param h = 1 in 0.01..10\ndq/dt = v\ndv/dt = -k*q - h*z - d*v + u\n"
            "dz/dt = 4*v - 2*abs(v)*z - 2*v*abs(z)\n"
            "y = q\ninitial q = 0 fixed\ninitial v = 0 fixed\ninitial z = 0 fixed\n",
            mechanical(parameters + "param g = 0.1 in 0.01..0.5\n",
                       "-k*(q - clip(q,-g,g)) - d*v + u")},
           -3.0,
           3.0,
           10.0,
           0.05,
           {0.6, 0.5}}};
}

std::vector<RivalCase> thermal() {
  return {{"one, two thermal masses",
           {scalar("param a = 0.3 in 0.02..5\nparam b = 1 in 0.05..20\n", "-a*x + b*u"),
            "input u hold zero\nparam a = 0.3 in 0.02..5\nparam b = 1.1 in 0.05..20\n"
            "param c = 0.1 in 0.005..5\nparam e = 0.2 in 0.005..5\n"
            "dx/dt = -a*x - c*(x - z) + b*u\ndz/dt = e*(x - z)\ny = x\n"
            "initial x = 0 fixed\ninitial z = 0 fixed\n"},
           0.0,
           1.0,
           20.0,
           0.1,
           {0.1}},
          {"conduction, radiation",
           {scalar("param a = 0.4 in 0.02..5\nparam b = 0.6 in 0.05..20\n", "-a*x + b*u"),
            scalar("param a = 0.15 in 0.005..5\nparam b = 0.6 in 0.05..20\n",
                   "-a*((1 + x)^4 - 1)/4 + b*u")},
           0.0,
           1.0,
           15.0,
           0.1,
           {0.1, 0.12}}};
}

}  // namespace

const std::vector<RivalCase>& rival_cases() {
  static const std::vector<RivalCase> cases = [] {
    std::vector<RivalCase> all;
    for (const auto& group :
         {friction(), rates(), tanks(), actuators(), oscillators(), thermal()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return cases;
}

}  // namespace lacuna::benchmarks
