// SPDX-License-Identifier: MIT
#include "cli/start/skeleton.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

RecordUse use() {
  return {"ms",
          {{{"x", "m"}, ColumnUse::State},
           {{"u", "V"}, ColumnUse::Input},
           {{"sum", ""}, ColumnUse::LeftOut},
           {{"v", ""}, ColumnUse::State}}};
}

TEST(Skeleton, IsAModelWithTheColumnsAndNothingElse) {
  const OdeModel model = parse_ode(skeleton_of(use(), "folder/run.csv"), "skeleton");
  ASSERT_EQ(model.dimension(), 2);
  EXPECT_EQ(model.states()[0], (Quantity{"x", "m"}));
  EXPECT_EQ(model.states()[1], (Quantity{"v", ""}));
  ASSERT_EQ(model.inputs().size(), 1u);
  EXPECT_EQ(model.inputs()[0], (Quantity{"u", "V"}));
  EXPECT_EQ(model.time_unit(), "ms");
  for (const Equation& equation : model.equations()) EXPECT_THAT(equation, IsEmpty());
}

TEST(Skeleton, ItsExamplesCanBeUncommented) {
  std::string text = skeleton_of(use(), "run.csv");
  EXPECT_THAT(text, HasSubstr("# Skeleton of a model for run.csv\n"));
  const std::string zero = "dx/dt = 0\n";
  ASSERT_THAT(text, HasSubstr(zero));
  text.erase(text.find(zero), zero.size());
  for (std::size_t at = text.find("#   "); at != std::string::npos; at = text.find("#   "))
    text.erase(at, 4);
  const SystemModel system = parse_ode_system(text, "uncommented");
  ASSERT_EQ(system.parameters().size(), 1u);
  EXPECT_EQ(system.model().coefficient(0, "u"), 1.0);
}

/// A file's name is somebody else's text.
TEST(Skeleton, NoNameOfAFileBecomesAStatement) {
  const OdeModel model = parse_ode(skeleton_of(use(), "a\ndx/dt = 1\r\u202e.csv"), "skeleton");
  EXPECT_THAT(model.equations()[0], IsEmpty());
}

TEST(Skeleton, FlagsSayWhatACommandDoesNotTakeByItself) {
  EXPECT_THAT(column_flags(use()), ElementsAre("--states", "x,v", "--inputs", "u"));
  const RecordUse plain{"s", {{{"x", ""}, ColumnUse::State}}};
  EXPECT_THAT(column_flags(plain), IsEmpty());
  EXPECT_THAT(column_flags(plain, false), ElementsAre("--states", "x"));
}

}  // namespace
}  // namespace lacuna::cli
