// SPDX-License-Identifier: MIT
// Two effects for tests of the search: one that is right for dry friction, one that is not.
#pragma once

#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna::support {

inline constexpr StageInfo kDry{"dry", "Dry friction for tests", ""};
inline constexpr StageInfo kCubic{"cubic", "Cubes for tests", ""};

template <const StageInfo& Info>
class FormEffect final : public Configured<Effect, EffectOptions<Info>> {
 public:
  explicit FormEffect(std::string form) : form_(std::move(form)) {}

 private:
  std::string_view do_typical_cause() const override { return "a test"; }
  std::vector<Candidate> do_candidates(const Scope&, Index) const override {
    Candidate candidate;
    candidate.form = candidate.argument = parse_expression(form_);
    return {candidate};
  }
  std::string form_;
};

inline std::vector<Stage<Effect>> own_effects() {
  return {FormEffect<kDry>("sign(v)"), FormEffect<kCubic>("q^3")};
}

}  // namespace lacuna::support
