// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace lacuna {

/// What a hint is about.
enum class HintKind {
  TimeUnit,         ///< time off by a factor
  ChannelUnit,      ///< a column off by a factor
  Sign,             ///< a column with the other sign
  SwappedColumns,   ///< two columns in each other's place
  UnusedColumn,     ///< a column that the model does not know explains what it lacks
  Identity,         ///< a column is not the derivative that the model says it is
  ClosedLoop,       ///< an input is nearly a function of the states
  Excitation,       ///< hardly any motion
  Sampling,         ///< too few samples in a period, too few periods
  NotIdentifiable,  ///< coefficients that the records do not distinguish
  DiscreteMap,      ///< samples follow from one another by a map, on no path in between
};

/// "time-unit", "channel-unit", "sign", ...
std::string to_string(HintKind kind);

/// How far the answer may go where a hint holds.
enum class Withheld {
  Nothing,  ///< a remark
  Names,    ///< no effect may be named: another cause is at hand
  Claims,   ///< nor may a coefficient be said to be off: nothing moves
  Answer,   ///< records and model do not fit together, and nothing can be said
};

/// Something odd about records and model, and what would mend it.
struct Hint {
  HintKind kind = HintKind::TimeUnit;
  std::string message;
  std::string remedy;
  Withheld withheld = Withheld::Nothing;
};

/// The most that any of the hints withholds.
Withheld withheld_by(const std::vector<Hint>& hints);

}  // namespace lacuna
