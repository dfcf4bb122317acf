// SPDX-License-Identifier: MIT
#include "lacuna/innovation/innovation_system.hpp"

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

Vector InnovationSystem::rate_column(Index equation, const std::vector<Vector>& values) const {
  Vector column(rows());
  for (std::size_t r = 0; r < filters_.size(); ++r) {
    const Matrix& shape = filters_[r].innovations;
    Eigen::Map<Matrix> out(column.data() + offsets_[r], shape.rows(), shape.cols());
    column_response(assimilation_->records[r], filters_[r], equation, values[r], out);
  }
  return column;
}

Vector InnovationSystem::channel_column(Index state, const std::vector<Vector>& values) const {
  Vector column(rows());
  for (std::size_t r = 0; r < filters_.size(); ++r) {
    const Matrix& shape = filters_[r].innovations;
    Eigen::Map<Matrix> out(column.data() + offsets_[r], shape.rows(), shape.cols());
    channel_response(assimilation_->records[r], filters_[r], state, values[r], out);
  }
  return column;
}

Vector InnovationSystem::term_column(const CoefficientPlace& place) const {
  const OdeModel& model = assimilation_->model;
  const Term& term = model
                         .equations()[static_cast<std::size_t>(place.equation)]
                                     [static_cast<std::size_t>(place.term)]
                         .term;
  std::vector<Vector> values;
  for (const LinearisedRecord& record : assimilation_->records)
    values.push_back(evaluate_on(record, model.variables(), term.expression()));
  return rate_column(place.equation, values);
}

Vector InnovationSystem::channel_term_column(const ChannelTerm& term) const {
  std::vector<Vector> values;
  for (const LinearisedRecord& record : assimilation_->records)
    values.push_back(evaluate_on(record, assimilation_->model.variables(),
                                 term.form)(Eigen::seq(0, Eigen::last, 2)));
  return channel_column(term.state, values);
}

Matrix InnovationSystem::fitted_columns() const {
  const std::vector<CoefficientPlace>& free = assimilation_->free;
  const std::vector<ChannelTerm>& terms = assimilation_->channel_terms;
  Matrix columns(rows(), static_cast<Index>(free.size() + terms.size()));
  Index next = 0;
  for (const CoefficientPlace& place : free) columns.col(next++) = term_column(place);
  for (const ChannelTerm& term : terms) columns.col(next++) = channel_term_column(term);
  return columns;
}

Vector evaluate_on(const LinearisedRecord& record, const Variables& variables,
                   const Expression& formula) {
  const Program program({&formula, 1}, variables);
  Program::Workspace workspace;
  Matrix out(record.slots.rows(), 1);
  if (program.delays().empty())
    program.evaluate(record.slots, out, workspace);
  else
    program.evaluate(with_delays(record, program.delays()), out, workspace);
  return out.col(0);
}

}  // namespace lacuna
