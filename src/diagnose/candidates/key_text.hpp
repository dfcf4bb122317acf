// SPDX-License-Identifier: MIT
// What fits and screenings are functions of, as text.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lacuna/diagnose/candidates/explanation.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {

/// Collects all that decides something, to the bit: short things as they are, long ones by a
/// digest.
class KeyText {
 public:
  template <class... Parts>
  void add_all(const Parts&... parts) {
    (add(parts), ...);
  }

  void add(double number) {
    text_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void add(Index number) { add(std::to_string(number)); }
  void add(int number) { add(std::to_string(number)); }
  void add(std::size_t number) { add(std::to_string(number)); }
  void add(bool yes) { text_ += yes ? '+' : '-'; }
  void add(const std::string& text) {
    text_ += text;
    text_ += '\0';
  }
  void add(const Matrix& numbers) {
    const std::string_view bytes(reinterpret_cast<const char*>(numbers.data()),
                                 sizeof(double) * static_cast<std::size_t>(numbers.size()));
    add_all(numbers.rows(), numbers.cols(), std::hash<std::string_view>{}(bytes));
  }
  void add(const Vector& numbers) { add(Matrix(numbers)); }

  template <class T>
  void add(const std::optional<T>& one) {
    add(one.has_value());
    if (one) add(*one);
  }
  template <class T>
  void add(const std::vector<T>& all) {
    add(all.size());
    for (const auto& one : all) add(static_cast<const T&>(one));
  }
  void add(const std::vector<bool>& all) {
    add(all.size());
    for (const bool one : all) add(one);
  }

  void add(const OdeModel& model) { add(format_model(model)); }
  void add(const Expression& form) { add(form.to_string()); }
  void add(const CoefficientPlace& place) { add_all(place.equation, place.term); }
  void add(const CoefficientPrior& prior) { add_all(prior.place, prior.mean, prior.deviation); }
  void add(const ChannelTerm& term) { add_all(term.state, term.form, term.coefficient); }
  void add(const ColouredNoise& noise) { add_all(noise.deviation, noise.time); }
  void add(const NoiseEntry& entry) { add_all(static_cast<int>(entry.kind), entry.state); }
  void add(const NoiseModel& noise) {
    add_all(noise.measurement, noise.coloured, noise.disturbance);
  }
  void add(const LinearisedRecord& record) {
    add_all(record.time, record.path, record.slots, record.bridge, record.range,
            record.grid.stride, record.grid.signals.size());
    for (const Interpolation signal : record.grid.signals) add(static_cast<int>(signal));
  }
  void add(const Trajectory& record) {
    add_all(record.time, record.states, record.inputs, record.marks);
  }
  void add(const Quantity& quantity) {
    add_all(quantity.name, quantity.unit,
            quantity.hold ? static_cast<int>(*quantity.hold) : -1);
  }
  void add(const Dataset& data) {
    add_all(data.time_unit, data.states, data.inputs, data.rate_of, data.reconstructed,
            data.trajectories);
  }
  void add(const Assimilation& fit) {
    add_all(fit.model, fit.records, fit.measured, fit.omitted, fit.noise, fit.least_noise,
            fit.estimated_noise, fit.curvature.entries, fit.curvature.inverse, fit.deviance,
            fit.used, fit.free, fit.channel_terms, fit.covariance, fit.held, fit.units);
  }
  void add(const AssimilationOptions& options) {
    add_all(options.free, options.priors, options.disturbed, options.coloured, options.passes,
            options.hidden, options.held_among, options.unseen, options.units);
  }
  void add(const ShapeParameter& shape) {
    add_all(shape.name, shape.unit, shape.low, shape.high, shape.logarithmic);
  }
  void add(const MemoryState& state) {
    add_all(state.name, state.rate, state.start, state.driven);
  }
  void add(const Candidate& candidate) {
    add_all(candidate.form, candidate.argument, candidate.within, candidate.shapes,
            candidate.starts, candidate.memory, static_cast<int>(candidate.place),
            candidate.equation, candidate.least, candidate.most, candidate.repeats,
            candidate.families);
  }
  void add(const FittedEffect& effect) {
    add_all(effect.candidate, effect.shapes, effect.coefficient, effect.deviation,
            effect.shape_deviations);
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace lacuna
