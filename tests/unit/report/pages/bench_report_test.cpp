// SPDX-License-Identifier: MIT
#include "lacuna/report/pages/bench_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/pages/pages.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

BenchCell finished_cell(std::size_t composition, double noise, bool exact, double error) {
  BenchScore score{.exact_structure = exact, .coefficient_error = error, .terms = 7};
  score.sync = 0.01;
  score.seconds = 0.25;
  return {composition, noise, {score, score}, {}};
}

BenchResult result_of_two() {
  BenchResult result{{"regressor", "filter"}, {{"ols", "abm"}, {"stlsq", "svd"}}, {0.0, 0.01}, {}};
  result.truth_known = true;
  result.cells = {finished_cell(0, 0.0, false, 0.5), finished_cell(0, 0.01, false, 0.75),
                  finished_cell(1, 0.0, true, 0.125),
                  {1, 0.01, {}, {"no term, \"none\""}}};
  return result;
}

TEST(BenchReport, TablesHaveTheBestFirst) {
  const std::string text = format_text(result_of_two());
  EXPECT_THAT(text, HasSubstr("Noise 0 % of each state"));
  EXPECT_THAT(text, HasSubstr("Noise 1 % of each state"));
  EXPECT_LT(text.find("stlsq"), text.find("ols "));  // in the first table
  EXPECT_THAT(text, HasSubstr("Failed (the first of each):\n  stlsq + svd, noise 1 %: no term"));
}

TEST(BenchReport, CsvHasALineForEachCell) {
  EXPECT_EQ(format_csv(result_of_two()),
            "regressor,filter,noise %,draws,failed,exact structure rate,coefficient error,terms,"
            "sync error %,time ms,failure\n"
            "ols,abm,0,2,0,0,0.5,7,1,250,\n"
            "ols,abm,1,2,0,0,0.75,7,1,250,\n"
            "stlsq,svd,0,2,0,1,0.125,7,1,250,\n"
            "stlsq,svd,1,1,1,,,,,,\"no term, \"\"none\"\"\"\n");
}

TEST(BenchReport, WithoutATruthTheErrorOfSynchronisationCounts) {
  BenchResult result = result_of_two();
  result.truth_known = false;
  for (BenchCell& cell : result.cells)
    for (BenchScore& score : cell.scores)
      score = BenchScore{.terms = score.terms, .sync = score.sync};
  EXPECT_THAT(bench_page(result, "r.csv").sections[0].pictures[0].title,
              HasSubstr("Synchronisation error"));
}

}  // namespace
}  // namespace lacuna
