// SPDX-License-Identifier: MIT
#include "lacuna/forms/candidate/effect.hpp"

#include "contract/contract.hpp"
#include "contract/effect_systems.hpp"
#include "diagnose/candidates/screening.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna::contract {
namespace {

class EveryEffect : public testing::TestWithParam<StageVariant> {
 protected:
  Stage<Effect> effect() const { return stage_of<Effect>(GetParam()); }

  /// Calls `visit(scope, candidate)` for all that the effect proposes in effect_systems().
  template <class Visit>
  void for_all(Visit visit) const {
    for (const EffectSystem& system : effect_systems()) {
      const Scope scope = system.scope();
      for (Index k = 0; k < scope.model.dimension(); ++k)
        for (const Candidate& candidate : effect()->candidates(scope, k))
          visit(scope, candidate);
    }
  }
};

TEST_P(EveryEffect, SaysWhereItComesFrom) { EXPECT_GT(effect()->typical_cause().size(), 5u); }

TEST_P(EveryEffect, ProposesSomethingSomewhere) {
  int count = 0;
  for_all([&](const Scope&, const Candidate& candidate) {
    ++count;
    EXPECT_EQ(candidate.families, std::vector<std::string>{std::string(effect()->info().name)});
  });
  EXPECT_GT(count, 0);
}

TEST_P(EveryEffect, FormsReadBackAsTheyArePrinted) {
  for_all([](const Scope&, const Candidate& candidate) {
    EXPECT_EQ(parse_expression(candidate.form.to_string()), candidate.form);
    EXPECT_EQ(parse_expression(candidate.argument.to_string()), candidate.argument);
    for (const MemoryState& memory : candidate.memory) {
      EXPECT_EQ(parse_expression(memory.rate.to_string()), memory.rate);
      EXPECT_EQ(parse_expression(memory.start.to_string()), memory.start);
    }
  });
}

TEST_P(EveryEffect, FormsAreDistinct) {
  for (const EffectSystem& system : effect_systems()) {
    const Scope scope = system.scope();
    for (Index k = 0; k < scope.model.dimension(); ++k) {
      const std::vector<Candidate> all = effect()->candidates(scope, k);
      EXPECT_EQ(merged(all).size(), all.size()) << scope.state(k).name;
    }
  }
}

TEST_P(EveryEffect, StartsLieInTheirRanges) {
  for_all([](const Scope&, const Candidate& candidate) {
    ASSERT_FALSE(candidate.starts.empty());
    EXPECT_LE(candidate.least, candidate.most);
    for (const Vector& start : candidate.starts)
      for (Index i = 0; i < start.size(); ++i) {
        EXPECT_GE(start[i], candidate.shapes[static_cast<std::size_t>(i)].low);
        EXPECT_LE(start[i], candidate.shapes[static_cast<std::size_t>(i)].high);
      }
  });
}

TEST_P(EveryEffect, NamesWhatItProposes) {
  bool named = false;
  for_all([&](const Scope& scope, const Candidate& candidate) {
    for (const double sign : {-1.0, 1.0})
      for (const Vector& start : candidate.starts) {
        const auto reading =
            reading_at(*effect(), scope, candidate, start, sign * size_of(scope, candidate));
        if (!reading) continue;
        named = true;
        EXPECT_GT(reading->sentence.size(), 5u);
        EXPECT_TRUE(reading->parameters.empty() ||
                    reading->parameters.size() == candidate.shapes.size());
      }
  });
  EXPECT_TRUE(named);
}

TEST_P(EveryEffect, NamesFormsWhoeverProposedThem) {
  for_all([&](const Scope& scope, Candidate candidate) {
    const Vector start = candidate.starts.front();
    const double size = size_of(scope, candidate);
    const bool own = reading_at(*effect(), scope, candidate, start, size).has_value();
    candidate.families = {"somebody"};
    EXPECT_EQ(reading_at(*effect(), scope, candidate, start, size).has_value(), own)
        << candidate.form.to_string();
  });
}

TEST_P(EveryEffect, HasNoNameForAFormThatNobodyKnows) {
  Candidate odd;
  odd.form = parse_expression("atan(q-exp(sin(v)))");
  odd.argument = Expression::variable("q");
  odd.equation = 1;
  const Scope scope = effect_systems().front().scope();
  for (const double sign : {-1.0, 1.0})
    EXPECT_FALSE(reading_at(*effect(), scope, odd, Vector(0), sign));
}

TEST_P(EveryEffect, SearchKeepsTheBounds) {
  const Dataset data = support::hidden_record(support::dry_friction, 0.01);
  const Assimilation fit = support::assimilated(data);
  const Scope scope = make_scope(support::oscillator(), data, Vector::Constant(2, 0.01));
  const Screening screening(fit);
  for (const Candidate& candidate : effect()->candidates(scope, 1)) {
    if (candidate.is_driven()) continue;
    ScreenedCandidate found = screening.at_starts(candidate);
    screening.polish(found);
    EXPECT_GE(found.coefficient, candidate.least);
    EXPECT_LE(found.coefficient, candidate.most);
    for (std::size_t i = 0; i < candidate.shapes.size(); ++i) {
      EXPECT_GE(found.shapes[static_cast<Index>(i)], candidate.shapes[i].low);
      EXPECT_LE(found.shapes[static_cast<Index>(i)], candidate.shapes[i].high);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryEffect, testing::ValuesIn(available(Effect::kKind)),
                         test_name);

}  // namespace
}  // namespace lacuna::contract
