// SPDX-License-Identifier: MIT
#include "trajectories/subset_selection/plain_candidates.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lacuna/bases/monomials.hpp"
#include "support/noisy_records.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

/// n samples of one orbit, 97 to a turn, with white noise of a fraction of its spread.
Dataset noisy_orbit(Index n, double fraction, std::uint64_t seed) {
  Dataset data;
  data.states = {{"x", "m"}, {"v", "m/s"}};
  data.trajectories = {oscillation(n, 0.0, 0.0324)};
  Matrix& states = data.trajectories[0].states;
  data.trajectories[0].inputs.resize(n, 0);
  const Vector sigma = fraction * spread(states);
  Random random(seed);
  for (Index k = 0; k < 2; ++k)
    for (Index i = 0; i < n; ++i) states(i, k) += sigma[k] * random.normal();
  return data;
}

struct OrbitCase {
  explicit OrbitCase(Dataset record)
      : library(Monomials{{.max_degree = 3}}.library(
            OdeModel(record.states, record.inputs, std::vector<Equation>(2)).variables())),
        task(search_task(record, {library}, analyse_noise(record), {})) {}

  /// The terms that are left in the first equation.
  std::vector<std::string> plain_terms(double strength = 3.0) const {
    std::vector<std::string> names;
    if (const std::optional<SearchTask> plain = plain_task(task, strength))
      for (const Coefficient& column : plain->candidates)
        if (column.equation == 0)
          names.push_back(library.terms[static_cast<std::size_t>(column.term)].name());
    return names;
  }

  Matrix coefficients(const std::string& term) const {
    Matrix values = Matrix::Zero(task.data.state_count(), library.size());
    for (std::size_t l = 0; l < library.terms.size(); ++l)
      if (library.terms[l].name() == term) values(0, static_cast<Index>(l)) = 1.0;
    return values;
  }

  TermLibrary library;
  SearchTask task;
};

TEST(PlainCandidates, AreNoMultiplesOfWhatIsConstantOnAnOrbit) {
  const OrbitCase c(noisy_orbit(2000, 0.01, 1));
  EXPECT_EQ(c.plain_terms(), (std::vector<std::string>{"1", "x", "v", "x*v"}));
}

TEST(PlainCandidates, AreAllWhereARelationIsTooWeakOrTermsAreConstrained) {
  OrbitCase c(noisy_orbit(2000, 0.05, 1));
  EXPECT_FALSE(c.plain_terms().empty());
  EXPECT_FALSE(plain_task(c.task, 10.0));
  c.task.constraints.push_back({{{0, 1, 1.0}}, 0.0});
  EXPECT_FALSE(plain_task(c.task, 3.0));
}

/// A sum that is constant says that one state is the others: none of them is the plainer one.
TEST(PlainCandidates, KeepStatesThatAddUp) {
  Dataset data = noisy_record("van-der-pol", 2000, 0.01, 1);
  Matrix& states = data.trajectories[0].states;
  states.col(1) = (3.0 - states.col(0).array()).matrix() + 1e-3 * states.col(1);
  EXPECT_FALSE(plain_task(OrbitCase(data).task, 3.0));
}

/// On one orbit many windows fit as well by x^3 and x v^2, which trade an initial state for a
/// frequency in each of them, as by x.
TEST(TrajectorySelection, FindsTwoTermsOnOneOrbitHoweverLong) {
  for (const std::uint64_t seed : {1, 2}) {
    const Dataset data = noisy_orbit(20000, 0.01, seed);
    const OdeModel none(data.states, data.inputs, std::vector<Equation>(2));
    const TermLibrary library = Monomials{{.max_degree = 3}}.library(none.variables());
    const OdeModel found = TrajectorySelection{}.refine({data, library, none}).model;
    EXPECT_EQ(structure_of(found), (Structure{{0, "v"}, {1, "x"}})) << to_text(found, 4);
  }
}

}  // namespace
}  // namespace lacuna
