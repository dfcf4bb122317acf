// SPDX-License-Identifier: MIT
#include <sstream>

#include "core/base/json.hpp"
#include "core/base/text.hpp"
#include "lacuna/report/reports.hpp"
#include "report/json/adequacy_json.hpp"
#include "report/json/stages_json.hpp"
#include "report/json/sync_json.hpp"

namespace lacuna {
namespace {

bool is_diagonal(const Matrix& matrix) {
  return Matrix(matrix.diagonal().asDiagonal()) == matrix;
}

/// "x 1, y 0.5" for a diagonal K, else all of its entries.
std::string coupling_text(const SyncReport& report) {
  const Matrix& coupling = report.result.coupling;
  std::vector<std::string> parts;
  for (Index i = 0; i < coupling.rows(); ++i) {
    for (Index j = 0; j < coupling.cols(); ++j) {
      if (coupling(i, j) == 0.0) continue;
      const std::string& to = report.states[static_cast<std::size_t>(i)].name;
      const std::string& from = report.states[static_cast<std::size_t>(j)].name;
      const std::string pair = is_diagonal(coupling) ? to : to + " from " + from;
      parts.push_back(pair + " " + format_number(coupling(i, j), 4));
    }
  }
  return parts.empty() ? "none" : join(parts, ", ");
}

}  // namespace

nlohmann::ordered_json sync_to_json(const SyncReport& report) {
  const SyncResult& result = report.result;
  nlohmann::ordered_json json;
  json["median"] = result.median;
  json["mean"] = result.mean;
  json["relative"] = result.relative;
  json["settled"] = result.settled;
  if (result.error_over_noise) json["error_over_noise"] = *result.error_over_noise;
  if (result.conditional_exponent) json["conditional_exponent"] = *result.conditional_exponent;
  json["holds"] = report.verdict.holds;
  json["adequacy"] = adequacy_json(report.verdict.adequacy);
  if (!report.verdict.sentence.empty()) json["sentence"] = report.verdict.sentence;
  if (report.verdict.until) json["holds_until"] = *report.verdict.until;
  if (report.verdict.equation) json["equation"] = *report.verdict.equation;
  json["status"] = to_string(result.status);
  if (!result.message.empty()) json["message"] = result.message;
  json["states"] = nlohmann::ordered_json::array();
  for (const Quantity& state : report.states) json["states"].push_back(state.name);
  json["coupling"] = nlohmann::ordered_json::array();
  for (Index i = 0; i < result.coupling.rows(); ++i) {
    const Vector row = result.coupling.row(i);
    json["coupling"].push_back(std::vector<double>(row.begin(), row.end()));
  }
  json["coupling_unit"] = "1/" + report.time_unit;
  json["coupling_source"] = report.coupling_given ? "given" : "time scale of the record";
  json["integrator"] = report.integrator;
  return json;
}

std::string format_json(const SyncReport& report) {
  nlohmann::ordered_json json;
  json["format"] = "lacuna.sync/1";
  json.update(sync_to_json(report));
  json["stages"] = stages_json(report.result.stages);
  return json_lines(json);
}

std::string format_text(const SyncReport& report) {
  const SyncResult& result = report.result;
  std::ostringstream out;
  out << "Synchronisation with the record (" << report.integrator << ")\n";
  if (result.status != IntegrationStatus::Completed) {
    if (report.verdict.sentence.empty()) out << "  " << result.message << "\n";
  } else {
    out << "  error: median " << format_number(result.median, 4) << ", mean "
        << format_number(result.mean, 4) << ", relative "
        << format_number(100.0 * result.relative, 4) << " %\n  "
        << (result.settled ? "settled" : "did not settle: the error still grows") << "\n";
  }
  if (!report.verdict.sentence.empty()) out << "  " << report.verdict.sentence << "\n";
  if (result.conditional_exponent)
    out << "  hidden states: slaves that begin elsewhere part by "
        << format_number(*result.conditional_exponent, 2) << " 1/" << report.time_unit
        << " (conditional Lyapunov exponent)\n";
  out << "  coupling [1/" << report.time_unit << "]: " << coupling_text(report)
      << (report.coupling_given ? "" : " (from the record's own time scale)") << "\n";
  return out.str();
}

}  // namespace lacuna
