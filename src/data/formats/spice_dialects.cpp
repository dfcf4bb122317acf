// SPDX-License-Identifier: MIT
// What circuit simulators write as text.
#include <algorithm>

#include "core/base/text.hpp"
#include "data/records/text_field.hpp"
#include "dialects.hpp"

namespace lacuna::dialects {
namespace {

std::vector<std::string> strings_of(const std::vector<std::string_view>& fields) {
  return {fields.begin(), fields.end()};
}

bool is_dashes(std::string_view line) {
  line = strip(line);
  return line.size() >= 10 && line.find_first_not_of('-') == std::string_view::npos;
}

bool all_numbers(const std::vector<std::string_view>& fields) {
  return std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
    return read_field(field).kind == TextField::Kind::Number;
  });
}

/// Every second column repeats the first one.
bool repeats_time(const std::vector<std::string_view>& fields) {
  if (fields.size() < 4 || fields.size() % 2 != 0) return false;
  for (std::size_t i = 2; i < fields.size(); i += 2)
    if (fields[i] != fields[0]) return false;
  return true;
}

std::vector<std::string> without_repeats(const std::vector<std::string_view>& fields) {
  std::vector<std::string> kept{std::string(fields[0])};
  for (std::size_t i = 1; i < fields.size(); i += 2) kept.emplace_back(fields[i]);
  return kept;
}

/// Takes the lines of a listing of ngspice.
class Listing {
 public:
  void operator()(std::string_view line, std::string& text) {
    const std::string_view content = strip(line);
    const auto fields = fields_of(content, ' ');
    if (is_named_ && !fields.empty() && all_numbers(fields)) {
      text += joined_line(without_index(fields));
    } else if (is_dashes(content) && last_.starts_with("Index") && !is_named_) {
      is_named_ = true;
      text += joined_line(without_index(fields_of(last_, ' ')));
    } else {
      text += '\n';  // titles, and heads that are repeated on every page
    }
    if (!is_named_ && !content.empty() && !is_dashes(content)) last_ = content;
  }

  bool is_named() const noexcept { return is_named_; }

 private:
  /// Without the number of the point.
  static std::vector<std::string> without_index(const std::vector<std::string_view>& fields) {
    return {fields.begin() + 1, fields.end()};
  }

  bool is_named_ = false;
  std::string last_;  ///< line that is neither empty nor dashes
};

/// Takes the lines of a raw file: the values of a point stand in lines of their own.
class RawPoints {
 public:
  explicit RawPoints(std::size_t variables) : variables_(variables) {}

  void operator()(std::string_view line, std::string& text) {
    const auto fields = fields_of(strip(line), ' ');
    if (in_values_ && !fields.empty()) {
      // The first value of a point stands behind the point's number.
      row_.emplace_back(row_.empty() && fields.size() > 1 ? fields[1] : fields[0]);
    }
    in_values_ = in_values_ || line.substr(0, 7) == "Values:";
    const bool is_full = row_.size() == variables_;
    text += is_full ? joined_line(row_) : "\n";
    if (is_full) row_.clear();
  }

 private:
  std::size_t variables_;
  bool in_values_ = false;
  std::vector<std::string> row_;
};

}  // namespace

std::optional<TextDialect> stepped_ltspice(std::string_view begin) {
  constexpr std::string_view kStep = "Step Information:";
  if (begin.find(kStep) == std::string_view::npos) return std::nullopt;
  const auto translate = [kStep, step = 0, named = false](std::string_view line,
                                                          std::string& text) mutable {
    if (line.substr(0, kStep.size()) == kStep) {
      ++step;
      text += '\n';
      return;
    }
    std::vector<std::string> fields = strings_of(fields_of(line, '\t'));
    fields.push_back(named ? std::to_string(step) : "run");
    named = true;
    text += strip(line).empty() ? "\n" : joined_line(fields);
  };
  return TextDialect{"taken for a stepped run of LTspice", translate, "run"};
}

std::optional<TextDialect> ngspice_print(std::string_view begin) {
  constexpr std::size_t kHead = 4096;  // in which the first page begins
  if (begin.substr(0, kHead).find("\nIndex ") == std::string_view::npos) return std::nullopt;
  Listing probe;
  std::string ignored;
  Lines lines(begin);
  while (const auto line = lines.next()) {
    probe(*line, ignored);
    if (probe.is_named()) return TextDialect{"taken for a listing of ngspice", Listing()};
  }
  return std::nullopt;
}

std::optional<TextDialect> ngspice_wrdata(std::string_view begin) {
  Lines probe(begin);
  const auto first = probe.next();
  if (!first || first->find(',') != std::string_view::npos) return std::nullopt;
  const auto heads = fields_of(*first, ' ');
  if (!repeats_time(heads)) return std::nullopt;
  const bool named = !all_numbers(heads);
  if (named && lower_case(heads[0]) != "time") return std::nullopt;
  while (const auto line = probe.next()) {
    const auto fields = fields_of(*line, ' ');
    if (fields.size() != heads.size() || !repeats_time(fields)) return std::nullopt;
  }
  std::string header;
  if (!named) {
    header = "t";
    for (std::size_t i = 1; i < heads.size(); i += 2) header += ";c" + std::to_string(i + 1);
    header += '\n';
  }
  const auto translate = [count = heads.size()](std::string_view line, std::string& text) {
    const auto fields = fields_of(line, ' ');
    if (fields.size() == count)
      text += joined_line(without_repeats(fields));
    else
      text.append(line) += '\n';  // the reader says what is wrong with it
  };
  return TextDialect{"taken for data of ngspice (wrdata)", translate, "", header};
}

std::optional<TextDialect> ngspice_raw(std::string_view begin) {
  if (begin.substr(0, 6) != "Title:" || begin.find("\nVariables:") == std::string_view::npos ||
      begin.find("\nValues:") == std::string_view::npos)
    return std::nullopt;
  std::vector<std::string> names;
  Lines lines(begin);
  bool listing = false;
  while (const auto line = lines.next()) {
    if (line->substr(0, 7) == "Values:") break;
    if (listing) {
      const auto fields = fields_of(strip(*line), ' ');
      if (fields.size() > 1) names.emplace_back(fields[1]);
    }
    listing = listing || line->substr(0, 10) == "Variables:";
  }
  if (names.empty()) return std::nullopt;
  return TextDialect{"taken for a raw file of ngspice or LTspice", RawPoints(names.size()), "",
                     joined_line(names)};
}

}  // namespace lacuna::dialects
