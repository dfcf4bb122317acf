// SPDX-License-Identifier: MIT
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/text.hpp"
#include "core/files/file_bytes.hpp"
#include "data/formats/npy.hpp"
#include "lacuna/data/formats/write.hpp"
#include "support/disk_limits.hpp"
#include "support/noisy_records.hpp"
#include "unit/cli/commands/records.hpp"
#include "unit/data/long_records/long_records.hpp"

namespace lacuna {
namespace {

using testing::CommandResult;
using testing::expect_failure;
using testing::expect_refused;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Records;
using testing::run_command;
using testing::run_well;
using testing::TemporaryFolder;
using testing::unfolded;

nlohmann::json run_identify(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "identify");
  arguments.insert(arguments.end(), {"--json", "-"});
  const CommandResult result = run_well(arguments);
  return nlohmann::json::parse(result.out);
}

std::size_t term_count(const nlohmann::json& result, std::size_t equation) {
  return result["model"]["equations"][equation]["terms"].size();
}

TEST(IdentifyCommand, FindsRosslerInItsOrbit) {
  const Records records;
  const auto result = run_identify({records.rossler()});
  EXPECT_EQ(result["format"], "lacuna.identification/1");
  EXPECT_EQ(term_count(result, 0) + term_count(result, 1) + term_count(result, 2), 7u);
  EXPECT_LT(result["sync"]["relative"].get<double>(), 1e-3);
  EXPECT_EQ(result["trail"].size(), 60u);
}

TEST(IdentifyCommand, SavesTheModelItShows) {
  const Records records;
  const std::string model = records.folder().file("m.json");
  const std::string json = records.folder().file("r.json");
  const auto result =
      run_well({"identify", records.rossler(), "--model-out", model, "--json", json});
  EXPECT_THAT(result.out, HasSubstr("Equations"));
  const auto saved = nlohmann::json::parse(records.folder().read("m.json"));
  EXPECT_EQ(saved, nlohmann::json::parse(records.folder().read("r.json"))["model"]);
  run_well({"sync", model, records.rossler()});
}

TEST(IdentifyCommand, ATimeLimitGivesAWholeAnswerThatSaysWhatItLacks) {
  const Records records;
  const auto limited = run_identify({records.rossler(), "--time-limit", "0.001"});
  EXPECT_EQ(limited["answer_from"], "equations");
  EXPECT_EQ(limited["stages"].back()["why"], "the time limit came first");
  EXPECT_TRUE(limited["sync"].is_null());
  const auto text = run_command({"identify", records.rossler(), "--time-limit", "0.001"});
  EXPECT_THAT(text.out, HasSubstr("left out: "));
  const auto without =
      run_well({"identify", records.rossler(), "--alternatives", "3", "--time-limit", "0.001"});
  EXPECT_THAT(without.out, HasSubstr("alternatives (the time limit came first)"));
  const auto quick = run_identify({records.rossler(), "--effort", "quick"});
  EXPECT_EQ(quick["answer_from"], "synchronisation");
  for (const char* wrong : {"0", "-1", "x", "nan"})
    expect_refused({"identify", records.rossler(), "--time-limit", wrong}, {"--time-limit"});
  expect_refused({"identify", records.rossler(), "--effort", "slow"}, {"--effort"});
}

TEST(IdentifyCommand, SameInputSameBytesWhateverTheThreads) {
  const Records records;
  const auto once = run_command({"identify", records.rossler(), "--json", "-"});
  const auto twice =
      run_command({"identify", records.rossler(), "--json", "-", "--threads", "2"});
  EXPECT_EQ(once.out, twice.out);
}

TEST(IdentifyCommand, ConfigurationComesFromPresetFileAndArguments) {
  const Records records;
  const std::string file = records.folder().write(
      "c.json", R"({"preset": "robust", "regressor": {"type": "stlsq", "threshold": 0.2}})");
  const auto result = run_identify({records.rossler(), "--config", file, "--preset", "sindy",
                                    "--degree", "2", "--set", "regressor.threshold=0.05"});
  EXPECT_EQ(result["pipeline"]["asked"]["preset"], "sindy");
  const auto used = result["pipeline"]["used"];
  EXPECT_EQ(used["filter"]["type"], "none");
  EXPECT_EQ(used["basis"]["max_degree"], 2);
  EXPECT_EQ(used["regressor"]["threshold"], 0.05);
}

TEST(IdentifyCommand, EmbedsAMeasuredQuantity) {
  const Records records;
  const auto result =
      run_identify({records.oscillator(), "--states", "x", "--inputs", "u", "--embed", "x=2",
                    "--terms", "x,x_d1,u", "--set", "differentiator=savitzky-golay"});
  const auto equations = result["model"]["equations"];
  EXPECT_EQ(equations[0]["terms"][0]["term"], "x_d1");
  ASSERT_EQ(equations[1]["state"], "x_d1");
  std::map<std::string, double> found;
  for (const auto& term : equations[1]["terms"])
    found[term["term"].get<std::string>()] = term["coefficient"].get<double>();
  EXPECT_NEAR(found["x"], -4.0, 0.02);
  EXPECT_NEAR(found["u"], 1.0, 0.02);
  EXPECT_LT(result["sync"]["relative"].get<double>(), 0.01);
}

TEST(IdentifyCommand, ADivergingVerificationIsAWarning) {
  const TemporaryFolder folder;
  std::string text = "t,x,dx\n";
  for (int i = 0; i < 30; ++i) {
    const int x = i * i % 11;
    text +=
        std::to_string(i) + "," + std::to_string(x) + "," + std::to_string(x * x * x) + "\n";
  }
  const auto result =
      run_identify({folder.write("d.csv", text), "--states", "x", "--derivatives", "dx"});
  EXPECT_NE(result["sync"]["status"], "completed");
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("synchronisation with the record failed"));
}

