// SPDX-License-Identifier: MIT
// What cannot hold of one answer: sentences and numbers that contradict each other. The rules
// of tests/hostile/consistency.py, for answers that tests have in their hands.
#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna::support {

using Json = nlohmann::json;
using Faults = std::vector<std::string>;

constexpr double kGapOfExplained = 1.5;  ///< times its noise floor
constexpr double kSeenGap = 0.002;  ///< fraction of the spread below which it is of no size
constexpr double kSignificantGap = 3.0;  ///< standard deviations
constexpr double kOpenGap = 2.0;         ///< noise floors, be it by chance or not
constexpr double kRunsAway = 1.0;        ///< spreads of the states
/// Half an interval over its number from which on a word has to be said.
constexpr double kUndetermined = 1e6;

inline bool has_all(const std::string& text, const std::vector<std::string>& parts) {
  return std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
    return text.find(part) != std::string::npos;
  });
}

inline void add_if(bool holds, const std::string& fault, Faults& found) {
  if (holds) found.push_back(fault);
}

/// Numbers of what is printed.
inline void add_printed_numbers(const std::string& text, Faults& found) {
  static const std::regex not_finite(R"((^|[^\w.])[-+]?(nan|inf|infinity)($|[^\w.]))",
                                     std::regex::icase);
  static const std::regex no_width(R"(\+- -?0($|[^.\d]))");
  static const std::regex interval(
      R"(([-+]?\d+\.?\d*(?:[eE][-+]?\d+)?)\s+\+- (\d+\.?\d*(?:[eE][-+]?\d+)?))");
  add_if(std::regex_search(text, not_finite), "a number that is not finite", found);
  add_if(std::regex_search(text, no_width), "an interval of width 0", found);
  for (std::sregex_iterator one(text.begin(), text.end(), interval), end; one != end; ++one) {
    const double value = std::abs(std::stod((*one)[1])), half = std::stod((*one)[2]);
    add_if(value > 0.0 && half > kUndetermined * value, one->str() + " without a word", found);
  }
}

/// Words for what contradicts itself in what was printed.
inline Faults printed_faults(const std::string& text) {
  Faults found;
  add_printed_numbers(text, found);
  const auto deny = [&](const std::vector<std::string>& parts, const std::string& fault) {
    add_if(has_all(text, parts), fault, found);
  };
  deny({"Fits to the noise", "does not fit"}, "fits to the noise, and does not");
  deny({"Fits to the noise", "Does not hold"}, "fits to the noise, and does not hold");
  deny({"Wrong library", "  Holds: "}, "wrong library, and holds");
  if (text.find(": does not fit") == std::string::npos)
    deny({"Wrong library", ": fits to the noise"}, "wrong library, and every equation fits");
  static const std::regex nothing(R"(gap 0 -> 0($|[^.\d])|rmse 0[ ,].*fit 0 %)");
  add_if(std::regex_search(text, nothing), "nothing compared, shown as perfect", found);
  return found;
}

inline std::optional<double> number_in(const Json& entry, const std::string& key) {
  const auto place = entry.find(key);
  if (place == entry.end() || !place->is_number()) return std::nullopt;
  return place->get<double>();
}

inline void add_interval(const Json& entry, const std::string& path, Faults& found) {
  std::optional<double> value;
  for (const char* key : {"estimated", "coefficient", "value"})
    if (const auto number = number_in(entry, key)) value = number;
  const double low = number_in(entry, "min").value_or(-INFINITY);
  const double high = number_in(entry, "max").value_or(INFINITY);
  add_if(value && (*value < low || *value > high), path + " is outside its range", found);
  add_if(number_in(entry, "stderr").value_or(1.0) <= 0.0, path + " has an error of 0", found);
  const auto place = entry.find("ci95");
  if (place == entry.end() || !place->is_array() || place->size() != 2 ||
      !(*place)[0].is_number() || !(*place)[1].is_number())
    return;
  const double begin = (*place)[0], end = (*place)[1];
  add_if(!(begin < end), path + " has an interval of width 0", found);
  add_if(begin < low || end > high, path + " has an interval outside its range", found);
  if (!value) return;
  add_if(*value < begin || *value > end, path + " is outside its interval", found);
  add_if(*value != 0.0 && (end - begin) / 2.0 > kUndetermined * std::abs(*value),
         path + " has an interval that says nothing", found);
}

inline void add_adequacy(const Json& adequacy, const std::string& path, Faults& found) {
  if (adequacy["fits"] != "yes") return;
  const Json& parts = adequacy["parts"];
  const bool denies = std::any_of(parts.begin(), parts.end(),
                                  [](const Json& part) { return part["fits"] == "no"; });
  add_if(denies || adequacy["samples"] == 0, path + " fits on nothing, or denies a part",
         found);
}

/// What holds of all of them.
inline void add_numbers(const Json& value, const std::string& path, Faults& found) {
  if (value.is_number_float())
    add_if(!std::isfinite(value.get<double>()), path + " is not finite", found);
  if (value.is_object()) add_interval(value, path, found);
  if (value.is_object() && path.ends_with("/adequacy")) add_adequacy(value, path, found);
  if (!value.is_structured()) return;
  for (const auto& [key, part] : value.items()) add_numbers(part, path + "/" + key, found);
}

inline void add_sync(const Json& sync, Faults& found) {
  const bool holds = sync["holds"], settled = sync["settled"];
  const std::string sentence = sync.value("sentence", "");
  add_if(holds != sentence.starts_with("Holds: "), "holds, and does not", found);
  add_if(holds && !settled, "holds, and did not settle", found);
  add_if(holds && sync["status"] != "completed", "holds, and did not get to the end", found);
}

