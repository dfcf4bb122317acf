// SPDX-License-Identifier: MIT
#include "diagnose/candidates/candidate_column.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// The variables of a candidate's formulas: those of the model, its memory states as inputs.
Variables with_memory(const Candidate& candidate, const Variables& variables) {
  Variables all = variables;
  for (const MemoryState& memory : candidate.memory) all.inputs.push_back(memory.name);
  return all;
}

/// The slots of a record with columns for memory states before the time.
Matrix with_memory(const Matrix& slots, const Matrix& memory) {
  const Index width = slots.cols() - 1;
  Matrix all(slots.rows(), slots.cols() + memory.cols());
  all << slots.leftCols(width), memory, slots.col(width);
  return all;
}

/// (exp(x) - 1) / x.
double growth(double x) { return std::abs(x) < 1e-8 ? 1.0 + 0.5 * x : std::expm1(x) / x; }

/// growth() of numbers that are mostly the one before.
class Growth {
 public:
  double operator()(double x) {
    if (x != last_) {
      last_ = x;
      value_ = growth(x);
    }
    return value_;
  }

 private:
  double last_ = 0.0, value_ = 1.0;
};

/// Rates of the memory states, and the derivatives of each with all of them.
struct MemoryRates {
  std::vector<Expression> rates, derivatives;  ///< K, K x K row by row
  bool affine = true;                          ///< whether no derivative depends on memory
};

MemoryRates memory_rates(const Candidate& candidate, std::span<const double> shapes) {
  MemoryRates result;
  for (const MemoryState& memory : candidate.memory) {
    result.rates.push_back(bind_formula(candidate, memory.rate, shapes));
    for (const MemoryState& other : candidate.memory) {
      result.derivatives.push_back(differentiate(result.rates.back(), other.name));
      for (const MemoryState& any : candidate.memory)
        result.affine =
            result.affine && !result.derivatives.back().variables().contains(any.name);
    }
  }
  return result;
}

/// The middles between rows of the slots of a record with columns for memory, which is 0.
Matrix middles(const Matrix& slots, Index count) {
  const Index rows = slots.rows() - 1, width = slots.cols() - 1;
  Matrix points = Matrix::Zero(rows, width + count + 1);
  points.leftCols(width) =
      0.5 * (slots.topRows(rows).leftCols(width) + slots.bottomRows(rows).leftCols(width));
  const auto before = slots.col(width).head(rows), after = slots.col(width).tail(rows);
  points.col(width + count) = before + 0.5 * (after - before);
  return points;
}

/// Delayed variables of a program at the rows of the slots of a record.
Matrix delayed_at_rows(const Program& program, const LinearisedRecord& record) {
  return delayed_step_slots(record.slots, record.grid, program.delays());
}

/// The same in the middles between rows.
Matrix delayed_in_middles(const Program& program, const LinearisedRecord& record) {
  const Matrix delayed = delayed_at_rows(program, record);
  const Index rows = delayed.rows() - 1;
  return 0.5 * (delayed.topRows(rows) + delayed.bottomRows(rows));
}

/// Memory whose rates are linear in it, r + A y, over all steps of a grid: r and A are computed
/// for many rows at once.
void write_affine(const MemoryRates& memory, const Variables& variables,
                  const LinearisedRecord& record, Matrix& values) {
  const Matrix& slots = record.slots;
  const Index count = values.cols(), rows = slots.rows() - 1;
  std::vector<Expression> formulas = memory.rates;
  formulas.insert(formulas.end(), memory.derivatives.begin(), memory.derivatives.end());
  const Program program(formulas, variables);
  Program::Workspace workspace;
  Matrix points(rows, program.slots()), out(rows, program.outputs());
  points << middles(slots, count), delayed_in_middles(program, record);
  program.evaluate(points, out, workspace);
  std::vector<Growth> growths(static_cast<std::size_t>(count));
  const auto time = slots.col(slots.cols() - 1);
  for (Index i = 0; i < rows; ++i) {
    const double length = time[i + 1] - time[i];
    for (Index k = 0; k < count; ++k) {
      double rate = out(i, k);
      for (Index j = 0; j < count; ++j) rate += out(i, count * (k + 1) + j) * values(i, j);
      const double own = out(i, count * (k + 1) + k) * length;
      values(i + 1, k) =
          values(i, k) + length * growths[static_cast<std::size_t>(k)](own) * rate;
    }
  }
}

