// SPDX-License-Identifier: MIT
#include <cmath>

#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "parts.hpp"

namespace lacuna::benchmarks {
namespace {

/// Master and slave are Rossler's equations by the same method; 200 time units.
SyncResult twins(int order, double h, double length) {
  const TestSystem& rossler = test_system("rossler");
  const Stage<Integrator> method = runge_kutta({.order = order});
  const Dataset master = record_of(rossler.model, method, Vector::Constant(3, 0.1), h,
                                   std::lround(length / h) + 1);
  return paper_sync(rossler.model, master, method);
}

void write_error_over_time(Output& output) {
  const SyncResult result = twins(4, kStep, 1000.0);
  Matrix columns(result.errors[0].size(), 2);
  columns.col(0) = Vector::LinSpaced(columns.rows(), 0.0, 1000.0);
  columns.col(1) = result.errors[0];
  output.data("figure1_time", {"t", "error"}, columns);
}

/// Median errors, one row per step, one column per order.
Matrix median_errors(const Vector& steps) {
  Matrix errors(steps.size(), 8);
  errors.col(0) = steps;
  for (int order = 2; order <= 8; ++order)
    for (Index i = 0; i < steps.size(); ++i)
      errors(i, order - 1) = twins(order, steps[i], 200.0).median;
  return errors;
}

/// Slope between the two steps where rounding is furthest.
double observed_order(const Matrix& errors, Index column) {
  return std::log(errors(1, column) / errors(3, column)) /
         std::log(errors(1, 0) / errors(3, 0));
}

void write_order_table(Output& output, const Matrix& errors) {
  ResultTable table;
  table.header = {"order of the method", "Lagrange points", "median error at h = 0.1",
                  "at h = 0.05", "observed order"};
  for (int order = 2; order <= 8; ++order)
    table.rows.push_back({std::to_string(order), std::to_string(order),
                          cell(errors(1, order - 1)), cell(errors(3, order - 1)),
                          ratio_cell(observed_order(errors, order - 1), 1.0)});
  output.table("figure1_orders", "Two Rossler models by one method", table);
}

/// The step at which the error of order 4 is the printed one.
void write_printed_median(Output& output) {
  const double found = twins(4, kStep, 1000.0).median;
  ResultTable table;
  table.header = {"quantity", "printed", "found at h = 0.1", "ratio", "step of equal error"};
  table.rows.push_back(
      {"median of Fig. 1", cell(kPrintedFigure1Median), cell(found),
       ratio_cell(found, kPrintedFigure1Median),
       ratio_cell(kStep * std::pow(kPrintedFigure1Median / found, 0.25), 1.0)});
  output.table("figure1", "Fig. 1", table);
}

}  // namespace

void write_figure_1(Output& output) {
  output.chapter("Fig. 1: synchronisation of two Rossler models",
                 "Master and slave by the same Runge-Kutta method, mid-points from as many "
                 "samples as the method has order; only x is coupled, k = 1.");
  write_error_over_time(output);
  const Vector steps{{0.14, 0.1, 0.07, 0.05, 0.035, 0.025, 0.0175, 0.0125}};
  const Matrix errors = median_errors(steps);
  output.data("figure1_step",
              {"h", "order2", "order3", "order4", "order5", "order6", "order7", "order8"},
              errors);
  write_printed_median(output);
  write_order_table(output, errors);
  output.picture("figure1", "Fig. 1: error over time, and against the step", 1100, 420,
                 R"(set multiplot layout 1,2
set logscale y
set format y '10^{%T}'
set grid
set xlabel 'time'
set ylabel '|x_s - x_m|'
set title 'RK4, h = 0.1'
plot 'figure1_time.csv' every ::1 using 1:2 with lines lc rgb '#2166ac' notitle
set logscale x
set format x '%g'
set xrange [0.011:0.16]
set xtics (0.0125, 0.025, 0.05, 0.1)
set yrange [1e-16:1e-1]
set xlabel 'step h'
set ylabel 'median |x_s - x_m|'
set title 'methods of order 2 to 8'
set key bottom right
plot for [p=2:8] 'figure1_step.csv' using 1:p with linespoints pt 7 ps 0.6 \
  title sprintf('order %d', p), \
  0.25*x**4 with lines dt 2 lc rgb 'black' title 'h^4'
unset multiplot
)");
}

}  // namespace lacuna::benchmarks
