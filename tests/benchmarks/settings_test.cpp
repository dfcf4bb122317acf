// SPDX-License-Identifier: MIT
#include "support/settings.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "support/environment.hpp"
#include "support/expect_error.hpp"

namespace lacuna::benchmarks {
namespace {

using ::testing::ElementsAre;
using testing::Environment;
using testing::expect_error;

int count_of_places(const StudyArguments& arguments) {
  return static_cast<int>(arguments.places.size());
}

StudyProgram program(bool has_options = true) {
  return {"some", "FOLDER [DRAWS]", count_of_places, 1, has_options};
}

TEST(StudyArguments, AreSortedWhereverTheyStand) {
  const Environment alone({});
  const auto arguments =
      study_arguments(program(), {"out", "--cells", "kept", "forms.same=0.2", "12"});
  EXPECT_THAT(arguments.places, ElementsAre("out", "12"));
  EXPECT_THAT(arguments.settings, ElementsAre("forms.same=0.2"));
  EXPECT_EQ(arguments.options.forms.same, 0.2);
  EXPECT_EQ(arguments.finished, "kept");
  EXPECT_EQ(arguments.at(0), "out");
  EXPECT_EQ(arguments.at(2, "else"), "else");
  EXPECT_EQ(arguments.count_at(1, 5), 12u);
  EXPECT_EQ(arguments.count_at(2, 5), 5u);
}

TEST(StudyArguments, SayWhereTheTableGoes) {
  EXPECT_EQ(study_arguments(program(), {}).folder_at(0), "build/studies/some");
  EXPECT_EQ(study_arguments(program(), {"out"}).folder_at(0), "out");
}

TEST(StudyArguments, MakeTheStoreOfThisProcess) {
  const Environment second({{"PMI_RANK", "1"}, {"PMI_SIZE", "3"}});
  const auto arguments =
      study_arguments(program(), {"out", "forms.same=0.2", "--cells", "kept"});
  const CellStore store = arguments.store("robust");
  EXPECT_EQ(store.study, "some");
  EXPECT_EQ(store.settings, "robust forms.same=0.2");
  EXPECT_EQ(store.folder, "kept");
  EXPECT_EQ(store.share.rank, 1);
  EXPECT_EQ(store.share.size, 3);
}

TEST(StudyArguments, OfAStudyWithoutOptionsArePlaces) {
  EXPECT_THAT(study_arguments(program(false), {"a=b"}).places, ElementsAre("a=b"));
}

TEST(StudyArguments, RefuseWhatNobodyReads) {
  expect_error<ConfigError>(
      [] {
        study_arguments(program(), {"out", "--cell", "x"});
      },
      "study_some", "'--cell'", "FOLDER [DRAWS] [--cells FOLDER]");
  EXPECT_THROW(study_arguments(program(), {"out", "--cells"}), ConfigError);
  EXPECT_THROW(study_arguments(program(), {"forms.some=0.2"}), ConfigError);
  expect_error<ConfigError>(
      [] {
        study_arguments(program(), {"out", "1e3"}).count_at(1, 1);
      },
      "study_some", "'1e3' is no whole number", "give a number");
}

TEST(StudyMain, RunsOrTellsTheUsage) {
  std::string name = "study_some", folder = "out", wrong = "--wrong";
  char* given[] = {name.data(), folder.data(), wrong.data()};
  EXPECT_EQ(study_main(program(), 2, given), 1);
  EXPECT_EQ(study_main(program(), 1, given), 2);
  EXPECT_EQ(study_main(program(), 3, given), 2);
}

}  // namespace
}  // namespace lacuna::benchmarks
