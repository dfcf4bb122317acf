// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "core/base/text.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {
namespace {

struct NamedForm {
  const char* name;
  NoiseForm form;
};

constexpr std::array<NamedForm, 6> kForms = {{{"constant", NoiseForm::Constant},
                                              {"proportional", NoiseForm::Proportional},
                                              {"both", NoiseForm::Both},
                                              {"lognormal", NoiseForm::LogNormal},
                                              {"poisson", NoiseForm::Poisson},
                                              {"student", NoiseForm::Student}}};

bool is_usable(const std::optional<double>& number) {
  return !number || (*number > 0.0 && std::isfinite(*number));
}

}  // namespace

std::string to_string(NoiseForm form) {
  for (const NamedForm& named : kForms)
    if (named.form == form) return named.name;
  return "";
}

std::optional<NoiseForm> noise_form_named(const std::string& name) {
  for (const NamedForm& named : kForms)
    if (named.name == name) return named.form;
  return std::nullopt;
}

bool has_constant(NoiseForm form) {
  return form != NoiseForm::Proportional && form != NoiseForm::LogNormal;
}

bool has_fraction(NoiseForm form) {
  return form == NoiseForm::Proportional || form == NoiseForm::Both ||
         form == NoiseForm::LogNormal;
}

std::string law_problem(const NoiseLaw& law) {
  if (!is_usable(law.constant) || !is_usable(law.fraction))
    return "the size of its noise is not above 0";
  if ((law.constant && !has_constant(law.form)) || (law.fraction && !has_fraction(law.form)))
    return "noise that is " + to_string(law.form) + " has one size";
  if (law.form == NoiseForm::Both && law.constant.has_value() != law.fraction.has_value())
    return "both sizes of its noise are given, or neither";
  if (law.form == NoiseForm::Student && !(law.freedom > 2.0 && std::isfinite(law.freedom)))
    return "the degrees of freedom of its noise are not above 2";
  if (law.form == NoiseForm::Student && (law.below || law.above))
    return "Student's noise has no limits";
  if (!std::isfinite(law.below.value_or(0.0)) || !std::isfinite(law.above.value_or(0.0)))
    return "a limit of it is not finite";
  if (law.below && law.above && !(*law.below < *law.above))
    return "its limits are upside down";
  if (law.truncated && !law.below && !law.above) return "it is truncated, but has no limit";
  if (law.form == NoiseForm::LogNormal &&
      !(law.below.value_or(1.0) > 0.0 && law.above.value_or(1.0) > 0.0))
    return "a limit of lognormal noise is not above 0";
  return "";
}

std::string to_text(const NoiseLaw& law) {
  std::string text = "noise " + to_string(law.form);
  if (law.form == NoiseForm::Student) text += " " + format_number(law.freedom);
  if (law.constant) text += " " + format_number(*law.constant);
  if (law.fraction) text += " " + format_number(*law.fraction);
  if (law.truncated) text += " truncated";
  if (law.below) text += " below " + format_number(*law.below);
  if (law.above) text += " above " + format_number(*law.above);
  return text;
}

}  // namespace lacuna
