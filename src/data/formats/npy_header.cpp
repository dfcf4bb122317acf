// SPDX-License-Identifier: MIT
#include "npy_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// The unit of a date or a span of time, "[ns]"; empty for those that are not read.
std::string unit_of_time(std::string_view brackets) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kUnits{{{"[ns]", "ns"},
                                                                                 {"[us]", "us"},
                                                                                 {"[ms]", "ms"},
                                                                                 {"[s]", "s"},
                                                                                 {"[m]", "min"},
                                                                                 {"[h]", "h"},
                                                                                 {"[D]", "d"}}};
  for (const auto& [written, unit] : kUnits)
    if (written == brackets) return std::string(unit);
  return "";
}

[[noreturn]] void refuse_unit(const std::string& type, const std::string& source) {
  throw NoMatrix(source, "the type '" + type + "' counts times in units that are not read",
                 "save them as t.astype('datetime64[ns]'), or timedelta64[ns]");
}

/// Reads the Python literal of the header: a dictionary of a type, a truth value, a tuple.
class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& source)
      : text_(text), source_(source) {}

  NpyHeader parse() {
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted();
      expect(':');
      read_entry(key);
      if (!accept(',') && !peek('}')) fail("its header is damaged");
    }
    if (header_.fields.empty() || !has_shape_) fail("its header is not complete");
    set_shape();
    return header_;
  }

  [[noreturn]] void fail(const std::string& problem) const { refuse<DataError>(problem); }

 private:
  template <class Problem>
  [[noreturn]] void refuse(const std::string& problem) const {
    throw Problem(source_, "this is no NumPy array that can be read: " + problem,
                  "save an array of numbers with one or two dimensions by numpy.save");
  }

  [[noreturn]] void fail_kind(const std::string& problem) const { refuse<NoMatrix>(problem); }

  void skip_blanks() {
    while (position_ < text_.size() && (text_[position_] == ' ' || text_[position_] == '\n'))
      ++position_;
  }

  bool peek(char c) {
    skip_blanks();
    return position_ < text_.size() && text_[position_] == c;
  }

  bool accept(char c) {
    if (!peek(c)) return false;
    ++position_;
    return true;
  }

  void expect(char c) {
    if (!accept(c)) fail(std::string("'") + c + "' is missing in its header");
  }

  std::string quoted() {
    skip_blanks();
    const char mark = position_ < text_.size() ? text_[position_] : ' ';
    if (mark != '\'' && mark != '"') fail("a name is missing in its header");
    const std::size_t end = text_.find(mark, position_ + 1);
    if (end == std::string_view::npos) fail("its header is damaged");
    std::string content(text_.substr(position_ + 1, end - position_ - 1));
    position_ = end + 1;
    return content;
  }

  bool truth() {
    skip_blanks();
    const std::string_view rest = text_.substr(position_);
    const bool value = rest.substr(0, 4) == "True";
    if (!value && rest.substr(0, 5) != "False") fail("its header is damaged");
    position_ += value ? 4 : 5;
    return value;
  }

  std::size_t count() {
    skip_blanks();
    std::size_t value = 0;
    const char* begin = text_.data() + position_;
    const auto [stop, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc()) fail("its shape is damaged");
    position_ += static_cast<std::size_t>(stop - begin);
    return value;
  }

  void read_entry(const std::string& key) {
    if (key == "descr")
      read_type();
    else if (key == "fortran_order")
      header_.fortran_order = truth();
    else if (key == "shape")
      read_dimensions();
    else
      fail("its header has an unknown entry '" + key + "'");
  }

  void read_type() {
    header_.fields.clear();
    header_.item_size = 0;
    header_.structured = accept('[');
    if (!header_.structured) return add_field("", quoted());
    while (!accept(']')) {
      expect('(');
      const std::string name = field_name();
      expect(',');
      if (!peek('\'') && !peek('"')) fail_kind("field '" + name + "' has fields inside");
      const std::string type = quoted();
      if (accept(',') && !peek(')')) fail_kind("field '" + name + "' is an array");
      expect(')');
      add_field(name, type);
      if (!accept(',') && !peek(']')) fail("its header is damaged");
    }
  }

  /// A name, or a title and a name in parentheses.
  std::string field_name() {
    if (!accept('(')) return quoted();
    quoted();
    expect(',');
    std::string name = quoted();
    expect(')');
    return name;
  }

  /// Adds a field such as '<f8'; unnamed bytes ('|V4') only fill space.
  void add_field(const std::string& name, const std::string& type) {
    if (type.size() < 3) fail_kind("the type '" + type + "' is not known");
    NpyField field{name, type[1], 0, header_.item_size, type[0] == '>'};
    const char* end = type.data() + type.size();
    const auto [stop, error] = std::from_chars(type.data() + 2, end, field.size);
    const bool is_time = field.kind == 'M' || field.kind == 'm';
    const bool number = error == std::errc() && (stop == end || is_time);
    if (!number || field.size > kLargestItem) fail_kind("the type '" + type + "' is not known");
    if (is_time) {
      field.unit = unit_of_time(std::string_view(stop, end));
      if (field.unit.empty()) refuse_unit(type, source_);
      field.kind = 'i';
    }
    header_.item_size += field.size;
    if (header_.structured && field.kind == 'V' && name.empty()) return;
    if (!is_supported(field)) fail_kind("the type '" + type + "' is not a real number");
    if (field.kind == 'b') field.kind = 'u';
    header_.fields.push_back(field);
  }

  static bool is_supported(const NpyField& field) {
    const std::size_t size = field.size;
    if (field.kind == 'b') return size == 1;
    if (field.kind == 'f') return size == 2 || size == 4 || size == 8;
    const bool integer = field.kind == 'i' || field.kind == 'u';
    return integer && (size == 1 || size == 2 || size == 4 || size == 8);
  }

  void read_dimensions() {
    expect('(');
    dimensions_.clear();
    while (!accept(')')) {
      dimensions_.push_back(count());
      if (!accept(',') && !peek(')')) fail("its shape is damaged");
    }
    has_shape_ = true;
  }

  void set_shape() {
    const std::size_t allowed = header_.structured ? 1 : 2;
    if (dimensions_.empty() || dimensions_.size() > allowed)
      fail_kind("it has " + std::to_string(dimensions_.size()) + " dimensions");
    header_.rows = dimensions_[0];
    header_.columns = dimensions_.size() > 1 ? dimensions_[1] : 1;
    if (header_.rows == 0 || header_.columns == 0) fail_kind("it is empty");
  }

  static constexpr std::size_t kLargestItem = 1U << 20U;
  std::string_view text_;
  const std::string& source_;
  std::size_t position_ = 0;
  NpyHeader header_;
  std::vector<std::size_t> dimensions_;
  bool has_shape_ = false;
};

