// SPDX-License-Identifier: MIT
#include "answers.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

#include "lacuna/cli/commands/cli.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::benchmarks {

Answer identified(const Dataset& data, int degree, const std::filesystem::path& file) {
  write_csv(file.string(), data);
  const std::string path = file.string(), order = std::to_string(degree);
  const std::vector<const char*> arguments{"lacuna",      "identify", path.c_str(), "--degree",
                                           order.c_str(), "--json",   "-"};
  std::ostringstream out, err;
  Answer answer;
  answer.status = run_cli(static_cast<int>(arguments.size()), arguments.data(),
                          default_registry(), {out, err});
  answer.json = out.str();
  answer.error = err.str();
  if (answer.json.empty()) return answer;
  const auto json = nlohmann::json::parse(answer.json);
  answer.model = parse_model(json["model"].dump(), "answer");
  answer.structure = structure_of(*answer.model);
  if (json["verdict"].is_string()) answer.verdict = json["verdict"];
  return answer;
}

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::Same:
      return "same";
    case Outcome::Refused:
      return "refused";
    case Outcome::Doubtful:
      return "doubtful";
    case Outcome::Other:
      break;
  }
  return "other";
}

bool has_structure(const Answer& answer, const Answer& base, const Structure& expected) {
  if (answer.model && base.model && has_shifted_terms(*answer.model))
    return shifted_structure(*answer.model) == shifted_structure(*base.model);
  return answer.structure == expected;
}

Outcome compared(const Answer& answer, const Answer& base, const Structure& expected) {
  if (answer.status != 0) return Outcome::Refused;
  const bool same = has_structure(answer, base, expected);
  if (same && answer.verdict == base.verdict) return Outcome::Same;
  const bool claims = answer.verdict == "fits to noise";
  if (!claims && (!same || base.verdict == "fits to noise")) return Outcome::Doubtful;
  return Outcome::Other;
}

}  // namespace lacuna::benchmarks
