// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "folded_text.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/model/equations/rounding.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/report/reports.hpp"
#include "report/json/adequacy_json.hpp"
#include "report/json/bands_json.hpp"
#include "report/json/stages_json.hpp"

namespace lacuna {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no way to write what is not finite.
Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class Value>
Json optional_json(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json numbers_or_null(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number_json(value));
  return list;
}

/// How a number varies over the records.
Json spread_json(const FittedSpread& spread) {
  Json json{{"law", spread.by_factor ? "lognormal" : "normal"},
            {"start", spread.start},
            {"value", number_json(spread.value)},
            {"stderr", optional_json(spread.standard_error)},
            {"ci95", optional_json(spread.ci95)}};
  if (spread.at_most) json["at_most"] = number_json(*spread.at_most);
  if (spread.value == 0.0) json["bound"] = "min";
  json["shrinkage"] = number_json(spread.shrinkage);
  return json;
}

Json population_json(const Fit& fit) {
  const FitPopulation& population = *fit.population;
  Json records = Json::array(), deviations = Json::array();
  for (std::size_t r = 0; r < population.log_likelihood.size(); ++r)
    records.push_back({{"record", fit.records[r]},
                       {"log_likelihood", number_json(population.log_likelihood[r])}});
  for (std::size_t c = 0; c < population.deviations.size(); ++c)
    deviations.push_back({{"channel", fit.quality[c].channel},
                          {"deviation", number_json(population.deviations[c])}});
  return {{"method", "Laplace"},
          {"unknowns", population.unknowns},
          {"aicc", number_json(population.aicc)},
          {"bic", number_json(population.bic)},
          {"noise", std::move(deviations)},
          {"records", std::move(records)}};
}

Json numbers_json(const Fit& fit) {
  Json list = Json::array();
  for (const FittedParameter& number : fit.numbers) {
    Json entry{{"name", number.name},
               {"unit", number.unit},
               {"start", number.start},
               {"value", number_json(number.value)},
               {"stderr", optional_json(number.standard_error)},
               {"ci95", optional_json(number.ci95)}};
    if (number.at_least) entry["at_least"] = number_json(*number.at_least);
    if (number.at_most) entry["at_most"] = number_json(*number.at_most);
    if (number.bound) entry["bound"] = *number.bound;
    if (!number.per_record.empty()) {
      entry["per_record"] = numbers_or_null(number.per_record);
      entry["per_record_stderr"] = numbers_or_null(number.per_record_errors);
    }
    if (number.spread) entry["spread"] = spread_json(*number.spread);
    list.push_back(std::move(entry));
  }
  return list;
}

Json initial_json(const Fit& fit) {
  Json records = Json::array();
  for (std::size_t r = 0; r < fit.initial.size(); ++r) {
    Json states = Json::object();
    for (const FittedStart& start : fit.initial[r]) {
      states[start.state] = {{"value", number_json(start.value)}};
      if (start.fixed)
        states[start.state]["fixed"] = true;
      else
        states[start.state]["stderr"] = optional_json(start.standard_error);
    }
    records.push_back({{"record", fit.records[r]}, {"states", std::move(states)}});
  }
  return records;
}

/// Whether residuals are noise, on what evidence.
Json residuals_json(const FitQuality& quality) {
  return {{"noise", to_string(quality.residuals)},
          {"p_value", quality.chance},
          {"power", quality.power},
          {"shown_by", quality.sign}};
}

/// A law of noise with its sizes.
Json law_json(const NoiseLaw& law) {
  Json json{{"law", to_string(law.form)}};
  if (law.form == NoiseForm::Student) json["freedom"] = law.freedom;
  if (law.constant) json["constant"] = *law.constant;
  if (law.fraction) json["fraction"] = *law.fraction;
  if (law.below) json["below"] = *law.below;
  if (law.above) json["above"] = *law.above;
  if (law.truncated) json["truncated"] = true;
  return json;
}

Json quality_json(const std::vector<FitQuality>& channels, Index ahead) {
  Json list = Json::array();
  for (const FitQuality& quality : channels) {
    list.push_back({{"channel", quality.channel},
                    {"unit", quality.unit},
                    {"samples", quality.samples},
                    {"rmse", number_json(quality.rmse)},
                    {"rmse_per_record", numbers_or_null(quality.rmse_per_record)},
                    {"fit_percent", number_json(quality.fit_percent)},
                    {"noise", quality.noise},
                    {"k_step",
                     {{"steps", ahead},
                      {"samples", quality.predicted},
                      {"rmse", number_json(quality.prediction)}}},
                    {"white", quality.white},
                    {"structure_sigma", number_json(quality.structure)},
                    {"residuals", residuals_json(quality)}});
    if (!quality.law) continue;
    list.back()["noise_law"] = law_json(*quality.law);
    list.back()["censored"] = quality.censored;
  }
  return list;
}

Json profiles_json(const Fit& fit) {
  Json list = Json::array();
  for (const FitProfile& profile : fit.profiles)
    list.push_back({{"name", profile.name},
                    {"values", profile.values},
                    {"deviance", profile.deviance},
                    {"limit", profile.limit}});
  return list;
}

Json gap_json(const Fit& fit) {
  if (!fit.gap) return nullptr;
  const FitGap& gap = *fit.gap;
  Json json{{"metric",
             "root mean square over the channels of rmse / standard deviation, free run from "
             "initial states fitted to the first samples"},
            {"before", number_json(gap.before)},
            {"after", number_json(gap.after)},
            {"noise_floor", number_json(gap.noise_floor)},
            {"ratio", number_json(gap.after / gap.before)},
            {"records", gap.records},
            {"channels", quality_json(gap.channels, fit.prediction)}};
  return json;
}

Json hints_json(const Fit& fit) {
  Json list = Json::array();
  for (const FitCombination& combination : fit.combinations)
    list.push_back(
        {{"kind", "not-identifiable"},
         {"message", combination.message},
         {"remedy", "mark one of them as fixed, or measure more of what they act on"}});
  return list;
}

std::size_t name_width(const Fit& fit) {
  std::size_t width = 4;
  for (const FittedParameter& number : fit.numbers) width = std::max(width, number.name.size());
  return width;
}

/// "at least 3, no upper limit"; empty for a number without a limit on one side.
std::string limit_text(const FittedParameter& number) {
  if (number.at_least)
    return "at least " + format_number(*number.at_least, 3) + ", no upper limit";
  if (number.at_most)
    return "at most " + format_number(*number.at_most, 3) + ", no lower limit";
  return "";
}

std::string interval_text(const FittedParameter& number) {
  const std::string limit = limit_text(number);
  if (number.bound)
    return "at the " + *number.bound + " of its range" + (limit.empty() ? "" : ", " + limit);
  if (!limit.empty()) return "not determined: " + limit;
  if (!number.per_record.empty() && !number.spread) return "own in each record";
  if (!number.ci95) return "not determined by itself";
  const auto [low, high] = *number.ci95;
  const double half = (high - low) / 2.0;
  const std::string ends = "[" + format_number(low, digits_of(low, half)) + ", " +
                           format_number(high, digits_of(high, half)) + "]";
  constexpr double kEven = 0.01;  // an interval ends where the range of its number does
  return std::abs(low + half - number.value) <= kEven * half
             ? "+- " + format_number(half, 2) + "  " + ends
             : ends;
}

/// The number with two digits of its interval.
std::string value_text(const FittedParameter& number) {
  constexpr int kWithoutInterval = 6;
  if (!number.ci95) return format_number(number.value, kWithoutInterval);
  const double half = ((*number.ci95)[1] - (*number.ci95)[0]) / 2.0;
  return format_number(number.value, digits_of(number.value, half));
}

/// "varies */ 1.9 [1.5, 2.8], shrinkage 3 %".
std::string spread_text(const FittedSpread& spread) {
  const auto size = [&](double value) {
    return format_number(spread.by_factor ? std::exp(value) : value, 3);
  };
  const std::string sign = spread.by_factor ? "*/ " : "+- ";
  if (spread.value == 0.0)
    return "does not vary" + (spread.at_most ? " (at most " + sign + size(*spread.at_most) + ")"
                                             : std::string());
  return "varies " + sign + size(spread.value) +
         (spread.ci95 ? " [" + size((*spread.ci95)[0]) + ", " + size((*spread.ci95)[1]) + "]"
                      : std::string()) +
         ", shrinkage " + format_number(100.0 * spread.shrinkage, 2) + " %";
}

/// What each record has for itself of the numbers that vary.
void write_individuals(const Fit& fit, std::ostringstream& out) {
  out << "Individual values\n";
  for (std::size_t r = 0; r < fit.records.size(); ++r) {
    out << "  " << fit.records[r] << ":";
    for (const FittedParameter& number : fit.numbers)
      if (number.spread) out << " " << number.name << " " << format_number(number.per_record[r], 4);
    out << "\n";
  }
}

void write_numbers(const Fit& fit, std::ostringstream& out) {
  const std::size_t width = name_width(fit);
  out << "Numbers (95 % intervals)\n";
  for (const FittedParameter& number : fit.numbers)
    out << "  " << padded(number.name, width) << "  "
        << padded(value_text(number), 11) << "  " << interval_text(number)
        << (number.unit.empty() ? "" : "  " + number.unit) << "\n"
        << (number.spread
                ? "  " + padded("", width) + "  " + spread_text(*number.spread) + "\n"
                : std::string());
  for (const FitCorrelation& pair : fit.correlations)
    out << "  " << pair.first << " and " << pair.second
        << " are correlated: " << format_number(pair.correlation, 3) << "\n";
}

std::string residuals_text(const FitQuality& quality) {
  if (!quality.sign.empty())
    return "residuals have structure (" + quality.sign + ", p = " +
           format_number(quality.chance, 2) + ")";
  if (quality.white) return "residuals white";
  return quality.residuals == Adequate::No
             ? "residuals correlated"
             : "too few samples to distinguish residuals from noise";
}

/// The law with three digits of its sizes, and how many values are limits.
std::string law_text(const FitQuality& quality) {
  const NoiseLaw& law = *quality.law;
  std::string text = to_string(law.form) + " noise";
  for (const std::optional<double>& size : {law.constant, law.fraction})
    if (size) text += " " + format_number(*size, 3);
  if (law.truncated)
    text += std::string(" truncated") +
            (law.below ? " below " + format_number(*law.below, 3) : std::string()) +
            (law.above ? " above " + format_number(*law.above, 3) : std::string());
  if (quality.censored > 0)
    text += " (" + std::to_string(quality.censored) + " values beyond a limit)";
  return text;
}

std::string quality_text(const FitQuality& quality, Index ahead) {
  if (quality.samples == 0) return "no sample was compared";
  return "rmse " + format_number(quality.rmse, 4) +
         (quality.unit.empty() ? "" : " " + quality.unit) +
         (std::isfinite(quality.fit_percent)
              ? ", fit " + format_number(quality.fit_percent, 4) + " %"
              : ", no fit in % (it never changes)") +
         ", " + std::to_string(ahead) + " samples ahead " +
         (std::isfinite(quality.prediction) ? format_number(quality.prediction, 4)
          : quality.predicted == 0          ? "nothing to compare"
                                            : "no finite prediction") +
         (quality.law              ? ", " + law_text(quality)
          : quality.noise > 0.0 ? ", noise " + format_number(quality.noise, 3)
                                : "") +
         ", " + residuals_text(quality);
}

void write_quality(const std::string& title, const std::vector<FitQuality>& channels,
                   Index ahead, std::ostringstream& out) {
  out << title << "\n";
  for (const FitQuality& quality : channels)
    out << "  " << quality.channel << ": " << quality_text(quality, ahead) << "\n";
}

/// Where predicted runs end, with their bands; all times are in the JSON and on the page.
void write_predicted(const Fit& fit, std::ostringstream& out) {
  const auto interval = [](double low, double high) {
    return "[" + format_number(low, 4) + ", " + format_number(high, 4) + "]";
  };
  for (const FitBands& run : fit.predicted) {
    const Index last = run.time.size() - 1;
    out << "Predicted at t = " << format_number(run.time[last], 6) << " of " << run.record
        << " (90 %)\n";
    for (std::size_t c = 0; c < run.quantities.size(); ++c) {
      const auto k = static_cast<Index>(c);
      out << "  " << run.quantities[c].name << " " << format_number(run.value(last, k), 5)
          << "  " << interval(run.low(last, k), run.high(last, k));
      if (std::isfinite(run.least(last, k)))
        out << ", measured " << interval(run.least(last, k), run.most(last, k));
      out << "\n";
    }
  }
}

bool starts_are_fixed(const Fit& fit) {
  return std::all_of(fit.initial.begin(), fit.initial.end(), [](const auto& record) {
    return std::all_of(record.begin(), record.end(),
                       [](const FittedStart& start) { return start.fixed; });
  });
}

/// What stands behind the log-likelihood where it is that of a population.
std::string likelihood_note(const Fit& fit) {
  if (!fit.population) return "";
  return " of the population, AICc " + format_number(fit.population->aicc, 6) + ", BIC " +
         format_number(fit.population->bic, 6);
}

std::string name_of(Standing standing) {
  switch (standing) {
    case Standing::Undetermined:
      return "undetermined";
    case Standing::Incomplete:
      return "incomplete";
    case Standing::Stands:
      break;
  }
  return "stands";
}

}  // namespace