std::size_t disputes(const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(" is in dispute: "); at != std::string::npos;
       at = text.find(" is in dispute: ", at + 1))
    ++count;
  return count;
}

/// Records so short and noisy that what is found may depend on where a search begins.
TEST(IdentifyCommand, NamesTermsOnWhichAnotherSearchDisagrees) {
  const TemporaryFolder folder;
  const std::string file = folder.file("short.csv");
  std::size_t all = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    write_csv(file, noisy_record("rossler", 100, 0.2, seed));
    const std::string text =
        unfolded(run_command({"identify", file, "--degree", "2", "--explain"}).out);
    const auto json = run_command({"identify", file, "--degree", "2", "--json", "-"}).out;
    EXPECT_EQ(disputes(text), disputes(nlohmann::json::parse(json)["warnings"].dump()));
    all += disputes(text);
    if (disputes(text) > 0) {
      EXPECT_THAT(text, HasSubstr("the one that another search finds"));
    }
  }
  EXPECT_GT(all, 0u);
}

TEST(IdentifyCommand, NoModelIsStatus1) {
  const Records records;
  const auto result =
      run_command({"identify", records.rossler(), "--set", "regressor=stlsq", "--set",
                   "regressor.threshold=1e6", "--set", "refiner=none", "--json", "-"});
  expect_failure(result, 1, {"no equation was found"});
  EXPECT_FALSE(nlohmann::json::parse(result.out)["warnings"].empty());
}

TEST(IdentifyCommand, SaysWhatTheModelIsWorth) {
  const Records records;
  const auto right = run_identify({records.rossler(), "--degree", "2"});
  EXPECT_EQ(right["verdict"], "fits to noise") << right["validation"].dump(2);
  EXPECT_TRUE(right["validation"]["advice"].empty());
  const auto wrong = run_identify({records.rossler(), "--degree", "1"});
  EXPECT_EQ(wrong["verdict"], "wrong library") << wrong["validation"].dump(2);
  EXPECT_FALSE(wrong["validation"]["advice"].empty());
  EXPECT_THAT(run_command({"identify", records.rossler(), "--degree", "1"}).out,
              HasSubstr("\n\nWrong library"));
}

TEST(IdentifyCommand, JudgesByRecordsThatAreHeldOut) {
  const Records records;
  const std::string other = records.folder().file("other.csv");
  run_well({"simulate", "rossler", "--x0", "-3,2,0.1", "--t-end", "60", "--dt", "0.05", "-o",
            other});
  const auto found = run_identify({records.rossler(), "--degree", "2", "--holdout", other});
  EXPECT_EQ(found["verdict"], "fits to noise") << found["validation"].dump(2);
  EXPECT_EQ(found["validation"]["held_out"], "records");
  EXPECT_EQ(found["validation"]["samples"], 1201);
  EXPECT_THAT(found["validation"]["records"][0].get<std::string>(), HasSubstr("other.csv"));
  // The model does not depend on them.
  EXPECT_EQ(found["model"], run_identify({records.rossler(), "--degree", "2"})["model"]);
  expect_refused(
      {"identify", records.rossler(), "--degree", "2", "--holdout", records.rossler()},
      {"r.csv", "it has the samples of", "leave --holdout out"});
  expect_refused({"identify", records.rossler(), "--holdout", "nowhere.csv"}, {"nowhere.csv"});
  expect_refused({"identify", records.rossler(), "--hidden", "1", "--holdout", other},
                 {"--holdout", "hidden"});
}

