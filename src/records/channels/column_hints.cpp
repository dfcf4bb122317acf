// SPDX-License-Identifier: MIT
#include "records/channels/column_hints.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/base/text.hpp"
#include "core/numerics/least_squares.hpp"
#include "records/channels/value_spacing.hpp"

namespace lacuna {
namespace {

/// Samples of a relation for each of its coefficients: fewer fit by chance.
constexpr Index kSamplesEach = 5;

/// Columns among which relations are sought: each is compared with all triples of the others, 2e6
/// comparisons for 64 (0.4 s), 3e9 for 400. A decision: with half as many the relations of a logger
/// of 40 channels go unseen, twice as many take 17 times as long.
constexpr Index kMostColumns = 64;

/// Changes of a held column: at fewer places they may be every n-th by chance (2^-20).
constexpr Index kFewestChanges = 20;

Matrix all_states(const Dataset& data) {
  Matrix all(data.samples(), data.state_count());
  Index row = 0;
  for (const Trajectory& record : data.trajectories) {
    all.middleRows(row, record.samples()) = record.states;
    row += record.samples();
  }
  return all;
}

/// States as columns, with the spacing of the values of each: half of it is their error.
struct StateColumns {
  Matrix values;
  Vector digit, range;
};

StateColumns columns_of_states(const Dataset& data) {
  Matrix values = all_states(data);
  const Vector range =
      (values.colwise().maxCoeff() - values.colwise().minCoeff()).transpose();
  return {std::move(values), value_spacings(data), range};
}

/// A value that is computed, and its error by the last digits of what it is made of.
struct Computed {
  double value = 0.0, error = 0.0;
};

/// Whether a column is, at every sample, what is computed; most others differ at the first one.
/// @param at gives what is computed at a sample.
template <class At>
bool agrees(const StateColumns& columns, Index column, const At& at) {
  // Coarser values agree with many things; half and double of it make no difference to
  // channels of 10 bits and more.
  constexpr double kMostError = 0.01;  // of the range
  const double most = kMostError * columns.range[column], digit = columns.digit[column];
  for (Index i = 0; i < columns.values.rows(); ++i) {
    const Computed computed = at(i);
    const double error = computed.error + digit;
    if (!(std::abs(columns.values(i, column) - computed.value) <= error) || error > most)
      return false;
  }
  return true;
}

std::string names_of(const Dataset& data, const std::vector<Index>& columns) {
  std::vector<std::string> names;
  for (const Index k : columns) names.push_back(data.states[static_cast<std::size_t>(k)].name);
  return join(names, ", ");
}

/// The columns of which one is a sum with factors, and a constant.
std::optional<std::vector<Index>> summands_of(const StateColumns& columns, Index column,
                                              const std::vector<Index>& others) {
  const Index rows = columns.values.rows(), count = static_cast<Index>(others.size());
  if (rows < kSamplesEach * (count + 1)) return std::nullopt;
  // So many samples determine the factors; all of them are compared.
  constexpr Index kFitted = 2000;
  const Index stride = 1 + (rows - 1) / kFitted;
  const auto fitted = Eigen::seq(0, rows - 1, stride);
  Matrix terms(1 + (rows - 1) / stride, count + 1);
  terms.leftCols(count) = columns.values(fitted, others);
  terms.col(count).setOnes();
  const Vector factors = least_squares(terms, Matrix(columns.values(fitted, column)));
  double error = 0.0;
  std::vector<Index> found;
  for (Index i = 0; i < count; ++i) {
    const auto k = others[static_cast<std::size_t>(i)];
    error += std::abs(factors[i]) * columns.digit[k];
    // A factor is there where what it adds is more than the last digit.
    if (std::abs(factors[i]) * columns.range[k] > columns.digit[column]) found.push_back(k);
  }
  const auto sum_at = [&](Index i) {
    double sum = factors[count];
    for (Index k = 0; k < count; ++k)
      sum += factors[k] * columns.values(i, others[static_cast<std::size_t>(k)]);
    return Computed{sum, error};
  };
  if (found.empty() || !agrees(columns, column, sum_at)) return std::nullopt;
  return found;
}

/// The two columns of which one is the product.
std::optional<std::vector<Index>> factors_of(const StateColumns& columns, Index column,
                                             const std::vector<Index>& others) {
  for (std::size_t i = 0; i < others.size(); ++i)
    for (std::size_t j = i + 1; j < others.size(); ++j) {
      const auto product_at = [&](Index row) {
        const double x = columns.values(row, others[i]), y = columns.values(row, others[j]);
        return Computed{x * y, std::abs(x) * columns.digit[others[j]] +
                                   std::abs(y) * columns.digit[others[i]]};
      };
      if (agrees(columns, column, product_at))
        return std::vector<Index>{others[i], others[j]};
    }
  return std::nullopt;
}

/// Whether a column is the length of a vector, at every sample.
bool is_length(const StateColumns& columns, Index column, const std::vector<Index>& parts) {
  double error = 0.0;
  for (const Index k : parts) error += columns.digit[k];
  return agrees(columns, column, [&](Index row) {
    double squares = 0.0;
    for (const Index k : parts) squares += columns.values(row, k) * columns.values(row, k);
    return Computed{std::sqrt(squares), error};
  });
}

/// The two or three columns of which one is the length. Squares may depend on one another (those
/// of a free rotation do), so that each choice is tried, not fitted.
std::optional<std::vector<Index>> components_of(const StateColumns& columns, Index column,
                                                const std::vector<Index>& others) {
  if (columns.values.col(column).minCoeff() < 0.0) return std::nullopt;
  for (std::size_t i = 0; i < others.size(); ++i)
    for (std::size_t j = i + 1; j < others.size(); ++j) {
      std::vector<Index> parts{others[i], others[j]};
      if (is_length(columns, column, parts)) return parts;
      for (std::size_t k = j + 1; k < others.size(); ++k) {
        std::vector<Index> in_space = parts;
        in_space.push_back(others[k]);
        if (is_length(columns, column, in_space)) return in_space;
      }
    }
  return std::nullopt;
}

/// What is said of a column that is computed from others of those that are left.
std::optional<ColumnRemark> computed_remark(const Dataset& data, const StateColumns& columns,
                                            Index column, const std::vector<Index>& left) {
  if (!(columns.range[column] > columns.digit[column])) return std::nullopt;
  std::vector<Index> others = left, before = left;
  std::erase(others, column);
  std::erase_if(before, [&](Index k) { return k >= column; });
  auto sources = before.empty() ? std::nullopt : summands_of(columns, column, before);
  if (!sources) sources = components_of(columns, column, others);
  if (!sources) sources = factors_of(columns, column, others);
  if (!sources) return std::nullopt;
  const std::string& name = data.states[static_cast<std::size_t>(column)].name;
  return ColumnRemark{column, ColumnKind::Computed,
                      name + " follows from " + names_of(data, *sources) +
                          " and is no state of its own"};
}

/// The number of samples that the values of a column are held, 1 where they are not.
Index held_samples(const Dataset& data, Index state) {
  Index period = 0, changes = 0;
  for (const Trajectory& record : data.trajectories) {
    std::optional<Index> last;
    for (Index i = 1; i < record.samples(); ++i) {
      if (record.states(i, state) == record.states(i - 1, state)) continue;
      if (last) period = std::gcd(period, i - *last);
      last = i;
      ++changes;
    }
  }
  return changes >= kFewestChanges ? std::max<Index>(period, 1) : 1;
}

/// Whether a column goes to and fro between two values and stays at each for a while.
bool is_switched(const Dataset& data, Index state) {
  // Decisions: two whole pulses; more samples between changes than the 2 of a bit of noise.
  constexpr Index kFewestSwitches = 4, kFewestHeld = 3;
  std::set<double> values;
  Index changes = 0, steps = 0;
  for (const Trajectory& record : data.trajectories)
    for (Index i = 0; i < record.samples(); ++i) {
      values.insert(record.states(i, state));
      if (values.size() > 2 || std::isnan(record.states(i, state))) return false;
      if (i == 0) continue;
      changes += record.states(i, state) != record.states(i - 1, state);
      ++steps;
    }
  return changes >= kFewestSwitches && steps >= kFewestHeld * changes;
}

std::string without(const Dataset& data, const std::vector<Index>& columns) {
  std::vector<std::string> names;
  for (Index k = 0; k < data.state_count(); ++k)
    if (std::find(columns.begin(), columns.end(), k) == columns.end())
      names.push_back(data.states[static_cast<std::size_t>(k)].name);
  return join(names, ",");
}

std::vector<ColumnRemark> held_remarks(const Dataset& data) {
  std::vector<Index> held;
  for (Index k = 0; k < data.state_count(); ++k) held.push_back(held_samples(data, k));
  // Where all are held the file repeats its samples.
  if (held.empty() || *std::min_element(held.begin(), held.end()) > 1) return {};
  std::vector<ColumnRemark> remarks;
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k] > 1)
      remarks.push_back({static_cast<Index>(k), ColumnKind::Held,
                         data.states[k].name + " is held " + std::to_string(held[k]) +
                             " samples, as the output of a controller"});
    else if (is_switched(data, static_cast<Index>(k)))
      remarks.push_back({static_cast<Index>(k), ColumnKind::Held,
                         data.states[k].name +
                             " switches between two values, as a relay or pulses do"});
  return remarks;
}

}  // namespace

