#include "pipeline/base/csv_file.h"

#include <gmock/gmock.h>

#include "pipeline/base/errors.h"
#include "pipeline/base/unpacked_file.h"
#include "tests/pipeline/image/gzipped.h"
#include "tests/pipeline/image/test_folder.h"

namespace domefall {
namespace {

using testing::EndsWith;

class Tables : public TestFolder {
 protected:
  std::filesystem::path file(const std::string& text) const {
    put(folder_ / "t.csv", text);
    return folder_ / "t.csv";
  }
  // What is said of the table, when all of its rows are read.
  std::string complaint(const std::string& text) const {
    return message_of([&] {
      CsvFile table(file(text), {"a"});
      while (table.next()) table.number("a");
    });
  }
};

TEST_F(Tables, FromSpreadsheetsHaveAMarkBlanksQuotesAndReturns) {
  CsvFile table(file(
      "\xEF\xBB\xBF# made by hand\r\n\r\n a ,\"b\",c\r\n\t# more\r\n 1 ,\" x, \"\"y\"\" \",\r\n"));
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number("a"), 1);
  EXPECT_EQ(table.text("b"), " x, \"y\" ");
  EXPECT_EQ(table.text("c"), "");
  EXPECT_EQ(table.number("c", 0, 1), std::nullopt);
  EXPECT_TRUE(table.has("c"));
  EXPECT_FALSE(table.has("d"));
  EXPECT_EQ(table.text("d"), "");
  EXPECT_FALSE(table.next());
}

TEST_F(Tables, WithoutAHeaderTakeTheirNamesFromTheCaller) {
  CsvFile table(file("7\t-1.5\n\"8\"\t2"), '\t', {"hip", "pm"});
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.required("hip", 1, 9), 7);
  EXPECT_EQ(table.number("pm", -2, 2), -1.5);
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.required("hip", 1, 9), 8);
  EXPECT_FALSE(table.next());
}

TEST_F(Tables, WhatIsWrongIsToldWithItsLine) {
  EXPECT_EQ(complaint("a,b\n1,2\n"), "");
  EXPECT_THAT(complaint(""), EndsWith("t.csv: the file is empty"));
  EXPECT_THAT(complaint("# a\n"), EndsWith("t.csv:1: the table has no header line"));
  EXPECT_THAT(complaint("b,c\n1,2\n"), EndsWith("t.csv:1: the table has no column a"));
  EXPECT_THAT(complaint("a,b\n\n1\n"), EndsWith("t.csv:3: expected 2 columns, got 1"));
  EXPECT_THAT(complaint("a,b\n1,\"2\n"), EndsWith("t.csv:2: a quote is left open"));
  EXPECT_THAT(complaint("a\n1e999\n"), EndsWith("t.csv:2: a must be a finite number, got '1e999'"));
  EXPECT_THAT(complaint("a\n1 2\n"), EndsWith("t.csv:2: a must be a finite number, got '1 2'"));
  CsvFile table(file("a,b\n3,\n"));
  ASSERT_TRUE(table.next());
  EXPECT_THAT(message_of([&] { table.required("a", -1, 2.5); }),
              EndsWith("t.csv:2: a must be a number from -1 to 2.5, got '3'"));
  EXPECT_THAT(message_of([&] { table.required("b", 0, 1); }), EndsWith("t.csv:2: b is empty"));
}

// ---- Tables as spreadsheets, databases and VizieR write them ----

TEST_F(Tables, AreReadWithAnySeparatorAndAnyEndOfLine) {
  for (const char* ends : {"\n", "\r\n", "\r"})
    for (const char* separator : {",", "\t", ";", "|"}) {
      const std::string s = separator, e = ends;
      CsvFile table(file("A" + s + "B" + e + "1" + s + "x y" + e + e + "# more" + e + "2" + s),
                    {"a"});
      ASSERT_TRUE(table.next()) << s << e;
      EXPECT_EQ(table.number("a"), 1);
      EXPECT_EQ(table.text("b"), "x y");
      ASSERT_TRUE(table.next()) << s << e;
      EXPECT_EQ(table.text("b"), "");
      EXPECT_THAT(message_of([&] { table.fail("x"); }), EndsWith("t.csv:5: x"));
      EXPECT_FALSE(table.next());
    }
}

