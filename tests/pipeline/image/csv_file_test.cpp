#include "pipeline/image/csv_file.h"

#include <gmock/gmock.h>

#include "pipeline/image/errors.h"
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
    try {
      CsvFile table(file(text), {"a"});
      while (table.next()) table.number("a");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
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
  EXPECT_THAT([&] { table.required("a", -1, 2.5); },
              testing::ThrowsMessage<InputError>(
                  EndsWith("t.csv:2: a must be a number from -1 to 2.5, got '3'")));
  EXPECT_THAT([&] { table.required("b", 0, 1); },
              testing::ThrowsMessage<InputError>(EndsWith("t.csv:2: b is empty")));
}

TEST_F(Tables, ThatCannotBeReadAreNamedWithTheReason) {
  EXPECT_THAT([&] { CsvFile(folder_ / "none.csv"); },
              testing::ThrowsMessage<InputError>(EndsWith("none.csv: No such file or directory")));
  EXPECT_THAT([&] { CsvFile table(folder_); },
              testing::ThrowsMessage<InputError>(
                  EndsWith("this is a folder; only regular files can be read")));
}

}  // namespace
}  // namespace domefall