TEST(IdentifyCommand, PrintsRelationsThatHoldOnTheData) {
  const Records records;
  const std::string file = records.folder().file("turn.csv");
  const std::string model = records.folder().write("turn.ode", "dx/dt = v\ndv/dt = -4*x\n");
  run_well({"simulate", model, "--x0", "1,0", "--t-end", "20", "--dt", "0.02", "-o", file});
  const auto found = run_identify({file, "--states", "x,v"});
  ASSERT_EQ(found["relations"].size(), 1u);
  EXPECT_EQ(found["relations"][0]["terms"][0]["term"], "x^2");
  EXPECT_EQ(found["relations"][0]["terms"][1]["term"], "v^2");
  EXPECT_NEAR(found["relations"][0]["terms"][1]["coefficient"].get<double>(), 0.25, 1e-3);
  EXPECT_NEAR(found["relations"][0]["value"].get<double>(), 1.0, 1e-3);
}

TEST(IdentifyCommand, BadEmbeddingsAreNamed) {
  const Records records;
  for (const char* bad : {"x", "x=two", "x=1.5", "x=99"})
    expect_refused({"identify", records.oscillator(), "--embed", bad}, {"--embed", bad, "q=2"});
  expect_refused({"identify", records.oscillator(), "--embed", "w=2"}, {"'w'"});
}

/// A folder with an orbit of Henon's map in "henon.csv".
class HenonRecord {
 public:
  HenonRecord() {
    const std::string model =
        folder_.write("truth.ode", "x[n+1] = 1 - 1.4*x^2 + y\ny[n+1] = 0.3*x\n");
    const auto orbit = run_well(
        {"simulate", model, "--x0", "0.1,0.1", "--t-end", "999", "-o", file("henon.csv")});
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  std::string data() const { return file("henon.csv"); }

 private:
  testing::TemporaryFolder folder_;
};

TEST(IdentifyCommand, FindsAMap) {
  const HenonRecord record;
  const auto result =
      run_well({"identify", record.data(), "--discrete", "--model-out",
                record.file("found.json"), "--report", record.file("found.html")});
  EXPECT_THAT(result.out, HasSubstr("x[n+1] = 1 + y - 1.4*x^2\n  y[n+1] = 0.3*x\n"));
  EXPECT_THAT(result.out, HasSubstr("Fits to the noise"));
  for (const char* flow : {"dx/dt", "Synchronisation", "Measurement noise", "Warnings"})
    EXPECT_THAT(result.out, Not(HasSubstr(flow)));
  const auto text = run_command({"model", record.file("found.json")});
  EXPECT_THAT(text.out, HasSubstr("\ny[n+1] = 0."));
  run_well({"simulate", record.file("found.json"), "--x0", "0.1,0.1", "--t-end", "20"});
}

TEST(IdentifyCommand, SaysThatARecordLooksLikeAMap) {
  const HenonRecord record;
  const auto found = run_identify({record.data()});
  EXPECT_THAT(found["warnings"].dump(), HasSubstr("looks like a map"));
  EXPECT_THAT(found["warnings"].dump(), HasSubstr("--discrete"));
  const auto map = run_identify({record.data(), "--discrete"});
  EXPECT_EQ(map["warnings"].size(), 0u);
  EXPECT_EQ(map["model"]["time"], "discrete");
  EXPECT_EQ(map["noise"].size(), 0u);
  EXPECT_EQ(map["verdict"], "fits to noise");
}

TEST(IdentifyCommand, OtherCommandsRefuseMaps) {
  const HenonRecord record;
  const std::string model = record.file("truth.ode");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"diagnose", "--model", model, record.data()},
        {"sync", model, record.data()},
        {"fit", model, record.data()},
        {"compare", model, record.data()},
        {"check", record.data(), "--model", model},
        {"export", model, "--format", "c"}})
    expect_refused(arguments, {"the model is a map", "simulate"});
  for (const char* option : {"--embed", "--hidden"})
    expect_refused({"identify", record.data(), "--discrete", option,
                    option == std::string("--embed") ? "x=2" : "1"},
                   {"--discrete", "no derivatives"});
}

TEST(IdentifyCommand, ReadsInPiecesWhatDoesNotFitIntoTheMemoryItIsGiven) {
  const TemporaryFolder folder;
  const Dataset data = testing::long_oscillation(400000, 97.3);
  write_npy(folder.file("a.npy"), testing::table_of(data));
  const std::vector<std::string> common = {"identify",    folder.file("a.npy"), "--map",
                                           "t=1,x=2,v=3", "--degree",           "1"};
  const auto with = [&](const std::string& memory) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), {"--memory", memory});
    return run_command(arguments);
  };
  const CommandResult pieces = with("16MB"), whole = with("4G");
  EXPECT_EQ(pieces.status, 0) << pieces.err;
  EXPECT_EQ(pieces.out, whole.out);
  EXPECT_THAT(pieces.out, HasSubstr("the terms come from all 400000 samples"));
  EXPECT_THAT(unfolded(pieces.out), HasSubstr("an excerpt of 400000 rows in 1 record\n"));
  EXPECT_THAT(pieces.out, HasSubstr("*v\n  dv/dt = -41.69"));
}

