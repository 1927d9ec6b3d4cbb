#include "schema/files/text_table.hpp"

#include <gtest/gtest.h>

namespace misalign::schema {
namespace {

TEST(TextTable, WidthsAreThoseOfATerminal) {
  const std::vector<std::pair<std::string, std::size_t>> kWidths = {
      {"", 0},
      {"abc", 3},
      {"\u00e9t\u00e9", 3},       // precomposed
      {"e\u0301te\u0301", 3},     // with combining accents
      {"\u2581\u2588", 2},        // sparklines
      {"\u6298\u308a\u7d19", 6},  // wide
      {"\uff21", 2},              // full width
      {"\U0001f9a2", 2},          // four bytes
  };
  for (const auto& [text, width] : kWidths) EXPECT_EQ(display_width(text), width) << text;
  // What is no UTF-8 takes some width, and ends.
  EXPECT_LE(display_width("\xff\xfe\xe2"), 3u);
}

TEST(TextTable, NumbersAreFlushRightAndLinesEndWithTheirLastWord) {
  EXPECT_EQ(aligned({{"name", "n"}, {"\u00e9", "5"}, {"long", "1000"}, {"x", ""}}, {false, true}),
            "name     n\n"
            "\u00e9        5\n"
            "long  1000\n"
            "x\n");
  EXPECT_EQ(aligned({{"a", "b", "c"}, {"1"}, {"11", "2", "3"}}, {true, false, false}),
            " a  b  c\n"
            " 1\n"
            "11  2  3\n");
  EXPECT_EQ(aligned({}, {}), "");
}

TEST(TextTable, ARowIsOneLineWhateverIsInIt) {
  EXPECT_EQ(aligned({{"na\x1b[2Jme", "n"}, {"x\naccepted 99999\u202e", "5"}}, {false, true}),
            "na\\u001b[2Jme                n\n"
            "x\\u000aaccepted 99999\\u202e  5\n");
}

}  // namespace
}  // namespace misalign::schema
