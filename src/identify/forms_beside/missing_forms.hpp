// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/model/equations/term.hpp"

namespace lacuna {

/// A form that a library lacks in one equation, with numbers for its shapes.
struct MissingForm {
  Candidate candidate;
  Vector shapes;

  Expression expression() const;
};

/// An equation as far as its structure is known: terms of a library and forms beside them.
struct EquationForms {
  Index equation = 0;
  std::vector<Term> terms;
  std::vector<MissingForm> forms;

  /// Coefficients and shapes.
  std::size_t parameters() const;
};

class FormProblem;
struct Trial;
struct Limit;

/// Which plain forms may take the place of others.
enum class Plainness {
  Jump,  ///< sign(w) for tanh(w/width) of a width that hardly a sample sees
  Any,   ///< sin(x) for sin(x/1.001)
};

/// What an equation leaves, as far as it is known.
enum class Remainder {
  Unknown,
  Noise,  ///< its trajectories are off by no more than noise: so is what it leaves in the rows
};

/// The search for forms in the weak form of a dataset, whose rows are white for white noise.
/// Shapes are fitted by variable projection: for each of their values coefficients are those of
/// least squares (Golub & Pereyra, SIAM J. Numer. Anal. 10 (1973) 413). Residuals that differ
/// by less than FormOptions::same (rms) are the same.
class FormSearch {
 public:
  /// @param noise of each state, state units. @param library terms whose rows are made once.
  /// @param seen white noise as the samples show it (estimate_noise()), where it is known.
  FormSearch(const Dataset& data, Vector noise, FormOptions options = {},
             RunContext context = {}, const std::vector<Term>& library = {},
             const std::optional<Vector>& seen = {});
  ~FormSearch();

  /// Rows of the weak form; a search needs more of them than terms.
  Index rows() const;

  /// |y - A h|^2 of an equation in these rows.
  double left(const EquationForms& equation) const;

  /// Whether a form that leaves no more than this fraction of what an equation leaves (sums of
  /// squares) would fit noise: white noise of the samples in the target and, by its derivatives,
  /// in the terms leaves more, with its mean less two standard deviations. Never where rates
  /// are measured.
  bool would_fit_noise(const EquationForms& equation, double fraction) const;

  /// Fractions with denominators in several variables, found in the implicit form of an
  /// equation, as further candidates.
  std::vector<Candidate> fractions(const Scope& scope, Index equation,
                                   const std::vector<Term>& library) const;

  /// Forcing from outside (forcing_forms()) beside a library, as further candidates.
  std::vector<Candidate> tones(const Scope& scope, Index equation,
                               const std::vector<Term>& library) const;

  /// Puts forms beside the whole library and the forms of an equation, and then drops what is
  /// not needed to leave as little: what other forms or a Taylor series stood for goes.
  /// @param negligible fraction of the target (rms) that is no form: errors of solvers.
  /// @return the library alone where it leaves no more than that.
  EquationForms recomposed(const EquationForms& equation,
                           const std::vector<Candidate>& candidates,
                           const std::vector<Term>& library, double negligible) const;

  /// Takes in the candidate that leaves least beside what is there, the plainest of those that
  /// leave the same, as long as more than noise is left and forms take something away.
  /// @param most_residual fraction of the residual (rms) that a form has to leave at most; 1: any
  ///   may be taken in.
  EquationForms with_missing_forms(EquationForms equation,
                                   const std::vector<Candidate>& candidates,
                                   std::size_t most_forms, double most_residual = 1.0) const;

  /// Looks for a form beside which so many terms and forms may leave that fewer parameters
  /// are equivalent: sin(x) for x, x^3, x*y^2, beside what the equation has, beside the
  /// constant and the variables, and beside terms of a library.
  /// @param negligible as of recomposed(): what it describes needs no parameters.
  /// @return the equation with the fewest.
  EquationForms with_fewer_terms(EquationForms equation,
                                 const std::vector<Candidate>& candidates,
                                 const std::vector<Term>& library,
                                 Remainder remainder = Remainder::Unknown,
                                 double negligible = 0.0) const;

  /// Puts candidates without shapes in the place of single terms and forms, the one that leaves
  /// least first, as long as each halves what more than noise is left (rms): x*cos(x) for x
  /// beside sin(x), of which x was the first of a series. In the place of a form with shapes
  /// where after such exchanges the same is left. No parameter more.
  EquationForms exchanged(const EquationForms& equation,
                          const std::vector<Candidate>& candidates) const;

  /// The equation with plain forms in the place of shaped ones that are nearly the same at the
  /// samples. Nothing where there is none.
  std::optional<EquationForms> plainer(const EquationForms& equation,
                                       const std::vector<Candidate>& candidates,
                                       Plainness kind) const;

  /// The equation with a form of fewer shapes in the place of each that has two or more, the
  /// one that leaves least. Nothing where no form has as many.
  std::optional<EquationForms> with_fewer_shapes(
      const EquationForms& equation, const std::vector<Candidate>& candidates) const;

  /// The equation in the plainer of two parametrisations: with the rest m - f of a term m in
  /// the place of a form f where less of m stays, c m + d f = (c + d) m - d (m - f);
  /// prey*fox/(a+prey) for fox and fox/(1+prey/a) that nearly cancel.
  /// @param coefficients of the terms, then of the forms. @param candidates that may be m - f.
  EquationForms plainly_written(EquationForms equation, const Vector& coefficients,
                                const std::vector<Candidate>& candidates) const;

  /// The forms of all equations, each once: what one equation takes from a state another one
  /// gives to the next. Of those that differ by nothing but shapes, and hardly at the samples,
  /// the first stands for all: two would say together what none of them says.
  std::vector<MissingForm> shared_forms(const std::vector<EquationForms>& equations) const;

  /// The equation with its shapes fitted.
  EquationForms refitted(EquationForms equation) const;

 private:
  /// Takes in candidates as with_missing_forms(), as long as more than `least` is left.
  EquationForms extended(EquationForms equation, const std::vector<Candidate>& candidates,
                         std::size_t most_forms, double least, double most_residual = 1.0) const;

  /// @param plain candidates without shapes.
  EquationForms with_exchanges(EquationForms equation,
                               const std::vector<Candidate>& plain) const;

  /// The most that an equation leaves that fits to so much noise (sums of squares).
  double fitting(double noise) const;

  /// The sum of squares that is this fraction (rms) of the target.
  double squares_of(double fraction, Index equation) const;

  /// The equation with one more form of the candidates that needs the fewest parameters to stay
  /// within a limit; infinite where none does.
  Trial fewest_beside(const EquationForms& others, const std::vector<Candidate>& candidates,
                      const Limit& limit) const;

  std::unique_ptr<const FormProblem> problem_;
};

}  // namespace lacuna
