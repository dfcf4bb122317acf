// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <string>
#include <unordered_map>

#include "lacuna/core/base/types.hpp"
#include "lacuna/diagnose/candidates/explanation.hpp"

namespace lacuna {

/// All that decides what fit_key() stands for, to the bit: the task but for its context, where
/// the fit starts, and the effects.
/// @param kind of fit: "rough".
std::string fit_key(const std::string& kind, const JointFitTask& task,
                    const Assimilation& start, const std::vector<FittedEffect>& effects);

/// Explanations by the keys of their fits. Searches that leave out one form or another begin
/// with much the same fits; a fit is a function of its key, so that it need not be done again.
/// As many are kept as there is room for, the first ones, where that is a good part of a search
/// (a copy of very large ones costs more than it saves). Several threads may ask at a time.
class FitMemory {
 public:
  /// A fact of the machines: 512 MB.
  static constexpr Index kMostNumbers = Index{1} << 26;

  /// A fact of searches: what two rounds fit.
  static constexpr Index kFewest = 32;

  /// @param most numbers that are kept.
  explicit FitMemory(Index most = kMostNumbers) : most_(most) {}

  /// The explanation with this key, or else that of `fit`, which is kept.
  Explanation explanation(const std::string& key, FunctionRef<Explanation()> fit);

 private:
  const Index most_;
  std::mutex guard_;
  std::unordered_map<std::string, Explanation> kept_;
  Index numbers_ = 0;
};

}  // namespace lacuna
