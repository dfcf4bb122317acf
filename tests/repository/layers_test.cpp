// SPDX-License-Identifier: MIT
// Who may include whom: the layers of docs/architecture.md, read from the #include lines.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

/// The wings from the ground up: each may include itself and what lies on floors below it.
const std::vector<std::set<std::string>> kFloors = {{"core"},
                                                    {"data"},
                                                    {"model"},
                                                    {"records"},
                                                    {"dynamics", "regression", "forms"},
                                                    {"trajectories"},
                                                    {"identify", "diagnose"},
                                                    {"report"},
                                                    {"cli"}};

/// The floor of a wing. @throws std::out_of_range where there is none of that name
std::size_t floor_of(const std::string& wing) {
  for (std::size_t floor = 0; floor < kFloors.size(); ++floor)
    if (kFloors[floor].contains(wing)) return floor;
  throw std::out_of_range(wing + " is no wing");
}

bool may_include(const std::string& wing, const std::string& other) {
  return wing == other || floor_of(other) < floor_of(wing);
}

/// Folders of concrete stages, which know nothing of each other.
const std::set<std::string> kConcrete = {
    "regression/formulations", "data/derivatives", "bases",
    "regression/filters",      "solvers",          "regression/pruners"};

/// Whether a header stands above all wings or below them: lacuna/lacuna.hpp, version.hpp.
bool has_no_wing(const std::string& header) { return header.find('/') == std::string::npos; }

/// "linear/factor" from `#include "lacuna/regression/linear/least_squares_system.hpp"`, and
/// from "linear/factor.hpp" where src/ has that header; empty for other lines.
std::string included_header(const std::string& line) {
  const std::string start = "#include \"", installed = "lacuna/", end = ".hpp";
  if (line.rfind(start, 0) != 0 || line.rfind(end) == std::string::npos) return "";
  const std::string header =
      line.substr(start.size(), line.rfind(end) + end.size() - start.size());
  const std::string name = header.substr(0, header.size() - end.size());
  if (name.rfind(installed, 0) == 0) return name.substr(installed.size());
  const std::filesystem::path source = LACUNA_SOURCE_DIR;
  return name.find('/') != std::string::npos && std::filesystem::exists(source / "src" / header)
             ? name
             : "";
}

const std::vector<std::string> kFolders = {"include", "src", "bases", "solvers", "effects"};

TEST(Layers, IncludesPointDownwards) {
  std::size_t edges = 0;
  ASSERT_FALSE(sources_below(kFolders).empty());
  for (const SourceFile& file : sources_below(kFolders)) {
    if (file.path.parent_path() == "include/lacuna") continue;
    for (const std::string& line : file.lines) {
      const std::string header = included_header(line);
      if (header.empty() || has_no_wing(header)) continue;
      ++edges;
      EXPECT_TRUE(may_include(wing_of(file.path), wing_of("src/" + header)))
          << file.path << " must not include " << header;
    }
  }
  EXPECT_GT(edges, 1000u);
}

TEST(Layers, WhatPointsUpOrBetweenTheJourneysIsFound) {
  EXPECT_TRUE(may_include("report", "diagnose"));
  EXPECT_FALSE(may_include("data", "model"));
  EXPECT_FALSE(may_include("identify", "diagnose"));
  EXPECT_FALSE(may_include("diagnose", "identify"));
  EXPECT_FALSE(may_include("forms", "regression"));
  EXPECT_EQ(wing_of("solvers/l1/l1_ceres.cpp"), "regression");
  EXPECT_EQ(wing_of("include/lacuna/effects/forms.hpp"), "forms");
}

/// Pairs of folders of which each includes the other, until they are one or a third lies below.
const std::set<std::pair<std::string, std::string>> kCirclesLeft = {
    {"core/base", "core/numerics"},
    {"data/formats", "data/logs"},
    {"data/records", "data/times"},
    {"data/records", "data/units"},
    {"diagnose/hypotheses", "diagnose/journey"},
    {"diagnose/hypotheses", "diagnose/search"},
    {"records/binding", "records/channels"},
    {"report/pages", "report/plot"},
    {"trajectories/refiners", "trajectories/subset_selection"}};

/// The pairs of folders that include each other, each in alphabetical order. `edges` has for a
/// folder those that it includes.
std::set<std::pair<std::string, std::string>> circles_in(
    const std::map<std::string, std::set<std::string>>& edges) {
  std::set<std::pair<std::string, std::string>> circles;
  for (const auto& [folder, included] : edges)
    for (const std::string& other : included) {
      const auto back = edges.find(other);
      if (folder < other && back != edges.end() && back->second.contains(folder))
        circles.emplace(folder, other);
    }
  return circles;
}

TEST(Circles, NoTwoFoldersIncludeEachOther) {
  std::map<std::string, std::set<std::string>> edges;
  for (const SourceFile& file : sources_below(kFolders)) {
    if (file.path.parent_path() == "include/lacuna") continue;
    const std::string folder = folder_of(file.path);
    for (const std::string& line : file.lines) {
      const std::string header = included_header(line);
      if (header.empty() || has_no_wing(header)) continue;
      const std::string other = folder_of("src/" + header);
      if (other != folder) edges[folder].insert(other);
    }
  }
  ASSERT_FALSE(edges.empty());
  EXPECT_EQ(circles_in(edges), kCirclesLeft);
}

TEST(Layers, PipelineReachesConcreteStagesOnlyInPresets) {
  ASSERT_FALSE(sources_below(kFolders).empty());
  for (const SourceFile& file : sources_below(kFolders)) {
    if (folder_of(file.path) != "identify/pipeline" || file.path.stem() == "presets") continue;
    for (const std::string& line : file.lines) {
      const std::string header = included_header(line);
      if (header.empty() || header == "data/derivatives/differentiator") continue;
      EXPECT_FALSE(kConcrete.contains(folder_of("src/" + header))) << file.path << ": " << line;
    }
  }
}

