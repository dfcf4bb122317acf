// SPDX-License-Identifier: MIT
#include "rates.hpp"

#include <algorithm>
#include <unordered_map>

namespace lacuna {
namespace {

struct ExpressionHash {
  std::size_t operator()(const Expression& e) const noexcept { return e.hash(); }
};

bool is_zero(const Expression& e) {
  return e.operation() == Operation::Number && e.value() == 0.0;
}

/// Distinct expressions and their numbers.
class ExpressionList {
 public:
  Index number_of(const Expression& e) {
    const auto [place, is_new] = numbers_.try_emplace(e, static_cast<Index>(list_.size()));
    if (is_new) list_.push_back(e);
    return place->second;
  }
  const std::vector<Expression>& list() const noexcept { return list_; }

 private:
  std::vector<Expression> list_;
  std::unordered_map<Expression, Index, ExpressionHash> numbers_;
};

void resize_rows(Matrix& matrix, Index rows, Index columns) {
  if (matrix.rows() < rows || matrix.cols() != columns) matrix.resize(rows, columns);
}

}  // namespace

void WeightedSums::add(Index value, double weight, std::optional<Index> parameter) {
  summands_.push_back({value, weight, parameter});
}

void WeightedSums::set(const Vector& parameters) {
  for (Summand& summand : summands_)
    if (summand.parameter) summand.weight = parameters[*summand.parameter];
}

void WeightedSums::apply(const Eigen::Ref<const Matrix>& values, Eigen::Ref<Matrix> out) const {
  std::size_t begin = 0;
  for (std::size_t sum = 0; sum < ends_.size(); begin = ends_[sum++]) {
    auto column = out.col(static_cast<Index>(sum));
    if (begin == ends_[sum]) column.setZero();
    for (std::size_t i = begin; i < ends_[sum]; ++i) {
      const Summand& s = summands_[i];
      if (i == begin) {
        column = s.weight * values.col(s.value);
      } else if (s.weight != 0.0) {
        column += s.weight * values.col(s.value);
      }
    }
  }
}

void WeightedSums::apply(const double* values, double* out) const {
  std::size_t i = 0;
  for (const std::size_t end : ends_) {
    double sum = 0.0;
    for (; i < end; ++i) sum += summands_[i].weight * values[summands_[i].value];
    *out++ = sum;
  }
}

/// Writes the sums of a model's rates and derivatives over one list of expressions.
class RatesBuilder {
 public:
  RatesBuilder(Rates& rates, const ParametrisedModel& model) : rates_(rates), model_(model) {
    for (const Equation& equation : model.symbolic().equations())
      parameters_.emplace_back(equation.size());
    Index number = 0;
    for (const FreeCoefficient& c : model.coefficients())
      parameters_[static_cast<std::size_t>(c.equation)][static_cast<std::size_t>(c.summand)] =
          number++;
  }

  void build(std::span<const CandidateColumn> extra) {
    add_rates();
    const Variables variables = model_.symbolic().variables();
    rates_.rate_ = Program(expressions_.list(), variables);
    add_jacobian();
    add_columns();
    for (const CandidateColumn& candidate : extra)
      add_column(candidate.equation, candidate.expression);
    rates_.full_ = Program(expressions_.list(), variables);
  }

 private:
  void add_rates() {
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
      add_sum(rates_.rate_sums_, k, [](const Expression& e) { return e; });
      rates_.rate_sums_.end_sum();
    }
  }

  void add_jacobian() {
    const OdeModel& model = model_.symbolic();
    for (Index j = 0; j < model.dimension(); ++j) {
      const std::string& name = model.states()[static_cast<std::size_t>(j)].name;
      add_derivative(rates_.jacobian_sums_, rates_.jacobian_places_, name, j);
    }
  }

  void add_columns() {
    for (const FreeCoefficient& c : model_.coefficients())
      add_column(c.equation, model_.symbolic()
                                 .equations()[static_cast<std::size_t>(c.equation)]
                                             [static_cast<std::size_t>(c.summand)]
                                 .term.expression());
    for (const FreeShape& shape : model_.shapes())
      add_derivative(rates_.column_sums_, rates_.column_places_, shape.name,
                     rates_.column_count_++);
  }