std::size_t little_endian(std::string_view bytes, std::size_t begin, std::size_t size) {
  std::size_t value = 0;
  for (std::size_t i = size; i-- > 0;)
    value = (value << 8U) | static_cast<unsigned char>(bytes[begin + i]);
  return value;
}

/// Whether rows x columns items lie in that many bytes; safe against overflow.
bool fits(const NpyHeader& header, std::size_t available) {
  const std::size_t items = available / header.item_size;
  return header.rows <= items / header.columns;
}

}  // namespace

NpyHeader parse_npy_header(std::string_view bytes, std::size_t file_size,
                           const std::string& source) {
  constexpr std::size_t kLengthAt = 8;
  const HeaderParser damaged("", source);
  if (bytes.substr(0, 6) != "\x93NUMPY") damaged.fail("its first bytes are not those of one");
  if (bytes.size() < 12) damaged.fail("it is cut short");
  const auto version = static_cast<unsigned char>(bytes[6]);
  if (version < 1 || version > 3)
    damaged.fail("its format version " + std::to_string(version) + " is not known");
  const std::size_t length_size = version == 1 ? 2 : 4;
  const std::size_t length = little_endian(bytes, kLengthAt, length_size);
  const std::size_t begin = kLengthAt + length_size;
  if (length > bytes.size() - begin) damaged.fail("it is cut short");
  NpyHeader header = HeaderParser(bytes.substr(begin, length), source).parse();
  header.data_begin = begin + length;
  if (!fits(header, file_size - header.data_begin)) damaged.fail("it is cut short");
  return header;
}

}  // namespace lacuna
