#include "apps/text/formats/csv_table.h"

#include <gmock/gmock.h>

#include "apps/text/formats/csv_text.h"
#include "tests/support/temp_folder.h"

namespace luxfit {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CsvTableTest : public ::testing::Test {
 protected:
  CsvTable Read(const std::string& text) const {
    folder_.Write("t.csv", text);
    return ReadCsvTable(folder_.Path("t.csv"), {{"id", "x_m", "lux"}, {"iso"}});
  }

  std::string Error(const std::string& text) const {
    try {
      const CsvTable table = Read(text);
      for (const CsvRow& row : table.rows) CsvNumber(table, row, "x_m"), CsvNumber(table, row, "lux");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  TempFolder folder_;
};

TEST_F(CsvTableTest, ReadsFieldsWithTheirLines) {
  const CsvTable table = Read("id,x_m,lux\na,1.5,2\n\n b , -3e2 ,+4\n");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].line, 2);
  EXPECT_EQ(table.rows[1].line, 4);
  EXPECT_EQ(CsvText(table, table.rows[1], "id"), "b");
  EXPECT_DOUBLE_EQ(CsvNumber(table, table.rows[1], "x_m"), -300);
  EXPECT_DOUBLE_EQ(CsvNumber(table, table.rows[1], "lux"), 4);
  EXPECT_THROW(CsvText(table, table.rows[1], "iso"), std::invalid_argument);
}

TEST_F(CsvTableTest, ToleratesByteOrderMarkCrlfQuotesAndOptionalColumns) {
  const CsvTable table = Read("\xEF\xBB\xBFid,x_m,lux,iso\r\n\"a, \"\"b\"\"\" ,1,2,100\r\n");
  EXPECT_THAT(table.columns, ElementsAre("id", "x_m", "lux", "iso"));
  EXPECT_TRUE(HasColumn(table, "iso"));
  EXPECT_EQ(CsvText(table, table.rows[0], "id"), "a, \"b\"");
  EXPECT_EQ(CsvText(table, table.rows[0], "iso"), "100");
}

// A spreadsheet runs a text that begins with =, so luxfit writes it with an apostrophe.
TEST_F(CsvTableTest, TextsThatLookLikeFormulasKeepTheirNames) {
  for (const std::string name : {"=1+1", "@sum", "-x", "+b", "=A1,\"b\""}) {
    EXPECT_THAT(CsvField(name), HasSubstr("'" + name.substr(0, 2))) << name;
    const CsvTable table = Read("id,x_m,lux\n" + CsvField(name) + ",1,2\n");
    EXPECT_EQ(CsvText(table, table.rows[0], "id"), name);
  }
  for (const std::string name : {"-1.5", "+2", "L1", "'quoted", "a=b"}) EXPECT_EQ(CsvField(name), name);
}

// Spreadsheets and old systems save such tables.
TEST_F(CsvTableTest, ReadsUtf16OldLineEndsAndRowsOfCommas) {
  const std::string plain = "id,x_m,lux\nL\xC3\xBC,1,2\n";
  std::string utf16 = "\xFF\xFE";
  for (const char16_t c : std::u16string(u"id,x_m,lux\r\nL\u00FC,1,2\r\n")) {
    utf16 += static_cast<char>(c & 0xFF);
    utf16 += static_cast<char>(c >> 8);
  }
  for (const std::string& text :
       {plain, utf16, std::string("id,x_m,lux\rL\xC3\xBC,1,2\r"), plain + ",,\n , ,\n"}) {
    const CsvTable table = Read(text);
    ASSERT_EQ(table.rows.size(), 1u) << text;
    EXPECT_EQ(CsvText(table, table.rows[0], "id"), "L\xC3\xBC");
    EXPECT_EQ(table.rows[0].line, 2);
  }
}

TEST_F(CsvTableTest, TextThatIsNotUnicodeIsRefusedWithItsLine) {
  EXPECT_THAT(
      Error("id,x_m,lux\na,1,2\nL\xFC,1,2\n"),
      AllOf(HasSubstr(
                "t.csv:3: expected text in UTF-8, got the byte 0xFC, which in Windows-1252 is \"\xC3\xBC\""),
            HasSubstr("save the file as UTF-8")));
}

TEST_F(CsvTableTest, AColumnInAnotherUnitIsToldItsFactor) {
  EXPECT_THAT(Error("id,x_mm,lux\na,1,2\n"),
              HasSubstr("column 2 is in another unit: multiply its numbers by 0.001 and name it \"x_m\""));
}

TEST_F(CsvTableTest, WrongHeaderNamesBothHeaders) {
  EXPECT_THAT(
      Error("id,x,lux\na,1,2\n"),
      AllOf(HasSubstr("t.csv:1: header: "), HasSubstr("expected \"id,x_m,lux[,iso]\", got \"id,x,lux\""),
            HasSubstr("column 2 must be \"x_m\": rename, reorder or add it")));
  EXPECT_THAT(Error("id,x_m\na,1\n"), HasSubstr("add the column \"lux\""));
  EXPECT_THAT(Error("id,x_m,lux,colour\na,1,2,3\n"), HasSubstr("remove the column \"colour\""));
  EXPECT_THAT(Error("id\tx_m\tlux\na\t1\t2\n"), HasSubstr("not tabs: save the table as CSV with commas"));
}

TEST_F(CsvTableTest, DecimalCommasAreRecognised) {
  EXPECT_THAT(Error("id,x_m,lux\na,1,2,3\n"),
              AllOf(HasSubstr("t.csv:2: expected 3 fields (id,x_m,lux), got 4"), HasSubstr("decimal comma"),
                    HasSubstr("save the table with decimal points (1.2)")));
  EXPECT_THAT(
      Error("id,x_m,lux\na,\"1,2\",3\n"),
      AllOf(HasSubstr("t.csv:2: x_m: expected a finite number, got \"1,2\""), HasSubstr("decimal comma")));
  EXPECT_THAT(Error("id;x_m;lux\na;1,2;3\n"),
              AllOf(HasSubstr("t.csv:1: header: "), HasSubstr("not semicolons"), HasSubstr("decimal comma"),
                    HasSubstr("save the table with commas and decimal points")));
}

TEST_F(CsvTableTest, FieldsThatAreNoNumbersAreReported) {
  for (const char* text : {"nan", "inf", "-inf", "1.2m", "", "1e999", "0x10", "1 2"})
    EXPECT_THAT(Error("id,x_m,lux\na,1,2\nb," + std::string(text) + ",3\n"),
                AllOf(HasSubstr("t.csv:3: x_m: expected a finite number, got \"" + std::string(text) + "\""),
                      HasSubstr("write it like 1.2")));
}

TEST_F(CsvTableTest, IncompleteTablesAreReported) {
  EXPECT_THAT(Error(""),
              AllOf(HasSubstr("t.csv:1: header: expected \"id,x_m,lux[,iso]\", got an empty file")));
  EXPECT_THAT(Error("id,x_m,lux\n\n"),
              HasSubstr("t.csv:1: expected at least one row under the header, got none; add"));
  EXPECT_THAT(Error("id,x_m,lux\na,1\n"),
              HasSubstr("t.csv:2: expected 3 fields (id,x_m,lux), got 2; fill in"));
  EXPECT_THAT(Error("id,x_m,lux\na,b,c,d\n"),
              HasSubstr("put a field that holds a comma between double quotes"));
  EXPECT_THAT(Error("id,x_m,lux\n\"a,1,2\n"), HasSubstr("t.csv:2: expected a closing quote"));
}

}  // namespace
}  // namespace luxfit
