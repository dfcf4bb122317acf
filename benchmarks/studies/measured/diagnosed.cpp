// SPDX-License-Identifier: MIT
#include "diagnosed.hpp"

#include <Eigen/QR>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/text.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "support/table.hpp"
#include "trajectories/shooting/refine.hpp"
#include "trajectories/smoother/innovation_system.hpp"

namespace lacuna::benchmarks {
namespace {

/// A diagnosis with all effects and the seconds it took.
struct Timed {
  Diagnosis diagnosis;
  double seconds = 0.0;
};

Timed diagnosed(const OdeModel& nominal, const Dataset& find, const Dataset& check) {
  DiagnosisOptions options;
  options.effects = default_registry().make_all<Effect>();
  const auto start = std::chrono::steady_clock::now();
  RunContext context;
  context.threads = 2;
  Timed result{diagnose(nominal, find, check, options, context)};
  result.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::string effects_of(const Timed& timed) {
  ResultTable table{{"name", "term", "coefficient", "95 % +-", "sigma"}, {}};
  for (const NamedEffect& effect : timed.diagnosis.effects)
    table.rows.push_back({effect.name, effect.term, format_number(effect.coefficient, 4),
                          format_number(1.96 * effect.deviation, 2),
                          format_number(effect.sigma, 3)});
  const Gap& gap = *timed.diagnosis.gap;
  return table.markdown() + "\nVerdict `" + to_string(timed.diagnosis.verdict) +
         "`; gap on the other record " + format_number(100.0 * gap.before, 3) + " % -> " +
         format_number(100.0 * gap.after, 3) + " %; " + format_number(timed.seconds, 3) +
         " s.\n";
}

/// Moving means of values with a Gaussian weight, or with its first or second derivative.
class Gaussian {
 public:
  /// Lets half the power through at a frequency (Hz).
  Gaussian(double frequency, double step)
      : deviation_(std::sqrt(std::log(2.0)) / (2.0 * std::numbers::pi * frequency)),
        step_(step),
        reach_(static_cast<Index>(5.0 * deviation_ / step)) {}

  Index reach() const { return reach_; }

  /// One entry for each sample that is `reach` away from the ends.
  Vector of(const Vector& values, int derivative) const {
    const Vector weights = weights_of(derivative);
    Vector result(values.size() - 2 * reach_);
    for (Index i = 0; i < result.size(); ++i)
      result[i] = weights.dot(values.segment(i, weights.size()));
    return result;
  }

 private:
  Vector weights_of(int derivative) const {
    Vector weights(2 * reach_ + 1);
    for (Index i = 0; i < weights.size(); ++i) {
      const double u = static_cast<double>(i - reach_) * step_ / deviation_;
      const double g =
          std::exp(-0.5 * u * u) * step_ / deviation_ / std::sqrt(2.0 * std::numbers::pi);
      const double s = deviation_;
      weights[i] = derivative == 0   ? g
                   : derivative == 1 ? u * g / s
                                     : (u * u - 1.0) * g / (s * s);
    }
    return weights;
  }

  double deviation_, step_;
  Index reach_;
};

/// What a record says of dv/dt: its smoothed value and those of the terms.
struct ForceBalance {
  Vector acceleration;
  Matrix terms;  ///< one column for each
};

/// All smoothed alike, to a frequency; signs are those of a rate smoothed to 50 Hz.
ForceBalance balance(const Dataset& record, const OdeModel& model, double frequency) {
  constexpr double kStep = 1e-3;
  const Gaussian slow(frequency, kStep), quick(50.0, kStep);
  const Trajectory& run = record.trajectories.front();
  const Index edge = quick.reach();
  Trajectory inner = run;
  const Vector q = run.states.col(0);
  const Index n = q.size() - 2 * edge;
  inner.time = run.time.segment(edge, n);
  inner.inputs = run.inputs.middleRows(edge, n);
  Matrix path(n, 2);
  path << quick.of(q, 0), quick.of(q, 1);
  const LinearisedRecord grid = grid_of(model.inputs(), inner, path);
  const Equation& terms = model.equations()[1];
  ForceBalance result{slow.of(q.segment(edge, n), 2), {}};
  result.terms.resize(result.acceleration.size(), static_cast<Index>(terms.size()));
  for (std::size_t j = 0; j < terms.size(); ++j) {
    const Vector values = evaluate_on(grid, model.variables(), terms[j].term.expression());
    result.terms.col(static_cast<Index>(j)) = slow.of(values(grid.sample_rows()), 0);
  }
  return result;
}

double rms(const Vector& values) {
  return values.norm() / std::sqrt(static_cast<double>(values.size()));
}

/// rms of (dv/dt - terms) over the coefficient of the force, which is the first term, N.
double left_force(const Dataset& record, const OdeModel& model, double frequency) {
  const ForceBalance found = balance(record, model, frequency);
  Vector coefficients(found.terms.cols());
  for (Index j = 0; j < coefficients.size(); ++j)
    coefficients[j] = model.equations()[1][static_cast<std::size_t>(j)].coefficient;
  return rms(found.acceleration - found.terms * coefficients) / std::abs(coefficients[0]);
}

/// The same with the coefficients that are best on the record.
double least_force(const Dataset& record, const OdeModel& model, double frequency) {
  const ForceBalance found = balance(record, model, frequency);
  const Vector best = Eigen::ColPivHouseholderQR<Matrix>(found.terms).solve(found.acceleration);
  return rms(found.acceleration - found.terms * best) / std::abs(best[0]);
}

/// The published parameters in the terms of the found model.
OdeModel published_positioning(const OdeModel& nominal) {
  constexpr double kMass = 95.11;
  const Variables variables = nominal.variables();
  Equation second;
  for (const auto& [term, force] :
       {std::pair{"F", 1.0}, {"v", -203.5}, {"sign(v)", -20.39}, {"1", 3.16}})
    second.push_back({Term::parse(term, variables), force / kMass});
  return {nominal.states(),
          nominal.inputs(),
          {nominal.equations()[0], second},
          nominal.time_unit()};
}

/// Force that models leave on the records, N rms, by the frequency to which all is smoothed.
ResultTable force_table(const OdeModel& nominal, const OdeModel& found, const Dataset& find,
                        const Dataset& check) {
  ResultTable table{{"record", "smoothed to Hz", "nominal", "nominal, best coefficients",
                     "published", "found", "found, best coefficients"},
                    {}};
  const OdeModel published = published_positioning(nominal);
  const auto number = [](double force) { return format_number(force, 3); };
  for (const auto& [name, record] : {std::pair{"train", &find}, {"validation", &check}})
    for (const double frequency : {3.0, 5.0, 10.0})
      table.rows.push_back({name, format_number(frequency, 2),
                            number(left_force(*record, nominal, frequency)),
                            number(least_force(*record, nominal, frequency)),
                            number(left_force(*record, published, frequency)),
                            number(left_force(*record, found, frequency)),
                            number(least_force(*record, found, frequency))});
  return table;
}

}  // namespace

Dataset rows(const Dataset& data, Index first, Index count) {
  Dataset part = data;
  part.trajectories = {rows_of(data.trajectories[0], first, count)};
  return part;
}

std::string simulation_error(const OdeModel& model, const Dataset& record) {
  constexpr Index kStart = 50;
  const Refinement start =
      refine(ParametrisedModel(model, {}), rows(record, 0, kStart), {.window_samples = kStart});
  const Trajectory& run = record.trajectories[0];
  RecordInput input(run);
  const Solution orbit =
      simulate(DrivenModel{model, input}, dopri8(), start.states.row(0), run.time);
  if (orbit.status != IntegrationStatus::Completed) return "diverged";
  const Vector error = (orbit.states.col(0) - run.states.col(0)).tail(run.samples() - kStart);
  return format_number(1e3 * error.norm() / std::sqrt(static_cast<double>(error.size())), 3);
}

Dataset oscillator_record(const std::filesystem::path& folder) {
  return read_dataset({(folder / "silverbox/silverbox_snls80mv.csv.gz").string()},
                      {.states = {"y"}, .inputs = {"u"}});
}

std::string diagnosed_positioning(const std::filesystem::path& folder) {
  const OdeModel nominal = read_model((folder / "emps/nominal.json").string());
  const auto read = [&](const std::string& name) {
    return read_records(nominal, {(folder / "emps" / name).string()}, {}, finite_differences());
  };
  const Dataset find = read("emps_train.csv.gz"), check = read("emps_validation.csv.gz");
  const Timed timed = diagnosed(nominal, find, check);
  const OdeModel& found = timed.diagnosis.augmented;
  const double mass = 1.0 / found.coefficient(1, "F");
  std::string forces;
  for (const WeightedTerm& summand : found.equations()[1])
    forces +=
        " " + summand.term.name() + ": " + format_number(mass * summand.coefficient, 4) + ";";
  return "## EMPS: what M q'' = F - Fv q' lacks\n\nWhole vocabulary, training record.\n\n" +
         effects_of(timed) + "\nMass " + format_number(mass, 4) + " kg; N by" + forces +
         " published Fc 20.39, offset -3.16.\n\nForce that a model leaves: (dv/dt - its "
         "terms) / coefficient of F, all smoothed alike by a Gaussian (half power at the "
         "frequency), N rms; best coefficients are those of least "
         "squares on the record itself.\n\n" +
         force_table(nominal, found, find, check).markdown();
}

std::string diagnosed_oscillator(const std::filesystem::path& folder) {
  const Dataset record = oscillator_record(folder);
  const Dataset train = rows(record, 40650, 8692), test = rows(record, 105712, 21688);
  const Dataset arrow = rows(record, 100, 40475), inside = rows(record, 100, 32000);
  const OdeModel nominal = read_model((folder / "silverbox/nominal.json").string());
  const Stage<Differentiator> rates = finite_differences();
  const Timed timed =
      diagnosed(nominal, model_view(nominal, train, rates), model_view(nominal, test, rates));
  ResultTable table{
      {"model", "multisine test mV", "arrow mV", "arrow without extrapolation mV"}, {}};
  for (const auto& [name, model] :
       {std::pair{"nominal", nominal}, {"found", timed.diagnosis.augmented}})
    table.rows.push_back({name, simulation_error(model, test), simulation_error(model, arrow),
                          simulation_error(model, inside)});
  return "## Silverbox: what a linear resonator lacks\n\nWhole vocabulary, the first multisine "
         "(8 692 samples).\n\n" +
         effects_of(timed) + "\n" + table.markdown();
}

}  // namespace lacuna::benchmarks
