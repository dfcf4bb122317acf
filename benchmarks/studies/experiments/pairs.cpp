// SPDX-License-Identifier: MIT
#include "pairs.hpp"

namespace lacuna::benchmarks {
namespace {

/// The state in which the middle of u's range holds the plant.
const char* kAtRest = "@";

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

std::vector<RivalCase> friction() {
  const std::string viscous = "param d = 0.8 in 0.01..10\n";
  const std::string dry = scalar(viscous + "param c = 0.1 in 0.001..5\n",
                                 "-d*x - c*tanh(30*x) + u");
  const std::string quadratic =
      scalar(viscous + "param b = 0.4 in 0.01..20\n", "-d*x - b*x*abs(x) + u");
  const std::string cubic =
      scalar(viscous + "param b = 0.5 in 0.01..20\n", "-d*x - b*x^3 + u");
  return {{"viscous, with dry", {scalar(viscous, "-d*x + u"), dry}, -1.0, 1.0, 8.0, 0.04},
          {"viscous, with quadratic",
           {scalar(viscous, "-d*x + u"), quadratic},
           -1.0,
           1.0,
           8.0,
           0.04},
          {"quadratic, cubic", {quadratic, cubic}, -1.0, 1.0, 8.0, 0.04},
          {"viscous, with quadratic, with cubic",
           {scalar(viscous, "-d*x + u"), quadratic, cubic},
           -1.0,
           1.0,
           8.0,
           0.04},
          {"dry, Stribeck",
           {dry, scalar(viscous + "param c = 0.1 in 0.001..5\nparam s = 0.1 in 0.001..5\n",
                        "-d*x - (c + s*exp(-25*x^2))*tanh(30*x) + u")},
           -1.0,
           1.0,
           8.0,
           0.04}};
}

std::vector<RivalCase> rates() {
  const std::string numbers = "param V = 1 in 0.05..20\nparam K = 1.5 in 0.05..20\n";
  const std::string hyperbola = scalar(numbers, "u - V*x/(K + x)", kAtRest);
  const std::string exponential = scalar(numbers, "u - V*(1 - exp(-x/K))", kAtRest);
  const std::string inhibited = scalar(numbers + "param I = 6 in 0.5..100\n",
                                       "u - V*x/(K + x + x^2/I)", kAtRest);
  const std::string hill =
      scalar("param V = 0.8 in 0.05..20\nparam K = 0.9 in 0.05..20\n",
             "u - V*x^2/(K^2 + x^2)", kAtRest);
  const std::string growth = "param r = 0.8 in 0.05..5\nparam K = 2 in 0.2..20\n";
  return {{"Michaelis-Menten, exponential", {hyperbola, exponential}, 0.0, 0.7, 20.0, 0.2},
          {"Michaelis-Menten, inhibited", {hyperbola, inhibited}, 0.0, 0.7, 20.0, 0.2},
          {"Michaelis-Menten, exponential, Hill",
           {hyperbola, exponential, hill},
           0.0,
           0.7,
           20.0,
           0.2},
          {"logistic, Gompertz",
           {scalar(growth, "r*x*(1 - x/K) - u*x", kAtRest),
            scalar(growth, "r*x*log(K/x) - u*x", kAtRest)},
           0.0,
           0.6,
           15.0,
           0.1}};
}

std::vector<RivalCase> tanks() {
  const std::string outflow = "param k = 0.4 in 0.01..5\n";
  return {{"outflow, with leak",
           {scalar(outflow, "u - k*sqrt(abs(x) + 1e-6)", kAtRest),
            scalar(outflow + "param l = 0.05 in 0.001..2\n",
                   "u - k*sqrt(abs(x) + 1e-6) - l*x", kAtRest)},
           0.0,
           1.0,
           15.0,
           0.1},
          {"leak, overflow",
           {scalar(outflow + "param l = 0.05 in 0.001..2\n",
                   "u - k*sqrt(abs(x) + 1e-6) - l*x", kAtRest),
            scalar(outflow + "param o = 0.2 in 0.001..2\n",
                   "u - k*sqrt(abs(x) + 1e-6) - o*max(x - 2,0)", kAtRest)},
           0.0,
           1.0,
           15.0,
           0.1}};
}

std::vector<RivalCase> actuators() {
  const std::string gain = "param a = 0.7 in 0.05..5\nparam b = 1 in 0.05..10\n";
  const std::string linear = scalar(gain, "-a*x + b*u");
  const std::string clipped =
      scalar(gain + "param s = 1.3 in 0.2..1.9\n", "-a*x + b*clip(u,-s,s)");
  const std::string saturated =
      scalar(gain + "param s = 1.5 in 0.2..10\n", "-a*x + b*s*tanh(u/s)");
  return {{"linear, clipped actuator", {linear, clipped}, -2.0, 2.0, 10.0, 0.05},
          {"clipped, smooth saturation", {clipped, saturated}, -2.0, 2.0, 10.0, 0.05},
          {"linear, dead zone at the input",
           {linear, scalar(gain + "param g = 0.1 in 0.01..1\n",
                           "-a*x + b*(u - clip(u,-g,g))")},
           -2.0,
           2.0,
           10.0,
           0.05},
          {"delay, lag",
           {scalar(gain, "-a*x + b*delay(u,0.05)"),
            "input u hold zero\n" + gain +
                "param w = 20 in 0.5..50\ndx/dt = -a*x + b*z\ndz/dt = w*u - w*z\ny = x\n"
                "initial x = 0 fixed\ninitial z = 0 fixed\n"},
           -2.0,
           2.0,
           10.0,
           0.05}};
}

std::vector<RivalCase> oscillators() {
  const std::string parameters = "param k = 4 in 0.2..40\nparam d = 0.5 in 0.01..5\n";
  const std::string linear = mechanical(parameters, "-k*q - d*v + u");
  const std::string cubic =
      mechanical(parameters + "param e = 1.5 in 0.01..20\n", "-k*q - e*q^3 - d*v + u");
  const std::string dry = mechanical(parameters + "param c = 0.1 in 0.001..5\n",
                                     "-k*q - d*v - c*tanh(30*v) + u");
  return {{"pendulum, linear",
           {mechanical(parameters, "-k*sin(q) - d*v + u"), linear},
           -3.0,
           3.0,
           10.0,
           0.05},
          {"cubic, quadratic stiffness",
           {cubic, mechanical(parameters + "param e = 1 in 0.01..20\n",
                              "-k*q - e*q*abs(q) - d*v + u")},
           -3.0,
           3.0,
           10.0,
           0.05},
          {"hysteresis, dry friction",
           {"input u hold zero\n" + parameters +
                "param h = 0.3 in 0.01..10\nparam b = 2 fixed\ndq/dt = v\n"
                "dv/dt = -k*q - h*z - d*v + u\ndz/dt = v - b*abs(v)*z - b*v*abs(z)\ny = q\n"
                "initial q = 0 fixed\ninitial v = 0 fixed\ninitial z = 0 fixed\n",
            dry},
           -3.0,
           3.0,
           10.0,
           0.05}};
}

std::vector<RivalCase> thermal() {
  const std::string one = "param a = 0.3 in 0.02..5\nparam b = 1 in 0.05..20\n";
  return {{"one, two thermal masses",
           {scalar(one, "-a*x + b*u", kAtRest),
            "input u hold zero\n" + one +
                "param c = 0.02 in 0.002..5\nparam e = 0.1 in 0.005..5\n"
                "dx/dt = -a*x - c*x + c*z + b*u\ndz/dt = e*x - e*z\ny = x\n"
                "initial x = @ fixed\ninitial z = @ fixed\n"},
           0.0,
           1.0,
           20.0,
           0.2},
          {"conduction, with radiation",
           {scalar(one, "-a*x + b*u", kAtRest),
            scalar(one + "param r = 0.0005 in 0.00001..1\n", "-a*x - r*((3 + x)^4 - 81) + b*u",
                   "1.2")},
           0.0,
           1.0,
           20.0,
           0.2}};
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
