// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "diagnose/journey/gap.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "report/plot/figure.hpp"

namespace lacuna {

/// Records with the models that ran in their windows, and what is needed to report them.
struct RunView {
  const std::vector<GapRecord>& runs;
  std::vector<Quantity> states;
  std::string time_unit;
  Vector noise;  ///< m: standard deviation of the measurement; 0 where it is not known
  std::string before = "nominal model";
  std::string after = "model";
  /// n x m: the same along the longest record where it depends on the value; empty: it does not.
  Matrix noise_along = {};
};

/// Both ends of a band as one curve with a gap between them.
Series ends_of(const std::string& label, const Vector& time, const Vector& low,
               const Vector& high, Curve curve);

/// Rows of several records under one another, a row of NaN between two: curves with gaps.
Matrix stacked(const std::vector<Matrix>& parts);

/// Where the models run in the pictures: "in windows of 1.7 s" of the longest record, or "over the
/// whole record". @param view of one record at least.
std::string stretch_text(const RunView& view);

/// Measured values beside the models over some windows of the longest record, one picture for
/// each state.
std::vector<Picture> comparison_pictures(const RunView& view);

/// What models are off over the whole of the longest record, with the noise as a band.
std::vector<Picture> deviation_pictures(const RunView& view);

/// Power spectra of what models are off; nothing where the record is short or not uniform.
std::vector<Picture> spectrum_pictures(const RunView& view);

/// Orbit of measured values and model: in space where there are three states, in the plane of
/// two; nothing for one.
std::vector<Picture> orbit_pictures(const RunView& view);

/// All of some runs with their bands, one picture for each quantity: those that are measured first,
/// six at most.
/// @param name of the pictures. @param measured the same records with their values, or none.
/// @param channels what their columns are.
std::vector<Picture> band_pictures(const std::string& name, const std::vector<FitBands>& runs,
                                   const std::vector<FitRun>& measured,
                                   const std::vector<FitQuality>& channels,
                                   const std::string& time_unit);

/// Root mean square of what the model is off (after, or before) over that of each state's
/// deviation from its mean, over all records and states.
double relative_misfit(const std::vector<GapRecord>& runs, bool before);

}  // namespace lacuna
