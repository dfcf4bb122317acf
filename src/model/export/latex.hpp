// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// The equations as align* environments of amsmath, of 40 lines each: \dot{x} &= -10\,x +
/// 10\,y.
std::string export_latex(const SystemModel& model);

}  // namespace lacuna
