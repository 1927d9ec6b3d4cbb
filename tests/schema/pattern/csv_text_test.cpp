// Cells of CSV by RFC 4180, and the lines that they are on.
#include "schema/pattern/csv_text.hpp"

#include <gtest/gtest.h>

#include "schema/files/text_table.hpp"

namespace misalign::schema {
namespace {

using Cells = std::vector<std::string>;

TEST(CsvText, SplitsCellsAndLines) {
  const auto lines = csv_lines(
      "\xEF\xBB\xBF"
      "a, b ,\"c,\"\"d\"\"\"\r\n# a comment, of two\n\n,,\n1,,3\n");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].number, 1U);
  EXPECT_EQ(lines[0].cells, (Cells{"a", "b", "c,\"d\""}));
  EXPECT_EQ(lines[1].number, 5U) << "comments, empty lines and lines of empty cells count";
  EXPECT_EQ(lines[1].cells, (Cells{"1", "", "3"}));
}

TEST(CsvText, CountsLinesWithinQuotations) {
  const auto lines = csv_lines("\"two\nlines\" ,x\nnext");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].cells, (Cells{"two\nlines", "x"}));
  EXPECT_EQ(lines[1].number, 3U);
}

TEST(CsvText, TakesTheRestAsAQuotationWithoutEnd) {
  const auto lines = csv_lines("a,\"b\nc,d");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].cells, (Cells{"a", "b\nc,d"}));
  EXPECT_EQ(csv_lines("\"").size(), 0U);
  EXPECT_EQ(csv_lines("").size(), 0U);
}

TEST(CsvText, ReadsWrittenCells) {
  for (const char* const text :
       {"plain", "with, comma", "with \"marks\"", "line\nbreak", " blank "}) {
    const auto lines = csv_lines("x," + csv_cell(text) + "\n");
    ASSERT_EQ(lines.size(), 1U);
    if (std::string(text) != " blank ") {
      EXPECT_EQ(lines[0].cells, (Cells{"x", text}));
    }
  }
}

}  // namespace
}  // namespace misalign::schema
