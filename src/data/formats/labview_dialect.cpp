// SPDX-License-Identifier: MIT
// LabVIEW measurement files (.lvm): a head, then packets, each with a head and its samples.
#include <map>

#include "core/base/text.hpp"
#include "data/records/text_field.hpp"
#include "dialects.hpp"

namespace lacuna::dialects {
namespace {

constexpr std::string_view kEnd = "***End_of_Header***";

using Head = std::map<std::string, std::vector<std::string>, std::less<>>;

double value_in(const Head& head, const std::string& key, double otherwise) {
  const auto found = head.find(key);
  if (found == head.end() || found->second.empty()) return otherwise;
  const TextField field = read_field(found->second.front());
  return field.kind == TextField::Kind::Number ? field.value : otherwise;
}

std::string unit_in(const Head& head, std::size_t channel) {
  const auto found = head.find("Y_Unit_Label");
  if (found == head.end() || channel >= found->second.size()) return "";
  const std::string word = lower_case(found->second[channel]);
  return word == "volts" || word == "volt" ? "V"
         : word == "amps"                  ? "A"
                                           : found->second[channel];
}

/// Columns that hold channels, by the names of a packet.
std::vector<std::size_t> channels_of(const std::vector<std::string>& names) {
  std::vector<std::size_t> channels;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!names[i].empty() && names[i] != "X_Value" && names[i] != "Comment")
      channels.push_back(i);
  return channels;
}

/// Samples of one packet up to an empty line or the next head.
struct Packet {
  std::vector<std::string> names;
  std::vector<std::size_t> channels;
  double begin = 0.0, step = 0.0;
  int run = 1;
};

/// One line of samples; a time that is left out is that of the sample's number.
std::string row_of(const std::vector<std::string_view>& fields, const Packet& packet,
                   double sample) {
  const bool timed = packet.names[0] == "X_Value" && !fields[0].empty();
  std::vector<std::string> row{timed ? std::string(fields[0])
                                     : format_number(packet.begin + sample * packet.step)};
  for (const std::size_t i : packet.channels)
    row.emplace_back(i < fields.size() ? fields[i] : std::string_view{});
  row.push_back(std::to_string(packet.run));
  return joined_line(row);
}

std::string names_of(const Packet& packet, const Head& head) {
  std::vector<std::string> names{"t [s]"};
  for (std::size_t c = 0; c < packet.channels.size(); ++c) {
    const std::string unit = unit_in(head, c);
    names.push_back(packet.names[packet.channels[c]] + (unit.empty() ? "" : " [" + unit + "]"));
  }
  names.emplace_back("packet");
  return joined_line(names);
}

bool begins_head(std::string_view line) { return line.substr(0, 8) == "Channels"; }

/// Takes the lines of a file, one after the other.
class Measurement {
 public:
  explicit Measurement(char delimiter) : delimiter_(delimiter) { packet_.run = 0; }

  void operator()(std::string_view line, std::string& text) {
    const std::string_view content = strip(line);
    if (!in_head_ && begins_head(content)) {
      in_head_ = true;
      packet_.names.clear();
    } else if (in_head_) {
      take_head(line);
    } else if (!content.empty() && packet_.names.empty()) {
      begin_packet(line);
      if (packet_.run == 1) text += names_of(packet_, head_);
      if (packet_.run == 1) return;
    } else if (!content.empty()) {
      text += row_of(fields_of(line, delimiter_), packet_, sample_++);
      return;
    }
    text += '\n';
  }

 private:
  /// "key value value ..." up to the end of a head.
  void take_head(std::string_view line) {
    in_head_ = line.substr(0, kEnd.size()) != kEnd;
    const auto fields = fields_of(line, delimiter_);
    if (!in_head_ || fields.empty()) return;
    head_[std::string(fields[0])].assign(fields.begin() + 1, fields.end());
  }

  void begin_packet(std::string_view line) {
    const auto names = fields_of(line, delimiter_);
    packet_ = {{names.begin(), names.end()},
               {},
               value_in(head_, "X0", 0.0),
               value_in(head_, "Delta_X", 1.0),
               packet_.run + 1};
    packet_.channels = channels_of(packet_.names);
    sample_ = 0.0;
  }

  char delimiter_;
  bool in_head_ = true;
  Head head_;
  Packet packet_;
  double sample_ = 0.0;
};

}  // namespace

std::optional<TextDialect> labview(std::string_view begin) {
  if (begin.substr(0, 19) != "LabVIEW Measurement") return std::nullopt;
  const char delimiter = begin.find("Separator\tComma") != std::string_view::npos ||
                                 begin.find("Separator,Comma") != std::string_view::npos
                             ? ','
                             : '\t';
  return TextDialect{"taken for a LabVIEW measurement", Measurement(delimiter), "packet", "",
                     delimiter};
}

}  // namespace lacuna::dialects
