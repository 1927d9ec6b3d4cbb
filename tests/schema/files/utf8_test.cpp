// UTF-8 as a table of RFC 3629's section 4 has it: which bytes may follow which.
#include "schema/files/utf8.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace misalign::schema {
namespace {

// The ABNF of RFC 3629, byte ranges only; nothing here computes a code point.
struct Form {
  std::vector<std::pair<int, int>> bytes;
};
const std::pair<int, int> kTail{0x80, 0xbf};
const std::vector<Form> kForms = {{{{0x00, 0x7f}}},
                                  {{{0xc2, 0xdf}, kTail}},
                                  {{{0xe0, 0xe0}, {0xa0, 0xbf}, kTail}},
                                  {{{0xe1, 0xec}, kTail, kTail}},
                                  {{{0xed, 0xed}, {0x80, 0x9f}, kTail}},
                                  {{{0xee, 0xef}, kTail, kTail}},
                                  {{{0xf0, 0xf0}, {0x90, 0xbf}, kTail, kTail}},
                                  {{{0xf1, 0xf3}, kTail, kTail, kTail}},
                                  {{{0xf4, 0xf4}, {0x80, 0x8f}, kTail, kTail}}};

// How many bytes of a text are a character by that table; 0: none begins here.
std::size_t bytes_by_the_table(const std::string& text) {
  for (const Form& form : kForms) {
    bool fits = text.size() >= form.bytes.size();
    for (std::size_t k = 0; fits && k < form.bytes.size(); ++k) {
      const int byte = static_cast<unsigned char>(text[k]);
      fits = byte >= form.bytes[k].first && byte <= form.bytes[k].second;
    }
    if (fits) return form.bytes.size();
  }
  return 0;
}

void expect_as_in_the_table(const std::string& text) {
  const std::size_t bytes = bytes_by_the_table(text);
  const Utf8Character c = first_character(text);
  ASSERT_EQ(c.is_utf8, bytes > 0) << testing::PrintToString(text);
  ASSERT_EQ(c.bytes, std::max<std::size_t>(bytes, 1)) << testing::PrintToString(text);
  if (bytes > 0) return;
  ASSERT_EQ(c.code, static_cast<unsigned char>(text[0]));
}

TEST(Utf8, CodePointsAreThoseOfTheCompiler) {
  EXPECT_EQ(first_character("a").code, U'a');
  EXPECT_EQ(first_character("\u00e9t").code, U'\u00e9');
  EXPECT_EQ(first_character("\u07ff").code, U'\u07ff');
  EXPECT_EQ(first_character("\u0800").code, U'\u0800');
  EXPECT_EQ(first_character("\ud7ff\ue000").code, U'\ud7ff');
  EXPECT_EQ(first_character("\uffff").code, U'\uffff');
  EXPECT_EQ(first_character("\U00010000").code, U'\U00010000');
  EXPECT_EQ(first_character("\U0010ffff").code, U'\U0010ffff');
  EXPECT_EQ(first_character(std::string("\0", 1)).bytes, 1u);
}

TEST(Utf8, OverlongFormsAndHalvesOfPairsAreNone) {
  for (const char* text : {"\xc0\x80", "\xc1\xbf", "\xe0\x80\x80", "\xe0\x9f\xbf",
                           "\xf0\x80\x80\x80", "\xf0\x8f\xbf\xbf",  // too long
                           "\xed\xa0\x80", "\xed\xbf\xbf",          // halves
                           "\xf4\x90\x80\x80", "\xf5\x80\x80\x80",  // beyond the last
                           "\x80", "\xbf", "\xfe", "\xff"}) {       // no beginning
    EXPECT_FALSE(first_character(text).is_utf8) << testing::PrintToString(std::string(text));
    expect_as_in_the_table(text);
  }
}

TEST(Utf8, CutEndsAreNone) {
  for (const std::string_view text : {"\u00e9", "\u6298", "\U0001f9a2"}) {
    for (std::size_t bytes = 1; bytes < text.size(); ++bytes) {  // the rest lies behind the end
      EXPECT_FALSE(first_character(text.substr(0, bytes)).is_utf8);
      EXPECT_FALSE(first_character(std::string(text.substr(0, bytes)) + "a").is_utf8);
      EXPECT_FALSE(first_character(text.substr(bytes)).is_utf8);
    }
  }
}

TEST(Utf8, AnyBytesAreReadAsTheTableSays) {
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      expect_as_in_the_table({static_cast<char>(first), static_cast<char>(second), '\x80', '\xbf'});
    }
  }
  const unsigned seed = std::random_device()();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const unsigned char kHard[] = {0x00, 0x7f, 0x80, 0x8f, 0x90, 0x9f, 0xa0, 0xbf, 0xc1, 0xc2,
                                 0xdf, 0xe0, 0xed, 0xef, 0xf0, 0xf3, 0xf4, 0xf5, 0xff};
  for (int k = 0; k < 100000; ++k) {
    std::string text(1 + random() % 5, '\0');
    for (char& c : text) c = static_cast<char>(kHard[random() % std::size(kHard)]);
    expect_as_in_the_table(text);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace misalign::schema
