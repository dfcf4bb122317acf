// SPDX-License-Identifier: MIT
// What an experiment is worth, in numbers that add up over experiments.
#pragma once

#include <cstdint>
#include <vector>

#include "model_run.hpp"

namespace lacuna {

/// What is known of the numbers of a model before the experiment.
struct Knowledge {
  Matrix information;  ///< P x P, of what was measured; singular where nothing is known
  Matrix proper;       ///< the same with something known of every number
  Matrix factor;       ///< P x P: L with L L' = proper^-1, for draws
};

/// @param spread of a number of which nothing is known, over its size (PlanOptions::spread).
Knowledge knowledge_of(const PlanModel& model, double spread);

/// Draws of the numbers of a path, in pairs that are opposite about the estimates (the mean of
/// each is the estimate), moved into their ranges.
/// Starts are offsets from those of an experiment.
std::vector<PathNumbers> draws_of(const ModelRun& run, const Knowledge& knowledge, int count,
                                  std::uint64_t seed);

/// The draw in an experiment, with the initial states of that.
PathNumbers in_experiment(const ModelRun& run, const Experiment& experiment,
                          const PathNumbers& draw);

/// (1 + X X')^-1 A: A after uncertain initial states are eliminated.
/// @param by_start X, values x uncertain starts.
Matrix weighted(const Matrix& by_start, const Matrix& a);

/// Of a model in an experiment; uncertain initial states are eliminated.
struct ModelEvidence {
  Matrix information;  ///< P x P: S' W S with W = (1 + X X')^-1, X the derivatives by starts
  double log_det = 0.0;  ///< of 1 + X X'
  double freedom = 0.0;  ///< values that initial states take up: trace of (1 + X'X)^-1 X'X

  ModelEvidence& operator+=(const ModelEvidence& other);
};

ModelEvidence model_evidence(const LinearPrediction& linear);

/// Log of the determinant of a symmetric positive definite matrix.
double log_det(const Matrix& symmetric);

/// Of a rival against draws of another model, which is right: d = y_draw - y_rival.
struct PairEvidence {
  Vector squares;   ///< K: d' W d
  Matrix gradient;  ///< P of the rival x K: S' W d

  PairEvidence& operator+=(const PairEvidence& other);
};

/// Of an experiment, or of several; empty: of none.
struct DesignEvidence {
  std::vector<ModelEvidence> models;
  std::vector<PairEvidence> pairs;  ///< number right * R + rival; those of a model with itself
                                    ///< are empty
  bool is_finite = true;

  DesignEvidence& operator+=(const DesignEvidence& other);
};

/// Models with what is known of them, and the draws of them that stand for it.
struct Rivals {
  std::vector<ModelRun> runs;         ///< R
  std::vector<Knowledge> knowledge;   ///< R
  std::vector<double> weights;        ///< R, sum 1
  std::vector<std::vector<PathNumbers>> draws;  ///< R x K
};

/// @param with_pairs whether rivals are compared; else only the models' own information.
DesignEvidence evidence_of(Rivals& rivals, const Experiment& experiment, bool with_pairs);

/// The same experiments made so many times.
DesignEvidence repeated(DesignEvidence evidence, double times);

/// A comparison where `right` is right.
struct Distinction {
  double log_bayes_factor = 0.0;  ///< expected
  double distance = 0.0;          ///< mean over the draws: d' C^-1 d
  double power = 0.0;             ///< probability of a log Bayes factor above `decisive`
};

/// @param evidence of pairs. @param squares K: distances after an exact refit, in the place of
///   linearised ones; empty: those.
Distinction distinction_of(const Rivals& rivals, const DesignEvidence& evidence, std::size_t right,
                           std::size_t rival, double decisive, const Vector& squares = {});

}  // namespace lacuna
