// SPDX-License-Identifier: MIT
#include "drives.hpp"

#include <utility>
#include <vector>

#include "core/base/text.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

/// What is added to dm/dt, each with the coefficient from which it is fitted.
using Law = std::vector<std::pair<std::string, double>>;

OdeModel with_law(OdeModel model, const Law& law) {
  for (const auto& [term, coefficient] : law)
    model = model.with_term(0, {Term::parse(term, model.variables()), coefficient});
  return model;
}

std::vector<std::string> fitted_row(const std::string& name, const OdeModel& model,
                                    const Dataset& records) {
  const Fit found = fit(SystemModel(model), records, {});
  const FitQuality& quality = found.quality.front();
  std::vector<std::string> row{name, std::to_string(found.numbers.size())};
  for (const double rmse : quality.rmse_per_record) row.push_back(format_number(rmse, 3));
  row.push_back(format_number(quality.rmse, 3));
  row.push_back(format_number(found.log_likelihood, 5));
  return row;
}

}  // namespace

std::string compared_drives(const std::filesystem::path& folder) {
  const std::filesystem::path drives = folder / "real/ced";
  const OdeModel nominal = read_model((drives / "nominal.json").string());
  const Dataset records =
      usable_records(
          read_records(nominal, {(drives / "train.csv.gz").string()}, {}, finite_differences()))
          .data;
  const std::pair<std::string, double> friction{"tanh(m/0.05)", -0.5}, cross{"w*u^2", 0.7};
  ResultTable table{{"added to dm/dt", "numbers", "record 1", "record 2", "both",
                     "log-likelihood"},
                    {}};
  for (const auto& [name, law] :
       std::vector<std::pair<std::string, Law>>{{"nothing", {}},
                                                {"dry friction", {friction}},
                                                {"w u^2", {cross}},
                                                {"both", {friction, cross}}})
    table.rows.push_back(fitted_row(name, with_law(nominal, law), records));
  return "## Coupled drives: dry friction or w u^2\n\nThe third-order model of the benchmark's "
         "report with one law more, fitted to the free runs of both training records "
         "(`fit()` as it is). rmse in tick/s.\n\n" +
         table.markdown();
}

}  // namespace lacuna::benchmarks
