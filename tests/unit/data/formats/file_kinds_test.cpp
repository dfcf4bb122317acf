// SPDX-License-Identifier: MIT
#include "data/formats/file_kinds.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(FileKinds, SayWhatAFileLooksLike) {
  EXPECT_EQ(known_file("TDSm1234")->what, "a LabVIEW TDMS file");
  EXPECT_NE(known_file("PAR1")->remedy.find("read_parquet"), std::string::npos);
  EXPECT_NE(known_file("\x89MCAP0\r\n")->remedy.find("ros2 topic echo --csv"), std::string::npos);
  EXPECT_EQ(known_file("#ROSBAG V2.0\n")->what, "a ROS 1 bag");
  EXPECT_EQ(known_file("PK\x03\x04....")->what, "a zip archive");
  EXPECT_EQ(known_file("%PDF-1.7")->remedy, "give the file with the numbers");
  EXPECT_FALSE(known_file("t,x\n0,1\n"));
  EXPECT_FALSE(known_file(""));
}

TEST(FileKinds, WorkbooksAreRead) {
  EXPECT_EQ(kind_of("a.xlsx", "PK\x03\x04....xl/workbook.xml", "a.xlsx"), FileKind::Workbook);
  EXPECT_EQ(kind_of("a.csv", "t,x\n", "a.csv"), FileKind::Text);
}

}  // namespace
}  // namespace lacuna
