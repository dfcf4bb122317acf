// SPDX-License-Identifier: MIT
#include "lacuna/libraries/identify_with_forms.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "lacuna/bases/expressions.hpp"
#include "lacuna/libraries/function_forms.hpp"
#include "lacuna/libraries/missing_forms.hpp"
#include "model_comparison.hpp"
#include "refined_shapes.hpp"

namespace lacuna {
namespace {

/// Whether what the library leaves of the rates is not worth a form: errors of solvers.
bool leaves_nothing(const IdentificationResult& result, double worth_asking) {
  return std::all_of(result.fit.begin(), result.fit.end(), [&](const EquationFit& fit) {
    return fit.identity || fit.residual_rms <= worth_asking * fit.target_rms;
  });
}

/// What is known of what an equation leaves.
Remainder left_by(const EquationFit& fit) {
  return fit.fits_to_noise.value_or(false) ? Remainder::Noise : Remainder::Unknown;
}

std::size_t terms_of(const IdentificationResult& result) {
  std::size_t count = 0;
  for (const Equation& equation : result.model.equations()) count += equation.size();
  return count;
}

/// A model and its equations with forms as such.
struct Extension {
  IdentificationResult result;
  std::vector<EquationForms> equations;

  bool has_forms() const {
    return std::any_of(equations.begin(), equations.end(),
                       [](const EquationForms& equation) { return !equation.forms.empty(); });
  }

