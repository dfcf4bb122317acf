// SPDX-License-Identifier: MIT
#include "report/json/stage_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/regression/formulations/strong_form.hpp"
#include "lacuna/regression/pruners/minor_terms.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

TEST(StageJson, WritesTypeAndEveryOption) {
  EXPECT_EQ(format_stage(FiniteDifferences{{.order = 6}}),
            R"({"type":"finite-differences","order":6})");
}

TEST(StageJson, WritesChoicesAsNamesAndAbsentValuesAsNull) {
  const std::string text = format_stage(MinorTerms{});
  EXPECT_THAT(text, HasSubstr(R"("tolerances":"relative")"));
  EXPECT_THAT(text, HasSubstr(R"("eta":null)"));
}

TEST(StageJson, WritesStagesInsideStages) {
  EXPECT_THAT(format_stage(StrongForm{{.differentiator = FiniteDifferences{{.order = 4}}}}),
              HasSubstr(R"("differentiator":{"type":"finite-differences","order":4})"));
}

TEST(StageJson, PipelineHasAllFiveStages) {
  const std::string text = format_pipeline(algorithm1());
  for (const char* key : {"basis", "formulation", "filter", "regressor", "pruner"})
    EXPECT_THAT(text, HasSubstr("\"" + std::string(key) + "\":{\"type\""));
}

}  // namespace
}  // namespace lacuna
