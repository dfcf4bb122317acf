// SPDX-License-Identifier: MIT
// Integration that stops at the events of a model and goes on behind their jumps.
#pragma once

#include <memory>
#include <vector>

#include "lacuna/dynamics/integration/simulate.hpp"

namespace lacuna {

/// Guards and resets of the events of a model, for states and inputs at a time. A value; not
/// for use from several threads at once.
class EventPrograms {
 public:
  explicit EventPrograms(const OdeModel& model);

  /// Events that have a guard, by their numbers.
  const std::vector<std::size_t>& guarded() const noexcept { return guarded_; }

  /// The guards of guarded().
  const std::vector<double>& guards(double t, const double* x, const double* u);

  /// The state behind an event.
  void apply(std::size_t event, double t, const double* u, double* x);

 private:
  void fill(double t, const double* x, const double* u);

  std::vector<std::size_t> guarded_;
  std::vector<std::vector<Index>> targets_;  // of each event
  std::vector<Index> first_;                 // its first reset among all
  Program guards_, resets_;
  Index states_ = 0, inputs_ = 0;
  std::vector<double> slots_, guard_values_, reset_values_;
  Program::Workspace workspace_;
};

/// An integrator that lands on every event and applies it. Guards are watched at all points at
/// which the rates are evaluated; the instant at which one rises through 0 is found to rounding.
/// Events that come ever faster, as those of a ball that comes to rest, end it as a step that is
/// too small.
class EventIntegrator final : public Integrator {
 public:
  /// @param driven its model has events; all outlive this.
  /// @param times of the samples; timed events beside one of them by rounding are there.
  EventIntegrator(const Integrator& integrator, const DrivenModel& driven, const Vector& times);

  const StageInfo& info() const override { return integrator_.info(); }
  void visit_options(OptionVisitor& v) const override { integrator_.visit_options(v); }
  int order() const override { return integrator_.order(); }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;

  /// The start behind the events of the first time.
  Vector behind_first(Vector x0) const;

 private:
  const Integrator& integrator_;
  const DrivenModel& driven_;
  double begin_;
  std::vector<Occurrence> occurrences_;  // behind the first time
};

/// What timed events do in the span of some times: those that are beside one of them by rounding
/// are moved there.
std::vector<Occurrence> occurrences_at(const std::vector<Event>& events, const Vector& times);

}  // namespace lacuna
