// SPDX-License-Identifier: MIT
#include "lacuna/identify/validation/advice.hpp"

#include <cmath>
#include <optional>

#include "core/base/text.hpp"
#include "identify/forms_beside/form_problem.hpp"
#include "identify/forms_beside/function_forms.hpp"

namespace lacuna {
namespace {

/// The form with its shapes to a few digits, as a user would write it.
std::string written(const MissingForm& form, const Variables& variables) {
  constexpr int kDigits = 3;
  MissingForm rounded = form;
  for (double& shape : rounded.shapes)
    shape = parse_number(format_number(shape, kDigits)).value_or(shape);
  return Term(rounded.expression(), variables).name();
}

/// An equation with the forms that its residual asks for, and the share that they leave.
struct Asked {
  EquationForms equation;
  double left = 1.0;
};

class FormAdvice {
 public:
  FormAdvice(const IdentificationResult& result, const Dataset& data,
             const std::vector<Stage<Effect>>& effects, const AdviceOptions& options,
             const RunContext& context)
      : model_(result.model),
        scope_(make_scope(result.model, data, result.noise)),
        effects_(effects),
        options_(options),
        search_(data, result.noise, options.search, context),
        problem_(data, result.noise, options.search, context) {}

  /// Nothing where no form stands out.
  std::optional<Asked> asked_by(Index k) const {
    EquationForms equation{k, {}, {}};
    const auto most_forms = static_cast<std::size_t>(options_.most_forms);
    for (const WeightedTerm& summand : model_.equations()[static_cast<std::size_t>(k)])
      equation.terms.push_back(summand.term);
    if (search_.rows() <= 2 * static_cast<Index>(equation.parameters() + most_forms))
      return std::nullopt;
    const double before = problem_.left(equation);
    if (!(std::sqrt(before / problem_.left({k, {}, {}})) > options_.worth_asking))
      return std::nullopt;
    const std::vector<Candidate> candidates = function_forms(scope_, effects_, k);
    double left = before;
    for (std::size_t forms = 1; forms <= most_forms; ++forms) {
      EquationForms more = search_.with_missing_forms(equation, candidates, forms);
      const double with = problem_.left(more);
      if (more.forms.size() < forms || !(std::sqrt(with / left) < options_.most_left)) break;
      equation = std::move(more);
      left = with;
    }
    if (equation.forms.empty()) return std::nullopt;
    return Asked{std::move(equation), std::sqrt(left / before)};
  }

  std::string sentence(const Asked& asked) const {
    std::vector<std::string> forms;
    for (const MissingForm& form : asked.equation.forms)
      forms.push_back(written(form, model_.variables()));
    const std::string& state =
        model_.states()[static_cast<std::size_t>(asked.equation.equation)].name;
    return "d" + state + "/dt: " + join(forms, " and ") + " beside its terms would leave " +
           format_number(100.0 * asked.left, 2) + " % of its residual; try --add \"" +
           join(forms, ",") + "\"";
  }

 private:
  const OdeModel& model_;
  Scope scope_;
  const std::vector<Stage<Effect>>& effects_;
  const AdviceOptions& options_;
  FormSearch search_;
  FormProblem problem_;
};

}  // namespace

std::vector<std::string> advice_for(const IdentificationResult& result, const Dataset& data,
                                    const std::vector<Stage<Effect>>& effects,
                                    const AdviceOptions& options, const RunContext& context) {
  const FormAdvice forms(result, data, effects, options, context);
  std::vector<std::string> advice;
  for (Index k = 0; k < data.state_count(); ++k) {
    context.report("asking what the residuals ask for",
                   static_cast<double>(k) / static_cast<double>(data.state_count()));
    if (data.rate_state(k)) continue;
    if (const std::optional<Asked> asked = forms.asked_by(k))
      advice.push_back(forms.sentence(*asked));
  }
  if (advice.empty())
    advice.push_back(
        "no function of states and inputs explains what is left: save the model (--model-out) "
        "and give it to `lacuna diagnose`, which looks for delays, memory, inputs that nobody "
        "measured and faults of sensors");
  return advice;
}

}  // namespace lacuna
