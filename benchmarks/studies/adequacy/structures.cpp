// SPDX-License-Identifier: MIT
#include "structures.hpp"

namespace lacuna::benchmarks {
namespace {

std::vector<StructurePair> of_decays() {
  return {
      {"two compartments",
       "param ka = 1.2 in 0.01..20\nparam ke = 0.3 in 0.001..20\nparam k12 = 0.8 in 0.001..20\n"
       "param k21 = 0.25 in 0.001..20\nparam V = 20 in 1..200\ndg/dt = -ka*g\n"
       "dc/dt = ka*g - ke*c - k12*c + k21*p\ndp/dt = k12*c - k21*p\ny = c/V\n"
       "initial g = 100 fixed\ninitial c = 0 fixed\ninitial p = 0 fixed\n",
       "param ka = 1.2 in 0.01..20\nparam ke = 0.3 in 0.001..20\nparam V = 20 in 1..200\n"
       "dg/dt = -ka*g\ndc/dt = ka*g - ke*c\ny = c/V\n"
       "initial g = 100 fixed\ninitial c = 0 fixed\n",
       {100.0, 0.0, 0.0}},
      {"saturable elimination",
       "param V = 2 in 0.01..50\nparam K = 1 in 0.01..50\ndc/dt = -V*c/(K+c)\ny = c\n",
       "param k = 0.5 in 0.001..50\ndc/dt = -k*c\ny = c\n",
       {5.0},
       0.15},
      {"second-order reaction",
       "param k = 0.4 in 0.001..50\nda/dt = -k*a^2\ny = a\n",
       "param k = 0.4 in 0.001..50\nda/dt = -k*a\ny = a\n",
       {3.0}},
      {"outflow of a tank",
       "param a = 0.4 in 0.001..50\ndh/dt = -a*sqrt(max(h,0.000001))\ny = h\n",
       "param a = 0.2 in 0.001..50\ndh/dt = -a*h\ny = h\n",
       {4.0},
       0.2},
      {"cooling with radiation",
       "param h = 0.05 in 0..5\nparam r = 0.3 in 0..5\ndT/dt = -h*(T-1) - r*(T^4-1)\n"
       "y = T\n",
       "param h = 0.5 in 0..5\ndT/dt = -h*(T-1)\ny = T\n",
       {2.0},
       0.1}};
}

std::vector<StructurePair> of_growth_and_motion() {
  return {
      {"two RC pairs",
       "input u hold linear\nparam a = 2 in 0.01..50\nparam b = 0.2 in 0.01..50\n"
       "param p = 0.6 in 0.01..50\nparam q = 0.15 in 0.01..50\ndx/dt = -a*x + p*u\n"
       "dz/dt = -b*z + q*u\ny = x + z\ninitial x = 0 fixed\ninitial z = 0 fixed\n",
       "input u hold linear\nparam a = 1 in 0.01..50\nparam p = 0.5 in 0.01..50\n"
       "dx/dt = -a*x + p*u\ny = x\ninitial x = 0 fixed\n",
       {0.0, 0.0}},
      {"logistic growth",
       "param r = 0.9 in 0.01..20\nparam K = 5 in 0.1..100\ndx/dt = r*x*(1-x/K)\ny = x\n",
       "param r = 0.4 in 0.01..20\nparam K = 5 in 0.1..100\ndx/dt = r*x*log(K/x)\ny = x\n",
       {0.2}},
      {"quadratic drag",
       "param k = 2 in 0.01..50\nparam c = 0.3 in 0.001..50\ndx/dt = v\n"
       "dv/dt = -k*x - c*v*abs(v)\ny = x\n",
       "param k = 2 in 0.01..50\nparam c = 0.3 in 0.001..50\ndx/dt = v\ndv/dt = -k*x - c*v\n"
       "y = x\n",
       {2.0, 0.0}},
      {"pendulum",
       "param g = 4 in 0.01..50\nparam d = 0.1 in 0.001..50\ndth/dt = w\n"
       "dw/dt = -g*sin(th) - d*w\ny = th\n",
       "param g = 4 in 0.01..50\nparam d = 0.1 in 0.001..50\ndth/dt = w\n"
       "dw/dt = -g*th - d*w\ny = th\n",
       {1.2, 0.0}},
      {"saturating predators",
       "param a = 1.1 in 0.01..20\nparam b = 0.5 in 0.01..20\nparam h = 0.3 in 0.001..20\n"
       "param c = 0.3 in 0.01..20\nparam d = 0.4 in 0.01..20\n"
       "dx/dt = a*x - b*x*z/(1+h*x)\ndz/dt = c*x*z/(1+h*x) - d*z\ny = x\nw = z\n",
       "param a = 1.1 in 0.01..20\nparam b = 0.4 in 0.01..20\nparam c = 0.2 in 0.01..20\n"
       "param d = 0.4 in 0.01..20\ndx/dt = a*x - b*x*z\ndz/dt = c*x*z - d*z\ny = x\nw = z\n",
       {3.0, 2.0}}};
}

}  // namespace

std::vector<StructurePair> structure_pairs() {
  std::vector<StructurePair> all = of_decays();
  for (StructurePair& pair : of_growth_and_motion()) all.push_back(std::move(pair));
  return all;
}

}  // namespace lacuna::benchmarks
