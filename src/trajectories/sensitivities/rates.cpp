// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/rates.hpp"

#include <algorithm>
#include <utility>

#include "model/expressions/domain.hpp"

namespace lacuna {
namespace {

void resize_rows(Matrix& matrix, Index rows, Index columns) {
  if (matrix.rows() < rows || matrix.cols() != columns) matrix.resize(rows, columns);
}

RateForm form_of(const ParametrisedModel& model) {
  RateForm form;
  for (const Equation& equation : model.symbolic().equations()) {
    form.emplace_back();
    for (const WeightedTerm& summand : equation)
      form.back().push_back({summand.term.expression(), summand.coefficient, {}});
  }
  Index number = 0;
  for (const FreeCoefficient& c : model.coefficients())
    form[static_cast<std::size_t>(c.equation)][static_cast<std::size_t>(c.summand)].parameter =
        number++;
  return form;
}

/// The form with its terms as they are outside of their domain.
RateForm held(RateForm form, Outside outside, Expression (*in_domain)(const Expression&)) {
  if (outside == Outside::NotANumber) return form;
  for (auto& equation : form)
    for (RateSummand& summand : equation) summand.term = in_domain(summand.term);
  return form;
}

ExpressionList terms_of(const RateForm& form) {
  ExpressionList terms;
  for (const auto& equation : form)
    for (const RateSummand& summand : equation) terms.number_of(summand.term);
  return terms;
}

/// The sums in the order of the terms, so that memory is passed through once.
WeightedSums sums_of(const RateForm& form, ExpressionList& terms) {
  WeightedSums sums;
  for (const auto& equation : form) {
    std::vector<std::pair<Index, const RateSummand*>> summands;
    for (const RateSummand& summand : equation)
      summands.emplace_back(terms.number_of(summand.term), &summand);
    std::stable_sort(summands.begin(), summands.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [number, summand] : summands)
      sums.add(number, summand->weight, summand->parameter);
    sums.end_sum();
  }
  return sums;
}

}  // namespace

Rates::Rates(const ParametrisedModel& model, Outside outside)
    : variables_(model.symbolic().variables()),
      record_inputs_(model.record_inputs()),
      column_count_(model.size()),
      form_(held(form_of(model), outside, held_in_domain)),
      sloped_(held(form_of(model), outside, held_off_edges)),
      terms_(terms_of(form_)),
      rate_sums_(sums_of(form_, terms_)),
      rate_(terms_.list(), variables_),
      point_values_(static_cast<std::size_t>(rate_.outputs())) {
  for (const FreeCoefficient& c : model.coefficients())
    coefficients_.push_back({c.equation, c.summand});
  for (const FreeShape& shape : model.shapes()) shapes_.push_back(shape.name);
  set(model.values());
}

Rates::Rates(const OdeModel& model) : Rates(ParametrisedModel(model, {})) {}

void Rates::set(const Vector& parameters) {
  parameters_ = parameters;
  shape_values_ = parameters.tail(static_cast<Index>(shapes_.size()));
  rate_sums_.set(parameters);
  if (derivatives_) set_weights(*derivatives_);
}

void Rates::set_weights(Derivatives& derivatives) const {
  derivatives.jacobian.sums.set(parameters_);
  derivatives.columns.sums.set(parameters_);
}

Rates::Derivatives& Rates::compiled() {
  if (!derivatives_) {
    derivatives_ = compile();
    set_weights(*derivatives_);
  }
  return *derivatives_;
}

/// The terms come first, so that delayed variables have the slots that they have in f.
Rates::Derivatives Rates::compile() const {
  ExpressionList expressions = terms_;
  PlacedSums jacobian, columns;
  for (std::size_t j = 0; j < variables_.states.size(); ++j)
    add_derivatives(sloped_, variables_.states[j], static_cast<Index>(j), expressions, jacobian);
  Index column = 0;
  for (const TermColumn& c : coefficients_) {
    const RateSummand& summand =
        form_[static_cast<std::size_t>(c.equation)][static_cast<std::size_t>(c.summand)];
    columns.sums.add(expressions.number_of(summand.term), 1.0);
    columns.sums.end_sum();
    columns.places.push_back({c.equation, column++});
  }
  for (const std::string& shape : shapes_)
    add_derivatives(sloped_, shape, column++, expressions, columns);
  return {Program(expressions.list(), variables_), std::move(jacobian), std::move(columns), {}};
}

void Rates::fill_signals(const Eigen::Ref<const Matrix>& signals,
                         Eigen::Ref<Matrix> slots) const {
  const Index shapes = dimension() + record_inputs_, after = signals.cols() - record_inputs_;
  slots.middleCols(dimension(), record_inputs_) = signals.leftCols(record_inputs_);
  for (Index i = 0; i < shape_values_.size(); ++i)
    slots.col(shapes + i).setConstant(shape_values_[i]);
  slots.middleCols(shapes + shape_values_.size(), after) = signals.rightCols(after);
}

void Rates::fill_signals(const double* signals, Index stride, double* slots) const {
  slots += dimension();
  const Index count = this->signals();
  Index i = 0;
  for (; i < record_inputs_; ++i) *slots++ = signals[i * stride];
  slots = std::copy_n(shape_values_.data(), shape_values_.size(), slots);
  for (; i < count; ++i) *slots++ = signals[i * stride];
}

void Rates::rate(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> f) {
  resize_rows(rate_values_, slots.rows(), rate_.outputs());
  auto values = rate_values_.topRows(slots.rows());
  rate_.evaluate(slots, values, workspace_);
  rate_sums_.apply(values, f);
}

void Rates::rate(const Eigen::Ref<const Matrix>& slots, Program::Block& block,
                 Eigen::Ref<Matrix> f) const {
  rate_.evaluate(slots, block);
  add_up(block, f);
}

void Rates::rate_changed(const Eigen::Ref<const Matrix>& slots, Program::SlotSet changed,
                         Program::Block& block, Eigen::Ref<Matrix> f) const {
  rate_.evaluate_changed(slots, changed, block);
  add_up(block, f);
}

void Rates::add_up(const Program::Block& block, Eigen::Ref<Matrix> f) const {
  rate_sums_.apply([&](Index value) { return rate_.output(value, block); }, f);
}

void Rates::rate(const double* slots, double* f) {
  rate_.evaluate(slots, point_values_.data(), workspace_);
  rate_sums_.apply(point_values_.data(), f);
}

void Rates::derivatives(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> jacobian,
                        Eigen::Ref<Matrix> columns) {
  Derivatives& own = compiled();
  resize_rows(own.values, slots.rows(), own.program.outputs());
  auto values = own.values.topRows(slots.rows());
  own.program.evaluate(slots, values, workspace_);
  own.jacobian.sums.apply(values, jacobian);
  own.columns.sums.apply(values, columns);
}

}  // namespace lacuna