std::string format_json(const Fit& fit) {
  Json json;
  json["format"] = "lacuna.fit/1";
  json["model"] = ordered_json(format_model(fit.model));
  json["parameters"] = numbers_json(fit);
  json["correlations"] = Json::array();
  for (const FitCorrelation& pair : fit.correlations)
    json["correlations"].push_back(
        {{"first", pair.first}, {"second", pair.second}, {"correlation", pair.correlation}});
  json["initial"] = initial_json(fit);
  json["fit"] = quality_json(fit.quality, fit.prediction);
  json["log_likelihood"] = number_json(fit.log_likelihood);
  if (fit.population) json["population"] = population_json(fit);
  json["adequacy"] = adequacy_json(fit.adequacy);
  const FitStanding standing = standing_of(fit);
  json["verdict"] = {{"sound", standing.is_sound()},
                     {"sentence", sentence_of(standing)},
                     {"standing", name_of(standing.admission.standing)},
                     {"why", standing.admission.stands() ? Json() : Json(standing.admission.why)},
                     {"not_determined", standing.open},
                     {"at_bounds", standing.at_ends}};
  json["profiles"] = profiles_json(fit);
  if (!fit.bands.empty()) json["bands"] = bands_json(fit.bands);
  if (!fit.predicted.empty()) json["predicted"] = bands_json(fit.predicted);
  json["gap"] = gap_json(fit);
  json["identifiable"] = fit.combinations.empty();
  json["combinations"] = Json::array();
  for (const FitCombination& combination : fit.combinations)
    json["combinations"].push_back(
        {{"members", combination.members}, {"message", combination.message}});
  json["converged"] = fit.converged;
  json["searches"] = {{"starts", fit.starts}, {"agreeing", fit.agreeing}};
  json["substeps"] = fit.substeps;
  json["hints"] = hints_json(fit);
  json["stages"] = stages_json(fit.stages);
  json["answer_from"] = answer_from(fit.stages);
  json["notes"] = fit.notes;
  return json_lines(json);
}

