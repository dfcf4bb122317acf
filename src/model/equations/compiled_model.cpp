// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_map>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {
/// Collects rows of coefficient times expression; equal expressions are evaluated once.
class SumBuilder {
 public:
  /// One more summand of the row that is being built.
  void add(double coefficient, const Expression& expression) {
    if (coefficient == 0.0) return;
    const auto [place, is_new] = numbers_.try_emplace(expression, distinct_.size());
    if (is_new) distinct_.push_back(expression);
    entries_.push_back({coefficient, place->second});
  }

  void end_row() { row_ends_.push_back(entries_.size()); }

  CompiledModel::Sums build(const Variables& variables) {
    return {Program(distinct_, variables), std::move(entries_), std::move(row_ends_),
            std::vector<double>(distinct_.size())};
  }

 private:
  struct Hash {
    std::size_t operator()(const Expression& e) const noexcept { return e.hash(); }
  };

  std::vector<Expression> distinct_;
  std::unordered_map<Expression, std::size_t, Hash> numbers_;
  std::vector<CompiledModel::Sums::Entry> entries_;
  std::vector<std::size_t> row_ends_;
};

CompiledModel::CompiledModel(const OdeModel& model)
    : dimension_(model.dimension()),
      input_count_(static_cast<Index>(model.inputs().size())),
      rate_(compile_rate(model)),
      model_(std::make_shared<const OdeModel>(model)),
      slots_(static_cast<std::size_t>(rate_.program.slots())),
      entries_(static_cast<std::size_t>(dimension_ * dimension_)) {}

CompiledModel::Sums CompiledModel::compile_rate(const OdeModel& model) {
  SumBuilder builder;
  for (const Equation& equation : model.equations()) {
    for (const WeightedTerm& summand : equation)
      builder.add(summand.coefficient, summand.term.expression());
    builder.end_row();
  }
  return builder.build(model.variables());
}

/// Rows are the entries of the Jacobian, column by column.
CompiledModel::Sums CompiledModel::compile_jacobian(const OdeModel& model) {
  SumBuilder builder;
  for (const Quantity& state : model.states()) {
    for (const Equation& equation : model.equations()) {
      for (const WeightedTerm& summand : equation) {
        const Expression derivative = differentiate(summand.term.expression(), state.name);
        if (!is_number(derivative, 0.0)) builder.add(summand.coefficient, derivative);
      }
      builder.end_row();
    }
  }
  return builder.build(model.variables());
}

void CompiledModel::fill_slots(double t, const double* x, const double* u) {
  double* slot = std::copy_n(x, dimension_, slots_.data());
  slot = std::copy_n(u, input_count_, slot);
  *slot = t;
}

/// The Jacobian may need fewer delayed variables than f does, in another order.
void CompiledModel::fill_delays(const Program& program, const double* delayed) {
  double* slot = slots_.data() + dimension_ + input_count_ + 1;
  for (const DelayedVariable& wanted : program.delays())
    *slot++ = delayed[std::find(delays().begin(), delays().end(), wanted) - delays().begin()];
}

void CompiledModel::add_up(Sums& sums, double* out) {
  sums.program.evaluate(slots_.data(), sums.values.data(), workspace_);
  const Sums::Entry* entry = sums.entries.data();
  for (const std::size_t row_end : sums.row_ends) {
    double sum = 0.0;
    for (const Sums::Entry* end = sums.entries.data() + row_end; entry != end; ++entry)
      sum += entry->coefficient * sums.values[entry->value];
    *out++ = sum;
  }
}

void CompiledModel::evaluate(double t, const double* x, const double* u, const double* delayed,
                             double* dxdt) {
  fill_slots(t, x, u);
  std::copy_n(delayed, delays().size(), slots_.data() + dimension_ + input_count_ + 1);
  add_up(rate_, dxdt);
}

void CompiledModel::jacobian(double t, const double* x, const double* u, const double* delayed,
                             Eigen::Ref<Matrix> derivative) {
  if (derivative.rows() != dimension_ || derivative.cols() != dimension_)
    throw ArgumentError("CompiledModel::jacobian",
                        "the matrix is " + std::to_string(derivative.rows()) + " x " +
                            std::to_string(derivative.cols()),
                        "give one row and one column per state");
  if (!jacobian_) jacobian_ = compile_jacobian(*model_);
  fill_slots(t, x, u);
  fill_delays(jacobian_->program, delayed);
  add_up(*jacobian_, entries_.data());
  derivative = Eigen::Map<const Matrix>(entries_.data(), dimension_, dimension_);
}

}  // namespace lacuna
