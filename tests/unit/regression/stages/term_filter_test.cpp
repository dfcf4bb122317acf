// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/term_filter.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "lacuna/core/base/options.hpp"
#include "systems.hpp"

namespace lacuna {
namespace {

struct AnswerOptions {
  static constexpr StageInfo kInfo{"answer", "", ""};
  std::function<FilterResult()> answer = {};
  void describe(OptionVisitor&) {}
};

class Answer final : public Configured<TermFilter, AnswerOptions> {
 public:
  using Configured::Configured;

 private:
  FilterResult do_filter(const LeastSquaresSystem&, const RunContext&) const override {
    return options().answer();
  }
};

FilterResult filtered(FilterResult answer) {
  return Answer{{.answer = [&] { return answer; }}}.filter(small_system());
}

TEST(TermFilter, ColumnsOfZerosAreRemovedWhateverTheMethod) {
  const FilterResult result = filtered({{0, 1, 2}, {}});
  EXPECT_EQ(result.kept, (TermSet{0, 2}));
  ASSERT_EQ(result.removed.size(), 1u);
  EXPECT_EQ(result.removed[0].term, 1);
  EXPECT_EQ(result.removed[0].value, 0.0);
}

TEST(TermFilter, EveryTermMustBeAccountedFor) {
  EXPECT_THROW(filtered({{0, 2}, {}}), ArgumentError);
  EXPECT_THROW(filtered({{0, 1, 2}, {{1, "why", 0.0, 0.0, 1}}}), ArgumentError);
  EXPECT_THROW(filtered({{2, 1, 0}, {}}), ArgumentError);
}

TEST(TermFilter, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  const Answer filter{{.answer = [] { return FilterResult{{0, 1, 2}, {}}; }}};
  EXPECT_THROW(filter.filter(small_system(), {.stop = source.get_token()}), Cancelled);
}

}  // namespace
}  // namespace lacuna
