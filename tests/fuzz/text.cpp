// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <cstring>

#include "data/formats/read_text.hpp"
#include "data/formats/text_rows.hpp"
#include "fuzz/target.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/roles.hpp"

namespace lacuna::fuzz {

/// Lines with a number that rises in the place of each #.
std::string rising(const std::string& line) {
  std::string text;
  for (int i = 0; i < 12; ++i)
    for (const char c : line) text += c == '#' ? std::to_string(i) : std::string(1, c);
  return text;
}

std::vector<std::string> seeds() {
  return {"t,x,y\n" + rising("#,1,#\n"),
          "time,x\n" + rising("10:00:#,#.5\n"),
          "X,CH1,Start,Increment,\nSequence,Volt,0,0.5,\n" + rising("#,1,,\n"),
          rising(" #.5 1.0 #.5 5.#\n"),
          "Title: * rc\nVariables:\n\t0\ttime\ttime\n\t1\tv(out)\tvoltage\nValues:\n" +
              rising(" #\t0.#\n\t1.#\n\n"),
          "time\tV(a)\nStep Information: R=1\n" + rising("#\t1\n"),
          "t,x,y\n0,1,2\n1,2,3\n2,3,4\n",
          "t [s];x [V]\n0;1,5\n1;2,5\n2;3,5\n",
          "# scope\nmodel,3\nt x y\n0 1 2\n1 2 nan\n2 3 4\n4 5 6\n",
          "\xef\xbb\xbftime\tu\xc2\xb5\r\n0\t1e-3\r\n1\t\r\n2\t\"3\"\r\n",
          "LabVIEW Measurement\t\n***End_of_Header***\t\nChannels\t1\nX0\t2.0\n"
          "***End_of_Header***\t\nX_Value\tv\tComment\n\t1,5\n\t2,5\n\t3,5\n",
          "Record Length,2,,-0.0005,  0.02,\nSource,CH2,,-0.0004,  0.04,\n",
          "Index   time   v(th)\n----------\n0\t0.0\t1.0\t\n1\t0.1\t2.0\t\n"};
}

/// Rows that come in two blocks are those of the whole, where the first block shows how they
/// are read.
void check_blocks(std::string_view input, const Table& whole) {
  const std::string_view begin = input.substr(0, input.size() * 3 / 4);
  auto format = find_format(begin, false, "input");
  if (!format || format->layout.line_end != line_end_of(input)) return;
  const auto known = find_format(input, true, "input");
  const auto note = [](const TextFormat& one) { return one.dialect ? one.dialect->note : ""; };
  if (note(*format) != note(*known) ||
      format->layout.data_begin != known->layout.data_begin ||
      format->layout.columns() != known->layout.columns())
    return;
  TextRows rows(std::move(*format), "input");
  const std::string_view first = whole_lines(begin, rows.line_end());
  Table table = rows.columns();
  Index row = 0;
  for (const std::string_view block : {first, input.substr(first.size())}) {
    rows.read(block, table);
    for (Index i = 0; i < table.values.rows(); ++i, ++row)
      for (Index k = 0; k < table.values.cols(); ++k)
        if (row >= whole.values.rows() ||
            std::memcmp(&table.values(i, k), &whole.values(row, k), sizeof(double)) != 0 ||
            table.lines[static_cast<std::size_t>(i)] !=
                whole.lines[static_cast<std::size_t>(row)])
          std::abort();
  }
  if (row != whole.values.rows()) std::abort();
}

void take(std::string_view input) {
  try {
    const Table table = parse_text_table(input, "input");
    check_blocks(input, table);
    assign_roles(table, {});
  } catch (const Error&) {
  }
}

}  // namespace lacuna::fuzz
