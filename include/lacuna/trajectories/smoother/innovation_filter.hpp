// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/types.hpp"
#include "lacuna/trajectories/sensitivities/linearised_record.hpp"
#include "lacuna/trajectories/smoother/noise_model.hpp"

namespace lacuna {

/// A Kalman filter that was run along a linearised record: the feedback that keeps the model on
/// the record, and what is new in each sample.
///
/// The whitened innovations are independent with unit variance when the model is complete. An
/// extra term with coefficient c adds c times its response to them (see column_response), so
/// that every question about missing terms is one of linear least squares. Source: Anderson and
/// Moore, Optimal Filtering (1979), Ch. 3, 6, 10; measurements are taken in one after another,
/// as their noise is independent.
struct InnovationFilter {
  Index size = 0;      ///< N: m states and the states of coloured noise
  Index channels = 0;  ///< number of measured states
  std::vector<Index> state_of_channel;
  std::vector<Index> colour_of_channel;  ///< its state of coloured noise; N where there is none
  std::vector<double> colour_decay;      ///< of the states m, m+1, ... in one step
  Matrix gain;                           ///< (N x channels) x n
  Matrix inverse_deviation;  ///< channels x n: 1/sqrt(S); 0 where a sample is left out
  Matrix innovations;        ///< channels x n, whitened
  double deviance = 0.0;     ///< -2 log likelihood: sum of log S + innovation^2
  Index used = 0;            ///< samples of all channels that were used
};

/// What the smoother adds to the filter.
struct SmoothedRecord {
  Matrix deviation;  ///< n x m: best estimate of truth - path from the whole record
  Matrix colour;     ///< n x channels: estimate of the coloured noise
  /// Sums for estimating variances: at the maximum of the likelihood `found` equals `expected`.
  /// m entries for the disturbances, then channels for white and channels for coloured noise.
  Vector found, expected;
  Matrix disturbance;     ///< (n-1) x m: smoothed disturbance of each equation, as a mean rate
  double deviance = 0.0;  ///< that of the filter
};

/// Runs the filter.
/// @param measured n x m values of the record; columns of states not measured are not looked
/// at.
/// @param omitted n x m: samples that are not to be used have an entry other than 0; or empty.
InnovationFilter run_filter(const LinearisedRecord& record, const Matrix& measured,
                            const Matrix& omitted, const NoiseModel& noise);

/// Deviance alone, without storing anything; `measured` and `omitted` (n x m) as of
/// run_filter().
double filter_deviance(const LinearisedRecord& record, const Matrix& measured,
                       const Matrix& omitted, const NoiseModel& noise);

/// Runs filter and smoother (Bryson and Frazier's form, no inverse needed).
SmoothedRecord smooth(const LinearisedRecord& record, const Matrix& measured,
                      const Matrix& omitted, const NoiseModel& noise);

/// Whitened responses of the innovations to rates in one equation, one for each column of
/// `values`; columns go through the record together, so many cost little more than one.
/// @param values 2n-1 x count: the rates at samples and midpoints.
/// @param out (channels n) x count, written sample by sample.
void column_response(const LinearisedRecord& record, const InnovationFilter& filter,
                     Index equation, const Eigen::Ref<const Matrix>& values,
                     Eigen::Ref<Matrix> out);

/// Whitened responses of the innovations to columns of `values` (n x count) being added to what
/// is measured of a state. @param out (channels n) x count, written sample by sample.
void channel_response(const LinearisedRecord& record, const InnovationFilter& filter,
                      Index state, const Eigen::Ref<const Matrix>& values,
                      Eigen::Ref<Matrix> out);

}  // namespace lacuna