std::string format_text(const Fit& fit) {
  std::ostringstream out;
  out << to_text(fit.model.symbolic(), 5) << "\n\n";
  write_numbers(fit, out);
  for (const FitCombination& combination : fit.combinations)
    out << "Not identifiable: " << combination.message << "\n";
  if (fit.population) write_individuals(fit, out);
  const std::size_t shown = fit.population && starts_are_fixed(fit) ? 0 : fit.initial.size();
  for (std::size_t r = 0; r < shown; ++r) {
    out << (r == 0 ? "Initial states\n" : "") << "  " << fit.records[r] << ":";
    for (const FittedStart& start : fit.initial[r])
      out << " " << start.state << " " << format_number(start.value, 5)
          << (start.fixed ? " (fixed)"
              : start.standard_error
                  ? " +- " + format_number(kNormalQuantile975 * *start.standard_error, 2)
                  : " (not determined)");
    out << "\n";
  }
  write_quality("Free run", fit.quality, fit.prediction, out);
  if (std::isfinite(fit.log_likelihood) && !fit.runs.empty())
    out << "  log-likelihood " << format_number(fit.log_likelihood, 7) << likelihood_note(fit)
        << "\n";
  if (fit.gap) {
    write_quality("Free run of held-out records", fit.gap->channels, fit.prediction, out);
    out << "  gap " << format_number(fit.gap->before, 3) << " -> "
        << format_number(fit.gap->after, 3) << " of the spread, noise floor "
        << format_number(fit.gap->noise_floor, 3) << "\n";
  }
  write_predicted(fit, out);
  out << "Verdict: " << sentence_of(standing_of(fit)) << "\n";
  for (const std::string& note : said_once(fit.notes)) out << "Note: " << note << "\n";
  return out.str();
}

}  // namespace lacuna
