// SPDX-License-Identifier: MIT
// Identifiers, options, files and folders that pages mention are there.
#include "repository/mentions.hpp"

#include <gtest/gtest.h>

#include <map>

#include "repository/pages.hpp"
#include "repository/word_rules.hpp"

namespace lacuna::repository {
namespace {

const NamesOfTree& tree() {
  static const NamesOfTree names = names_of_tree();
  return names;
}

/// Whether the tree has all names of a span of code on a page of `docs`.
bool is_known(const std::string& span) {
  const std::vector<std::string> names = names_in(span);
  EXPECT_FALSE(names.empty()) << span;
  return std::all_of(names.begin(), names.end(),
                     [](const std::string& name) { return is_known(tree(), name, "docs"); });
}

TEST(Mentions, WhatIsThereIsFound) {
  for (const std::string span :
       {"identify_records()", "DiagnosisOptions::decision", "kOutlyingDeviations",
        "StageInfo x{}", "--time-limit S", "decision.explained_gap", "core/base/check.hpp",
        "solvers/entropic", "diagnosis/limits.md", "tests/hidden/", "lacuna/lacuna.hpp",
        "reweighting.hpp", "examples/0*", "lacuna.fit/1", "Pages.LinksLeadSomewhere",
        "registry.add<FamilyEffect<k>>();"})
    EXPECT_TRUE(is_known(span)) << span;
}

TEST(Mentions, WhatIsMadeUpIsNot) {
  for (const std::string span :
       {"identify_dreams()", "DiagnosisOptions::wishful", "kShareOfDreams", "Stage<DreamBasis>",
        "decision.dreamt_gap", "core/dreams.hpp", "core/base/dreams", "dreams.hpp",
        "tests/dreams/", "Dreams.AreTrue", "x = WishfulThinking(3)", "-DLACUNA_WITH_DREAMS=ON",
        "--dream-limit 3"})
    EXPECT_FALSE(is_known(span)) << span;
}

/// Pages, and where exceptions of each are looked up by its path.
std::vector<SourceFile> mentioning_pages() {
  auto pages = pages_below("docs");
  for (const std::string name : {"README.md", "CONTRIBUTING.md", "bases/README.md",
                                 "solvers/README.md", "effects/README.md", "python/README.md"})
    pages.push_back({name, read_lines(std::filesystem::path(LACUNA_SOURCE_DIR) / name)});
  return pages;
}

/// The one that says that a span is not of this tree; nothing where none does.
const WordException* exception_of(const std::vector<WordException>& exceptions,
                                  const std::string& page, const std::string& span) {
  for (const WordException& one : exceptions)
    if (page.rfind(one.path, 0) == 0 && span.find(one.text) != std::string::npos) return &one;
  return nullptr;
}

TEST(Mentions, OfPagesAreThere) {
  const auto exceptions = word_exceptions(read_lines(
      std::filesystem::path(LACUNA_SOURCE_DIR) / "tests/repository/mentions_exceptions.txt"));
  std::map<const WordException*, int> used;
  std::size_t found = 0;
  for (const SourceFile& page : mentioning_pages()) {
    const std::string folder = page.path.parent_path().string();
    for (const std::string& line : prose_of(page.lines))
      for (const std::string& span : all_matches(line, "`([^`]+)`"))
        for (const std::string& name : names_in(span)) {
          ++found;
          if (is_known(tree(), name, folder)) continue;
          const WordException* meant = exception_of(exceptions, page.path.string(), span);
          if (meant != nullptr) ++used[meant];
          EXPECT_NE(meant, nullptr) << page.path << " mentions `" << name << "` in `" << span
                                    << "`, which is nowhere in the code";
        }
  }
  EXPECT_GT(found, 1500u);
  for (const WordException& one : exceptions)
    EXPECT_GT(used[&one], 0) << "nothing needs the exception " << one.path << " | " << one.text;
}

}  // namespace
}  // namespace lacuna::repository
