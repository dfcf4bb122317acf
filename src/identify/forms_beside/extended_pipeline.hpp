// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "identify/forms_beside/missing_forms.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"
#include "model_comparison.hpp"

namespace lacuna {

/// A model and its equations with forms as such.
struct Extension {
  IdentificationResult result;
  std::vector<EquationForms> equations;

  bool has_forms() const;

  /// Coefficients, and shapes of forms.
  std::size_t numbers() const;
};

/// The equations of a model, terms that are forms of some equation as such: one equation may
/// take over what was found for another.
std::vector<EquationForms> kept_in(const IdentificationResult& found,
                                   const std::vector<EquationForms>& equations);

/// What a pipeline makes of records with forms beside its library or in its place.
class ExtendedPipeline {
 public:
  /// @param alone what the library gives. All that is given has to outlive this.
  ExtendedPipeline(const RecordStream& records, const Pipeline& pipeline,
                   const FormOptions& options, const IdentificationResult& alone,
                   const RunContext& context);

  const TermLibrary& library() const { return library_; }
  const ModelComparison& models() const { return models_; }
  const FormSearch& search() const { return search_; }

  /// With the forms of all equations beside the library.
  IdentificationResult identified(const std::vector<EquationForms>& equations) const;

  /// The model that the pipeline makes of these equations with nothing beside them, shapes as
  /// the trajectories ask for; with the library beside the forms where that does not fit.
  /// @param candidates of each equation.
  Extension settled(std::vector<EquationForms> equations,
                    const std::vector<std::vector<Candidate>>& candidates) const;

 private:
  /// What a pipeline makes of the records. @throws OutOfTime where it could not be refined.
  IdentificationResult refined_in_time(const Pipeline& pipeline) const;

  /// With no other terms than these in equations that have forms.
  /// @param roughly without the refit of a model that does not fit to the noise.
  IdentificationResult identified_as(const std::vector<EquationForms>& equations,
                                     bool roughly = false) const;

  /// Whether the library reaches the noise and a model leaves more by what fitting its shapes
  /// to the trajectories does not take away: in the rows they were fitted already.
  bool is_worse(const IdentificationResult& model) const;

  /// With shapes that trajectories ask for beside the terms that are there now, where that
  /// leaves less by no more numbers: they were fitted beside others.
  Extension reshaped(Extension found) const;

  const RecordStream& records_;
  const Pipeline& pipeline_;
  const FormOptions& options_;
  const RunContext& context_;
  const IdentificationResult& alone_;
  TermLibrary library_;
  ModelComparison models_;
  FormSearch search_;
};

}  // namespace lacuna
