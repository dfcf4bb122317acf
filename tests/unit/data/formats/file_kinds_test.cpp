// SPDX-License-Identifier: MIT
#include "data/formats/file_kinds.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(FileKinds, SayWhatAFileLooksLike) {
  EXPECT_EQ(known_file("TDSm1234")->what, "a LabVIEW TDMS file");
  EXPECT_EQ(known_file("PK\x03\x04....xl/workbook.xml")->what, "an Excel workbook (.xlsx)");
  EXPECT_EQ(known_file("PK\x03\x04....")->what, "a zip archive");
  EXPECT_EQ(known_file("%PDF-1.7")->remedy, "give the file with the numbers");
  EXPECT_FALSE(known_file("t,x\n0,1\n"));
  EXPECT_FALSE(known_file(""));
}

}  // namespace
}  // namespace lacuna