std::vector<ColumnRemark> column_remarks(const Dataset& data) {
  std::vector<ColumnRemark> remarks = held_remarks(data);
  const bool all_finite =
      std::all_of(data.trajectories.begin(), data.trajectories.end(),
                  [](const Trajectory& record) { return record.states.allFinite(); });
  const bool can_compare = data.state_count() >= 2 && data.state_count() <= kMostColumns;
  if (!can_compare || data.samples() < 2 || !all_finite) return remarks;
  const StateColumns columns = columns_of_states(data);
  std::vector<Index> left(static_cast<std::size_t>(data.state_count()));
  std::iota(left.begin(), left.end(), Index{0});
  std::vector<ColumnRemark> computed;
  for (Index k = data.state_count() - 1; k >= 0; --k) {
    auto remark = computed_remark(data, columns, k, left);
    if (!remark) continue;
    computed.push_back(*std::move(remark));
    std::erase(left, k);
  }
  remarks.insert(remarks.end(), computed.rbegin(), computed.rend());
  return remarks;
}

std::vector<Hint> column_hints(const Dataset& data) {
  const std::vector<ColumnRemark> remarks = column_remarks(data);
  std::vector<Index> computed;
  for (const ColumnRemark& remark : remarks)
    if (remark.kind == ColumnKind::Computed) computed.push_back(remark.column);
  std::vector<Hint> hints;
  for (const auto& [column, kind, sentence] : remarks)
    if (kind == ColumnKind::Held)
      hints.push_back({HintKind::Sampling, sentence + ": it looks like an input",
                       "--inputs " + data.states[static_cast<std::size_t>(column)].name,
                       Withheld::Nothing});
    else
      hints.push_back({HintKind::Identity, sentence + ": leave it out",
                       "--states " + without(data, computed), Withheld::Nothing});
  return hints;
}

}  // namespace lacuna