inline void add_identification(const Json& json, Faults& found) {
  const std::string verdict = json["verdict"].is_null() ? "" : std::string(json["verdict"]);
  Index told = 0, fits = 0, denied = 0;
  for (const Json& fit : json["fit"]) {
    if (fit["identity"] == true) continue;
    ++told;
    fits += fit["fits_to_noise"] == true;
    denied += fit["fits_to_noise"] == false;
    add_if(fit["target"] == 0.0 && fit["fits_to_noise"] == true,
           "nothing to explain, and it fits to the noise", found);
  }
  add_if(verdict == "fits to noise" && denied > 0, "fits to noise, and an equation does not",
         found);
  add_if(verdict == "wrong library" && told > 0 && fits == told,
         "wrong library, and every equation fits to the noise", found);
  add_if(json["adequacy"]["fits"] == "yes" && !verdict.empty() && verdict != "fits to noise",
         "fits to the noise, and " + verdict, found);
  const Json& validation = json["validation"];
  add_if(!validation.is_null() && validation["samples"] == 0 && verdict != "cannot tell",
         "a verdict on no samples", found);
  const Json& sync = json["sync"];
  if (sync.is_null()) return;
  add_sync(sync, found);
  const std::string sentence = sync.value("sentence", "");
  add_if(verdict == "fits to noise" && sentence.starts_with("Does not hold"),
         "fits to noise, and does not hold", found);
  add_if(verdict == "wrong library" && sync["holds"] == true, "wrong library, and holds",
         found);
}

inline void add_diagnosis(const Json& json, Faults& found) {
  const std::string verdict = json["verdict"];
  const bool effects = !json["effects"].empty(), left = json["remaining"]["structure"];
  const bool explained = verdict == "explained";
  const bool named = explained || verdict == "partly-explained";
  add_if(named && !effects, verdict + " without effects", found);
  const bool refused = verdict == "undetermined" || verdict == "incomplete";
  add_if(!named && !refused && effects, verdict + " with effects", found);
  const bool has_reason = json.contains("why") && !json["why"].is_null();
  add_if(refused != has_reason, verdict + " with the reason of another", found);
  add_if(left && (explained || verdict == "no-discrepancy" || verdict == "coefficients-only"),
         verdict + " with structure left", found);
  const Json& gap = json["gap"];
  add_if(!gap.is_null() && gap["before"] == 0.0 && gap["after"] == 0.0, "a gap of nothing",
         found);
  if (gap.is_null()) return add_if(explained, "explained without a gap", found);
  const double after = gap["after"], floor = gap["noise_floor"];
  const double sigma = number_in(gap, "above_floor").value_or(INFINITY);
  const bool open = after > std::max(kGapOfExplained * floor, kSeenGap) &&
                    (sigma >= kSignificantGap || after > kOpenGap * floor);
  add_if(open && (explained || verdict == "no-discrepancy" || verdict == "coefficients-only"),
         verdict + " beside a gap", found);
  const Json free = gap.value("free_run", Json());
  add_if(explained && !free.is_null() && number_in(free, "after").value_or(INFINITY) > kRunsAway,
         "explained by a model that runs away", found);
}

inline void add_fit_quality(const Json& quality, Faults& found) {
  const Json& ahead = quality["k_step"];
  add_if(quality["samples"] == 0 && !quality["rmse"].is_null(), "an error of no samples",
         found);
  add_if(ahead["samples"] == 0 && !ahead["rmse"].is_null(), "a prediction of no samples",
         found);
  add_if(quality["rmse"] == 0.0 && quality["fit_percent"] == 0.0,
         "nothing compared, shown as perfect", found);
}

inline void add_fit(const Json& json, Faults& found) {
  for (const Json& quality : json["fit"]) add_fit_quality(quality, found);
  if (const Json& gap = json["gap"]; !gap.is_null()) {
    for (const Json& quality : gap["channels"]) add_fit_quality(quality, found);
    add_if(gap["before"] == 0.0 && gap["after"] == 0.0, "a gap of nothing", found);
  }
  Faults said;
  for (const Json& one : json["combinations"])
    for (const Json& member : one["members"]) said.push_back(member);
  for (const Json& number : json["parameters"]) {
    if (!number["ci95"].is_null() || number.contains("bound") || number.contains("per_record"))
      continue;
    const std::string name = number["name"];
    add_if(std::find(said.begin(), said.end(), name) == said.end() || json["identifiable"],
           name + " has no interval without a word", found);
  }
}

inline void add_comparison(const Json& json, Faults& found) {
  if (json["agree"] != true) return;
  Index judged = 0;
  for (const Json& measure : json["measures"]) {
    if (measure["agree"] != true) continue;
    ++judged;
    for (const char* key : {"first_ci95", "second_ci95"})
      for (const Json& end : measure[key])
        add_if(!end.is_number(), "agreement by an interval that says nothing", found);
  }
  add_if(judged == 0, "agreement of nothing", found);
}

/// Words for what contradicts itself in an answer's JSON.
inline Faults json_faults(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return {"JSON that cannot be read"};
  Faults found;
  add_numbers(json, "", found);
  const std::string format = json.value("format", "");
  if (format == "lacuna.identification/1") add_identification(json, found);
  if (format == "lacuna.diagnosis/1") add_diagnosis(json, found);
  if (format == "lacuna.fit/1") add_fit(json, found);
  if (format == "lacuna.sync/1") add_sync(json, found);
  if (format == "lacuna.comparison/1") add_comparison(json, found);
  return found;
}

/// Both, of one answer.
inline Faults contradictions(const std::string& printed, const std::string& json) {
  Faults found = printed_faults(printed);
  const Faults more = json_faults(json);
  found.insert(found.end(), more.begin(), more.end());
  return found;
}

}  // namespace lacuna::support
