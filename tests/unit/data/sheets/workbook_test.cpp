// SPDX-License-Identifier: MIT
#include "data/sheets/workbook.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/formats/read_text.hpp"
#include "data/sheets/sheet_text.hpp"
#include "data/sheets/xlsx.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/written_arrays.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

// Workbooks made by hand as ECMA-376 and OpenDocument say, read as texts and as tables.
/// A workbook of two sheets, "Info" and "Messung".
std::string xlsx_with(const std::string& cells) {
  const std::string sheet = "<worksheet><sheetData>";
  return testing::zip_archive(
      {{"xl/workbook.xml",
        "<workbook xmlns:r=\"r\"><workbookPr/><sheets><sheet name=\"Info\" r:id=\"rId1\"/>"
        "<sheet name=\"Messung\" r:id=\"rId2\"/></sheets></workbook>"},
       {"xl/_rels/workbook.xml.rels",
        "<Relationships><Relationship Id=\"rId1\" Target=\"worksheets/a.xml\"/>"
        "<Relationship Id=\"rId2\" Target=\"/xl/worksheets/b.xml\"/></Relationships>"},
       {"xl/sharedStrings.xml",
        "<sst><si><t>t [s]</t></si><si><r><t>u </t></r><r><t>[V]</t></r></si>"
        "<si><t>Mittelwert</t><rPh><t>x</t></rPh></si></sst>"},
       {"xl/styles.xml",
        "<styleSheet><numFmts><numFmt numFmtId=\"164\" formatCode=\"hh:mm:ss\"/></numFmts>"
        "<cellStyleXfs><xf numFmtId=\"0\"/></cellStyleXfs>"
        "<cellXfs><xf numFmtId=\"0\"/><xf numFmtId=\"22\"/><xf numFmtId=\"164\"/></cellXfs>"
        "</styleSheet>"},
       {"xl/worksheets/a.xml", sheet + "<row r=\"1\"><c r=\"A1\" t=\"inlineStr\"><is><t>made "
                                       "by hand</t></is></c></row></sheetData></worksheet>"},
       {"xl/worksheets/b.xml", sheet + cells + "</sheetData></worksheet>"}});
}

const char* const kCells =
    "<row r=\"2\"><c r=\"A2\" t=\"s\"><v>0</v></c><c r=\"B2\" t=\"s\"><v>1</v></c></row>"
    "<row r=\"3\"><c r=\"A3\"><v>0</v></c><c r=\"B3\"><f>1+0.5</f><v>1.5</v></c></row>"
    "<row r=\"4\"><c r=\"A4\"><v>0.1</v></c><c r=\"B4\" t=\"e\"><v>#DIV/0!</v></c></row>"
    "<row><c><v>0.2</v></c><c t=\"b\"><v>1</v></c></row>"
    "<row r=\"6\"><c r=\"A6\" t=\"s\"><v>2</v></c><c r=\"B6\" t=\"str\"><v>x</v></c></row>";

TEST(Workbook, CellsOfXlsx) {
  EXPECT_EQ(sheet_text(xlsx_with(kCells), "Messung", "a.xlsx"),
            "\nt [s]\tu [V]\n0\t1.5\n0.1\t\n0.2\t1\nMittelwert\tx\n");
  EXPECT_EQ(sheet_text(xlsx_with(kCells), std::nullopt, "a.xlsx"), "made by hand\n");
  expect_error<DataError>([] { sheet_text(xlsx_with(kCells), "Mesung", "a.xlsx"); }, "a.xlsx",
                          "no sheet 'Mesung'", "Messung");
}

TEST(Workbook, DatesOfXlsx) {
  const std::string cells =
      "<row r=\"1\"><c r=\"A1\" s=\"1\"><v>45265.5</v></c><c r=\"C1\" s=\"2\"><v>0.5</v></c>"
      "<c r=\"D1\" s=\"0\"><v>0.5</v></c></row>";
  EXPECT_EQ(sheet_text(xlsx_with(cells), "Messung", "a.xlsx"),
            "2023-12-05T12:00:00\t\t12:00:00\t0.5\n");
}

std::string ods_with(const std::string& rows) {
  return testing::zip_archive(
      {{"mimetype", "application/vnd.oasis.opendocument.spreadsheet"},
       {"content.xml",
        "<office:document-content xmlns:office=\"o\" xmlns:table=\"b\" xmlns:text=\"x\">"
        "<office:body><office:spreadsheet><table:table table:name=\"A\">" +
            rows +
            "</table:table><table:table table:name=\"B\"><table:table-row><table:table-cell "
            "office:value-type=\"float\" office:value=\"7\"/></table:table-row></table:table>"
            "</office:spreadsheet></office:body></office:document-content>"}});
}

