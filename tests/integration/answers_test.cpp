// SPDX-License-Identifier: MIT
// A walk over answers: none contradicts itself in what it prints and in its JSON.
#include "benchmarks/studies/invariance/answers.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "core/base/text.hpp"
#include "integration/program.hpp"
#include "support/consistency.hpp"
#include "support/schemas.hpp"

namespace lacuna::testing {
namespace {

using ::testing::IsEmpty;

const std::string kData = LACUNA_SOURCE_DIR "/data/";

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

const nlohmann::json& table() {
  static const auto rows =
      nlohmann::json::parse(content_of(LACUNA_SOURCE_DIR "/tests/hostile/contradictions.json"));
  return rows;
}

TEST(Consistency, FindsWhatContradictsItselfAndNothingElse) {
  ASSERT_GT(table().size(), 40u);
  for (const auto& row : table()) {
    const std::string fault = row["fault"];
    const support::Faults found = row["json"].is_null()
                                      ? support::printed_faults(row["text"])
                                      : support::json_faults(row["json"].dump());
    if (fault.empty())
      EXPECT_THAT(found, IsEmpty()) << row;
    else
      EXPECT_THAT(found, ::testing::Contains(::testing::HasSubstr(fault))) << row;
  }
}

TEST(Consistency, IsTheSameInPython) {
  const std::string folder = LACUNA_SOURCE_DIR "/tests/hostile/";
  const int status = std::system(("python3 '" + folder + "consistency.py' --table '" + folder +
                                  "contradictions.json' > /dev/null")
                                     .c_str());
  if (WEXITSTATUS(status) == 127) GTEST_SKIP() << "no python3";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

class Answers : public ::testing::Test {
 protected:
  /// Expects an answer without contradictions, and one that is what its schema says.
  void expect_consistent(const std::string& schema, const std::string& arguments) {
    const std::string json = folder_.file("answer.json"), page = folder_.file("page.html");
    const bool has_page = schema != "comparison";
    const CommandResult result = run_program(arguments + " --json '" + json + "'" +
                                             (has_page ? " --report '" + page + "'" : ""));
    ASSERT_EQ(result.status, 0) << arguments << "\n" << result.err;
    const std::string text = folder_.read("answer.json");
    EXPECT_THAT(support::contradictions(result.out, text), IsEmpty()) << arguments << "\n"
                                                                      << result.out;
    EXPECT_EQ(violation(schema, text), "") << arguments;
  }

  /// x = cos, y = its derivative, noise of a deviation that is given, from a phase.
  std::string wave(const std::string& name, double noise, double phase = 0.0,
                   double offset = 0.0) {
    std::string text = "t [s],x [m],y [m/s]\n";
    std::uint64_t state = 88172645463325252ULL;
    const auto off = [&] {
      state ^= state << 13U, state ^= state >> 7U, state ^= state << 17U;
      return noise * 3.4 * (static_cast<double>(state >> 11U) / 9007199254740992.0 - 0.5);
    };
    for (int i = 0; i < 500; ++i) {
      const double t = 0.05 * i;
      text += format_number(t) + "," + format_number(offset + std::cos(t + phase) + off()) +
              "," + format_number(offset - std::sin(t + phase) + off()) + "\n";
    }
    return "'" + folder_.write(name, text) + "'";
  }

  std::string model(const std::string& text) {
    return "'" + folder_.write("m" + std::to_string(count_++) + ".ode", text) + "'";
  }

  TemporaryFolder folder_;
  int count_ = 0;
};

TEST_F(Answers, OfIdentify) {
  for (const auto& [noise, offset] :
       {std::pair{0.0, 0.0}, {0.0, 1e7}, {1e-4, 1e4}, {1e-4, 1e7}, {0.01, 0.0}, {0.1, 1.0}})
    expect_consistent("identification",
                      "identify " + wave("r.csv", noise, 0.0, offset) + " --degree 1");
  expect_consistent("identification", "identify " + wave("r.csv", 0.01) + " --holdout " +
                                          wave("s.csv", 0.01, 1.0));
  expect_consistent("identification", "identify " + wave("r.csv", 0.01) + " --embed x=2");
  expect_consistent("identification", "identify " + wave("r.csv", 0.01) + " --terms '1,x'");
  expect_consistent("identification", "identify " + wave("r.csv", 0.01) + " --preset robust");
  expect_consistent("identification", "identify '" + kData + "tl072_record.csv.gz'");
}

TEST_F(Answers, OfFit) {
  const std::string r = wave("r.csv", 0.01), s = wave("s.csv", 0.01, 1.0);
  const std::string right = "param a = 2 in 0..5\ndx/dt = y\ndy/dt = -a*x\n";
  const std::string wrong = "param a = 2 in 0..5\ndx/dt = y\ndy/dt = -a*x^3\n";
  const std::string bound = "param a = 2 in 1.5..5\ndx/dt = y\ndy/dt = -a*x\n";
  const std::string idle = "param a = 2\nparam b = 1\ndx/dt = y\ndy/dt = -a*x + 1e-15*b\n";
  const std::string product = "param a = 2\nparam b = 1\ndx/dt = y\ndy/dt = -a*b*x\n";
  for (const std::string& text : {right, wrong, bound, idle, product})
    expect_consistent("fit", "fit " + model(text) + " " + r + " --holdout " + s);
  expect_consistent("fit", "fit " + model(wrong) + " " + r + " --holdout " + s +
                               " --start-samples 100000 --ahead 100000");
}

TEST_F(Answers, OfSyncAndCompare) {
  const std::string r = wave("r.csv", 0.01), s = wave("s.csv", 0.01, 1.0);
  for (const char* text :
       {"dx/dt = y\ndy/dt = -x\n", "dx/dt = y\ndy/dt = -1.5*x\n", "dx/dt = y\ndy/dt = 0.1*y\n"})
    expect_consistent("sync", "sync " + model(text) + " " + r);
  expect_consistent("comparison", "compare " + r + " " + s);
  expect_consistent("comparison", "compare " + r + " " + r);
}

TEST_F(Answers, OfDiagnose) {
  const std::string r = wave("r.csv", 0.01), s = wave("s.csv", 0.01, 1.0);
  for (const char* text : {"dx/dt = y\ndy/dt = -x\n", "dx/dt = y\ndy/dt = -1.5*x\n",
                           "dx/dt = y\ndy/dt = -x - 0.3*y\n", "dx/dt = y\ndy/dt = -0.5*x^3\n"})
    expect_consistent("diagnosis",
                      "diagnose --model " + model(text) + " " + r + " --holdout " + s);
  expect_consistent("diagnosis",
                    "diagnose --model " + model("dx/dt = y\ndy/dt = -0.5*x^3\n") + " " + r);
  expect_consistent("diagnosis", "diagnose --model '" + kData + "pendulum.ode' '" + kData +
                                     "pendulum_scope_1.csv.gz' --map th=CH1,w=CH2,u=CH3");
}

// In other units every answer is the same, and far from 0 too: each variant on one of three.
TEST(Invariance, OtherUnitsGiveTheSameAnswerOrARefusal) {
  using namespace benchmarks;
  const TemporaryFolder folder;
  const auto records = small_records();
  const auto all = variants();
  const std::size_t chosen[] = {2, 13, 28};
  for (std::size_t k = 0; k < 3; ++k) {
    const SmallRecord& record = records[chosen[k]];
    const Answer base = identified(record.data, record.degree, folder.file("r.csv"));
    ASSERT_EQ(base.status, 0) << record.name;
    for (std::size_t v = k; v < all.size(); v += 3) {
      const Answer answer =
          identified(in_units(record.data, all[v]), record.degree, folder.file("r.csv"));
      const Outcome outcome =
          compared(answer, base, expected_structure(*base.model, record.data, all[v]));
      EXPECT_NE(outcome, Outcome::Other) << record.name << ", " << all[v].name;
      if (answer.status == 0)
        EXPECT_THAT(support::json_faults(answer.json), IsEmpty())
            << record.name << ", " << all[v].name;
      else
        EXPECT_THAT(answer.error, ::testing::HasSubstr("; ")) << "it says what to do";
    }
  }
}

TEST(Invariance, AShiftedPolynomialHasTheTermsOfItsExpansion) {
  using namespace benchmarks;
  const SmallRecord record = small_records()[20];  // van-der-pol
  const Variant shifted{"", {1.0}, 1.0, 1.0}, scaled{"", {1e9}, 1e-3};
  EXPECT_EQ(expected_structure(record.model, record.data, scaled), structure_of(record.model));
  EXPECT_THAT(expected_structure(record.model, record.data, shifted)[1],
              ::testing::IsSupersetOf(structure_of(record.model)[1]));
  const Dataset other = in_units(record.data, scaled);
  EXPECT_EQ(other.trajectories[0].states(7, 0), 1e9 * record.data.trajectories[0].states(7, 0));
  EXPECT_EQ(other.trajectories[0].time[7], 1e-3 * record.data.trajectories[0].time[7]);
}

}  // namespace
}  // namespace lacuna::testing