TEST_F(Tables, TakeTheSeparatorByWhichTheHeaderHasTheColumns) {
  CsvFile table(file("name (or number, or both, or none)\ta\nx, y\t3\n"), {"a"});
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number("a"), 3);
  CsvFile told(file("sep=;\na;b\n1;2\n"), {"a"});
  ASSERT_TRUE(told.next());
  EXPECT_EQ(told.number("b"), 2);
}

TEST_F(Tables, CellsOfNullAndTheLikeHoldNothing) {
  for (const char* nothing : {"", "null", "NULL", "NaN", "nan", "NA", "N/A", "n/a", "--", "-", "~",
                              "\"\"", "\"NaN\"", " "}) {
    CsvFile table(file(std::string("a,b\n1,") + nothing + "\n"));
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table.number("b", 0, 1), std::nullopt) << nothing;
    EXPECT_EQ(table.text("b"), "") << nothing;
    EXPECT_THROW(table.required("b", 0, 1), InputError) << nothing;
    EXPECT_THROW(table.number("b"), InputError) << nothing;
  }
  for (const char* other :
       {"none", "nul", "---", "N", "?", "inf", "-inf", "1e", "0x1", "1 2", "+-1", "--1",
        "\xE2\x80\x93"
        "1",
        "1.2.3", "1,2,3", "\"1,234.5\""}) {
    CsvFile table(file(std::string("b;a\n") + other + ";1\n"), {"b"});
    ASSERT_TRUE(table.next());
    EXPECT_THROW(table.number("b", -9, 9), InputError) << other;
  }
}

TEST_F(Tables, RowsOfUnitsAndDashesBelowTheHeaderArePassedOver) {
  for (const char* below :
       {"deg\tmag\n", "deg\tmag\n------\t----\n", "-\t------\n", "[deg]\t(Mag)\n", "\"h:m:s\"\t \n",
        "------+-----\n", "====\t=====\n", "\xC2\xB0\tmag\n# more\n---\t---\n"}) {
    CsvFile table(file(std::string("#VizieR\n\na\tb\n") + below + "1\t-2\n"), {"a"});
    ASSERT_TRUE(table.next()) << below;
    EXPECT_EQ(table.number("a"), 1) << below;
    EXPECT_FALSE(table.next());
  }
  // They are mistakes anywhere else, and words that are no units are so there, too.
  EXPECT_THAT(complaint("a,b\n1,2\ndeg,mag\n"),
              EndsWith("t.csv:3: a must be a finite number, got 'deg'"));
  EXPECT_THAT(complaint("a,b\nx,mags of V\n"),
              EndsWith("t.csv:2: a must be a finite number, got 'x'"));
  EXPECT_THAT(complaint("a,b\ndeg,7\n"), EndsWith("t.csv:2: a must be a finite number, got 'deg'"));
}

TEST_F(Tables, RowsOfEmptyCellsAndHeadersOfAppendedPartsArePassedOver) {
  CsvFile table(file("A,b\n1,2\n,\n\"\",\na,B\ndeg,mag\n3,4\n,,,\n"), {"a"});
  ASSERT_TRUE(table.next());
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number("a"), 3);
  EXPECT_FALSE(table.next());
}

TEST_F(Tables, ASecondPartNeedsNoHeader) {
  CsvFile first(file("A;B\n1;2\n"), {"a", "b"});
  for (const char* text : {"3;4\n", "A;B\n3;4\n", "b,x,a\n4,7,3\n"}) {
    CsvFile second(file(text), {"a", "b"}, &first);
    ASSERT_TRUE(second.next()) << text;
    EXPECT_EQ(second.number("a"), 3) << text;
    EXPECT_EQ(second.number("b"), 4) << text;
    EXPECT_FALSE(second.next());
  }
  EXPECT_THAT(
      complaint("3,4\n"),
      EndsWith("t.csv:1: the table has no column a; its first line has numbers, so name the "
               "part with the header line before it"));
}

TEST_F(Tables, QuotedCellsHaveSeparatorsQuotesAndEndsOfLines) {
  CsvFile table(file("a,\"b\"\n1, \"x,\"\"y\"\"\r\nz\" \n2,5\" gun\n\"3\",\n"), {"a"});
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.text("b"), "x,\"y\" z");
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.text("b"), "5\" gun");
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number("a"), 3);
  EXPECT_THAT(message_of([&] { table.fail("x"); }), EndsWith("t.csv:5: x"));
  EXPECT_THAT(complaint("a,b\n1,\"2\" x\n"),
              EndsWith("t.csv:2: text follows the quote that ends a cell"));
  EXPECT_THAT(complaint("a,b\n1,\"2\n3,4\n"), EndsWith("t.csv:2: a quote is left open"));
}

