// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "dynamics/attractor/extents.hpp"
#include "dynamics/test_systems/rossler_circuit.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "parts.hpp"
#include "spice.hpp"

namespace lacuna::benchmarks {
namespace {

/// A part of Table 1: the digit it is printed to decides how far it may be from its value.
struct Part {
  const char* name;
  double RosslerComponents::*value;
  double rounding;  ///< half a unit of the last digit
  const char* unit;
};

constexpr Part kParts[] = {
    {"R1", &RosslerComponents::r1, 0.005, "kOhm"},
    {"R2", &RosslerComponents::r2, 0.005, "kOhm"},
    {"R3", &RosslerComponents::r3, 0.005, "kOhm"},
    {"R4", &RosslerComponents::r4, 0.05, "kOhm"},
    {"R8", &RosslerComponents::r8, 0.05, "kOhm"},
    {"R10", &RosslerComponents::r10, 0.005, "kOhm"},
    {"R11", &RosslerComponents::r11, 0.005, "kOhm"},
    {"R12", &RosslerComponents::r12, 0.005, "kOhm"},
    {"R13", &RosslerComponents::r13, 0.0005, "kOhm"},
    {"C1", &RosslerComponents::c1, 0.05, "nF"},
    {"C2", &RosslerComponents::c2, 0.05, "nF"},
    {"C3", &RosslerComponents::c3, 0.05, "nF"},
};

Dataset orbit_of(const RosslerComponents& parts) {
  return record_of(rossler_circuit(parts), dopri8(), Vector::Constant(3, 0.1), kStep, kSamples);
}

/// dx, dy, dz, volume.
Vector sizes_of(const AttractorExtents& extents) {
  Vector sizes(4);
  sizes << extents.size, extents.volume;
  return sizes;
}

/// Sizes with all parts drawn within their last printed digit, one draw per row.
Matrix sizes_within_rounding(int draws) {
  Random random(1);
  Matrix sizes(draws, 4);
  for (Index d = 0; d < draws; ++d) {
    RosslerComponents parts = RosslerComponents::measured();
    for (const Part& part : kParts)
      parts.*part.value += random.uniform(-part.rounding, part.rounding);
    sizes.row(d) = sizes_of(attractor_extents(orbit_of(parts))).transpose();
  }
  return sizes;
}

void write_rounding_table(Output& output, const PrintedSystem& printed) {
  const Matrix sizes = sizes_within_rounding(100);
  ResultTable table;
  table.header = {"quantity", "printed", "+-", "smallest", "largest"};
  const char* const names[] = {"dx", "dy", "dz", "volume"};
  for (Index k = 0; k < 4; ++k)
    table.rows.push_back({names[k], cell((*printed.extents)[static_cast<std::size_t>(2 * k)]),
                          cell((*printed.extents)[static_cast<std::size_t>(2 * k + 1)]),
                          cell(sizes.col(k).minCoeff()), cell(sizes.col(k).maxCoeff())});
  output.table("table2_rounding",
               "Row 1 of Table 2 with the parts of Table 1 anywhere within their last printed "
               "digit (100 draws)",
               table);
}

void add_rows(ResultTable& table, const std::string& name, const PrintedSystem* printed,
              const AttractorExtents& extents) {
  const char* const names[] = {"dx [V]", "dy [V]", "dz [V]", "volume [V^3]"};
  Vector half_width(4);
  half_width << extents.half_width, extents.volume_half_width;
  const Vector sizes = sizes_of(extents);
  for (Index k = 0; k < 4; ++k) {
    std::vector<std::string> row{name, names[k], "", "", cell(sizes[k]), cell(half_width[k]),
                                 "",   ""};
    if (printed != nullptr) {
      const double value = (*printed->extents)[static_cast<std::size_t>(2 * k)];
      const double reach = (*printed->extents)[static_cast<std::size_t>(2 * k + 1)];
      row[2] = cell(value);
      row[3] = cell(reach);
      row[6] = ratio_cell(sizes[k], value);
      const double off = std::abs(sizes[k] - value);
      row[7] = off <= reach ? "inside" : off <= reach + half_width[k] ? "overlap" : "outside";
    }
    table.rows.push_back(row);
  }
}

Dataset in_volts(const Source& source) {
  Dataset record = source.record;
  record.trajectories[0].states *= source.unit;
  return record;
}

/// The circuits again, with the amplifiers' offset voltages.
void write_offset_table(Output& output) {
  ResultTable table;
  table.header = {"system", "quantity", "printed circuit", "+-",
                  "found",  "+-",       "ratio",           "interval"};
  const auto records = simulate_netlists({"tl072_offset", "opa2134_offset"}, output);
  for (std::size_t i = 0; i < records.size(); ++i)
    if (records[i])
      add_rows(table, i == 0 ? "TL072 with 3 mV offset" : "OPA2134 with 0.5 mV offset",
               &printed_systems()[4 + i], attractor_extents(*records[i]));
  if (!table.rows.empty())
    output.table("table2_offset",
                 "The simulated circuits with offset voltages, beside the "
                 "measured circuits",
                 table);
}

}  // namespace

void write_table_1(Output& output) {
  output.chapter("Table 1 and equation (12)",
                 "The library function rossler_circuit() makes the model from the parts, in V "
                 "per tau, with tau = 0.1 ms and amplitudes divided by M = 4.");
  const RosslerComponents ideal, measured = RosslerComponents::measured();
  ResultTable table;
  table.header = {"part", "proposed", "measured", "unit"};
  for (const Part& part : kParts)
    table.rows.push_back(
        {part.name, cell(ideal.*part.value), cell(measured.*part.value), part.unit});
  output.table("table1", "Table 1", table);
  std::string text = "Equation (12) with the measured parts:\n\n";
  const std::string equations = to_text(rossler_circuit(measured), 4);
  for (std::size_t begin = 0; begin < equations.size();) {
    const std::size_t end = std::min(equations.find('\n', begin), equations.size());
    text += "    " + equations.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  output.chapter("Adjusted system", text);
}

void write_table_2(Output& output, const std::vector<Source>& sources) {
  output.chapter("Table 2: geometry of the attractors",
                 "Extents of 1000 tau; 95 % intervals of the mean of five blocks. 'inside': "
                 "within the printed interval; 'overlap': the two intervals meet.");
  ResultTable table;
  table.header = {"system", "quantity", "printed", "+-", "found", "+-", "ratio", "interval"};
  for (const Source& source : sources)
    if (source.printed != nullptr && source.printed->extents)
      add_rows(table, source.name, source.printed, attractor_extents(in_volts(source)));
  output.table("table2", "Table 2", table);
  write_rounding_table(output, printed_systems()[1]);
  write_offset_table(output);
}

void write_figures_3_4(Output& output, const std::vector<Source>& sources) {
  output.chapter("Figs. 3 and 4: attractors", "In V.");
  std::string plane =
      "set multiplot layout 2,3\nset grid\nset xrange [-3.5:3.5]\n"
      "set yrange [-3.5:3.5]\nset xlabel 'x, V'\nset ylabel 'y, V' offset 1\n";
  std::string space =
      "set multiplot layout 2,3\nset grid\nset xrange [-3:3.5]\n"
      "set yrange [-3.5:2.5]\nset zrange [0:9]\nset xyplane 0\n"
      "set view 65,40,1.15,1.35\nset lmargin 7\nset xlabel 'x, V'\nset ylabel 'y, V'\n"
      "set zlabel 'z, V' rotate by 90 offset 2\nset xtics 2\nset ytics 2\nset ztics 2\n";
  for (const Source& source : sources) {
    if (source.printed == nullptr) continue;
    output.data("attractor_" + source.stem, {"x", "y", "z"},
                in_volts(source).trajectories[0].states);
    const std::string file = "'attractor_" + source.stem + ".csv' every ::500 ";
    const std::string style = "with lines lw 0.5 lc rgb '#2166ac' notitle\n";
    plane += "set title '" + source.name + "'\nplot " + file + "using 1:2 " + style;
    space += "set title '" + source.name + "'\nsplot " + file + "using 1:2:3 " + style;
  }
  output.picture("figure3", "Fig. 3: projections on the plane of x and y", 1200, 760, plane);
  output.picture("figure4", "Fig. 4: attractors", 1300, 860, space);
}

}  // namespace lacuna::benchmarks
