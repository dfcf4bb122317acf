// SPDX-License-Identifier: MIT
// Polynomials whose origin is arbitrary are as long as all that a shift makes of them.
#pragma once

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// The result of a centred library (with_centred_library()) without terms that stand in for
/// lower ones. About a point c a product x y has 1, x and y beside it, whose coefficients are
/// small where c happens to lie near a root of theirs; one more power that follows them on the
/// record is then fewer terms than they are, though it is more by what holds about every point:
/// the number of terms that a shift of the model has. So each highest term of an equation that
/// lacks lower ones is left out on trial and all of them are let in; that model is taken where
/// its chi squared is not larger by log n for each term that it has fewer about every point
/// (marginality of polynomials: Nelder, J. Roy. Stat. Soc. A 140 (1977) 48; Peixoto, American
/// Statistician 44 (1990) 26). A model with other basis functions stays as it is. Past
/// the deadline nothing is tried.
/// @param plain the pipeline before its library was centred.
/// @throws as identify().
IdentificationResult with_lower_terms(const Pipeline& plain, const Pipeline& centred,
                                      const RecordStream& records, IdentificationResult found,
                                      const RunContext& context);

}  // namespace lacuna
