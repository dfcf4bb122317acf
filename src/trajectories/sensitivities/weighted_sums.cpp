// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/weighted_sums.hpp"

namespace lacuna {
Index ExpressionList::number_of(const Expression& e) {
  const auto [place, is_new] = numbers_.try_emplace(e, static_cast<Index>(list_.size()));
  if (is_new) list_.push_back(e);
  return place->second;
}

Index ExpressionList::append(const Expression& e) {
  const auto number = static_cast<Index>(list_.size());
  numbers_.try_emplace(e, number);
  list_.push_back(e);
  return number;
}

void WeightedSums::add(Index value, double weight, std::optional<Index> parameter) {
  summands_.push_back({value, weight, parameter});
}

void WeightedSums::set(const Eigen::Ref<const Vector>& parameters) {
  for (Summand& summand : summands_)
    if (summand.parameter) summand.weight = parameters[*summand.parameter];
}

void WeightedSums::apply(const Eigen::Ref<const Matrix>& values, Eigen::Ref<Matrix> out) const {
  apply([&](Index value) { return values.col(value).data(); }, out);
}

void WeightedSums::apply(FunctionRef<const double*(Index)> column_of,
                         Eigen::Ref<Matrix> out) const {
  std::size_t i = 0;
  for (std::size_t sum = 0; sum < ends_.size(); ++sum) {
    auto column = out.col(static_cast<Index>(sum));
    bool empty = true;
    for (; i < ends_[sum]; ++i) {
      const Summand& s = summands_[i];
      if (s.weight == 0.0) continue;
      const Eigen::Map<const Vector> values(column_of(s.value), out.rows());
      if (empty)
        column = s.weight * values;
      else
        column += s.weight * values;
      empty = false;
    }
    if (empty) column.setZero();
  }
}

void WeightedSums::apply(const double* values, double* out) const {
  std::size_t i = 0;
  for (const std::size_t end : ends_) {
    double sum = 0.0;
    for (; i < end; ++i)
      if (summands_[i].weight != 0.0) sum += summands_[i].weight * values[summands_[i].value];
    *out++ = sum;
  }
}

void add_derivatives(const RateForm& form, const std::string& variable, Index column,
                     ExpressionList& expressions, PlacedSums& derivatives) {
  for (std::size_t k = 0; k < form.size(); ++k) {
    bool any = false;
    for (const RateSummand& summand : form[k]) {
      const Expression derivative = differentiate(summand.term, variable);
      if (is_number(derivative, 0.0)) continue;
      derivatives.sums.add(expressions.number_of(derivative), summand.weight,
                           summand.parameter);
      any = true;
    }
    if (!any) continue;
    derivatives.sums.end_sum();
    derivatives.places.push_back({static_cast<Index>(k), column});
  }
}

}  // namespace lacuna
