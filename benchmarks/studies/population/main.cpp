// SPDX-License-Identifier: MIT
// Populations drawn and fitted: how often 95 % intervals of typical values and spreads contain
// what individuals were drawn from. Usage:
// study_population [OUTPUT_FOLDER] [DRAWS] [--cells FOLDER]
//                                                    (default build/studies/population, 50)
#include <cmath>
#include <iostream>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/parallel.hpp"
#include "support/populations.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

/// A dose into a gut, absorbed with ka and cleared with CL from a volume V.
constexpr const char* kModel = R"(param ka = 1 varies */ 1.5
param CL = 0.2 varies */ 1.5
param V = 1.5 varies */ 1.5
dgut/dt = -ka*gut
dcen/dt = ka*gut - CL/V*cen
y = cen/V noise NOISE
initial gut = 10 fixed
initial cen = 0 fixed
)";
const std::vector<double> kTypical = {1.5, 0.3, 2.0}, kSpreads = {0.5, 0.3, 0.15};

struct Design {
  const char* noise;
  Index individuals;
};
const std::vector<Design> kDesigns = {
    {"constant", 12}, {"constant", 40}, {"proportional", 12}, {"proportional", 40}};

/// What one draw gave.
struct Draw {
  bool is_sound = false, converged = false;
  int typical = 0, spreads = 0;  ///< intervals that contain the truth, of three each
  int zero = 0;                  ///< spreads that were not seen
  double seconds = 0.0;

  auto fields() { return std::tie(is_sound, converged, typical, spreads, zero, seconds); }
};

Dataset drawn(const SystemModel& system, const Design& design, std::uint64_t seed) {
  const bool proportional = std::string(design.noise) == "proportional";
  const Vector time{{0.25, 0.5, 1.0, 2.0, 3.5, 5.0, 7.0, 9.0, 12.0, 16.0}};
  Vector all(time.size() + 1);
  all << 0.0, time;
  Dataset data = support::individuals(
      system, design.individuals, all, seed, [=](Random& random) {
        std::vector<double> own;
        for (std::size_t i = 0; i < 3; ++i)
          own.push_back(kTypical[i] * std::exp(kSpreads[i] * random.normal()));
        return [=](double t, Random& each) {
          const double k = own[1] / own[2];
          const double y = 10.0 * own[0] / (own[2] * (own[0] - k)) *
                           (std::exp(-k * t) - std::exp(-own[0] * t));
          return y + (proportional ? 0.1 * y : 0.15) * each.normal();
        };
      });
  return data;
}

Draw draw_of(const Design& design, std::uint64_t number) {
  std::string text = kModel;
  text.replace(text.find("NOISE"), 5, design.noise);
  const SystemModel system = parse_ode_system(text, "population.ode");
  const Dataset data = drawn(system, design, number);
  const double begin = thread_seconds();
  const Fit found = fit(system, data, {});
  Draw draw;
  draw.seconds = thread_seconds() - begin;
  draw.converged = found.converged;
  draw.is_sound = standing_of(found).is_sound();
  for (std::size_t i = 0; i < 3; ++i) {
    const FittedParameter& one = found.numbers[i];
    draw.typical += one.ci95 && kTypical[i] >= (*one.ci95)[0] && kTypical[i] <= (*one.ci95)[1];
    const auto& interval = one.spread->ci95;
    draw.zero += one.spread->value == 0.0;
    draw.spreads += interval ? kSpreads[i] >= (*interval)[0] && kSpreads[i] <= (*interval)[1]
                             : one.spread->at_most && kSpreads[i] <= *one.spread->at_most;
  }
  return draw;
}

ResultTable table_of(const Finished<Draw>& finished) {
  ResultTable table{{"noise", "individuals", "draws", "converged %", "typical values covered %",
                     "spreads covered %", "spreads of 0", "sound %", "seconds"},
                    {}};
  for (std::size_t k = 0; k < kDesigns.size(); ++k) {
    double converged = 0, typical = 0, spreads = 0, zero = 0, sound = 0, seconds = 0;
    for (const Draw& draw : finished.group(k)) {
      converged += draw.converged ? 1 : 0;
      typical += draw.typical;
      spreads += draw.spreads;
      zero += draw.zero;
      sound += draw.is_sound ? 1 : 0;
      seconds += draw.seconds;
    }
    const auto count = static_cast<double>(finished.group(k).size());
    const auto percent = [&](double part, double of) {
      return format_number(100.0 * part / (of * count), 3);
    };
    table.rows.push_back({kDesigns[k].noise,
                          format_number(static_cast<double>(kDesigns[k].individuals)),
                          format_number(count), percent(converged, 1.0), percent(typical, 3.0),
                          percent(spreads, 3.0), format_number(zero), percent(sound, 1.0),
                          format_number(seconds / count, 2)});
  }
  return table;
}

int run(const StudyArguments& arguments) {
  const std::size_t draws = arguments.count_at(1, 50);
  Cells<Draw> cells;
  for (const Design& design : kDesigns)
    cells.add_draws(design.noise + std::to_string(design.individuals), draws,
                    [&](std::size_t number) { return draw_of(design, number); });
  const auto finished = run_cells(arguments.store(), cells);
  if (!finished) return 0;
  const ResultTable table = table_of(*finished);
  write_results(arguments.folder_at(0), "population", table.csv(),
                "# Populations drawn and fitted\n\nA dose into a gut, ten samples of each "
                "individual; ka 1.5, CL 0.3, V 2 with lognormal spreads of 0.5, 0.3 and "
                "0.15; noise of\n0.15, or 10 %. The fit starts from 1, 0.2, 1.5 and spreads "
                "of 0.41. covered: 95 % intervals that contain the truth.\n\n" +
                    table.markdown() + "\n" + finished->origin.machine + ", " +
                    finished->origin.day + ".\n");
  std::cout << table.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"population", "[OUTPUT_FOLDER] [DRAWS]", lacuna::benchmarks::run}, argc, argv);
}
