// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "folded_text.hpp"
#include "lacuna/report/reports.hpp"

namespace lacuna {
namespace {

using Json = nlohmann::ordered_json;

std::string adequacy_text(const FitRival& rival) {
  if (!rival.converged) return "did not converge";
  switch (rival.fits) {
    case Adequate::Yes:
      return "residuals are noise";
    case Adequate::No:
      return "residuals have structure";
    case Adequate::Undetermined:
      break;
  }
  return "residuals not distinguished from noise";
}

/// Those that the records do not distinguish from the best, which is the first of them.
std::vector<std::string> tied_names(const RivalComparison& comparison) {
  std::vector<std::string> tied;
  for (const FitRival& rival : comparison.rivals)
    if (rival.is_tied) tied.push_back(rival.name);
  return tied;
}

/// What the table says, in a sentence.
std::string verdict_of(const RivalComparison& comparison) {
  const std::vector<std::string> tied = tied_names(comparison);
  const std::string best = comparison.rivals.front().name;
  std::string verdict = tied.size() == 1
                            ? best + " meets the records better than all others."
                            : "The records do not distinguish these: " + join(tied, ", ") + ".";
  if (comparison.rivals.front().fits == Adequate::No)
    verdict += " None is adequate: the residuals of " + best + " have structure.";
  return verdict;
}

}  // namespace

std::string format_text(const RivalComparison& comparison) {
  const bool held_out = comparison.rivals.front().held_out.has_value();
  const bool any_tied = tied_names(comparison).size() > 1;
  std::vector<std::vector<std::string>> rows{
      {"model", "unknowns", "log-likelihood", "AICc", "BIC", "behind (sigma)"}};
  if (held_out) rows.front().push_back("held-out gap");
  rows.front().push_back("");
  for (const FitRival& rival : comparison.rivals) {
    std::vector<std::string> row{rival.name,
                                 format_number(rival.unknowns),
                                 format_number(rival.log_likelihood, 6),
                                 format_number(rival.aicc, 6),
                                 format_number(rival.bic, 6),
                                 format_number(rival.behind, 3)};
    if (held_out)
      row.push_back(rival.held_out ? format_number(*rival.held_out, 3) : std::string("-"));
    row.push_back(adequacy_text(rival) + (any_tied && rival.is_tied ? ", tied" : ""));
    rows.push_back(std::move(row));
  }
  std::string notes;
  for (const std::string& note : comparison.notes) notes += "Note: " + note + ".\n";
  return verdict_of(comparison) + "\n\n" + text_table(rows) + "\n" +
         format_number(comparison.values) +
         " values. behind: Vuong's test against the first. tied: AICc within 2, or less than "
         "1.96 sigma behind.\n" +
         notes;
}

std::string format_json(const RivalComparison& comparison) {
  const auto number = [](double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
  };
  Json json{{"format", "lacuna.rivals/1"},
            {"values", comparison.values},
            {"verdict", verdict_of(comparison)},
            {"rivals", Json::array()},
            {"notes", comparison.notes}};
  for (const FitRival& rival : comparison.rivals)
    json["rivals"].push_back(
        {{"model", rival.name},
         {"unknowns", rival.unknowns},
         {"log_likelihood", number(rival.log_likelihood)},
         {"aicc", number(rival.aicc)},
         {"bic", number(rival.bic)},
         {"held_out_gap", rival.held_out ? number(*rival.held_out) : Json(nullptr)},
         {"adequacy", to_string(rival.fits)},
         {"converged", rival.converged},
         {"behind_sigma", number(rival.behind)},
         {"tied", rival.is_tied}});
  return json_lines(json);
}

}  // namespace lacuna
