// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "lacuna/model/equations/adequacy.hpp"

namespace lacuna {

/// {"fits": "yes|no|untold", "samples": n, "parts": [{"name", "fits", "samples",
/// "noise_known"}]}.
inline nlohmann::ordered_json adequacy_json(const Adequacy& adequacy) {
  nlohmann::ordered_json parts = nlohmann::ordered_json::array();
  for (const AdequacyPart& part : adequacy.parts)
    parts.push_back({{"name", part.name},
                     {"fits", to_string(part.fits)},
                     {"samples", part.samples},
                     {"noise_known", part.noise_known}});
  return {{"fits", to_string(adequacy.fits)},
          {"samples", adequacy.samples()},
          {"parts", std::move(parts)}};
}

}  // namespace lacuna
