// SPDX-License-Identifier: MIT
#include "problems.hpp"

#include "support/stiff_models.hpp"

namespace lacuna::benchmarks {
namespace {

std::vector<GreyBox> measured() {
  return {
      {"rc",
       "input u hold linear\nparam a = 0.8\nparam b = 0.5\ndx/dt = -a*x + b*u\ny = x\n",
       {2.0}},
      {"mass-spring",
       "input u hold linear\nparam k = 4\nparam d = 0.3\nparam g = 0.9\ndx/dt = v\n"
       "dv/dt = -k*x - d*v + g*u\ny = x\nz = v\n",
       {1.0, 0.0}},
      {"pendulum",
       "input u hold linear\nparam g = 9.8\nparam d = 0.2\nparam b = 1.5\ndth/dt = w\n"
       "dw/dt = -g*sin(th) - d*w + b*u\ny = th\n",
       {1.2, 0.0},
       0.02},
      {"van-der-pol",
       "param mu = 1.3\nparam k = 0.9\ndx/dt = v\ndv/dt = mu*v - mu*x^2*v - k*x\ny = x\nz = "
       "v\n",
       {1.0, 0.5}},
      {"lotka-volterra",
       "param a = 1.1\nparam b = 0.4\nparam c = 0.1\nparam d = 0.4\ndx/dt = a*x - b*x*z\n"
       "dz/dt = c*x*z - d*z\ny = x\nw = z\n",
       {10.0, 5.0}},
      {"logistic",
       "input u hold linear\nparam r = 0.9\nparam K = 5\nparam h = 0.3\n"
       "dx/dt = r*x*(1-x/K) - h*u*x\ny = x\n",
       {0.5}},
      {"duffing",
       "input u hold linear\nparam d = 0.2\nparam a = 1.0\nparam b = 0.8\nparam g = 1.2\n"
       "dx/dt = v\ndv/dt = -d*v - a*x - b*x^3 + g*u\ny = x\n",
       {1.0, 0.0}},
      {"chemostat",
       "input D hold linear\nparam mu = 1.6 in 0.01..50\nparam K = 0.8 in 0.01..50\n"
       "param Y = 0.5 in 0.01..50\ndX/dt = mu*S*X/(K+S) - 0.5*D*X\n"
       "dS/dt = 2*D - 0.5*D*S - mu*S*X/(K+S)/Y\nfixed dX/dt: D*X\nfixed dS/dt: D\n"
       "fixed dS/dt: S*D\ny = X\nw = S\n",
       {0.5, 2.0},
       0.1},
  };
}

std::vector<GreyBox> more_measured() {
  return {
      {"motor",
       "input u hold linear\nparam R = 2\nparam k = 0.5\nparam f = 0.3\ndi/dt = -R*i - k*w + "
       "u\n"
       "dw/dt = 4*k*i - f*w\nfixed dw/dt: i*k\ny = i\nz = w\n",
       {0.0, 0.0}},
      {"two-nodes",
       "input q hold linear\nparam a = 0.4\nparam b = 0.25\nparam c = 0.8\n"
       "dT1/dt = -a*T1 + a*T2 + c*q\ndT2/dt = a*T1 - a*T2 - b*T2\ny = T1\nz = T2\n",
       {1.0, 0.2},
       0.1},
  };
}

std::vector<GreyBox> hidden() {
  return {
      {"tanks",
       "input u hold linear\nparam k1 = 0.5 in 0..20\nparam k2 = 0.8 in 0..20\n"
       "param k4 = 0.4 in 0..20\ndx1/dt = -k1*sqrt(max(x1,0.0001)) + k4*u\n"
       "dx2/dt = k1*sqrt(max(x1,0.0001)) - k2*sqrt(max(x2,0.0001))\ny = x2\n",
       {0.3, 0.1},
       0.1,
       600,
       true},
      {"compartments",
       "input d hold linear\nparam k10 = 0.4\nparam k12 = 0.35\nparam k21 = 0.3\n"
       "dc1/dt = -k10*c1 - k12*c1 + k21*c2 + d\ndc2/dt = k12*c1 - k21*c2\ny = c1\n",
       {0.0, 0.0},
       0.1,
       600,
       true},
      {"chemostat-biomass",
       "input D hold linear\nparam mu = 1.6 in 0.01..50\nparam K = 0.8 in 0.01..50\n"
       "dX/dt = mu*S*X/(K+S) - 0.5*D*X\ndS/dt = 2*D - 0.5*D*S - 2*mu*S*X/(K+S)\n"
       "fixed dX/dt: D*X\nfixed dS/dt: D\nfixed dS/dt: S*D\nfixed dS/dt: mu*S*X/(K+S)\ny = X\n",
       {0.5, 2.0},
       0.1,
       600,
       true},
      {"neuron",
       "input I hold linear\nparam a = 0.08\nparam b = 0.064\nparam c = 0.056\nparam e = 0.33\n"
       "dv/dt = v - e*v^3 - r + 0.6*I\ndr/dt = a*v - b*r + c\nfixed dv/dt: I\ny = v\n",
       {-1.0, -0.5},
       0.2,
       800,
       true},
      {"epidemic",
       "param beta = 0.9\nparam gamma = 0.3\ndS/dt = -beta*S*I\ndI/dt = beta*S*I - gamma*I\n"
       "y = beta*S*I\ninitial S = 0.99 fixed\n",
       {0.99, 0.01},
       0.1,
       400,
       true},
  };
}

std::vector<GreyBox> more_hidden() {
  return {
      {"ladder",
       "input u hold linear\nparam a = 2\nparam b = 0.7\ndv1/dt = -a*v1 + a*u - b*v1 + b*v2\n"
       "dv2/dt = b*v1 - b*v2\ny = v1\n",
       {0.0, 0.0},
       0.05,
       600,
       true},
      {"drive",
       "input u hold linear\nparam p = 1.5\nparam g = 2\nparam k = 12\nparam d = 1.2\n"
       "dm/dt = -p*m + g*u\ndw/dt = a\nda/dt = k*m - k*w - d*a\ny = abs(w)\n"
       "initial w = 0.5\n",
       {0.2, 0.5, 0.0},
       0.05,
       600,
       true},
      {"oven",
       "input q hold linear\nparam h = 0.8\nparam l = 0.3 in 0..0.7\nparam s = 1.5 in "
       "0.9..20\ndT/dt = h*q - l*T\n"
       "dM/dt = s*T - s*M\ny = M\n",
       {0.5, 0.5},
       0.1,
       600,
       true},
      {"prey-only",
       "param a = 1.1\nparam c = 0.1\nparam d = 0.4\ndx/dt = a*x - 0.4*x*z\n"
       "dz/dt = c*x*z - d*z\nfixed dx/dt: x*z\ny = x\n",
       {10.0, 5.0},
       0.05,
       600,
       true},
      {"enzyme",
       "param V = 0.8 in 0.01..50\nparam K = 1.2 in 0.01..50\nparam e = 0.25\n"
       "dS/dt = -V*S/(K+S)\ndP/dt = V*S/(K+S) - e*P\ny = P\ninitial S = 5 fixed\n",
       {5.0, 0.0},
       0.05,
       500,
       true},
  };
}

/// Records along which errors grow by exp(0.9 t), 1.7 exp(0.07 t) and the like: those of the
/// integration, too.
std::vector<GreyBox> chaotic() {
  const std::string lorenz =
      "param s = 10\nparam r = 28\nparam b = 2.7\ndx/dt = s*(y - x)\n"
      "dy/dt = x*(r - z) - y\ndz/dt = x*y - b*z\nX = x\nY = y\nZ = z\n";
  return {{"lorenz, 8", lorenz, {1.0, 2.0, 20.0}, 0.01, 800, false, true},
          {"lorenz, 12", lorenz, {1.0, 2.0, 20.0}, 0.01, 1200, false, true},
          {"rossler, 100",
           "param a = 0.2\nparam b = 0.2\nparam c = 5.7\ndx/dt = -y - z\ndy/dt = x + a*y\n"
           "dz/dt = b + z*(x - c)\nX = x\nY = y\nZ = z\n",
           {3.0, 3.0, 0.1},
           0.1,
           1000,
           false,
           true},
          {"chua, 25",
           "param a = 10.8\nparam b = 14.3\nparam g = 0.6\ndx/dt = a*(y - g*x^3 + 0.2*x)\n"
           "dy/dt = x - y + z\ndz/dt = -b*y\nfixed dy/dt: x\nfixed dy/dt: y\n"
           "fixed dy/dt: z\nX = x\nY = y\nZ = z\n",
           {0.3, 0.1, 0.0},
           0.05,
           500,
           false,
           true}};
}

/// Rates from 1e-3 to 1e6.
GreyBox reactions() {
  std::vector<double> start(static_cast<std::size_t>(support::kChain), 0.0);
  start[0] = 1.0;
  return {"thirty reactions", support::chain_text(), start, 60.0, 101, true, true};
}

}  // namespace

std::vector<GreyBox> grey_boxes() {
  std::vector<GreyBox> all = measured();
  for (const auto& more : {more_measured(), hidden(), more_hidden(), chaotic()})
    all.insert(all.end(), more.begin(), more.end());
  all.push_back(reactions());
  return all;
}

}  // namespace lacuna::benchmarks