  /// Coefficients, and shapes of forms.
  std::size_t numbers() const {
    std::size_t count = 0;
    for (const EquationForms& equation : equations) count += equation.parameters();
    return count;
  }
};

/// A model and how many numbers it has.
struct Counted {
  const IdentificationResult& result;
  std::size_t numbers;
};

/// Whether fewer numbers say the same by Schwarz' criterion: 2 n ln(what is left) of each state
/// and ln(n m) for each number.
bool says_the_same(const Counted& fewer, const Counted& more, const ModelComparison& models,
                   const Dataset& data) {
  const auto n = static_cast<double>(data.samples());
  const double price = std::log(n * static_cast<double>(data.state_count()));
  return fewer.numbers < more.numbers &&
         2.0 * n * models.excess(fewer.result, more.result) <
             price * static_cast<double>(more.numbers - fewer.numbers);
}

/// Coefficients of the terms, then of the forms, of each equation; 0 where the model has none.
std::vector<Vector> coefficients_of(const OdeModel& model,
                                    const std::vector<EquationForms>& equations) {
  std::vector<Vector> all;
  for (const EquationForms& equation : equations) {
    std::vector<double> numbers;
    for (const Term& term : equation.terms)
      numbers.push_back(model.coefficient(equation.equation, term.name()));
    for (const MissingForm& form : equation.forms)
      numbers.push_back(model.coefficient(equation.equation,
                                          Term(form.expression(), model.variables()).name()));
    all.push_back(Eigen::Map<const Vector>(numbers.data(), static_cast<Index>(numbers.size())));
  }
  return all;
}

/// The equations of a model, terms that are forms of some equation as such: one equation may
/// take over what was found for another.
std::vector<EquationForms> kept_in(const IdentificationResult& found,
                                   const std::vector<EquationForms>& equations) {
  std::map<std::string, MissingForm> forms;
  for (const EquationForms& equation : equations)
    for (const MissingForm& form : equation.forms)
      forms.emplace(Term(form.expression(), found.model.variables()).name(), form);
  std::vector<EquationForms> kept;
  for (std::size_t k = 0; k < equations.size(); ++k) {
    kept.push_back({static_cast<Index>(k), {}, {}});
    for (const WeightedTerm& summand : found.model.equations()[k]) {
      const auto form = forms.find(summand.term.name());
      if (form == forms.end())
        kept[k].terms.push_back(summand.term);
      else
        kept[k].forms.push_back(form->second);
    }
  }
  return kept;
}

/// Names of a library's terms and of the forms beside them, each once.
std::vector<std::string> with_forms(const TermLibrary& library,
                                    const std::vector<MissingForm>& forms) {
  std::vector<std::string> names = library.names();
  for (const MissingForm& form : forms) {
    const std::string name = Term(form.expression(), library.variables).name();
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

/// A run with forms beside the library.
class ExtendedRun {
 public:
  ExtendedRun(const RecordStream& records, const Pipeline& pipeline, const FormOptions& options,
              const IdentificationResult& alone, const RunContext& context)
      : records_(records),
        data_(records.excerpt()),
        pipeline_(pipeline),
        options_(options),
        context_(context),
        alone_(alone),
        library_(pipeline.basis->library(alone.model.variables())),
        models_(data_),
        search_(data_, alone.noise, options, context, library_.terms) {}

  /// Collects the candidates of each equation.
  void look_for(const std::vector<Stage<Effect>>& effects, const IdentificationResult& alone) {
    const Scope scope = make_scope(alone.model, data_, alone.noise);
    for (Index k = 0; k < data_.state_count(); ++k) {
      std::vector<Candidate>& all = candidates_.emplace_back();
      if (data_.rate_state(k)) continue;
      all = function_forms(scope, effects, k);
      for (Candidate& fraction : search_.fractions(scope, k, library_.terms))
        all.push_back(std::move(fraction));
    }
  }

  /// Whether there are rows enough to tell forms from the library.
  bool is_possible() const { return search_.rows() > 2 * library_.size(); }

  /// Whether forms have made the model better. Where the library fits already they have to say
  /// the same by fewer numbers; else it fits now, or leaves less with no more terms.
  bool is_better(const Extension& with, const IdentificationResult& without) const {
    if (reaches_the_noise(without))
      return reaches_the_noise(with.result) &&
             says_the_same({with.result, with.numbers()}, {without, terms_of(without)}, models_,
                           data_);
    if (is_known_to_fit(with.result)) return true;
    return models_.excess(with.result, without) < -options_.same &&
           terms_of(with.result) <= terms_of(without);
  }

  /// Forms that equations lack, and the model that the pipeline makes with them.
  Extension result(const IdentificationResult& alone) const {
    std::vector<EquationForms> equations = bare();
    const bool fits = reaches_the_noise(alone);
    if (!fits) equations = with_missing(std::move(equations));
    const IdentificationResult found = fits ? alone : identified(equations);
    const std::vector<EquationForms> kept = kept_in(found, equations);
    const auto fewest = static_cast<std::size_t>(options_.fewest_numbers);
    bool changed = false;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (candidates_[k].empty()) continue;
      context_.report("searching forms", 0.5 + 0.5 * double(k) / double(candidates_.size()));
      equations[k] = kept[k];
      if (fits && kept[k].parameters() < fewest) continue;
      equations[k] = search_.with_fewer_terms(kept[k], candidates_[k], library_.terms,
                                              left_by(found.fit[k]));
      equations[k] = search_.refitted(std::move(equations[k]));
      changed = changed || !equations[k].forms.empty();
    }
    if (!changed) return {found, kept};
    Extension thinned = plain(std::move(equations));
    const bool is_lost = models_.is_ahead(found, thinned.result, options_.same);
    return is_lost ? Extension{found, kept} : std::move(thinned);
  }

 private:
  std::vector<EquationForms> bare() const {
    std::vector<EquationForms> equations;
    for (std::size_t k = 0; k < candidates_.size(); ++k)
      equations.push_back({static_cast<Index>(k), library_.terms, {}});
    return equations;
  }

  std::vector<EquationForms> with_missing(std::vector<EquationForms> equations) const {
    const auto most_forms = static_cast<std::size_t>(options_.most_forms);
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      context_.report("searching forms", 0.5 * double(k) / double(candidates_.size()));
      if (!candidates_[k].empty())
        equations[k] =
            search_.with_missing_forms(std::move(equations[k]), candidates_[k], most_forms);
    }
    return equations;
  }

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
  Extension plain(std::vector<EquationForms> equations) const {
    // What a solver makes of a jump is worse than what it makes of a steep slope: residuals do
    // not decide here.
    make_plainer(equations, Plainness::Jump);
    Extension found = with_fewer_shapes(settled(std::move(equations)));
    std::vector<EquationForms> plainer = found.equations;
    if (!make_plainer(plainer, Plainness::Any)) return found;
    Extension other = settled(std::move(plainer));
    const bool same = models_.excess(other.result, found.result) <= options_.same ||
                      (reaches_the_noise(other.result) && reaches_the_noise(found.result));
    return same && other.numbers() <= found.numbers() ? std::move(other) : std::move(found);
  }

  /// A model without shapes of its forms that say nothing by Schwarz' criterion.
  Extension with_fewer_shapes(Extension found) const {
    std::vector<EquationForms> fewer = found.equations;
    bool changed = false;
    for (std::size_t k = 0; k < fewer.size(); ++k)
      if (auto equation = search_.with_fewer_shapes(fewer[k], candidates_[k])) {
        fewer[k] = std::move(*equation);
        changed = true;
      }
    if (!changed) return found;
    Extension other = settled(std::move(fewer));
    const bool same = reaches_the_noise(other.result) >= reaches_the_noise(found.result) &&
                      says_the_same({other.result, other.numbers()},
                                    {found.result, found.numbers()}, models_, data_);
    return same ? std::move(other) : std::move(found);
  }

  /// The model that the pipeline makes of these equations with nothing beside them, shapes as
  /// the trajectories ask for; with the library beside the forms where that does not fit.
  Extension settled(std::vector<EquationForms> equations) const {
    IdentificationResult alone = identified_as(equations);
    if (is_worse(alone)) return {std::move(alone), std::move(equations)};
    const std::vector<Vector> coefficients = coefficients_of(alone.model, equations);
    equations = refined_shapes(alone.model, std::move(equations), data_, context_);
    for (std::size_t k = 0; k < equations.size(); ++k)
      equations[k] =
          search_.plainly_written(std::move(equations[k]), coefficients[k], candidates_[k]);
    alone = identified_as(equations);
    if (is_known_to_fit(alone)) {
      equations = kept_in(alone, equations);
      return {std::move(alone), std::move(equations)};
    }
    IdentificationResult beside = identified(equations);
    const bool better = models_.is_ahead(beside, alone, options_.same) ||
                        models_.excess(beside, alone) < -options_.same;
    if (better) alone = std::move(beside);
    equations = kept_in(alone, equations);
    return {std::move(alone), std::move(equations)};
  }

  /// Whether the library reaches the noise and a model leaves more by what fitting its shapes
  /// to the trajectories does not take away: in the rows they were fitted already.
  bool is_worse(const IdentificationResult& model) const {
    return reaches_the_noise(alone_) && models_.excess(model, alone_) > options_.same;
  }

  /// With no other terms than these in equations that have forms.
  IdentificationResult identified_as(const std::vector<EquationForms>& equations) const {
    Pipeline extended = pipeline_;
    for (const EquationForms& equation : equations) {
      if (equation.forms.empty()) continue;
      EquationTerms terms{data_.states[static_cast<std::size_t>(equation.equation)].name, {}};
      for (const Term& term : equation.terms) terms.terms.push_back(term.name());
      for (const MissingForm& form : equation.forms)
        terms.terms.push_back(form.expression().to_string());
      extended.equations.push_back(std::move(terms));
    }
    return identify(records_, extended, context_);
  }

  IdentificationResult identified(const std::vector<EquationForms>& equations) const {
    Pipeline extended = pipeline_;
    extended.basis =
        Expressions{{.terms = with_forms(library_, search_.shared_forms(equations))}};
    return identify(records_, extended, context_);
  }

  const RecordStream& records_;
  const Dataset& data_;  ///< the excerpt
  const Pipeline& pipeline_;
  const FormOptions& options_;
  const RunContext& context_;
  const IdentificationResult& alone_;  ///< what the library gives
  TermLibrary library_;
  ModelComparison models_;
  FormSearch search_;
  std::vector<std::vector<Candidate>> candidates_;  ///< of each equation
};

}  // namespace

IdentificationResult identify_with_forms(const RecordStream& records, const Pipeline& pipeline,
                                         const std::vector<Stage<Effect>>& effects,
                                         const FormOptions& options,
                                         const RunContext& context) {
  IdentificationResult alone = identify(records, pipeline, context);
  if (!context.leads() || leaves_nothing(alone, options.worth_asking) ||
      lacks_input_columns(records.excerpt()) || !pipeline.equations.empty())
    return alone;
  const RunContext leader = context.alone();
  ExtendedRun run(records, pipeline, options, alone, leader);
  if (!run.is_possible()) return alone;
  run.look_for(effects, alone);
  Extension extended = run.result(alone);
  if (!run.is_better(extended, alone)) return alone;
  if (extended.has_forms()) extended.result.library_alone = std::move(alone.model);
  return std::move(extended.result);
}

}  // namespace lacuna
