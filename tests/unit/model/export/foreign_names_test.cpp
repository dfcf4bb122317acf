// SPDX-License-Identifier: MIT
#include "model/export/foreign_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "model/export/languages.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> called(const std::vector<std::string>& names, const NameRules& rules) {
  const ForeignNames foreign = foreign_names(names, rules);
  std::vector<std::string> found;
  for (const std::string& name : names) found.push_back(foreign.at(name));
  return found;
}

TEST(ForeignNames, LongOnesAreShortAndStayApart) {
  const std::string a = std::string(200, 'a') + "1", b = std::string(200, 'a') + "2";
  EXPECT_THAT(called({a, b}, c_names()),
              ElementsAre(std::string(51, 'a'), std::string(51, 'a') + "_"));
}

TEST(ForeignNames, OfManyThatCollideAreFoundAtOnce) {
  std::vector<std::string> names;
  for (int i = 0; i < 100000; ++i) names.push_back(std::string(80, 'a') + std::to_string(i));
  EXPECT_EQ(foreign_names(names, c_names()).at(names.back()), std::string(51, 'a') + "_99999");
}

/// Whatever the names are: as many, all different, none of them a word, all of the shape.
TEST(ForeignNames, RandomNamesStayApart) {
  Random random(7);
  for (const NameRules* rules :
       {&c_names(), &python_names(), &matlab_names(), &modelica_names(), &spice_names()}) {
    std::vector<std::string> words(rules->words.begin(), rules->words.end());
    for (const char* more :
         {"x", "X", "x_", "x_2", "_", "__", "\xc3\xa9", "lacuna_", "M_", "a b"})
      words.emplace_back(more);
    for (int run = 0; run < 500; ++run) {
      std::set<std::string> names;
      for (std::uint64_t i = random.below(9); i > 0; --i) {
        std::string name = words[random.below(words.size())];
        if (random.below(3) == 0) name += words[random.below(words.size())];
        if (random.below(4) == 0) name += "_";
        if (random.below(4) == 0 && !name.empty())
          name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
        if (random.below(50) == 0) name.append(60, 'q');
        names.insert(name);
      }
      std::set<std::string> seen;
      for (const auto& [name, foreign] :
           foreign_names(std::vector<std::string>(names.begin(), names.end()), *rules)) {
        std::string key = foreign;
        if (rules->case_blind)
          for (char& c : key)
            c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        EXPECT_TRUE(seen.insert(key).second) << foreign;
        EXPECT_FALSE(rules->words.contains(key)) << foreign;
        EXPECT_THAT(foreign, ::testing::MatchesRegex("[a-zA-Z][a-zA-Z0-9_]*"));
        EXPECT_EQ(foreign.find("__"), std::string::npos) << foreign;
        EXPECT_LE(foreign.size(), 63u);
      }
      EXPECT_EQ(seen.size(), names.size());
    }
  }
}

}  // namespace
}  // namespace lacuna