/// Numbers as text, with all their digits.
std::string text_of(const Dataset& data) {
  const Matrix values = testing::table_of(data);
  std::string text = "t [s],x [m],v [m/s]\n";
  for (Index row = 0; row < values.rows(); ++row) {
    for (Index column = 0; column < values.cols(); ++column)
      text += (column > 0 ? "," : "") + format_number(values(row, column));
    text += '\n';
  }
  return text;
}

TEST(IdentifyCommand, TextIsReadInPiecesByWayOfATemporaryFile) {
  const TemporaryFolder folder, temporary;
  const testing::TemporaryFilesIn there(temporary.path());
  const std::string text = text_of(testing::long_oscillation(200000, 97.3, 1e-3));
  folder.write("a.csv", text);
  folder.write("a.csv.gz", gzip(text));
  const auto with = [&](const std::string& name, const std::string& memory) {
    return run_command({"identify", folder.file(name), "--degree", "1", "--memory", memory});
  };
  for (const char* name : {"a.csv", "a.csv.gz"}) {
    const CommandResult pieces = with(name, "16MB"), whole = with(name, "4G");
    EXPECT_EQ(pieces.status, 0) << pieces.err;
    EXPECT_EQ(pieces.out, whole.out) << name;
    EXPECT_THAT(unfolded(pieces.out), HasSubstr("an excerpt of 200000 rows in 1 record\n"));
  }
  EXPECT_EQ(temporary.count(), 0);
  const testing::FileSizeLimit limit(1000000);
  expect_failure(with("a.csv", "16MB"), 2,
                 {temporary.path().string().c_str(), folder.file("a.csv").c_str(),
                  "could be written; set TMPDIR"});
  EXPECT_EQ(temporary.count(), 0);
}

TEST(IdentifyCommand, PiecesHaveLimits) {
  const TemporaryFolder folder;
  write_npy(folder.file("a.npy"), testing::table_of(testing::long_oscillation(400000, 97.3)));
  const auto refused = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"identify", folder.file("a.npy"), "--map", "t=1,x=2,v=3", "--memory", "16MB"});
    return run_command(more).err;
  };
  EXPECT_THAT(refused({"--hold", "u=zero"}), HasSubstr("--memory"));
  EXPECT_THAT(refused({"--set", "formulation=weak"}), HasSubstr("formulation=strong"));
  EXPECT_THAT(refused({"--terms", "delay(x,0.1)"}), HasSubstr("without a past"));
  EXPECT_THAT(refused({"--memory", "3MX"}), HasSubstr("not a size"));
}

TEST(IdentifyCommand, ReportsThatTheRefinerOverridesAChoice) {
  const Records records;
  const std::vector<std::string> chosen{"identify", records.rossler(), "--degree",
                                        "2",        "--set",           "regressor=stlsq"};
  const auto refined = run_command(chosen);
  EXPECT_THAT(testing::unfolded(refined.out),
              HasSubstr("the choice of regressor seldom shows in the model"));
  auto alone = chosen;
  alone.insert(alone.end(), {"--set", "refiner=none"});
  EXPECT_THAT(run_command(alone).out, Not(HasSubstr("seldom shows")));
}

TEST(IdentifyCommand, EveryAddAdds) {
  const HenonRecord record;
  const auto result = run_well({"identify", record.data(), "--discrete", "--degree", "1",
                                "--add", "sin(x),cos(x)", "--add", "x^2", "--json", "-"});
  EXPECT_EQ(nlohmann::json::parse(result.out)["pipeline"]["asked"]["basis"]["include"],
            (std::vector<std::string>{"sin(x)", "cos(x)", "x^2"}));
}

TEST(IdentifyCommand, ExplainsWhichOptionsDecidedNothing) {
  const HenonRecord record;
  const std::vector<std::string> words{"identify", record.data(), "--discrete", "--explain"};
  EXPECT_THAT(run_command(words).out, Not(HasSubstr("Options that decided nothing")));
  std::vector<std::string> more = words;
  more.insert(more.end(), {"--integrator", "dopri5", "--set", "validation.resolution=1e-4",
                           "--set", "basis.max_degree=2"});
  const auto result = run_well(more);
  EXPECT_THAT(result.out, HasSubstr("\nOptions that decided nothing\n  --integrator: the stage "
                                    "`synchronisation` was not reached\n"));
  EXPECT_THAT(result.out, HasSubstr("\n  --set validation.resolution=1e-4: without it the "
                                    "answer is the same\n"));
  EXPECT_THAT(result.out, Not(HasSubstr("max_degree=2: without")));
  EXPECT_THAT(result.out, Not(HasSubstr("validation: ")));
}

}  // namespace
}  // namespace lacuna