/// Memory over all steps of a grid, one after another.
void write_stepwise(const MemoryRates& memory, const Variables& variables,
                    const LinearisedRecord& record, Matrix& values) {
  const Matrix& slots = record.slots;
  const Index count = values.cols(), width = slots.cols() - 1;
  std::vector<Expression> formulas;
  for (Index k = 0; k < count; ++k) {
    formulas.push_back(memory.rates[static_cast<std::size_t>(k)]);
    formulas.push_back(memory.derivatives[static_cast<std::size_t>(k * count + k)]);
  }
  const Program program(formulas, variables);
  Program::Workspace workspace;
  Vector point(program.slots()), out(program.outputs());
  const Matrix delayed = delayed_in_middles(program, record);
  for (Index i = 0; i + 1 < slots.rows(); ++i) {
    const double length = slots(i + 1, width) - slots(i, width);
    point.head(width) = 0.5 * (slots.row(i) + slots.row(i + 1)).head(width).transpose();
    point.segment(width, count) = values.row(i).transpose();
    point[width + count] = slots(i, width) + 0.5 * length;
    point.tail(delayed.cols()) = delayed.row(i).transpose();
    program.evaluate(point.data(), out.data(), workspace);
    for (Index k = 0; k < count; ++k)
      values(i + 1, k) = values(i, k) + length * growth(out[2 * k + 1] * length) * out[2 * k];
  }
}

/// Where memory states begin.
Vector begin_of_memory(const Candidate& candidate, std::span<const double> shapes,
                       const Variables& variables, const LinearisedRecord& record) {
  Vector begin(static_cast<Index>(candidate.memory.size()));
  for (Index k = 0; k < begin.size(); ++k) {
    const Expression& start = candidate.memory[static_cast<std::size_t>(k)].start;
    begin[k] = evaluate_on(record, variables, bind_formula(candidate, start, shapes))[0];
  }
  return begin;
}

/// memory_along() from given values on.
Matrix memory_from(const Candidate& candidate, std::span<const double> shapes,
                   const Variables& variables, const LinearisedRecord& record,
                   const Vector& begin) {
  Matrix values(record.slots.rows(), begin.size());
  values.row(0) = begin.transpose();
  const MemoryRates rates = memory_rates(candidate, shapes);
  const Variables all = with_memory(candidate, variables);
  if (rates.affine)
    write_affine(rates, all, record, values);
  else
    write_stepwise(rates, all, record, values);
  return values;
}

/// Longest delay in a formula; 0 when there is none.
double longest_delay(const Expression& formula, const Variables& variables) {
  double longest = 0.0;
  const Program program({&formula, 1}, variables);
  for (const DelayedVariable& delay : program.delays())
    longest = std::max(longest, delay.delay);
  return longest;
}

/// Index of the first row from which on two memories are closer than a twentieth of where they
/// began; the number of rows when they never are.
Index forgotten_from(const Matrix& one, const Matrix& other) {
  // A decision (docs/decisions.md).
  constexpr double kFractionOfStart = 0.05;
  const Matrix apart = (one - other).cwiseAbs();
  Index row = apart.rows();
  while (row > 0 &&
         (apart.row(row - 1).array() <= kFractionOfStart * apart.row(0).array()).all())
    --row;
  return row;
}

/// Row of the grid from which on memory has forgotten where it began.
std::optional<Index> memory_known_from(const Candidate& candidate,
                                       std::span<const double> shapes,
                                       const Variables& variables,
                                       const LinearisedRecord& record) {
  const Vector begin = begin_of_memory(candidate, shapes, variables, record);
  const Matrix values = memory_from(candidate, shapes, variables, record, begin);
  const Vector range = (values.colwise().maxCoeff() - values.colwise().minCoeff()).transpose();
  if (!(range.minCoeff() > 0.0)) return std::nullopt;
  const auto from = [&](double sign) {
    return memory_from(candidate, shapes, variables, record, begin + sign * range);
  };
  const Index row = forgotten_from(from(0.5), from(-0.5));
  return row < values.rows() ? std::optional(row) : std::nullopt;
}

}  // namespace

