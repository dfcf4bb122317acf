// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/hints/hints.hpp"
#include "lacuna/records/binding/bound_records.hpp"

namespace lacuna {

/// One column of the records as it was read.
struct ChannelSummary {
  Quantity quantity;
  std::string role;  ///< "state", "input", "not used"
  double least = 0.0, largest = 0.0;
  std::optional<Channel> channel = {};      ///< of a state: noise, blanks, ends
  std::optional<double> signal_until = {};  ///< 1/time unit: above it only noise is seen
  std::optional<Hold> hold = {};            ///< of an input that moves: what its samples show
};

/// One record.
struct RecordSummary {
  std::string source;
  Index samples = 0;
  double begin = 0.0, end = 0.0;
  double step = 0.0;  ///< mean
  bool uniform = false;
};

/// What was read: all that can be said of records before anything is made of them.
struct DataSummary {
  std::string time_unit;
  std::vector<RecordSummary> records;
  std::vector<ChannelSummary> channels;
  std::vector<Hint> hints;         ///< of records and model, or that records look like a map
  std::vector<std::string> notes;  ///< of the reader and of the channels
};

/// Looks at records. Inputs behind the first `known` ones are columns that nobody asked for.
/// The signal of a state reaches up to the highest frequency at which its power spectrum
/// (Welch) is above four times that of its noise, 2 h sigma^2.
/// @throws DataError as check_dataset().
DataSummary summarise(const Dataset& data, Index known);

/// For people: columns with their roles, records, what is odd.
std::string format_text(const DataSummary& summary);

/// JSON text of the format "lacuna.check/1".
std::string format_json(const DataSummary& summary);

/// One line: files, columns with roles and units, rows, step, records.
/// @throws DataError as check_form().
std::string data_line(const Dataset& data, Index known);

}  // namespace lacuna
