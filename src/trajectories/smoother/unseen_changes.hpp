// SPDX-License-Identifier: MIT
// What records cannot say of a model whose states are not all measured, whatever the noise is.
#pragma once

#include <vector>

#include "lacuna/trajectories/smoother/assimilation.hpp"

namespace lacuna {

/// What a rate does when a number p of the model changes, relatively: p df_k/dp.
struct RateChange {
  Index equation = 0;
  Expression rate;
};

/// The rates that a number of the model changes: a coefficient changes one.
using NumberChange = std::vector<RateChange>;

/// How rates change with the coefficients: c_j T_j each.
std::vector<NumberChange> changes_of(const OdeModel& model,
                                     const std::vector<CoefficientPlace>& places);

/// What is estimated of a model.
struct EstimatedNumbers {
  std::vector<CoefficientPlace> free = {};
  /// What is known beforehand of some of these: they are not changed.
  std::vector<CoefficientPrior> known = {};
  std::vector<NumberChange> others = {};  ///< beside the free coefficients
};

/// Changes of a model that other hidden states make up for.
struct UnseenChanges {
  /// p x h, orthonormal: relative changes of the free coefficients.
  Matrix coefficients;
  /// h of these coefficients that, kept as they are, leave nothing of the changes: units of the
  /// hidden states. Before others those by which a hidden state acts on one that is seen, so
  /// that what moves the hidden state may be anything.
  std::vector<Index> units = {};
  /// m entries: hidden states on which nothing that is measured depends.
  std::vector<bool> unseen_states = {};
};

/// Changes of variables x_k -> x_k + e (a_0 + sum_j a_j x_j) of hidden states that changes of
/// the coefficients c_j -> c_j (1 + e v_j) undo: with the rates f and the terms T,
///
///   sum_j v_j c_j T_ij + sum_k df_i/dx_k g_k = dg_i/dt,   g_k = a_k0 + sum_l a_kl x_l,
///
/// at all samples, in all equations; g_k = 0 where a state is not hidden. The null space of
/// this linear system in (v, a). A scale of a hidden state is one: in dx1/dt = -a x1 + b x2,
/// dx2/dt = c x1 - d x2 with x1 measured only a, d and b c are seen. Source: Chappell and
/// Godfrey, Math. Biosci. 108 (1992), similarity transformations, for affine ones.
/// What else is estimated makes up for changes too: effects with coefficients and shapes of
/// their own leave some unseen (an edge is scaled with its state) and show others.
/// @param data records with paths of the hidden states. None for models with delays.
UnseenChanges unseen_changes(const OdeModel& model, const Dataset& data,
                             const std::vector<bool>& hidden, const EstimatedNumbers& numbers);

}  // namespace lacuna
