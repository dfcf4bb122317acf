// SPDX-License-Identifier: MIT
#include "trajectories/smoother/innovation_system.hpp"

namespace lacuna {

InnovationSystem::InnovationSystem(const Assimilation& assimilation)
    : assimilation_(&assimilation), offsets_{0} {
  for (std::size_t r = 0; r < assimilation.records.size(); ++r) {
    const Matrix none;
    const Matrix& omitted = assimilation.omitted.empty() ? none : assimilation.omitted[r];
    filters_.push_back(run_filter(assimilation.records[r], assimilation.measured[r], omitted,
                                  assimilation.noise));
    offsets_.push_back(offsets_.back() + filters_.back().innovations.size());
    deviance_ += filters_.back().deviance;
    used_ += filters_.back().used;
  }
  innovations_.resize(offsets_.back());
  for (std::size_t r = 0; r < filters_.size(); ++r)
    innovations_.segment(offsets_[r], offsets_[r + 1] - offsets_[r]) =
        filters_[r].innovations.reshaped();
}

Matrix InnovationSystem::rate_columns(Index equation, const std::vector<Matrix>& values) const {
  Matrix columns(rows(), values.front().cols());
  for (std::size_t r = 0; r < filters_.size(); ++r)
    column_response(assimilation_->records[r], filters_[r], equation, values[r],
                    columns.middleRows(offsets_[r], offsets_[r + 1] - offsets_[r]));
  return columns;
}

Matrix InnovationSystem::channel_columns(Index state, const std::vector<Matrix>& values) const {
  Matrix columns(rows(), values.front().cols());
  for (std::size_t r = 0; r < filters_.size(); ++r)
    channel_response(assimilation_->records[r], filters_[r], state, values[r],
                     columns.middleRows(offsets_[r], offsets_[r + 1] - offsets_[r]));
  return columns;
}

std::vector<TermValues> InnovationSystem::free_terms() const {
  const OdeModel& model = assimilation_->model;
  std::vector<TermValues> values(static_cast<std::size_t>(model.dimension()));
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::vector<Expression> terms;
    for (const CoefficientPlace& place : assimilation_->free)
      if (place.equation == static_cast<Index>(k))
        terms.push_back(
            model.equations()[k][static_cast<std::size_t>(place.term)].term.expression());
    if (terms.empty()) continue;
    for (const LinearisedRecord& record : assimilation_->records)
      values[k].push_back(evaluate_on(record, model.variables(), terms));
  }
  return values;
}

Vector InnovationSystem::channel_term_column(const ChannelTerm& term) const {
  std::vector<Matrix> values;
  for (const LinearisedRecord& record : assimilation_->records)
    values.push_back(
        evaluate_on(record, assimilation_->model.variables(), term.form)(record.sample_rows()));
  return channel_columns(term.state, values);
}

Matrix InnovationSystem::fitted_columns(const std::vector<TermValues>& values) const {
  const std::vector<CoefficientPlace>& free = assimilation_->free;
  const std::vector<ChannelTerm>& terms = assimilation_->channel_terms;
  Matrix columns(rows(), static_cast<Index>(free.size() + terms.size()));
  for (Index k = 0; k < assimilation_->model.dimension(); ++k) {
    const TermValues& along = values[static_cast<std::size_t>(k)];
    if (along.empty()) continue;
    const Matrix own = rate_columns(k, along);
    Index next = 0;
    for (std::size_t j = 0; j < free.size(); ++j)
      if (free[j].equation == k) columns.col(static_cast<Index>(j)) = own.col(next++);
  }
  auto next = static_cast<Index>(free.size());
  for (const ChannelTerm& term : terms) columns.col(next++) = channel_term_column(term);
  return columns;
}

}  // namespace lacuna
