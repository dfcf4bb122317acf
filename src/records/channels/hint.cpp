// SPDX-License-Identifier: MIT
#include "lacuna/records/channels/hint.hpp"

#include <algorithm>

namespace lacuna {

std::string to_string(HintKind kind) {
  switch (kind) {
    case HintKind::TimeUnit:
      return "time-unit";
    case HintKind::ChannelUnit:
      return "channel-unit";
    case HintKind::Sign:
      return "sign";
    case HintKind::SwappedColumns:
      return "swapped-columns";
    case HintKind::UnusedColumn:
      return "unused-column";
    case HintKind::Identity:
      return "identity";
    case HintKind::ClosedLoop:
      return "closed-loop";
    case HintKind::Excitation:
      return "excitation";
    case HintKind::Sampling:
      return "sampling";
    case HintKind::NotIdentifiable:
      return "not-identifiable";
    case HintKind::DiscreteMap:
      return "discrete-map";
  }
  return "";
}

Withheld withheld_by(const std::vector<Hint>& hints) {
  Withheld most = Withheld::Nothing;
  for (const Hint& hint : hints) most = std::max(most, hint.withheld);
  return most;
}

}  // namespace lacuna
