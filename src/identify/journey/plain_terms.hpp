// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// The result without products of a state and an input that the records do not distinguish from
/// lower ones: in a step from rest w*u is w, because w is 0 as long as u is. Each term x^p u^q
/// with p, q > 0 is replaced on trial by the same without its inputs; that model is taken where
/// it has no more terms and its chi squared is not larger by log n, the penalty of one term.
/// Only of libraries that the user did not write for each equation. Past the deadline nothing
/// is tried.
/// @throws as identify().
IdentificationResult with_plain_terms(const Pipeline& pipeline, const RecordStream& records,
                                      IdentificationResult found, const RunContext& context);

}  // namespace lacuna
