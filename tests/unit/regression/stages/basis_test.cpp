// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/basis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/options.hpp"

namespace lacuna {
namespace {

struct ListedOptions {
  static constexpr StageInfo kInfo{"listed", "", ""};
  std::vector<std::string> terms = {};
  void describe(OptionVisitor& v) { v.field({"terms", "", ""}, terms); }
};

class Listed final : public Configured<Basis, ListedOptions> {
 public:
  using Configured::Configured;

 private:
  std::vector<Term> do_terms(const Variables& variables) const override {
    std::vector<Term> terms;
    for (const std::string& text : options().terms)
      terms.push_back(Term::parse(text, variables));
    return terms;
  }
};

const Variables kVariables{{"x", "y"}, {}};

TEST(Basis, TermsAreDistinctAndInOrder) {
  const Listed basis{{.terms = {"y", "x*y", "y*x", "y"}}};
  const TermLibrary library = basis.library(kVariables);
  EXPECT_THAT(library.names(), testing::ElementsAre("y", "x*y"));
  EXPECT_EQ(library.variables, kVariables);
}

TEST(Basis, NoTermsAreAnError) {
  try {
    Listed{}.library(kVariables);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.where(), "basis.listed");
  }
}

}  // namespace
}  // namespace lacuna
