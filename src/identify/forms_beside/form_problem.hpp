// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "base_columns.hpp"
#include "form_rows.hpp"
#include "identify/forms_beside/missing_forms.hpp"
#include "lacuna/identify/options.hpp"

namespace lacuna {

/// Evaluations for a shape when it is fitted to the last digits.
inline constexpr int kEvaluationsExactly = 80;

/// How far the shapes of a form are fitted.
struct ShapeFit {
  int evaluations = kEvaluationsExactly;
  double wanted = 0.0;  ///< sum of squares of use: what stays far above it is fitted roughly; 0:
                        ///< any is
};

/// A candidate at one of its starting points.
struct Start {
  MissingForm form;
  std::size_t candidate = 0;
  double left = 0.0;
};

/// All candidates at all of their starting points.
std::vector<Start> all_starts(const std::vector<Candidate>& candidates);

/// Notes the residual with each.
void set_residuals(const Vector& left, std::vector<Start>& starts);

/// The first so many of those that leave something finite, those that leave least first, each
/// candidate at its best starting point.
std::vector<Start> best_of(const std::vector<Start>& starts, std::size_t count);

inline constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

/// An equation to which a form is added.
struct Beside {
  const EquationForms& equation;
  std::size_t most_parameters = kAnyNumber;  ///< with the form
  std::size_t fewest_members = 0;  ///< that stay beside the form
  /// A form has to take this fraction of what is beyond a limit where those members are gone
  /// that are missed least, as many as most_parameters asks for.
  double takes = 0.0, limit = 0.0;
};

/// An equation and what it leaves.
struct Trial {
  EquationForms equation;
  double left = 0.0;  ///< sum of squares
};

/// How much an equation may leave in place of another.
struct Limit {
  double left = 0.0;           ///< with as many numbers
  double penalty = 0.0;        ///< more for each number less; 0 where residuals are no noise
  std::size_t parameters = 0;  ///< of the other

  double operator()(const EquationForms& equation) const;

  /// Whether one trial is the better of two: by fewer parameters, and by the residual where
  /// they have as many. Terms whose noise is not in the rows' whitening make Schwarz' criterion
  /// take too many.
  static bool prefers(const Trial& a, const Trial& b);
};

/// Rows of the weak form, and what equations leave in them.
class FormProblem {
 public:
  /// @param library terms whose columns are kept. @param seen as of FormSearch.
  FormProblem(const Dataset& data, Vector noise, FormOptions options = {},
              RunContext context = {}, const std::vector<Term>& library = {},
              const std::optional<Vector>& seen = {});

  const FormOptions& options() const { return options_; }
  const FormRows& all_rows() const { return rows_; }
  const RunContext& context() const { return context_; }
  Index rows() const { return rows_.rows(); }

  /// The sum of squares that noise leaves, or quadrature and rounding where there is none.
  double residual_noise(Index equation) const;

  /// The largest sum of squares that is the same as another: what is no noise is known to
  /// FormOptions::same (rms), noise to what chance does for the best of many forms.
  /// @param noise the sum of squares that noise leaves.
  double same_as(double left, double noise) const;

  /// Columns of starting points that were made so far.
  Index columns_made() const { return columns_.made(); }

  /// What may take the place of an equation. Where its trajectories leave nothing but noise,
  /// what it leaves here is noise too, however much of it: noise in terms is not in the
  /// whitening.
  Limit limit_of(const EquationForms& equation, Remainder remainder = Remainder::Unknown) const;

  /// Columns of an equation: terms, then forms.
  Matrix columns(const EquationForms& equation) const;

  double left(const EquationForms& equation) const;

  /// As of FormSearch.
  bool would_fit_noise(const EquationForms& equation, double fraction) const;

  /// The constant and the variables.
  std::vector<Term> linear_terms() const;

  /// The equation with each of the candidates, shapes fitted, the one that leaves least first.
  /// @param wanted sum of squares of use: FormOptions::takes says what is fitted; 0: any is.
  std::vector<Trial> with_each(const EquationForms& equation,
                               const std::vector<Candidate>& candidates,
                               double wanted = 0.0) const;

  /// The equation with one form more and without those members that are missed least, as long
  /// as the residual stays within a limit; infinite where already the form does not.
  Trial thinned(EquationForms equation, const MissingForm& form, const Limit& limit) const;

  /// The form with those terms of an equation that it needs beside it, chosen by a penalty for
  /// each in units of what the limit leaves on average in a row; thinned to the limit.
  Trial chosen(const EquationForms& from, const MissingForm& form, const Limit& limit) const;

  /// Whether two forms are nearly the same at the samples: a jump differs from a slope at few
  /// of them, other forms hardly differ at all.
  bool alike(const MissingForm& a, const MissingForm& b, Plainness kind) const;

  /// The candidate that is a term without a form, but for a factor, at all samples, with the
  /// same shapes.
  std::optional<MissingForm> rest_of(const Term& term, const MissingForm& form,
                                     const std::vector<Candidate>& candidates) const;

  /// Correlation of two forms over the samples.
  double likeness(const MissingForm& a, const MissingForm& b) const;

  /// Fits the shapes of one form. @return the residual.
  double polish(EquationForms& equation, std::size_t place, const ShapeFit& fit = {}) const;

  /// The residual with each of the starting points more: starts x equations; infinite where an
  /// equation asks for less than the form leaves or takes. Columns of the starting points are
  /// made once for all equations.
  Matrix rated(const std::vector<Beside>& equations, const std::vector<Start>& starts) const;

 private:
  /// The equation without that member, the last form apart, that is missed least.
  /// @param members its columns; the same of what is returned.
  Trial without_least(const EquationForms& equation, Matrix& members) const;

  /// Fits the shapes of a form beside columns that stay. @return the residual.
  double fit_shapes(const BaseColumns& base, MissingForm& form, const ShapeFit& fit) const;

  const FormRows rows_;
  const ColumnMemory columns_;  ///< of starting points
  const Vector noise_;
  const FormOptions options_;
  RunContext context_;
};

}  // namespace lacuna
