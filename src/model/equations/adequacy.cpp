// SPDX-License-Identifier: MIT
#include "lacuna/model/equations/adequacy.hpp"

#include <algorithm>
#include <utility>

namespace lacuna {

std::string to_string(Adequate adequate) {
  switch (adequate) {
    case Adequate::Yes:
      return "yes";
    case Adequate::No:
      return "no";
    case Adequate::Undetermined:
      break;
  }
  return "untold";
}

Index Adequacy::samples() const {
  Index all = 0;
  for (const AdequacyPart& part : parts) all += part.samples;
  return all;
}

Adequacy adequacy_of(std::vector<AdequacyPart> parts) {
  const auto any = [&](Adequate wanted) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const AdequacyPart& part) { return part.fits == wanted; });
  };
  const Adequate whole = any(Adequate::No)    ? Adequate::No
                         : any(Adequate::Yes) ? Adequate::Yes
                                              : Adequate::Undetermined;
  return {whole, std::move(parts)};
}

}  // namespace lacuna
