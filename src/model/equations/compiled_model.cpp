// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
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

  /// @param target where the sum of the row goes.
  void end_row(std::size_t target) { rows_.push_back({target, entries_.size()}); }

  CompiledModel::Sums build(const Variables& variables) {
    return {Program(distinct_, variables), std::move(entries_), std::move(rows_),
            std::vector<double>(distinct_.size())};
  }

 private:
  struct Hash {
    std::size_t operator()(const Expression& e) const noexcept { return e.hash(); }
  };

  std::vector<Expression> distinct_;
  std::unordered_map<Expression, std::size_t, Hash> numbers_;
  std::vector<CompiledModel::Sums::Entry> entries_;
  std::vector<CompiledModel::Sums::Row> rows_;
};

CompiledModel::CompiledModel(const OdeModel& model)
    : dimension_(model.dimension()),
      input_count_(static_cast<Index>(model.inputs().size())),
      rate_(compile_rate(model)),
      model_(std::make_shared<const OdeModel>(model)),
      slots_(static_cast<std::size_t>(rate_.program.slots())) {}

CompiledModel::Sums CompiledModel::compile_rate(const OdeModel& model) {
  SumBuilder builder;
  std::size_t row = 0;
  for (const Equation& equation : model.equations()) {
    for (const WeightedTerm& summand : equation)
      builder.add(summand.coefficient, summand.term.expression());
    builder.end_row(row++);
  }
  return builder.build(model.variables());
}

/// Rows are the entries of the Jacobian that can be other than 0; it is stored by columns.
CompiledModel::Sums CompiledModel::compile_jacobian(const OdeModel& model) {
  SumBuilder builder;
  const std::size_t dimension = model.states().size();
  const VariableIndex index(model.variables());
  std::map<std::size_t, std::vector<const WeightedTerm*>> entries;
  for (std::size_t k = 0; k < dimension; ++k)
    for (const WeightedTerm& summand : model.equations()[k])
      for (const std::string& name : summand.term.expression().variables())
        if (const Index slot = *index.find(name); slot < index.states())
          entries[static_cast<std::size_t>(slot) * dimension + k].push_back(&summand);
  for (const auto& [target, summands] : entries) {
    for (const WeightedTerm* summand : summands) {
      const Expression derivative =
          differentiate(summand->term.expression(), index.names()[target / dimension]);
      if (!is_number(derivative, 0.0)) builder.add(summand->coefficient, derivative);
    }
    builder.end_row(target);
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

template <class Put>
void CompiledModel::add_up(Sums& sums, Put put) {
  sums.program.evaluate(slots_.data(), sums.values.data(), workspace_);
  const Sums::Entry* entry = sums.entries.data();
  for (const Sums::Row& row : sums.rows) {
    double sum = 0.0;
    for (const Sums::Entry* end = sums.entries.data() + row.end; entry != end; ++entry)
      sum += entry->coefficient * sums.values[entry->value];
    put(row.target, sum);
  }
}

void CompiledModel::evaluate(double t, const double* x, const double* u, const double* delayed,
                             double* dxdt) {
  fill_slots(t, x, u);
  std::copy_n(delayed, delays().size(), slots_.data() + dimension_ + input_count_ + 1);
  add_up(rate_, [&](std::size_t row, double sum) { dxdt[row] = sum; });
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
  derivative.setZero();
  add_up(*jacobian_, [&](std::size_t target, double sum) {
    const auto place = static_cast<Index>(target);
    derivative(place % dimension_, place / dimension_) = sum;
  });
}

}  // namespace lacuna