  void add_column(Index equation, const Expression& expression) {
    rates_.column_sums_.add(expressions_.number_of(expression), 1.0);
    rates_.column_sums_.end_sum();
    rates_.column_places_.push_back({equation, rates_.column_count_++});
  }

  /// One column of derivatives with respect to a variable.
  void add_derivative(WeightedSums& sums, std::vector<MatrixPlace>& places,
                      const std::string& name, Index column) {
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
      const bool any =
          add_sum(sums, k, [&](const Expression& e) { return differentiate(e, name); });
      if (!any) continue;
      sums.end_sum();
      places.push_back({static_cast<Index>(k), column});
    }
  }

  /// Sum of weighted expressions made from the terms of equation k; whether there is any.
  template <class Make>
  bool add_sum(WeightedSums& sums, std::size_t k, Make make) {
    bool any = false;
    const Equation& equation = model_.symbolic().equations()[k];
    for (std::size_t i = 0; i < equation.size(); ++i) {
      const Expression e = make(equation[i].term.expression());
      if (is_zero(e)) continue;
      sums.add(expressions_.number_of(e), equation[i].coefficient, parameters_[k][i]);
      any = true;
    }
    return any;
  }

  Rates& rates_;
  const ParametrisedModel& model_;
  ExpressionList expressions_;
  std::vector<std::vector<std::optional<Index>>> parameters_;  // of each summand
};

Rates::Rates(const ParametrisedModel& model, std::span<const CandidateColumn> extra)
    : dimension_(model.symbolic().dimension()),
      record_inputs_(model.record_inputs()),
      shape_count_(static_cast<Index>(model.shapes().size())),
      rate_({}, model.symbolic().variables()),
      full_({}, model.symbolic().variables()),
      shape_values_(shape_count_) {
  RatesBuilder(*this, model).build(extra);
  point_values_.resize(static_cast<std::size_t>(rate_.outputs()));
  set(model.values());
}

void Rates::set(const Vector& parameters) {
  rate_sums_.set(parameters);
  jacobian_sums_.set(parameters);
  column_sums_.set(parameters);
  shape_values_ = parameters.tail(shape_count_);
}

void Rates::fill_signals(const Eigen::Ref<const Matrix>& signals,
                         Eigen::Ref<Matrix> slots) const {
  const Index shapes = dimension_ + record_inputs_, after = signals.cols() - record_inputs_;
  slots.middleCols(dimension_, record_inputs_) = signals.leftCols(record_inputs_);
  for (Index i = 0; i < shape_count_; ++i) slots.col(shapes + i).setConstant(shape_values_[i]);
  slots.middleCols(shapes + shape_count_, after) = signals.rightCols(after);
}

void Rates::fill_signals(const double* signals, Index stride, double* slots) const {
  slots += dimension_;
  const Index count = this->signals();
  Index i = 0;
  for (; i < record_inputs_; ++i) *slots++ = signals[i * stride];
  slots = std::copy_n(shape_values_.data(), shape_count_, slots);
  for (; i < count; ++i) *slots++ = signals[i * stride];
}

void Rates::rate(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> f) {
  resize_rows(rate_values_, slots.rows(), rate_.outputs());
  auto values = rate_values_.topRows(slots.rows());
  rate_.evaluate(slots.leftCols(rate_.slots()), values, workspace_);
  rate_sums_.apply(values, f);
}

void Rates::rate(const double* slots, double* f) {
  rate_.evaluate(slots, point_values_.data(), workspace_);
  rate_sums_.apply(point_values_.data(), f);
}

void Rates::derivatives(const Eigen::Ref<const Matrix>& slots, Eigen::Ref<Matrix> jacobian,
                        Eigen::Ref<Matrix> columns) {
  resize_rows(full_values_, slots.rows(), full_.outputs());
  auto values = full_values_.topRows(slots.rows());
  full_.evaluate(slots, values, workspace_);
  jacobian_sums_.apply(values, jacobian);
  column_sums_.apply(values, columns);
}

}  // namespace lacuna
