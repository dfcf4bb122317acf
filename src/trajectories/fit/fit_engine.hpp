// SPDX-License-Identifier: MIT
// The model beside the records: paths, residuals and their derivatives.
#pragma once

#include <optional>
#include <vector>

#include "fit_domain.hpp"
#include "fit_records.hpp"
#include "lacuna/core/base/types.hpp"
#include "records/channels/channel_noise.hpp"
#include "trajectories/sensitivities/implicit/radau.hpp"
#include "trajectories/sensitivities/step_maps.hpp"
#include "trajectories/windows/channels.hpp"
#include "trajectories/windows/event_maps.hpp"

namespace lacuna {

/// The records between their samples, for steps that are where the error wants them.
struct ImplicitSteps {
  std::vector<DrivingSignals> signals;  ///< of each record
  RadauFlow flow{};
  double relaxed = 1.0;  ///< times the error that is let pass where fits end
};

/// Model and records with what is computed once from them. One object per thread.
struct FitEngine {
  ParametrisedModel model;
  FitRecords records;
  Rates rates;  ///< beyond an edge of their domain as they are there
  Channels channels;
  FitDomain domain;
  StageSignals signals;
  Vector sigma;                                ///< c: deviation by which residuals are divided
  std::optional<ImplicitSteps> implicit = {};  ///< in the place of equal explicit steps
  std::optional<EventMaps> events = {};        ///< where the model has some
  /// c: the law of a channel that has one; others are normal, their deviation is sigma.
  std::vector<std::optional<ChannelNoise>> laws = {};

  Index states() const noexcept { return rates.dimension(); }    ///< m
  Index parameters() const noexcept { return rates.columns(); }  ///< P
  Index count() const noexcept { return channels.count(); }      ///< c
};

FitEngine fit_engine(const ParametrisedModel& model, FitRecords records);

/// The deviation of a sample of a channel without a law: its own where it is known.
double deviation_of(const FitEngine& engine, Index sample, Index channel);

/// Whether a sample is a value, neither missing nor a limit.
bool is_value(const FitEngine& engine, Index sample, Index channel);

/// Integrates every sampling interval by so many steps of the Runge-Kutta method of order 4.
void set_substeps(FitEngine& engine, Index substeps);

/// The most explicit steps in a sampling interval; see choose_method().
constexpr Index kMostSubsteps = 32;

/// What is estimated.
struct FitPoint {
  Matrix parameters;  ///< R x P: a parameter that records share is the same in all rows
  Matrix starts;      ///< R x m
};

/// What a point gives.
struct FitPath {
  Matrix states;               ///< N x m, before each sample is looked at
  Matrix arrivals = {};        ///< N x m, before the events of a sample; empty without events
  Matrix residuals;            ///< N x c: measured - model, 0 where there is no value
  std::vector<Matrix> stages;  ///< per stage: states where f was evaluated, steps x m
  /// Sum of (residual / sigma)^2, or -2 log-likelihood of a law less a constant; infinite where
  /// a path diverges.
  double cost = 0.0;
  /// Whether a free run came to where the model is not defined: it has no numbers from there
  /// on.
  bool left_domain = false;
};

/// How much of each residual is added to each state behind a sample: N x (m c), column
/// c m + k; empty: the model runs freely.
using Gains = Matrix;

/// Residuals in deviations of the noise; 0 for what is no value. N x c.
Matrix whitened(const FitEngine& engine, const FitPath& path);

/// The model along the records: x_{n+1} = F(x_n + K_n (y_n - h(x_n))).
FitPath follow(FitEngine& engine, const FitPoint& point, const Gains& gains);

/// The same along one record, written into its rows of a path; the cost stays as it is.
void follow_record(FitEngine& engine, const FitPoint& point, const Gains& gains, Index record,
                   FitPath& path);

/// Takes implicit steps, whose error is controlled, from now on.
void take_implicit_steps(FitEngine& engine);

/// Takes implicit steps where the model is stiff: along its path with them explicit ones are
/// unstable, as many as there may be in a sampling interval. And where explicit ones leave the
/// domain of the model: implicit ones come to its edge within their error. Where events are set
/// off by guards steps are implicit anyway.
void choose_method(FitEngine& engine, const FitPoint& point);

/// Takes explicit steps again where the model is not stiff along its path with them (parameters
/// that were tried on the way to a point may make it stiff): one in a sampling interval, which may
/// be too few. @return whether it does.
bool leave_implicit_steps(FitEngine& engine, const FitPoint& point);

/// Implicit steps, where they are taken, with larger errors as long as it lives: for fits whose
/// minimum is found again by exact steps, and for errors of predictions.
class RoughSteps {
 public:
  explicit RoughSteps(FitEngine& engine)
      : engine_(engine), before_(engine.implicit ? engine.implicit->relaxed : 1.0) {
    if (engine.implicit) engine.implicit->relaxed = kRelaxed;
  }
  ~RoughSteps() {
    if (engine_.implicit) engine_.implicit->relaxed = before_;
  }
  RoughSteps(const RoughSteps&) = delete;
  RoughSteps& operator=(const RoughSteps&) = delete;

 private:
  static constexpr double kRelaxed = 100.0;  // a decision: 0.1 % of the noise, 1e-5 of a state
  FitEngine& engine_;
  double before_;
};

/// What rows and residuals are in deviations of.
enum class Whitening {
  Likelihood,  ///< their squares are those of the likelihood (NoiseScore)
  Pearson      ///< residuals are those of the measured values, in their deviations
};

/// Calls `visit(n, rows, residual)` at every sample of a record with the derivatives of the c
/// whitened model values by [initial states, parameters], 0 by those that are fixed, and the
/// whitened residuals; gains do not change with them.
void sensitivities(FitEngine& engine, const FitPoint& point, const FitPath& path,
                   const Gains& gains, Index record,
                   FunctionRef<void(Index, const Matrix&, const Vector&)> visit,
                   Whitening whitening = Whitening::Likelihood);

/// Sizes of the disturbances that a filter allows for.
struct Disturbances {
  Vector scale;         ///< m: spread of each state; 0: its equation is exact
  double fraction = 0;  ///< of a state's spread: disturbance in one time scale
};

/// The gains of the extended Kalman filter along its own path (Anderson and Moore, Optimal
/// Filtering (1979), Ch. 8); initial states are known. Q = (fraction scale)^2 / time scale.
/// @param path receives the states of the filter.
Gains filter_gains(FitEngine& engine, const FitPoint& point, const Disturbances& disturbances,
                   FitPath& path);

/// Errors of prediction so many samples ahead, from states of a filter that were corrected by
/// all samples before: N x c, at every `ahead`-th sample, 0 elsewhere and where there is none.
/// @param compared receives how many values each channel has, c.
Matrix prediction_errors(FitEngine& engine, const FitPoint& point, const Gains& gains,
                         Index ahead, Vector& compared);

}  // namespace lacuna
