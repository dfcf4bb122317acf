// SPDX-License-Identifier: MIT
#include "identify/forms_beside/identify_with_forms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "extended_pipeline.hpp"
#include "identify/forms_beside/function_forms.hpp"
#include "identify/forms_beside/missing_forms.hpp"

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

/// A run with forms beside the library.
class ExtendedRun {
 public:
  ExtendedRun(const RecordStream& records, const Pipeline& pipeline, const FormOptions& options,
              const IdentificationResult& alone, const RunContext& context)
      : data_(records.excerpt()),
        options_(options),
        context_(context),
        pipeline_(records, pipeline, options, alone, context) {}

  /// Collects the candidates of each equation.
  void look_for(const std::vector<Stage<Effect>>& effects, const IdentificationResult& alone) {
    const Scope scope = make_scope(alone.model, data_, alone.noise);
    for (Index k = 0; k < data_.state_count(); ++k) {
      std::vector<Candidate>& all = candidates_.emplace_back();
      if (data_.rate_state(k)) continue;
      all = function_forms(scope, effects, k);
      for (Candidate& fraction :
           pipeline_.search().fractions(scope, k, pipeline_.library().terms))
        all.push_back(std::move(fraction));
    }
  }

  /// Whether there are rows enough to tell forms from the library.
  bool is_possible() const {
    return pipeline_.search().rows() > 2 * pipeline_.library().size();
  }

  /// Whether forms have made the model better. Where the library fits already they have to say
  /// the same by fewer numbers; else it fits now, or leaves less with no more terms.
  bool is_better(const Extension& with, const IdentificationResult& without) const {
    if (reaches_the_noise(without))
      return reaches_the_noise(with.result) &&
             says_the_same({with.result, with.numbers()}, {without, terms_of(without)},
                           pipeline_.models(), data_);
    if (is_known_to_fit(with.result)) return true;
    return pipeline_.models().excess(with.result, without) < -options_.same &&
           terms_of(with.result) <= terms_of(without);
  }

  /// Forms that equations lack, and the model that the pipeline makes with them.
  Extension result(const IdentificationResult& alone) const {
    std::vector<EquationForms> equations = bare();
    const bool fits = reaches_the_noise(alone);
    if (!fits) equations = with_missing(std::move(equations));
    const IdentificationResult found = fits ? alone : pipeline_.identified(equations);
    const std::vector<EquationForms> kept = kept_in(found, equations);
    const auto fewest = static_cast<std::size_t>(options_.fewest_numbers);
    bool changed = false;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      if (candidates_[k].empty()) continue;
      context_.report("searching forms", 0.5 + 0.5 * double(k) / double(candidates_.size()));
      equations[k] = kept[k];
      if (fits && kept[k].parameters() < fewest) continue;
      equations[k] = pipeline_.search().with_fewer_terms(
          kept[k], candidates_[k], pipeline_.library().terms, left_by(found.fit[k]));
      equations[k] = pipeline_.search().refitted(std::move(equations[k]));
      changed = changed || !equations[k].forms.empty();
    }
    if (!changed) return {found, kept};
    Extension thinned = plain(std::move(equations));
    const bool is_lost = pipeline_.models().is_ahead(found, thinned.result, options_.same);
    return is_lost ? Extension{found, kept} : std::move(thinned);
  }

 private:
  std::vector<EquationForms> bare() const {
    std::vector<EquationForms> equations;
    for (std::size_t k = 0; k < candidates_.size(); ++k)
      equations.push_back({static_cast<Index>(k), pipeline_.library().terms, {}});
    return equations;
  }

  std::vector<EquationForms> with_missing(std::vector<EquationForms> equations) const {
    const auto most_forms = static_cast<std::size_t>(options_.most_forms);
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      context_.report("searching forms", 0.5 * double(k) / double(candidates_.size()));
      if (!candidates_[k].empty())
        equations[k] = pipeline_.search().with_missing_forms(std::move(equations[k]),
                                                             candidates_[k], most_forms);
    }
    return equations;
  }

  /// @return whether something has changed.
  bool make_plainer(std::vector<EquationForms>& equations, Plainness kind) const {
    bool changed = false;
    for (std::size_t k = 0; k < equations.size(); ++k)
      if (const auto plainer = pipeline_.search().plainer(equations[k], candidates_[k], kind)) {
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
    Extension found = with_fewer_shapes(pipeline_.settled(std::move(equations), candidates_));
    std::vector<EquationForms> plainer = found.equations;
    if (!make_plainer(plainer, Plainness::Any)) return found;
    Extension other = pipeline_.settled(std::move(plainer), candidates_);
    const bool same = pipeline_.models().excess(other.result, found.result) <= options_.same ||
                      (reaches_the_noise(other.result) && reaches_the_noise(found.result));
    return same && other.numbers() <= found.numbers() ? std::move(other) : std::move(found);
  }

  /// A model without shapes of its forms that say nothing by Schwarz' criterion.
  Extension with_fewer_shapes(Extension found) const {
    std::vector<EquationForms> fewer = found.equations;
    bool changed = false;
    for (std::size_t k = 0; k < fewer.size(); ++k)
      if (auto equation = pipeline_.search().with_fewer_shapes(fewer[k], candidates_[k])) {
        fewer[k] = std::move(*equation);
        changed = true;
      }
    if (!changed) return found;
    Extension other = pipeline_.settled(std::move(fewer), candidates_);
    const bool same = reaches_the_noise(other.result) >= reaches_the_noise(found.result) &&
                      says_the_same({other.result, other.numbers()},
                                    {found.result, found.numbers()}, pipeline_.models(), data_);
    return same ? std::move(other) : std::move(found);
  }

  const Dataset& data_;  ///< the excerpt
  const FormOptions& options_;
  const RunContext& context_;
  ExtendedPipeline pipeline_;
  std::vector<std::vector<Candidate>> candidates_;  ///< of each equation
};

}  // namespace

IdentificationResult identify_with_forms(const RecordStream& records, const Pipeline& pipeline,
                                         const std::vector<Stage<Effect>>& effects,
                                         const FormOptions& options,
                                         const RunContext& context) {
  IdentificationResult alone = identify(records, pipeline, context);
  if (!context.leads() || leaves_nothing(alone, options.worth_asking) ||
      !pipeline.equations.empty())
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
