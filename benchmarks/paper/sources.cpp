// SPDX-License-Identifier: MIT
#include "sources.hpp"

#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "spice.hpp"

namespace lacuna::benchmarks {
namespace {

/// The start is not printed; this one gives the original system's row of Table 5 and its
/// largest |x| to about one per cent.
Vector start() { return Vector::Constant(3, 0.1); }

Source from_equations(const PrintedSystem& printed, const std::string& stem,
                      const std::string& origin, OdeModel model) {
  Dataset record = record_of(model, dopri8({.substeps = 4}), start(), kStep, kSamples);
  record.trajectories[0].source = printed.name;
  record.trajectories[0].derivatives.resize(0, 0);
  return {printed.name,     stem,    origin, std::move(record), printed.unit,
          std::move(model), &printed};
}

/// 16 bits over +-10 V and 1 mV noise, in the units of the source.
Source as_measured(const Source& clean) {
  Source source = clean;
  source.name += " measured";
  source.stem += "_measured";
  source.origin += ", 16-bit converter over +-10 V, 1 mV noise";
  source.printed = nullptr;
  source.clean = clean.record.trajectories[0].states;
  source.record = quantise(add_noise(clean.record, Vector::Constant(3, 1e-3 / clean.unit), 1),
                           16, 10.0 / clean.unit);
  return source;
}

void add_simulated_circuit(std::vector<Source>& sources, const PrintedSystem& printed,
                           const std::string& stem, const std::optional<Dataset>& record) {
  if (!record) return;
  sources.push_back({printed.name,
                     stem,
                     "ngspice, netlists/" + stem + ".cir",
                     *record,
                     printed.unit,
                     {},
                     &printed});
}

}  // namespace

std::vector<Source> make_sources(Output& output) {
  const auto& printed = printed_systems();
  std::vector<Source> sources;
  sources.push_back(from_equations(printed[0], "original", "Rossler's equations",
                                   test_system("rossler").model));
  sources.push_back(from_equations(printed[1], "adjusted", "equation (12) with Table 1",
                                   test_system("rossler-adjusted").model));
  const std::vector<std::optional<Dataset>> circuits =
      simulate_netlists({"tl072", "opa2134"}, output);
  add_simulated_circuit(sources, printed[2], "tl072", circuits[0]);
  add_simulated_circuit(sources, printed[3], "opa2134", circuits[1]);
  sources.push_back(from_equations(printed[4], "circuit_tl072", "Table 3, TL072 column",
                                   rescaled(test_system("tl072").model, 4.0)));
  sources.push_back(from_equations(printed[5], "circuit_opa2134", "Table 3, OPA2134 column",
                                   rescaled(test_system("opa2134").model, 4.0)));
  sources.push_back(as_measured(sources[sources.size() - 2]));
  return sources;
}

// A monomial c x^p of degree p in new units is factor c (x_new / factor)^p.
OdeModel rescaled(const OdeModel& model, double factor) {
  std::vector<Equation> equations = model.equations();
  const Vector point = Vector::Constant(model.dimension(), 1.0 / factor);
  Vector value(model.dimension());
  for (Equation& equation : equations) {
    for (WeightedTerm& summand : equation) {
      std::vector<Equation> alone(equations.size());
      alone[0] = {summand};
      OdeModel(model.states(), {}, alone, model.time_unit())
          .compile()
          .evaluate(0.0, point.data(), nullptr, nullptr, value.data());
      summand = {summand.term, factor * value[0], {}, {}};
    }
  }
  return OdeModel(model.states(), {}, std::move(equations), model.time_unit());
}

SyncResult paper_sync(const OdeModel& model, const Dataset& record,
                      const Integrator& integrator) {
  Matrix coupling = Matrix::Zero(model.dimension(), model.dimension());
  coupling(0, 0) = 1.0;
  return synchronise(model, record, integrator, {.coupling = coupling});
}

SyncResult paper_sync(const OdeModel& model, const Dataset& record) {
  return paper_sync(model, record, rk4());
}

}  // namespace lacuna::benchmarks
