// SPDX-License-Identifier: MIT
#include "data/sheets/sheet_text.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(SheetText, NoRecordHasCellsWithoutEnd) {
  SheetRows rows("a.xlsx");
  EXPECT_THROW(rows.put(0, 16384, "1"), DataError);
  EXPECT_THROW(rows.put(1048576, 0, "1"), DataError);
}

TEST(SheetText, AStrayCellDoesNotFillTheMemoryWithBlankOnes) {
  SheetRows rows("a.xlsx");
  for (std::size_t i = 0; i < 10; ++i) rows.put(i, 0, "1");
  rows.put(0, 16383, "1");
  EXPECT_EQ(rows.text().size(), 10u * 16384u + 11u);
  for (std::size_t i = 10; i < 13000; ++i) rows.put(i, 0, "1");
  EXPECT_THROW((void)rows.text(), DataError);
}

/// 25569 is 1 January 1970 (days between the two dates, as every spreadsheet has them); others
/// by Python's datetime(1899, 12, 30) + timedelta(days=...).
TEST(SheetText, DatesOfSerials) {
  EXPECT_EQ(date_of_serial(25569.0, false), "1970-01-01T00:00:00");
  EXPECT_EQ(date_of_serial(45265.416667, false), "2023-12-05T10:00:00.0288");
  EXPECT_EQ(date_of_serial(45265.0 + 36000.5 / 86400.0, false), "2023-12-05T10:00:00.5");
  EXPECT_EQ(date_of_serial(43803.0, true), "2023-12-05T00:00:00");
  EXPECT_EQ(date_of_serial(60.0, false), "1900-02-28T00:00:00");
  EXPECT_EQ(date_of_serial(0.75, false), "18:00:00");
}

TEST(SheetText, FormatsOfDates) {
  for (const char* format :
       {"yyyy-mm-dd", "dd/mm/yy hh:mm", "[h]:mm:ss", "mm:ss.0", "[$-407]d. mmm"})
    EXPECT_TRUE(is_date_format(format)) << format;
  for (const char* format : {"General", "0.00", "#,##0", "0.0\" days\"", "0.00E+00", "[Red]0.0",
                             "0\\m", "0.0;[h]"})
    EXPECT_FALSE(is_date_format(format)) << format;
}

}  // namespace
}  // namespace lacuna
