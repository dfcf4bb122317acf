// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/differentiator.hpp"

#include <cmath>
#include <string>

#include "core/base/text.hpp"
#include "lacuna/core/base/options.hpp"

namespace lacuna {
namespace {

void check_shapes(const std::string& where, const Vector& time,
                  const Eigen::Ref<const Matrix>& values, int order) {
  if (time.size() != values.rows())
    throw ArgumentError(where,
                        std::to_string(time.size()) + " times for " +
                            std::to_string(values.rows()) + " rows of values",
                        "give one time for each row");
  constexpr int kHighest = 1000;  // a fact of doubles: the factorial of less is beyond them
  if (order < 0 || order > kHighest)
    throw ArgumentError(where, "the order of the derivative is " + std::to_string(order),
                        "give 0 for the signal itself, 1 for its first derivative, ...");
}

void check_noise(const std::optional<Vector>& noise, Index states, std::string_view where) {
  if (noise && noise->size() != states)
    throw ArgumentError(std::string(where), "the noise is not one number per state",
                        "give one standard deviation for each state");
}

void check_time(const std::string& where, const Vector& time) {
  for (Index i = 0; i < time.size(); ++i) {
    const bool forward = i == 0 || time[i] > time[i - 1];
    if (std::isfinite(time[i]) && forward) continue;
    throw DataError(where,
                    "time does not increase at sample " + std::to_string(i + 1) +
                        " (t = " + format_number(time[i]) + ")",
                    "sort the record or cut it there");
  }
}

void check_values(const std::string& where, const Eigen::Ref<const Matrix>& values) {
  if (values.allFinite()) return;
  for (Index column = 0; column < values.cols(); ++column)
    for (Index row = 0; row < values.rows(); ++row)
      if (!std::isfinite(values(row, column)))
        throw DataError(where,
                        "column " + std::to_string(column + 1) + " is not finite at sample " +
                            std::to_string(row + 1),
                        "cut the record there");
}

void check_samples_of(const std::string& where, const Vector& time,
                      const Eigen::Ref<const Matrix>& values, int order) {
  check_shapes(where, time, values, order);
  check_time(where, time);
  check_values(where, values);
}

/// Finds the first nested differentiator.
class DifferentiatorFinder final : public IdleVisitor {
 public:
  std::shared_ptr<const Differentiator> found;

 protected:
  void nested_stage(const FieldInfo&, std::string_view,
                    std::shared_ptr<const StageInterface>& stage) override {
    if (!found) found = std::dynamic_pointer_cast<const Differentiator>(stage);
  }
};

}  // namespace

Matrix Differentiator::differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                                     int order) const {
  check_samples_of(std::string(info().name), time, values, order);
  return do_differentiate(time, values, order);
}

std::optional<Matrix> Differentiator::standard_error(const Vector& time,
                                                     const Eigen::Ref<const Matrix>& values,
                                                     int order) const {
  check_samples_of(std::string(info().name), time, values, order);
  return do_standard_error(time, values, order);
}

Stage<Differentiator> fitted_to(const Stage<Differentiator>& method, const Dataset& data,
                                const std::optional<Vector>& noise) {
  check_form(data);
  check_noise(noise, data.state_count(), method->info().name);
  auto fitted = method->do_fit(data, noise);
  return fitted ? Stage<Differentiator>(std::move(fitted)) : method;
}

Stage<Differentiator> differentiator_of(const StageInterface& stage) {
  DifferentiatorFinder finder;
  stage.visit_options(finder);
  if (!finder.found)
    throw ConfigError(std::string(stage.info().name),
                      "there is no differentiator among the options",
                      "choose a formulation that has one, e.g. --set formulation=strong");
  return Stage<Differentiator>(finder.found);
}

}  // namespace lacuna
