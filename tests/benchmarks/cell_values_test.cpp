// SPDX-License-Identifier: MIT
#include "support/cell_values.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lacuna/core/base/error.hpp"
#include "lacuna/core/base/types.hpp"
#include "support/environment.hpp"
#include "support/expect_error.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::benchmarks {
namespace {

using ::testing::ElementsAre;
using testing::Environment;
using testing::expect_error;
using testing::TemporaryFolder;

enum class Colour { Red, Green };

struct Inner {
  int count = 0;
  bool yes = false;

  auto fields() { return std::tie(count, yes); }
};

struct Everything {
  double number = 0.0;
  std::string text;
  Colour colour = Colour::Red;
  std::optional<double> known, unknown;
  Vector values;
  std::vector<Inner> inner;
  std::array<Colour, 2> colours{};

  auto fields() {
    return std::tie(number, text, colour, known, unknown, values, inner, colours);
  }
};

/// Written as text and read again.
template <class T>
T again(T value) {
  T read{};
  read_value(nlohmann::json::parse(json_of(value).dump()), read);
  return read;
}

TEST(CellValues, NumbersAreTheSameToTheBit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double value : {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -2.0 / 3e-7, 42.0,
                             kInfinity, -kInfinity})
    EXPECT_EQ(again(value), value);
  EXPECT_TRUE(std::signbit(again(-0.0)));
  EXPECT_TRUE(std::isnan(again(std::numeric_limits<double>::quiet_NaN())));
}

TEST(CellValues, StructsListTheirFields) {
  Vector values(2);
  values << 0.1, -std::numeric_limits<double>::infinity();
  const Everything there{1e-300,
                         "a \"b\",\n\xC3\xA4",
                         Colour::Green,
                         0.7,
                         {},
                         values,
                         {{3, true}, {-4, false}},
                         {Colour::Green, Colour::Red}};
  const Everything read = again(there);
  EXPECT_EQ(read.number, there.number);
  EXPECT_EQ(read.text, there.text);
  EXPECT_EQ(read.colour, Colour::Green);
  EXPECT_EQ(read.known, there.known);
  EXPECT_FALSE(read.unknown.has_value());
  EXPECT_EQ(read.values, values);
  ASSERT_EQ(read.inner.size(), 2u);
  EXPECT_EQ(read.inner[1].count, -4);
  EXPECT_TRUE(read.inner[0].yes);
  EXPECT_EQ(read.colours, there.colours);
}

TEST(CellValues, NothingTakesThePlaceOfSomething) {
  std::optional<double> value = 1.0;
  read_value(nlohmann::json(), value);
  EXPECT_FALSE(value.has_value());
  std::vector<int> list{1, 2, 3};
  read_value(nlohmann::json::array(), list);
  EXPECT_TRUE(list.empty());
}

TEST(CellValues, OtherValuesAreAnError) {
  Inner inner;
  EXPECT_THROW(read_value(nlohmann::json::parse("[1]"), inner), nlohmann::json::exception);
  EXPECT_THROW(read_value(nlohmann::json::parse("[\"a\",true]"), inner),
               nlohmann::json::exception);
}

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

const ResultTable kTable{{"system", "error"}, {{"Lorenz, chaotic", "0.1"}, {"SIR", "2"}}};

TEST(ResultTable, IsWrittenForPeopleAndForPrograms) {
  EXPECT_EQ(kTable.csv(), "system,error\n\"Lorenz, chaotic\",0.1\nSIR,2\n");
  EXPECT_EQ(kTable.markdown(),
            "| system | error |\n| --- | --- |\n| Lorenz, chaotic | 0.1 |\n| SIR | 2 |\n");
}

TEST(ResultTable, GoesIntoAFolderThatIsMade) {
  const TemporaryFolder folder;
  write_results(folder.path() / "a" / "b", "some", kTable.csv(), "# Some\n");
  EXPECT_EQ(folder.read("a/b/some.csv"), kTable.csv());
  EXPECT_EQ(folder.read("a/b/some.md"), "# Some\n");
}

}  // namespace
}  // namespace lacuna::benchmarks
