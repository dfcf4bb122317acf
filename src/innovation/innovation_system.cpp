// SPDX-License-Identifier: MIT
#include "lacuna/innovation/innovation_system.hpp"

namespace lacuna {

InnovationSystem::InnovationSystem(const Assimilation& assimilation)
    : records_(&assimilation.records), model_(&assimilation.model), offsets_{0} {
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
    column_response((*records_)[r], filters_[r], equation, values[r], out);
  }
  return column;
}

Vector InnovationSystem::channel_column(Index state, const std::vector<Vector>& values) const {
  Vector column(rows());
  for (std::size_t r = 0; r < filters_.size(); ++r) {
    const Matrix& shape = filters_[r].innovations;
    Eigen::Map<Matrix> out(column.data() + offsets_[r], shape.rows(), shape.cols());
    channel_response((*records_)[r], filters_[r], state, values[r], out);
  }
  return column;
}

Matrix InnovationSystem::model_columns(const std::vector<CoefficientPlace>& places) const {
  Matrix columns(rows(), static_cast<Index>(places.size()));
  for (std::size_t j = 0; j < places.size(); ++j) {
    const Term& term = model_
                           ->equations()[static_cast<std::size_t>(places[j].equation)]
                                        [static_cast<std::size_t>(places[j].term)]
                           .term;
    std::vector<Vector> values;
    for (const LinearisedRecord& record : *records_)
      values.push_back(evaluate_on(record, model_->variables(), term.expression()));
    columns.col(static_cast<Index>(j)) = rate_column(places[j].equation, values);
  }
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
