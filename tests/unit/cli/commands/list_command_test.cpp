// SPDX-License-Identifier: MIT
#include "unit/cli/commands/records.hpp"

namespace lacuna {
namespace {

using testing::expect_failure;
using ::testing::HasSubstr;
using testing::run_command;

TEST(ListCommand, ShowsEveryPart) {
  const std::string shown = run_command({"list"}).out;
  EXPECT_LE(std::count(shown.begin(), shown.end(), '\n'), 40) << shown;
  const std::string out = testing::unfolded(shown);
  const Registry registry = default_registry();
  for (const RegistryEntry& entry : registry.entries())
    EXPECT_THAT(out, ::testing::ContainsRegex(" " + std::string(entry.info.name) + "[,\n]"));
  for (const char* name : {"algorithm1", "robust", "sindy", "lorenz", "tl072"})
    EXPECT_THAT(out, ::testing::ContainsRegex(" " + std::string(name) + "[,\n]"));
  std::map<std::string, int> counts{{"preset", 4}};
  for (const RegistryEntry& entry : registry.entries())
    if (entry.kind != entry.info.name) ++counts[std::string(entry.kind)];  // no set of options
  for (const auto& [kind, count] : counts)
    EXPECT_THAT(out, HasSubstr(kind + " (" + std::to_string(count) + "): "));
  EXPECT_THAT(out, ::testing::ContainsRegex("\nSets of options: .*decision"));
}

TEST(ListCommand, ShowsOneKind) {
  const std::string out = run_command({"list", "pruner"}).out;
  EXPECT_THAT(out, HasSubstr("minor-terms"));
  EXPECT_EQ(out.find("stlsq"), std::string::npos);
  EXPECT_THAT(run_command({"list", "system"}).out, HasSubstr("rossler"));
}

TEST(ListCommand, UnknownKindsAreNamed) {
  expect_failure(run_command({"list", "prunner"}), 2, {"list prunner", "pruner"});
}

}  // namespace
}  // namespace lacuna
