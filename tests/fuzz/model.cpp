// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "fuzz/target.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::fuzz {

std::vector<std::string> seeds() {
  return {R"json({"format": "lacuna.model/1", "time_unit": "s",
      "states": [{"name": "th", "unit": "rad"}, {"name": "w"}],
      "inputs": [{"name": "u", "hold": "zero"}],
      "equations": [{"state": "th", "terms": [{"term": "w", "coefficient": 1.0}]},
        {"state": "w", "terms": [{"term": "sin(th)", "coefficient": -19.62,
          "ci95": [-20, -19], "stderr": 0.1}, {"term": "u", "coefficient": 1}]}]})json",
          R"json({"format":"lacuna.model/1","states":[{"name":"x"}],"equations":[{"state":"x",
      "terms":[]}]})json"};
}

void take(std::string_view input) {
  try {
    const std::string text = format_model(parse_model(input, "input"));
    if (format_model(parse_model(text, "again")) != text) std::abort();
  } catch (const Error&) {
  }
}

}  // namespace lacuna::fuzz
