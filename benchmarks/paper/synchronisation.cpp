// SPDX-License-Identifier: MIT
// Tables 4 and 5, Figs. 5 and 6: how far models stay from the records that drive them.
#include <limits>

#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "parts.hpp"

namespace lacuna::benchmarks {
namespace {

/// Median and mean in the unit they are compared in, e_r in per cent.
PrintedError errors_of(const SyncResult& result, double factor) {
  return {factor * result.median, factor * result.mean, 100.0 * result.relative};
}

void add_row(ResultTable& table, const std::string& master, const std::string& slave,
             const std::string& unit, const PrintedError& printed, const PrintedError& found) {
  table.rows.push_back({master, slave, unit, cell(printed.median), cell(found.median),
                        ratio_cell(found.median, printed.median), cell(printed.mean),
                        cell(found.mean), ratio_cell(found.mean, printed.mean),
                        cell(printed.percent), cell(found.percent),
                        ratio_cell(found.percent, printed.percent)});
}

void write_closed_loop(Output& output, const Source& source) {
  const double unit = source.unit;
  const OdeModel original = rescaled(test_system("rossler-circuit").model, 1.0 / unit);
  const OdeModel adjusted = rescaled(test_system("rossler-adjusted").model, 1.0 / unit);
  Matrix columns(source.record.samples(), 3);
  columns.col(0) = source.record.trajectories[0].time;
  columns.col(1) = unit * paper_sync(original, source.record).errors[0];
  columns.col(2) = unit * paper_sync(adjusted, source.record).errors[0];
  output.data("table4_" + source.stem, {"t", "original", "adjusted"}, columns);
}

/// "" for a model that loses the record, which ends its errors early.
std::string percent_cell(const SyncResult& result) {
  return result.status == IntegrationStatus::Completed ? cell(100.0 * result.relative)
                                                       : "diverges";
}

std::vector<std::string> default_row(const Identified& entry) {
  const Dataset& record = entry.source->record;
  const SyncResult raw = paper_sync(entry.paper_mode, record);
  const SyncResult own = paper_sync(entry.standard, record);
  std::vector<std::string> row{entry.source->name, percent_cell(raw), percent_cell(own)};
  const std::string eighth = percent_cell(paper_sync(entry.standard, record, dopri8()));
  if (!entry.source->truth) {
    row.insert(row.end(), {"", "", "", eighth, ""});
    return row;
  }
  const SyncResult truth = paper_sync(*entry.source->truth, record);
  const SyncResult truth8 = paper_sync(*entry.source->truth, record, dopri8());
  row.insert(row.end(),
             {percent_cell(truth), ratio_cell(raw.relative, truth.relative),
              ratio_cell(own.relative, truth.relative), eighth, percent_cell(truth8)});
  return row;
}

/// The errors over time of a model that may have lost the record early.
void fill_errors(const SyncResult& result, double unit, Eigen::Ref<Vector> column) {
  const Vector& errors = result.errors[0];
  column.setConstant(std::numeric_limits<double>::quiet_NaN());
  column.head(errors.size()) = unit * errors;
}

/// Mean distance of the slave from the orbit without noise, and its fraction of the largest
/// |x|.
PrintedError errors_from(const Matrix& orbit, const SyncResult& result) {
  const Matrix& slave = result.states[0];
  const Vector errors = (slave - orbit.topRows(slave.rows())).rowwise().norm();
  return {0.0, errors.mean(), 100.0 * errors.mean() / orbit.rowwise().norm().maxCoeff()};
}

/// A record with noise: the distance from the noisy samples, which noise alone makes large,
/// and from the orbit behind them.
void write_noise_table(Output& output, const Identified& entry) {
  const Source& source = *entry.source;
  ResultTable table;
  table.header = {"model", "% of the samples", "ratio to truth", "% of the orbit without noise",
                  "ratio to truth"};
  const SyncResult truth = paper_sync(*source.truth, source.record);
  const double orbit_truth = errors_from(*source.clean, truth).percent;
  const auto add = [&](const char* name, const SyncResult& result) {
    const double orbit = errors_from(*source.clean, result).percent;
    table.rows.push_back({name, cell(100.0 * result.relative),
                          ratio_cell(result.relative, truth.relative), cell(orbit),
                          ratio_cell(orbit, orbit_truth)});
  };
  add("paper mode", paper_sync(entry.paper_mode, source.record));
  add("default", paper_sync(entry.standard, source.record));
  add("truth", truth);
  output.table("table5_noise", source.name + ": mean error over the largest |x|", table);
}

Matrix free_orbit(const OdeModel& model, const Trajectory& record) {
  return simulate(model, rk4(), record.states.row(0).transpose(), record.time).states;
}

}  // namespace

void write_table_4(Output& output, const std::vector<Source>& sources) {
  output.chapter("Table 4: synchronisation with Rossler's equations",
                 "Errors with the original system as slave are in units of 1/4 V, those with "
                 "the adjusted system in V, as mean / percent of the printed numbers tells.");
  ResultTable table;
  table.header = {"record",       "slave", "unit [V]", "printed median", "median", "ratio",
                  "printed mean", "mean",  "ratio",    "printed %",      "%",      "ratio"};
  const OdeModel& original = test_system("rossler-circuit").model;
  const OdeModel& adjusted = test_system("rossler-adjusted").model;
  for (const Source& source : sources) {
    if (source.printed == nullptr) continue;
    const double unit = source.unit;
    add_row(table, source.name, "original", "0.25", source.printed->to_original,
            errors_of(paper_sync(rescaled(original, 1.0 / unit), source.record), 4.0 * unit));
    add_row(table, source.name, "adjusted", "1", source.printed->to_adjusted,
            errors_of(paper_sync(rescaled(adjusted, 1.0 / unit), source.record), unit));
    write_closed_loop(output, source);
  }
  output.table("table4", "Table 4", table);
}

void write_table_5(Output& output, const std::vector<Identified>& identified) {
  output.chapter("Table 5: synchronisation with the identified models",
                 "First the paper's procedure beside the printed numbers, then every record "
                 "with the relative mean error (%) of the paper's procedure, of the default "
                 "pipeline and of the true equations, by RK4 and by a slave of order 8.");
  ResultTable table;
  table.header = {"record",       "model", "unit [V]", "printed median", "median", "ratio",
                  "printed mean", "mean",  "ratio",    "printed %",      "%",      "ratio"};
  ResultTable own;
  own.header = {
      "record",          "paper mode %",      "default %",      "truth %", "paper mode / truth",
      "default / truth", "default % order 8", "truth % order 8"};
  for (const Identified& entry : identified) {
    const Source& source = *entry.source;
    if (source.printed != nullptr) {
      const auto add = [&](const std::string& name, const OdeModel& model) {
        add_row(table, source.name, name, cell(source.unit), source.printed->identified,
                errors_of(paper_sync(model, source.record), 1.0));
      };
      add("paper mode", entry.paper_mode);
      add("paper mode, IRLS", entry.with_irls);
    }
    own.rows.push_back(default_row(entry));
  }
  output.table("table5", "Table 5; the paper's procedure", table);
  output.table("table5_default", "Table 5; what the default pipeline reaches", own);
  for (const Identified& entry : identified)
    if (entry.source->clean && entry.source->truth) write_noise_table(output, entry);
}

void write_figure_5(Output& output, const std::vector<Identified>& identified) {
  output.chapter("Fig. 5: synchronisation error over time", "Errors in V at the samples.");
  std::string script = "set multiplot layout " + std::to_string((identified.size() + 1) / 2) +
                       ",2\nset logscale y\nset format y '10^{%T}'\nset grid\n"
                       "set xlabel 't, tau'\nset ylabel '|x_s - x_m|, V'\nset xrange [0:200]\n"
                       "set yrange [1e-8:10]\nset key bottom right horizontal\n";
  for (const Identified& entry : identified) {
    const Source& source = *entry.source;
    Matrix columns(source.record.samples(), 4);
    columns.col(0) = source.record.trajectories[0].time;
    fill_errors(paper_sync(entry.paper_mode, source.record), source.unit, columns.col(1));
    fill_errors(paper_sync(entry.standard, source.record), source.unit, columns.col(2));
    fill_errors(paper_sync(source.truth.value_or(entry.standard), source.record), source.unit,
                columns.col(3));
    output.data("figure5_" + source.stem, {"t", "paper mode", "default", "truth"}, columns);
    const std::string file = "'figure5_" + source.stem + ".csv' every ::1 ";
    script += "set title '" + source.name + "'\nplot " + file +
              "using 1:2 with lines lc rgb '#b2182b' title 'paper mode', " + file +
              "using 1:3 with lines lc rgb '#2166ac' title 'default'";
    if (source.truth)
      script += ", " + file + "using 1:4 with lines lc rgb 'gray60' title 'truth'";
    script += "\n";
  }
  output.picture("figure5", "Fig. 5: synchronisation errors over time", 1300, 1200, script);
}

void write_figure_6(Output& output, const std::vector<Identified>& identified) {
  output.chapter("Fig. 6: record, model, model with synchronisation",
                 "The circuit with TL072 amplifiers as measured, and the default model.");
  const Identified& entry = identified.back();
  const Source& source = *entry.source;
  const Trajectory& record = source.record.trajectories[0];
  output.data("figure6_record", {"x", "y", "z"}, source.unit * record.states);
  output.data("figure6_model", {"x", "y", "z"},
              source.unit * free_orbit(entry.standard, record));
  output.data("figure6_synchronised", {"x", "y", "z"},
              source.unit * paper_sync(entry.standard, source.record).states[0]);
  output.picture("figure6", "Fig. 6: attractor, model, model with synchronisation", 1400, 480,
                 R"(set multiplot layout 1,3
set grid
set xyplane 0
set view 65,40,1.1,1.3
set lmargin 7
set xrange [-2.5:3]
set yrange [-3:2]
set zrange [0:4.5]
set xtics -2,2
set ytics -2,2
set ztics 1
set xlabel 'x, V'
set ylabel 'y, V'
set zlabel 'z, V' rotate by 90 offset 2
set title 'a: record'
splot 'figure6_record.csv' every ::500 using 1:2:3 with lines lw 0.5 lc rgb '#2166ac' notitle
set title 'b: model, running free'
splot 'figure6_model.csv' every ::500 using 1:2:3 with lines lw 0.5 lc rgb '#b2182b' notitle
set title 'c: model, synchronised'
splot 'figure6_synchronised.csv' every ::500 using 1:2:3 with lines lw 0.5 lc rgb '#1b7837' notitle
unset multiplot
)");
}

}  // namespace lacuna::benchmarks