/// "solvers/l1/l1_ceres" of include/lacuna/solvers/l1/l1_ceres.hpp and solvers/l1/l1_ceres.cpp.
std::string header_of(std::filesystem::path path) {
  path.replace_extension();
  if (path.begin()->string() == "include") path = path.lexically_relative("include/lacuna");
  if (path.begin()->string() == "src") path = path.lexically_relative("src");
  return path.string();
}

TEST(Layers, NoConcreteStageIncludesAnother) {
  std::set<std::string> stage_headers;
  for (const SourceFile& file : sources_below(kFolders)) {
    if (!kConcrete.contains(folder_of(file.path)) || file.path.extension() != ".hpp") continue;
    for (const std::string& line : file.lines)
      if (line.find("public Configured<") != std::string::npos)
        stage_headers.insert(header_of(file.path));
  }
  ASSERT_FALSE(stage_headers.empty());
  for (const SourceFile& file : sources_below(kFolders)) {
    if (!kConcrete.contains(folder_of(file.path))) continue;
    for (const std::string& line : file.lines) {
      const std::string header = included_header(line);
      if (!stage_headers.contains(header)) continue;
      std::string own = header_of(file.path);
      if (own == "data/derivatives/automatic_differentiator") continue;  // chooses among them
      if (const auto absent = own.find("no_"); absent != std::string::npos)
        own.erase(absent, 3);
      EXPECT_EQ(header, own) << file.path;
    }
  }
}

/// What a public header includes: "lacuna/version.hpp" of `#include "lacuna/version.hpp"`.
std::set<std::string> included_by(const SourceFile& file) {
  const std::string start = "#include \"";
  std::set<std::string> headers;
  for (const std::string& line : file.lines)
    if (line.rfind(start, 0) == 0)
      headers.insert(line.substr(start.size(), line.rfind('"') - start.size()));
  return headers;
}

TEST(PublicHeaders, IncludePublicOnesOnly) {
  const std::filesystem::path root = LACUNA_SOURCE_DIR;
  std::size_t found = 0;
  for (const SourceFile& file : sources_below("include"))
    for (const std::string& header : included_by(file)) {
      ++found;
      EXPECT_TRUE(std::filesystem::exists(root / "include" / header))
          << file.path << " includes " << header;
    }
  EXPECT_GT(found, 200u);
}

TEST(PublicHeaders, AreAllInTheOneHeader) {
  const std::filesystem::path root = std::filesystem::path(LACUNA_SOURCE_DIR) / "include";
  // What needs GoogleTest is included by tests alone.
  std::set<std::string> known = {"lacuna/lacuna.hpp", "lacuna/testing.hpp"};
  for (std::vector<std::string> next = {"lacuna/lacuna.hpp"}; !next.empty();) {
    const SourceFile file{next.back(), read_lines(root / next.back())};
    next.pop_back();
    for (const std::string& header : included_by(file))
      if (known.insert(header).second) next.push_back(header);
  }
  ASSERT_FALSE(sources_below("include").empty());
  for (const SourceFile& file : sources_below("include"))
    EXPECT_TRUE(known.contains(file.path.lexically_relative("include").string()))
        << "lacuna/lacuna.hpp does not lead to " << file.path;
}

TEST(PublicHeaders, WhatMakesStagesIsInTheHeaderOfStages) {
  const std::filesystem::path root = std::filesystem::path(LACUNA_SOURCE_DIR) / "include";
  const auto stages = included_by({"", read_lines(root / "lacuna/stages.hpp")});
  std::size_t found = 0;
  for (const SourceFile& file : sources_below("include"))
    for (const std::string& line : file.lines) {
      // An effect that is a value is made by a template; thresholds are shown as a part.
      const std::string folder = folder_of(file.path);
      EXPECT_FALSE(line.rfind("class ", 0) == 0 && folder != "diagnose/criterion" &&
                   folder != "effects" && line.find("public Configured<") != std::string::npos)
          << file.path << " shows a stage's class: " << line;
      if (line.rfind("Stage<", 0) != 0 || line.find("Options& options") == std::string::npos)
        continue;
      ++found;
      EXPECT_TRUE(stages.contains(file.path.lexically_relative("include").string()))
          << file.path;
    }
  EXPECT_GT(found, 50u);
}

TEST(PublicHeaders, SayTheVersionOfTheProject) {
  const std::filesystem::path root = LACUNA_SOURCE_DIR;
  std::string version;
  for (const std::string& line : read_lines(root / "CMakeLists.txt"))
    if (const auto at = line.find("project(lacuna VERSION "); at == 0)
      version = line.substr(23, line.find(' ', 23) - 23);
  ASSERT_FALSE(version.empty());
  int said = 0;
  for (const std::string& line : read_lines(root / "include/lacuna/version.hpp"))
    said += line.find("kVersion = \"" + version + "\"") != std::string::npos;
  EXPECT_EQ(said, 1) << version;
}

TEST(Layers, PublicHeadersNeedOnlyEigenAndTheStandardLibrary) {
  const std::set<std::string> banned = {"<nlohmann", "<CLI",  "<ceres",
                                        "<nlopt",    "<zlib", "<fmt"};
  ASSERT_FALSE(sources_below("include").empty());
  for (const SourceFile& file : sources_below("include"))
    for (const std::string& line : file.lines)
      for (const std::string& name : banned)
        EXPECT_EQ(line.find("#include " + name), std::string::npos)
            << file.path << ": " << line;
}

}  // namespace
}  // namespace lacuna::repository
