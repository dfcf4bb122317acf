// SPDX-License-Identifier: MIT
// Who may include whom: the layers of docs/architecture.md, read from the #include lines.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "repository/source_tree.hpp"

namespace lacuna::repository {
namespace {

using Allowed = std::map<std::string, std::set<std::string>>;

const std::set<std::string> kConcrete = {"formulations", "differentiators", "bases",
                                         "filters",      "solvers",         "pruners"};

/// Folders each folder may include, besides itself.
Allowed allowed_includes() {
  Allowed allowed;
  allowed["core"] = {};
  allowed["numerics"] = {"core"};
  allowed["data"] = {"core", "numerics"};
  allowed["model"] = {"core", "numerics", "data"};
  allowed["linear"] = {"core", "numerics", "data", "model"};
  allowed["streams"] = {"core", "data"};
  allowed["stages"] = {"core", "numerics", "data", "model", "linear", "streams"};
  allowed["records"] = {"core", "numerics", "data", "model", "stages"};
  for (const std::string& folder : kConcrete)
    allowed[folder] = {"core", "numerics", "data", "model", "linear", "streams", "stages"};
  allowed["formulations"].insert("records");
  allowed["selection"] = allowed["formulations"];
  allowed["selection"].insert({"records", "formulations", "flow", "shooting", "relations"});
  allowed["relations"] = {"core", "numerics", "data", "model"};
  allowed["pipeline"] = {"core",    "numerics", "data",   "model",
                         "streams", "linear",   "stages", "relations"};
  allowed["pipeline"].insert(kConcrete.begin(), kConcrete.end());
  allowed["pipeline"].insert("selection");
  allowed["dynamics"] = {"core", "numerics", "data", "model", "records"};
  allowed["systems"] = {"core", "numerics", "data", "model", "dynamics"};
  allowed["attractor"] = {"core", "numerics", "data", "model", "records", "dynamics"};
  allowed["flow"] = {"core", "numerics", "data", "model", "dynamics"};
  allowed["shooting"] = {"core",   "numerics", "data",     "model",
                         "linear", "records",  "dynamics", "flow"};
  allowed["fitting"] = {"core",    "numerics", "data", "model",   "linear",
                        "records", "dynamics", "flow", "shooting"};
  allowed["estimation"] = {"core", "numerics", "data", "model", "records", "flow"};
  allowed["candidates"] = {"core", "numerics", "data", "model", "estimation"};
  allowed["effects"] = {"core", "data", "model", "candidates"};
  allowed["decision"] = {"core",    "numerics",   "data",      "model",
                         "records", "estimation", "candidates"};
  allowed["hypotheses"] = {"core",    "bases",      "numerics",   "data",     "model",
                           "records", "estimation", "candidates", "shooting", "decision"};
  allowed["diagnosis"] = {"core",       "numerics",   "data",     "model",     "records",
                          "estimation", "candidates", "decision", "hypotheses"};
  allowed["libraries"] = allowed["pipeline"];
  allowed["libraries"].insert({"pipeline", "candidates", "effects", "shooting"});
  allowed["validation"] = allowed["libraries"];
  allowed["validation"].insert({"libraries", "records", "flow", "estimation"});
  allowed["realisation"] = allowed["pipeline"];
  allowed["realisation"].insert({"pipeline", "records", "shooting"});
  allowed["plot"] = {"core"};
  allowed["report"] = allowed["pipeline"];
  allowed["report"].insert({"pipeline", "dynamics", "shooting", "fitting", "estimation",
                            "candidates", "decision", "hypotheses", "diagnosis", "records",
                            "flow", "attractor", "plot"});
  allowed["config"] = allowed["report"];
  allowed["config"].insert({"report", "effects", "libraries", "relations", "validation"});
  allowed["codegen"] = {"core", "model"};
  allowed["cli"] = allowed["config"];
  allowed["cli"].insert(
      {"codegen", "config", "realisation", "records", "systems", "attractor"});
  return allowed;
}

/// The header of all that most programs need, which belongs to no layer.
const std::filesystem::path kUmbrella = "include/lacuna/lacuna.hpp";

/// "linear/factor" from `#include "lacuna/linear/factor.hpp"`, and from "linear/factor.hpp"
/// where src/ has that header; empty for other lines.
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

TEST(LayerReader, FindsInstalledAndPrivateHeaders) {
  EXPECT_EQ(included_header("#include \"lacuna/linear/factor.hpp\""), "linear/factor");
  EXPECT_EQ(included_header("#include \"model/operations.hpp\"  // why"), "model/operations");
  EXPECT_EQ(included_header("#include \"operations.hpp\""), "");
  EXPECT_EQ(included_header("#include <nlohmann/json.hpp>"), "");
  EXPECT_EQ(included_header("  const auto x = \"lacuna/linear/factor.hpp\";"), "");
}

const std::vector<std::string> kFolders = {"include", "src", "bases", "solvers", "effects"};

TEST(Layers, IncludesPointDownwards) {
  const Allowed allowed = allowed_includes();
  for (const SourceFile& file : sources_below(kFolders)) {
    if (file.path == kUmbrella) continue;
    const std::string folder = layer_of(file.path);
    ASSERT_TRUE(allowed.contains(folder)) << file.path << " lies in no known layer";
    for (const std::string& line : file.lines) {
      const std::string header = included_header(line);
      if (header.empty()) continue;
      const std::string other = header.substr(0, header.find('/'));
      EXPECT_TRUE(other == folder || allowed.at(folder).contains(other))
          << file.path << " must not include " << header;
    }
  }
}

TEST(Layers, PipelineReachesConcreteStagesOnlyInPresets) {
  for (const SourceFile& file : sources_below(kFolders)) {
    if (layer_of(file.path) != "pipeline" || file.path.stem() == "presets") continue;
    for (const std::string& line : file.lines) {
      const std::string header = included_header(line);
      EXPECT_FALSE(kConcrete.contains(header.substr(0, header.find('/'))))
          << file.path << ": " << line;
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
  for (const SourceFile& file : sources_below("include")) {
    if (!kConcrete.contains(layer_of(file.path))) continue;
    for (const std::string& line : file.lines)
      if (line.find("public Configured<") != std::string::npos)
        stage_headers.insert(header_of(file.path));
  }
  ASSERT_FALSE(stage_headers.empty());
  for (const SourceFile& file : sources_below(kFolders)) {
    const std::string folder = layer_of(file.path);
    if (!kConcrete.contains(folder)) continue;
    for (const std::string& line : file.lines) {
      const std::string header = included_header(line);
      if (!stage_headers.contains(header)) continue;
      std::string own = header_of(file.path);
      if (const auto absent = own.find("no_"); absent != std::string::npos)
        own.erase(absent, 3);
      EXPECT_EQ(header, own) << file.path;
    }
  }
}

TEST(Layers, PublicHeadersNeedOnlyEigenAndTheStandardLibrary) {
  const std::set<std::string> banned = {"<nlohmann", "<CLI",  "<ceres",
                                        "<nlopt",    "<zlib", "<fmt"};
  for (const SourceFile& file : sources_below("include"))
    for (const std::string& line : file.lines)
      for (const std::string& name : banned)
        EXPECT_EQ(line.find("#include " + name), std::string::npos)
            << file.path << ": " << line;
}

}  // namespace
}  // namespace lacuna::repository