std::string ods_number(const std::string& value) {
  return "<table:table-cell office:value-type=\"float\" office:value=\"" + value +
         "\"><text:p>shown</text:p></table:table-cell>";
}

TEST(Workbook, CellsOfOds) {
  const std::string rows =
      "<table:table-row><table:table-cell office:value-type=\"string\"><office:annotation>"
      "<text:p>a remark</text:p></office:annotation><text:p>t</text:p></table:table-cell>"
      "<table:table-cell office:value-type=\"string\"><text:p>x</text:p></table:table-cell>"
      "<table:table-cell table:number-columns-repeated=\"16000\"/></table:table-row>"
      "<table:table-row table:number-rows-repeated=\"2\">" +
      ods_number("1.5") + ods_number("2") +
      "</table:table-row><table:table-row><table:table-cell office:value-type=\"date\" "
      "office:date-value=\"2023-12-05T10:00:00\"/><table:table-cell office:value-type=\"time\" "
      "office:time-value=\"PT01H02M03.5S\"/></table:table-row>"
      "<table:table-row table:number-rows-repeated=\"1048000\"><table:table-cell "
      "table:number-columns-repeated=\"16384\"/></table:table-row>";
  EXPECT_EQ(sheet_text(ods_with(rows), std::nullopt, "a.ods"),
            "t\tx\n1.5\t2\n1.5\t2\n2023-12-05T10:00:00\t3723.5 s\n");
  EXPECT_EQ(sheet_text(ods_with(rows), "B", "a.ods"), "7\n");
}

TEST(Workbook, BombsAreRefused) {
  const std::string many =
      "<table:table-row table:number-rows-repeated=\"1048576\"><table:table-cell "
      "table:number-columns-repeated=\"16384\" office:value-type=\"float\" "
      "office:value=\"1\"/></table:table-row>";
  expect_error<DataError>([&] { sheet_text(ods_with(many), "A", "a.ods"); }, "a.ods",
                          "more cells than any record", "");
  const std::string entities = testing::zip_archive(
      {{"mimetype", "application/vnd.oasis.opendocument.spreadsheet"},
       {"content.xml", "<!DOCTYPE a [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;\">]><a>&b;</a>"}});
  expect_error<DataError>([&] { sheet_text(entities, "A", "a.ods"); }, "a.ods",
                          "type declaration", ".csv");
}

TEST(Workbook, DamagedOnesAreRefused) {
  const std::string damaged = testing::zip_archive(
      {{"mimetype", "application/vnd.oasis.opendocument.spreadsheet"},
       {"content.xml", "<a><b></a>"}});
  expect_error<DataError>([&] { sheet_text(damaged, "A", "a.ods"); }, "a.ods, line 1",
                          "its XML is damaged", "");
  expect_error<DataError>(
      [] { sheet_text(testing::zip_archive({{"mimetype", "x"}}), "A", "a.ods"); }, "a.ods",
      "no sheet in it", "");
  const std::string without_text = xlsx_with(
      "<row r=\"2\"><c r=\"A2\" t=\"s\"><v>2</v></c><c r=\"B2\" t=\"s\"><v>3</v></c></row>");
  expect_error<DataError>([&] { sheet_text(without_text, "Messung", "a.xlsx"); }, "a.xlsx",
                          "a cell in row 2 names a text that is not there", "save the sheet");
}

TEST(Workbook, IsReadAsATable) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.write("a.xlsx", xlsx_with(kCells));
  const Table table = read_table(path + "#Messung");
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_EQ(table.columns[1].name, "u");
  EXPECT_EQ(table.values.col(0), Eigen::Vector3d(0.0, 0.1, 0.2));
  EXPECT_EQ(table.lines, (std::vector<std::size_t>{3, 4, 5})) << "rows of the sheet";
  EXPECT_TRUE(is_workbook(xlsx_with(kCells)));
  EXPECT_TRUE(is_workbook(ods_with("")));
  EXPECT_FALSE(is_workbook(testing::zip_archive({{"a.npy", "x"}})));
}

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
  for (const char* format :
       {"General", "0.00", "#,##0", "0.0\" days\"", "0.00E+00", "[Red]0.0", "0\\m", "0.0;[h]"})
    EXPECT_FALSE(is_date_format(format)) << format;
}

}  // namespace
}  // namespace lacuna
