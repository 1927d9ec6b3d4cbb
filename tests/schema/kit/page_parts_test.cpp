// Tables of pages: none has more rows than a page holds, and none a single row left over; lengths
// in both units.
#include "schema/kit/page_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace misalign::schema {
namespace {

std::size_t count_of(const std::string& text, const std::string& words) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) {
    ++count;
  }
  return count;
}

TEST(PageTables, DivideTheirRowsEqually) {
  EXPECT_EQ(page_tables({"a"}, {}, 0), "");
  for (const std::size_t count : {1U, 2U, 24U, 25U, 48U, 49U, 100U}) {
    const std::vector<std::vector<std::string>> rows(count, {"x"});
    std::string text = page_tables({"a"}, rows, 1);
    const std::size_t tables = count_of(text, "<table");
    EXPECT_EQ(tables, (count + 23) / 24);
    EXPECT_EQ(count_of(text, "<th>"), tables);  // each has its headings
    EXPECT_EQ(count_of(text, "<td"), count);
    std::size_t least = count, most = 0;
    while (!text.empty()) {
      const std::size_t end = text.find("</table>") + std::string("</table>\n").size(),
                        table_rows = count_of(text.substr(0, end), "<td");
      least = std::min(least, table_rows);
      most = std::max(most, table_rows);
      text.erase(0, end);
    }
    EXPECT_LE(most, 24U);
    EXPECT_LE(most - least, 1U) << count;
  }
}

TEST(LengthUnit, AnInchIs25Point4Millimetres) {
  EXPECT_EQ(length_text(25.4, LengthUnit::millimetre, 1), "25.4 mm");
  EXPECT_EQ(length_text(25.4, LengthUnit::inch, 1), "1.00 in");
  EXPECT_EQ(length_number(-0.4, LengthUnit::inch, 4), "-0.01575");
  EXPECT_EQ(length_number(12.34, LengthUnit::millimetre, 0), "12");
}

}  // namespace
}  // namespace misalign::schema
