// SPDX-License-Identifier: MIT
// Models identified from the records: Table 3 and what the paper does not have.
#include <algorithm>
#include <cmath>
#include <optional>

#include "dynamics/attractor/density_distance.hpp"
#include "dynamics/attractor/lyapunov.hpp"
#include "dynamics/attractor/power_spectrum.hpp"
#include "dynamics/attractor/prediction_time.hpp"
#include "dynamics/attractor/rosenstein.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "parts.hpp"

namespace lacuna::benchmarks {
namespace {

Identified identify_one(const Source& source) {
  return {&source, identify(source.record, preset("algorithm1", Tolerances::Paper)).model,
          identify(source.record, preset("paper")).model,
          identify(source.record, preset("algorithm1")).model};
}

const Identified* find(const std::vector<Identified>& identified, const std::string& stem) {
  for (const Identified& entry : identified)
    if (entry.source->stem == stem) return &entry;
  return nullptr;
}

/// All 20 terms of an equation with three columns of numbers, in V per tau.
void write_coefficients(Output& output, const Identified& entry) {
  const double unit = entry.source->unit;
  const OdeModel printed = rescaled(*entry.source->truth, unit);
  const OdeModel paper_mode = rescaled(entry.paper_mode, unit);
  const OdeModel standard = rescaled(entry.standard, unit);
  ResultTable table;
  table.header = {"equation", "term", "printed", "paper mode", "ratio", "default", "ratio"};
  for (Index k = 0; k < printed.dimension(); ++k)
    for (const WeightedTerm& summand : printed.equations()[static_cast<std::size_t>(k)]) {
      const std::string& term = summand.term.name();
      const double value = summand.coefficient;
      const double raw = paper_mode.coefficient(k, term);
      const double own = standard.coefficient(k, term);
      table.rows.push_back({"d" + printed.states()[static_cast<std::size_t>(k)].name, term,
                            cell(value), cell(raw), ratio_cell(raw, value), cell(own),
                            ratio_cell(own, value)});
    }
  output.table("table3_" + entry.source->stem, "Table 3, " + entry.source->name, table);
}

double largest_difference(const OdeModel& a, const OdeModel& b) {
  double largest = 0.0;
  for (Index k = 0; k < a.dimension(); ++k)
    for (const OdeModel* model : {&a, &b})
      for (const WeightedTerm& summand : model->equations()[static_cast<std::size_t>(k)]) {
        const std::string& term = summand.term.name();
        const double off = a.coefficient(k, term) - b.coefficient(k, term);
        largest = std::max(largest, std::abs(off));
      }
  return largest;
}

std::string term_counts(const OdeModel& model) {
  std::string text;
  for (const Equation& equation : model.equations())
    text += (text.empty() ? "" : " + ") + std::to_string(equation.size());
  return text;
}

void write_support_table(Output& output, const std::vector<Identified>& identified) {
  ResultTable table;
  table.header = {"system",
                  "true terms",
                  "paper mode",
                  "default",
                  "largest error; paper mode",
                  "largest error; default"};
  for (const Identified& entry : identified) {
    const bool known = entry.source->truth.has_value();
    const auto error = [&](const OdeModel& model) {
      return known ? cell(largest_difference(model, *entry.source->truth)) : "";
    };
    table.rows.push_back({entry.source->name,
                          known ? term_counts(*entry.source->truth) : "unknown",
                          term_counts(entry.paper_mode), term_counts(entry.standard),
                          error(entry.paper_mode), error(entry.standard)});
  }
  output.table("table3_terms", "Terms per equation, and the largest error of a coefficient",
               table);
}

/// A free run of the model from the record's start; nothing when it leaves the attractor.
std::optional<Trajectory> free_run(const OdeModel& model, const Trajectory& record) {
  const Solution orbit =
      simulate(model, dopri8(), record.states.row(0).transpose(), record.time);
  if (orbit.status != IntegrationStatus::Completed) return {};
  Trajectory run;
  run.source = "free run";
  run.time = orbit.time;
  run.states = orbit.states;
  return run;
}

std::vector<std::string> measures_of(const Identified& entry, const char* name,
                                     const OdeModel& model) {
  const Trajectory& record = entry.source->record.trajectories[0];
  std::vector<std::string> row{entry.source->name, name,
                               cell(rosenstein_divergence(record, 1000).exponent)};
  const std::optional<Trajectory> run = free_run(model, record);
  if (!run) {
    row.insert(row.end(), {"diverges", "", "", "", ""});
    return row;
  }
  const LyapunovSpectrum spectrum = lyapunov_spectrum(
      model, rk4(), run->states.bottomRows(1).transpose(), {0.1, 0.0, 3000.0});
  const PredictionTime time = valid_prediction_time(model, entry.source->record, dopri8());
  row.insert(row.end(),
             {cell(spectrum.exponents[0]), cell(spectrum.dimension),
              cell(power_spectrum_distance(record, *run)),
              cell(density_distance(record.states, run->states)), cell(time.median)});
  return row;
}

}  // namespace

std::vector<Identified> identify_all(const std::vector<Source>& sources) {
  std::vector<Identified> identified;
  for (const Source& source : sources) identified.push_back(identify_one(source));
  return identified;
}

void write_table_3(Output& output, const std::vector<Identified>& identified) {
  output.chapter("Table 3: the identified equations of the measured circuits",
                 "Each column of Table 3, simulated, is identified from its own record. "
                 "Ratios of terms that were dropped are 0.");
  for (const char* stem : {"circuit_tl072", "circuit_opa2134"})
    if (const Identified* entry = find(identified, stem)) write_coefficients(output, *entry);
  write_support_table(output, identified);
}

void write_measures(Output& output, const std::vector<Identified>& identified) {
  output.chapter("Attractors of the identified models",
                 "Largest Lyapunov exponents in 1/tau, from the record (Rosenstein) and of the "
                 "model (variational); Kaplan-Yorke dimension; Hellinger distances of power "
                 "spectra and of invariant densities between the record and a free run; median "
                 "valid prediction time in tau.");
  ResultTable table;
  table.header = {"record",           "model",          "exponent; record",
                  "exponent; model",  "dimension",      "spectral distance",
                  "density distance", "prediction time"};
  for (const Identified& entry : identified) {
    if (entry.source->truth)
      table.rows.push_back(measures_of(entry, "true", *entry.source->truth));
    table.rows.push_back(measures_of(entry, "paper mode", entry.paper_mode));
    table.rows.push_back(measures_of(entry, "default", entry.standard));
  }
  output.table("measures", "Measures of the attractors", table);
}

}  // namespace lacuna::benchmarks
