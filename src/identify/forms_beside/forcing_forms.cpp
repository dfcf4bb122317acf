// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base_columns.hpp"
#include "core/base/parallel.hpp"
#include "forms/candidate/tone.hpp"
#include "product_forms.hpp"

namespace lacuna {
namespace {

/// The frequencies that records and rows resolve, in steps of a quarter of the resolution.
std::vector<double> frequencies_of(const Scope& scope, const FormRows& rows) {
  // Facts of the search: fewer periods are a trend; a row is a mean over a window.
  constexpr double kRowsOfAPeriod = 4.0, kStepsOfALine = 4.0;
  std::vector<double> all;
  const double most = static_cast<double>(rows.rows()) / kRowsOfAPeriod;
  for (double periods = kFewestPeriods; periods <= most; periods += 1.0 / kStepsOfALine)
    all.push_back(periods / scope.duration);
  return all;
}

/// m sin(2 pi f t) and m cos(2 pi f t).
std::vector<Expression> quadratures(const Expression& m, double frequency) {
  const Expression angle =
      Expression::number(2.0 * std::numbers::pi * frequency) * Expression::variable("t");
  return {m * Expression::make(Operation::Sin, {angle}),
          m * Expression::make(Operation::Cos, {angle})};
}

/// A line of the spectrum of what an equation leaves.
struct Peak {
  double frequency = 0.0;
  BaseColumns::Pair pair;
};

/// The lines that leave least, each less than its neighbours.
std::vector<Peak> peaks_of(const std::vector<Peak>& spectrum, std::size_t count) {
  std::vector<Peak> peaks;
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const double left = spectrum[i].pair.left;
    if (i > 0 && spectrum[i - 1].pair.left < left) continue;
    if (i + 1 < spectrum.size() && spectrum[i + 1].pair.left < left) continue;
    peaks.push_back(spectrum[i]);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const Peak& a, const Peak& b) { return a.pair.left < b.pair.left; });
  if (peaks.size() > count) peaks.resize(count);
  return peaks;
}

}  // namespace

std::vector<Candidate> forcing_forms(const Scope& scope, const FormRows& rows,
                                     const EquationForms& equation, std::size_t count,
                                     const RunContext& context) {
  std::vector<Candidate> result;
  if (!(scope.duration > 0.0)) return result;
  const BaseColumns base(rows.columns_of(equation.terms), rows.target(equation.equation));
  const std::vector<double> frequencies = frequencies_of(scope, rows);
  for (const Expression& m : monomials_of(scope, 1)) {
    std::vector<Peak> spectrum(frequencies.size());
    parallel_for(frequencies.size(), context.threads, [&](std::size_t i) {
      context.check_stop();
      const Matrix pair = rows.columns(quadratures(m, frequencies[i]));
      spectrum[i] = {frequencies[i], base.with_pair(pair.col(0), pair.col(1))};
    });
    for (const Peak& peak : peaks_of(spectrum, count)) {
      const double phase = std::atan2(peak.pair.second, peak.pair.first);
      Candidate tone = tone_candidate({equation.equation, peak.frequency, phase}, scope);
      if (!m.variables().empty()) tone.form = m * tone.form;
      tone.repeats = true;
      result.push_back(std::move(tone));
    }
  }
  return result;
}

}  // namespace lacuna
