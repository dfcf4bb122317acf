// SPDX-License-Identifier: MIT
#include "lacuna/cli/configuration/configuration.hpp"

#include "fuzz/target.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::fuzz {

std::vector<std::string> seeds() {
  return {R"({"preset": "algorithm1", "basis": {"type": "monomials", "max_degree": 3}})",
          R"({"regressor": {"type": "irls-l1", "inner": {"type": "ceres"}, "alpha": 0.1}})",
          R"({"formulation": {"type": "strong", "differentiator": "savitzky-golay"},
      "filter": "none", "pruner": {"type": "minor-terms", "eta": null}, "tolerances": "paper"})",
          "regressor.threshold=0.05", "basis.include=[\"sin(x)\"]"};
}

void take(std::string_view input) {
  static const Registry registry = default_registry();
  for (const bool whole : {true, false}) {
    try {
      Configuration configuration;
      if (whole)
        configuration.merge_text(input, "input");
      else
        configuration.set(input);
      configuration.build(registry);
    } catch (const Error&) {
    }
  }
}

}  // namespace lacuna::fuzz
