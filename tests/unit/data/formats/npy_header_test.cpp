// SPDX-License-Identifier: MIT
// The header of .npy files, read through parse_npy.
#include <gtest/gtest.h>

#include <string>

#include "data/formats/npy.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

/// A file of the given version with this header and 16 bytes behind it.
std::string npy(const std::string& header, char version = 1) {
  std::string bytes = "\x93NUMPY";
  bytes += version;
  bytes += '\0';
  bytes += static_cast<char>(header.size());
  bytes += std::string(version == 1 ? 1 : 3, '\0');
  return bytes + header + std::string(16, '\0');
}

void expect_refused(const std::string& bytes, const std::string& problem) {
  testing::expect_error<DataError>([&] { parse_npy(bytes, "a.npy"); }, "a.npy", problem,
                                   "numpy.save");
}

void expect_header_refused(const std::string& header, const std::string& problem) {
  expect_refused(npy(header), problem);
}

constexpr auto kGood = "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }";

TEST(NpyHeader, VersionsDifferInTheLengthOfTheLength) {
  for (const char version : {'\1', '\2', '\3'})
    EXPECT_EQ(parse_npy(npy(kGood, version), "a.npy").values, Matrix::Zero(2, 1));
  expect_refused(npy(kGood, 4), "version 4 is not known");
}

TEST(NpyHeader, TheOrderOfEntriesDoesNotMatter) {
  const std::string header = "{\"shape\":(1,2),\"fortran_order\":True,\"descr\":\"<f8\"}  \n";
  EXPECT_EQ(parse_npy(npy(header), "a.npy").values, Matrix::Zero(1, 2));
}

TEST(NpyHeader, RefusesOtherFiles) {
  expect_refused("", "first bytes");
  expect_refused("t,x\n0,1\n", "first bytes");
  expect_refused(npy(kGood).substr(0, 9), "cut short");
  expect_refused(npy(kGood).substr(0, 40), "cut short");
  expect_refused(npy(kGood).substr(0, npy(kGood).size() - 1), "cut short");
}

TEST(NpyHeader, RefusesTypesThatAreNoRealNumbers) {
  const std::string tail = ", 'fortran_order': False, 'shape': (1,), }";
  expect_header_refused("{'descr': '<c16'" + tail, "type '<c16' is not a real number");
  expect_header_refused("{'descr': '|O8'" + tail, "type '|O8'");
  expect_header_refused("{'descr': '<f16'" + tail, "type '<f16'");
  expect_header_refused("{'descr': 'f'" + tail, "type 'f' is not known");
  expect_header_refused("{'descr': [('a', '<f8', (2,))]" + tail, "field 'a' is an array");
  expect_header_refused("{'descr': [('a', [('b', '<f8')])]" + tail, "field 'a' has fields");
}

TEST(NpyHeader, RefusesDatesInUnitsThatAreNotRead) {
  const std::string tail = ", 'fortran_order': False, 'shape': (1,), }";
  for (const std::string type : {"<M8", "<M8[M]", "<m8[Y]", "<M8[10ms]", "<M8[", "<m8[ns]]"})
    testing::expect_error<DataError>(
        [&] { parse_npy(npy("{'descr': '" + type + "'" + tail), "a.npy"); }, "a.npy", type,
        "datetime64[ns]");
}

TEST(NpyHeader, RefusesShapesThatAreNoTable) {
  const std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': ";
  expect_header_refused(head + "(), }", "it has 0 dimensions");
  expect_header_refused(head + "(1,1,1), }", "it has 3 dimensions");
  expect_header_refused(head + "(0,2), }", "it is empty");
  expect_header_refused(head + "(4294967296,4294967296), }", "cut short");
  expect_header_refused(head + "(99999999999999999999,), }", "shape is damaged");
}

TEST(NpyHeader, RefusesADamagedHeader) {
  expect_header_refused("", "'{' is missing");
  expect_header_refused("{'descr': '<f8'}", "not complete");
  expect_header_refused("{'descr': '<f8', 'order': False}", "unknown entry 'order'");
  expect_header_refused("{'descr' '<f8'}", "':' is missing");
  expect_header_refused("{'fortran_order': maybe}", "damaged");
}

}  // namespace
}  // namespace lacuna
