// SPDX-License-Identifier: MIT
// Small records of any values: an answer contradicts itself nowhere and is what its schema
// says.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "core/base/text.hpp"
#include "fuzz/target.hpp"
#include "support/consistency.hpp"
#include "support/run_command.hpp"
#include "support/schemas.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::fuzz {
namespace {

/// Bytes one after another; 0 behind the end.
class Bytes {
 public:
  explicit Bytes(std::string_view text) : text_(text) {}

  int next() { return at_ < text_.size() ? static_cast<unsigned char>(text_[at_++]) : 0; }
  bool at_end() const { return at_ >= text_.size(); }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// How the values of a column come about.
struct Column {
  double scale = 1.0, offset = 0.0, rate = 1.0, noise = 0.0;
  int kind = 0;  ///< 0: oscillation, 1: constant, 2: values come twice, 3: bytes, 4: decay

  explicit Column(Bytes& bytes) {
    const int power = bytes.next() - 128;
    scale = std::pow(10.0, power * (bytes.next() % 4 == 0 ? 2.0 : 0.05));
    if (bytes.next() % 5 == 0) offset = std::pow(10.0, bytes.next() % 16);
    rate = 0.1 + bytes.next() / 64.0;
    noise = bytes.next() % 3 == 0 ? 0.0 : 1e-3;
    kind = bytes.next() % 5;
  }

  double value(int i, int byte) const {
    const double t = 0.1 * (kind == 2 ? i / 2 : i), off = noise * (byte - 128) / 64.0;
    if (byte == 255) return std::numeric_limits<double>::quiet_NaN();
    const double plain = kind == 1   ? 1.0
                         : kind == 3 ? byte / 64.0
                         : kind == 4 ? std::exp(-0.2 * rate * t) + off
                                     : std::cos(rate * t) + off;
    return scale * (plain + offset);
  }
};

/// A table with a header: number of columns and samples, step, then what the columns are.
std::string table_of(std::string_view input) {
  Bytes bytes(input);
  const int states = 1 + bytes.next() % 2, samples = 2 + bytes.next() % 64;
  const double step = std::pow(10.0, bytes.next() % 7 == 0 ? bytes.next() - 128 : -1);
  std::vector<Column> columns;
  for (int k = 0; k < states; ++k) columns.emplace_back(bytes);
  std::string text = states == 1 ? "t,x\n" : "t,x,y\n";
  for (int i = 0; i < samples; ++i) {
    text += format_number(step * i);
    for (const Column& column : columns) {
      const double value = column.value(i, bytes.at_end() ? (i * 67 + 31) % 251 : bytes.next());
      text += "," + (std::isnan(value) ? std::string() : format_number(value));
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::vector<std::string> seeds() {
  return {std::string("\1\50\1\200\1\1\40\1\0", 9), std::string("\0\60\1\204\1\5\11\1\4", 9),
          std::string("\1\77\1\40\4\5\14\60\3\1\100\1\200\1\1\50\1\2", 18)};
}

void take(std::string_view input) {
  const testing::TemporaryFolder folder;
  folder.write("r.csv", table_of(input));
  const std::string json = folder.file("answer.json");
  const testing::CommandResult result =
      testing::run_command({"identify", folder.file("r.csv"), "--degree", "2", "--json", json});
  if (result.status != 0) {
    if (result.err.starts_with("lacuna: error: ")) return;
    std::printf("status %d: %s\n", result.status, result.err.c_str());
    std::abort();
  }
  const std::string text = folder.read("answer.json");
  support::Faults faults = support::contradictions(result.out, text);
  if (const std::string broken = testing::violation("identification", text); !broken.empty())
    faults.push_back(broken);
  if (faults.empty()) return;
  std::printf("%s\n%s\n", faults.front().c_str(), result.out.c_str());
  std::printf("%s", folder.read("r.csv").c_str());
  std::abort();
}

}  // namespace lacuna::fuzz