TEST_F(Tables, KeepToOneDecimalSign) {
  CsvFile table(file("a;b\n101,3;-16,7\n+5;\"0,5\"\n"), {"a"});
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number("a"), 101.3);
  EXPECT_EQ(table.required("b", -20, 0), -16.7);
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number("a"), 5);
  EXPECT_EQ(table.number("b"), 0.5);
  EXPECT_THAT(complaint("a;b\n101.3;x\n-1,223;x\n"),
              EndsWith("t.csv:3: '-1,223' has a decimal comma, and the numbers before it have a "
                       "decimal point"));
}

TEST_F(Tables, AreReadFromUtf16AndPackedByGzip) {
  using namespace std::string_literals;
  for (const std::string& text :
       {"\xFF\xFE"s + "a\0,\0b\0\n\0"s + "1\0,\0\xE9\0\r\0\n\0"s,
        "a\0,\0b\0\n\0"s + "1\0,\0\xE9\0\n\0"s, "\xFE\xFF\0a\0,\0b\0\n\0"s + "1\0,\0\xE9\0\n"s}) {
    CsvFile table(file(text), {"a"});
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table.number("a"), 1);
    EXPECT_EQ(table.text("b"), "\xC3\xA9");
    EXPECT_FALSE(table.next());
  }
  EXPECT_THAT(complaint("\xFF\xFE"s + "a\0,"s),
              EndsWith("t.csv: byte 5: the text is UTF-16 and ends within a character"));
  EXPECT_THAT(complaint("\xFF\xFE\0\0a\0\0\0"s),
              EndsWith("t.csv: this is UTF-32; save it as UTF-8"));
  CsvFile table(file(gzipped("a,b\n1,2\n") + gzipped("3,4\n")), {"a"});
  ASSERT_TRUE(table.next());
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number("b"), 4);
  EXPECT_FALSE(table.next());
}

TEST_F(Tables, CharactersThatLookLikeOthersAreNamed) {
  EXPECT_THAT(complaint("a\n\xE2\x88\x92"
                        "16.7\n"),
              EndsWith("t.csv:2: a must be a finite number, got '\xE2\x88\x92"
                       "16.7', which begins with a minus sign (U+2212), not a hyphen-minus (-)"));
  EXPECT_THAT(complaint("\xE2\x80\x8B"
                        "a,b\n1,2\n"),
              EndsWith("begins with a zero width space (U+200B)"));
}

TEST_F(Tables, ThatCannotBeReadAreNamedWithTheReason) {
  EXPECT_THAT(message_of([&] { CsvFile(folder_ / "none.csv"); }),
              EndsWith("none.csv: No such file or directory"));
  EXPECT_THAT(message_of([&] { CsvFile table(folder_); }),
              EndsWith("this is a folder; only regular files can be read"));
}

TEST_F(Tables, GzipThatIsDamagedOrHoldsTooMuchIsRefused) {
  const std::string packed = gzipped("a,b\n" + std::string(5000, '7') + ",1\n");
  const auto refusal = [](const std::string& bytes, std::uint64_t most) {
    return message_of([&] { unpacked(bytes, "t.gz", most); });
  };
  EXPECT_EQ(unpacked(packed, "t.gz", 5007).size(), 5007U);
  EXPECT_EQ(refusal(packed, 5006),
            "t.gz: the gzip file holds more than 5006 bytes; unpack it by gunzip "
            "and name the result");
  EXPECT_EQ(refusal(packed.substr(0, packed.size() - 3), 9999), "t.gz: the gzip file is cut short");
  EXPECT_EQ(refusal(packed.substr(0, 5), 9999), "t.gz: the gzip file is cut short");
  std::string damaged = packed;
  damaged[packed.size() - 6] ^= 1;  // of the sum of all bytes
  EXPECT_EQ(refusal(damaged, 9999), "t.gz: the gzip file is damaged");
  // As zlib does it, what follows the last member is no part of the file.
  EXPECT_EQ(unpacked(packed + std::string(512, '\0'), "t.gz", 5007).size(), 5007U);
  // A large one goes through in pieces.
  const std::string large(5 << 20, 'x');
  EXPECT_EQ(unpacked(gzipped(large), "t.gz", large.size()), large);
}

}  // namespace
}  // namespace domefall
