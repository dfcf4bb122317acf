// SPDX-License-Identifier: MIT
#include "trajectories/subset_selection/candidate_screening.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "lacuna/bases/monomials.hpp"
#include "support/lorenz96.hpp"

namespace lacuna {
namespace {

/// A search among quadratic monomials, not begun.
struct ScreeningCase {
  explicit ScreeningCase(Index states, double noise = 1e-3)
      : model(lorenz96(states)),
        library(Monomials{{.max_degree = 2}}.library(model.variables())),
        task(search_task(lorenz96_record(states, 1500, noise, 1), {library},
                         analyse_noise(lorenz96_record(states, 1500, noise, 1)), {})),
        search(prepared_search(task)) {
    search.shortest = 20;
    search.path.windows = windows_of(search.path.records, 60);
    search.fit.coefficients = Matrix::Zero(states, library.size());
  }

  /// The columns of the true model.
  std::vector<Coefficient> truth() const {
    std::vector<Coefficient> columns;
    const std::vector<std::string> names = library.names();
    for (const auto& [equation, term] : structure_of(model))
      columns.push_back({static_cast<Index>(equation),
                         std::find(names.begin(), names.end(), term) - names.begin()});
    std::sort(columns.begin(), columns.end());
    return columns;
  }

  OdeModel model;
  TermLibrary library;
  SearchTask task;
  WindowSearch search;
};

bool contains(const std::vector<Coefficient>& all, const std::vector<Coefficient>& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

TEST(CandidateScreening, TrueTermsAreAmongThePlausibleOnes) {
  ScreeningCase c(8);
  const ScreenedCandidates found = screen_candidates(c.task, c.search, {});
  EXPECT_TRUE(contains(found.plausible, c.truth()));
  EXPECT_TRUE(contains(found.plausible, found.worth));
  EXPECT_TRUE(std::is_sorted(found.plausible.begin(), found.plausible.end()));
}

/// What chance keeps out of the first few may be needed; a problem of 250 columns is cheap.
TEST(CandidateScreening, KeepsAsManyAsThereIsRoomForOrSeveralTimesWhatIsWorthIt) {
  for (const Index states : {8, 24}) {
    ScreeningCase c(states);
    const ScreenedCandidates found = screen_candidates(c.task, c.search, {});
    const auto most = static_cast<std::size_t>(states);
    EXPECT_GE(found.plausible.size(), 250 / most * most);
    EXPECT_LE(found.plausible.size(),
              std::max<std::size_t>(250, 2 * found.worth.size() + 4 * most));
    EXPECT_LT(found.plausible.size(), c.task.candidates.size());
  }
}

TEST(CandidateScreening, ColumnsOfTheModelStay) {
  ScreeningCase c(8);
  const Coefficient odd{3, c.library.size() - 1};  // x7^2, which explains nothing
  c.search.fit.coefficients(odd.equation, odd.term) = 0.1;
  const ScreenedCandidates found = screen_candidates(c.task, c.search, {});
  EXPECT_TRUE(contains(found.plausible, {odd}));
  EXPECT_FALSE(contains(found.worth, {odd}));
}

}  // namespace
}  // namespace lacuna
