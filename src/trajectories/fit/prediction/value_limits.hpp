// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// 90 % limits of a value y > 0 or any, known with a standard error.
/// @param reach 95 % quantile of Student's distribution. @param by_factor whether limits are
///   those of the logarithm.
std::array<double, 2> run_limits(double y, double error, double reach, bool by_factor);

/// 90 % limits of a value that will be measured about y, itself known with a standard error:
/// the variances of both add, of logarithms for lognormal noise. Widths of Student's noise add as
/// squares, which is exact where one of them is small. What is beyond limits of the law is
/// reported as the limit; of truncated noise only values between them are measured.
/// @param law with its sizes.
std::array<double, 2> value_limits(const NoiseLaw& law, double y, double error, double reach);

}  // namespace lacuna