Matrix memory_along(const Candidate& candidate, std::span<const double> shapes,
                    const Variables& variables, const LinearisedRecord& record) {
  return memory_from(candidate, shapes, variables, record,
                     begin_of_memory(candidate, shapes, variables, record));
}

std::optional<double> known_from(const Candidate& candidate, std::span<const double> shapes,
                                 const Variables& variables, const LinearisedRecord& record) {
  if (candidate.memory.empty())
    return record.time[0] + longest_delay(bind_form(candidate, shapes), variables);
  const auto row = memory_known_from(candidate, shapes, variables, record);
  if (!row) return std::nullopt;
  return record.slots(*row, record.slots.cols() - 1);
}

Vector form_along(const Candidate& candidate, std::span<const double> shapes,
                  const Variables& variables, const LinearisedRecord& record) {
  const Expression form = bind_form(candidate, shapes);
  if (candidate.memory.empty()) return evaluate_on(record, variables, form);
  const Program program({&form, 1}, with_memory(candidate, variables));
  Program::Workspace workspace;
  Matrix slots(record.slots.rows(), program.slots()), out(record.slots.rows(), 1);
  slots << with_memory(record.slots, memory_along(candidate, shapes, variables, record)),
      delayed_at_rows(program, record);
  program.evaluate(slots, out, workspace);
  return out.col(0);
}

namespace {

/// form_along(); 0 while a delayed value lies before the record.
Vector acting_along(const Candidate& candidate, std::span<const double> shapes,
                    const Variables& variables, const LinearisedRecord& record) {
  Vector values = form_along(candidate, shapes, variables, record);
  if (!contains(candidate.form, Operation::Delay)) return values;
  const double known = *known_from(candidate, shapes, variables, record);
  const auto t = record.slots.col(record.slots.cols() - 1);
  for (Index i = 0; i < values.size() && t[i] < known; ++i) values[i] = 0.0;
  return values;
}

}  // namespace

ProbeColumns probe_columns(std::span<const Probe> probes, const Assimilation& assimilation,
                           const InnovationSystem& system) {
  const Variables variables = assimilation.model.variables();
  const std::vector<std::string> taken = variables.names();
  const bool in_rate = probes.front().candidate->place == Place::Rate;
  std::vector<Matrix> values;
  for (const LinearisedRecord& record : assimilation.records)
    values.emplace_back(in_rate ? record.slots.rows() : record.samples(),
                        static_cast<Index>(probes.size()));
  ProbeColumns result{{}, std::vector<bool>(probes.size(), true)};
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const Candidate candidate = without_clash(*probes[p].candidate, taken);
    for (std::size_t r = 0; r < values.size(); ++r) {
      const Vector all = acting_along(candidate, as_span(probes[p].shapes), variables,
                                      assimilation.records[r]);
      result.finite[p] = result.finite[p] && all.allFinite();
      auto column = values[r].col(static_cast<Index>(p));
      if (!result.finite[p])
        column.setZero();
      else if (in_rate)
        column = all;
      else
        column = all(assimilation.records[r].sample_rows());
    }
  }
  const Index equation = probes.front().candidate->equation;
  result.columns = in_rate ? system.rate_columns(equation, values)
                           : system.channel_columns(equation, values);
  return result;
}

std::optional<Vector> candidate_column(const Candidate& candidate,
                                       std::span<const double> shapes,
                                       const Assimilation& assimilation,
                                       const InnovationSystem& system) {
  const Probe probe{&candidate,
                    Eigen::Map<const Vector>(shapes.data(), static_cast<Index>(shapes.size()))};
  const ProbeColumns found = probe_columns({&probe, 1}, assimilation, system);
  if (!found.finite.front()) return std::nullopt;
  return Vector(found.columns.col(0));
}

}  // namespace lacuna
