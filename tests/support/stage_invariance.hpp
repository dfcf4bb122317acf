// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "lacuna/regression/linear/least_squares_system.hpp"
#include "support/rossler_system.hpp"

namespace lacuna::testing {

/// One way to write down the same data differently.
struct Rewriting {
  std::string name;
  double state_scale = 1.0;              ///< new states / old states
  double time_scale = 1.0;               ///< new times / old times
  int copies = 1;                        ///< of every row
  std::vector<Index> order = {0, 1, 2};  ///< new variable number -> old one
};

inline std::vector<Rewriting> rewritings() {
  return {{"small states", 1e-3},
          {"large states", 1e4},
          {"fast time", 1.0, 1e-4},
          {"rows twice", 1.0, 1.0, 2},
          {"permuted", 1.0, 1.0, 1, {2, 0, 1}}};
}

inline LeastSquaresSystem rewritten(const Matrix& states, const Matrix& derivatives, int degree,
                                    const Rewriting& r) {
  const Matrix x = r.state_scale * states(Eigen::all, r.order);
  const Matrix dx = r.state_scale / r.time_scale * derivatives(Eigen::all, r.order);
  return monomial_system(x.replicate(r.copies, 1), dx.replicate(r.copies, 1), degree);
}

/// The name in the old variables of a monomial "ijk" in the new ones.
inline std::string old_name(const std::string& name, const Rewriting& r) {
  std::string old(3, '0');
  for (std::size_t i = 0; i < 3; ++i) old[static_cast<std::size_t>(r.order[i])] = name[i];
  return old;
}

/// Sorted names, in the old variables, of a set of terms.
inline std::vector<std::string> old_names(const LeastSquaresSystem& system,
                                          const TermSet& terms, const Rewriting& r) {
  std::vector<std::string> names;
  for (const std::string& name : names_of(system, terms)) names.push_back(old_name(name, r));
  std::sort(names.begin(), names.end());
  return names;
}

/// |h_j theta_j| with sign, relative to |y|: the same however the data are written.
inline std::map<std::string, double> fractions(const LeastSquaresSystem& system, Index target,
                                               const TermSet& active, const Vector& h,
                                               const Rewriting& r) {
  std::map<std::string, double> result;
  for (std::size_t i = 0; i < active.size(); ++i) {
    const std::string& name = system.term_names()[static_cast<std::size_t>(active[i])];
    result[old_name(name, r)] = h[static_cast<Index>(i)] *
                                system.factor().column_norms[active[i]] /
                                system.factor().target_norms[target];
  }
  return result;
}

/// Which target of the rewritten system belongs to an old one.
inline Index new_target(Index old, const Rewriting& r) {
  return std::find(r.order.begin(), r.order.end(), old) - r.order.begin();
}

inline void expect_same_fractions(const std::map<std::string, double>& a,
                                  const std::map<std::string, double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, fraction] : a) {
    ASSERT_TRUE(b.count(name)) << name;
    EXPECT_NEAR(fraction, b.at(name), tolerance) << name;
  }
}

}  // namespace lacuna::testing
