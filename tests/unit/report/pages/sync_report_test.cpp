// SPDX-License-Identifier: MIT
#include "lacuna/report/pages/sync_report.hpp"

#include <nlohmann/json.hpp>

#include "unit/report/pages/reports.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using testing::sample_sync;

TEST(SyncReport, TextStatesErrorsAndCoupling) {
  const std::string text = format_text(sample_sync());
  EXPECT_THAT(text, HasSubstr("median 0.001, mean 0.002, relative 0.05 %"));
  EXPECT_THAT(text, HasSubstr("coupling [1/ms]: x 0.5 (from the record's own time scale)"));
  EXPECT_THAT(text, HasSubstr("settled"));
}

TEST(SyncReport, TextShowsCrossCoupling) {
  SyncReport report = sample_sync();
  report.coupling_given = true;
  report.result.coupling(1, 0) = 0.25;
  EXPECT_THAT(format_text(report), HasSubstr("x from x 0.5, y from x 0.25\n"));
}

TEST(SyncReport, DivergenceIsToldInsteadOfErrors) {
  SyncReport report = sample_sync();
  report.result.status = IntegrationStatus::Diverged;
  report.result.message = "diverged at t = 3";
  EXPECT_THAT(format_text(report), HasSubstr("diverged at t = 3"));
  EXPECT_EQ(nlohmann::json::parse(format_json(report))["message"], "diverged at t = 3");
}

}  // namespace
}  // namespace lacuna
