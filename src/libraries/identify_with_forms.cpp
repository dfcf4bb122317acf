// SPDX-License-Identifier: MIT
#include "lacuna/libraries/identify_with_forms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lacuna/bases/expressions.hpp"
#include "lacuna/libraries/function_forms.hpp"
#include "lacuna/libraries/missing_forms.hpp"

namespace lacuna {
namespace {

/// Residuals that differ by less are the same.
constexpr double kSlack = 0.1;

bool reaches_the_noise(const IdentificationResult& result) {
  return std::all_of(result.fit.begin(), result.fit.end(),
                     [](const EquationFit& fit) { return fit.fits_to_noise.value_or(true); });
}

/// Whether what the library leaves of the rates is not worth a form: errors of solvers.
bool leaves_nothing(const IdentificationResult& result) {
  constexpr double kNothing = 1e-5;  // of the rate, rms
  return std::all_of(result.fit.begin(), result.fit.end(), [](const EquationFit& fit) {
    return fit.identity || fit.residual_rms <= kNothing * fit.target_rms;
  });
}

/// Sum of the logarithms of the misfits; of the residuals where there are none.
double misfit_of(const IdentificationResult& result) {
  double sum = 0.0;
  for (const EquationFit& fit : result.fit)
    if (!fit.identity) sum += std::log(std::max(fit.misfit.value_or(fit.residual_rms), 1e-300));
  return sum;
}

std::size_t terms_of(const IdentificationResult& result) {
  std::size_t count = 0;
  for (const Equation& equation : result.model.equations()) count += equation.size();
  return count;
}

/// Whether forms have made the model better: it fits now, or leaves less by more than a tenth
/// with no more terms.
bool is_better(const IdentificationResult& with, const IdentificationResult& without) {
  if (reaches_the_noise(with)) return true;
  return misfit_of(with) < misfit_of(without) - kSlack && terms_of(with) <= terms_of(without);
}

/// A run with forms beside the library.
class ExtendedRun {
 public:
  ExtendedRun(const Dataset& data, const Pipeline& pipeline,
              const std::vector<Stage<Effect>>& effects, const IdentificationResult& alone,
              const RunContext& context)
      : data_(data),
        pipeline_(pipeline),
        context_(context),
        library_(pipeline.basis->library(alone.model.variables())),
        search_(data, alone.noise, context) {
    const Scope scope = make_scope(alone.model, data, alone.noise);
    for (Index k = 0; k < data.state_count(); ++k)
      candidates_.push_back(data.rate_state(k) ? std::vector<Candidate>()
                                               : function_forms(scope, effects, k));
  }

  /// Whether there are rows enough to tell forms from the library.
  bool is_possible() const { return search_.rows() > 2 * library_.size(); }

  /// Forms that equations lack, and the model that the pipeline makes with them.
  IdentificationResult result() const {
    constexpr std::size_t kMostForms = 3;
    std::vector<EquationForms> equations;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      context_.report("searching forms", double(k) / double(candidates_.size()));
      equations.push_back({static_cast<Index>(k), library_.terms, {}});
      if (!candidates_[k].empty())
        equations[k] =
            search_.with_missing_forms(std::move(equations[k]), candidates_[k], kMostForms);
    }
    const IdentificationResult found = identified(equations);
    bool changed = false;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (candidates_[k].empty()) continue;
      const EquationForms kept = kept_in(found, k, equations[k].forms);
      equations[k] = search_.with_fewer_terms(kept, candidates_[k]);
      equations[k] = search_.refitted(std::move(equations[k]));
      changed = changed || !equations[k].forms.empty();
    }
    return changed ? plain(std::move(equations)) : found;
  }

 private:
  /// @return whether something has changed.
  bool make_plainer(std::vector<EquationForms>& equations, Plainness kind) const {
    bool changed = false;
    for (std::size_t k = 0; k < equations.size(); ++k)
      if (const auto plainer = search_.plainer(equations[k], candidates_[k], kind)) {
        equations[k] = *plainer;
        changed = true;
      }
    return changed;
  }

  /// The model with these forms, or with plainer ones where they do the same.
  IdentificationResult plain(std::vector<EquationForms> equations) const {
    // What a solver makes of a jump is worse than what it makes of a steep slope: residuals do
    // not decide here.
    make_plainer(equations, Plainness::Jump);
    IdentificationResult found = identified(equations);
    if (!make_plainer(equations, Plainness::Any)) return found;
    IdentificationResult other = identified(equations);
    const bool same = misfit_of(other) <= misfit_of(found) + kSlack ||
                      (reaches_the_noise(other) && reaches_the_noise(found));
    return same && terms_of(other) <= terms_of(found) ? std::move(other) : std::move(found);
  }

  IdentificationResult identified(const std::vector<EquationForms>& equations) const {
    ExpressionsOptions options;
    options.terms = library_.names();
    for (const EquationForms& equation : equations)
      for (const MissingForm& form : equation.forms) {
        const std::string name = Term(form.expression(), library_.variables).name();
        if (std::find(options.terms.begin(), options.terms.end(), name) == options.terms.end())
          options.terms.push_back(name);
      }
    Pipeline extended = pipeline_;
    extended.basis = Expressions{std::move(options)};
    return identify(data_, extended, context_);
  }

  /// The terms that a model has in one equation, those that are forms as such.
  EquationForms kept_in(const IdentificationResult& found, std::size_t equation,
                        const std::vector<MissingForm>& forms) const {
    EquationForms kept{static_cast<Index>(equation), {}, {}};
    for (const WeightedTerm& summand : found.model.equations()[equation]) {
      const auto form = std::find_if(forms.begin(), forms.end(), [&](const MissingForm& each) {
        return Term(each.expression(), library_.variables) == summand.term;
      });
      if (form == forms.end())
        kept.terms.push_back(summand.term);
      else
        kept.forms.push_back(*form);
    }
    return kept;
  }

  const Dataset& data_;
  const Pipeline& pipeline_;
  const RunContext& context_;
  TermLibrary library_;
  FormSearch search_;
  std::vector<std::vector<Candidate>> candidates_;  ///< of each equation
};

}  // namespace

IdentificationResult identify_with_forms(const Dataset& data, const Pipeline& pipeline,
                                         const std::vector<Stage<Effect>>& effects,
                                         const RunContext& context) {
  IdentificationResult alone = identify(data, pipeline, context);
  if (reaches_the_noise(alone) || leaves_nothing(alone) || lacks_input_columns(data))
    return alone;
  const ExtendedRun run(data, pipeline, effects, alone, context);
  if (!run.is_possible()) return alone;
  IdentificationResult extended = run.result();
  if (!is_better(extended, alone)) return alone;
  extended.library_alone = std::move(alone.model);
  return extended;
}

}  // namespace lacuna
