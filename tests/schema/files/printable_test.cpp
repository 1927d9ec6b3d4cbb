#include "schema/files/printable.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "schema/exchange/xml_text.hpp"
#include "schema/files/input.hpp"

namespace misalign::schema {
namespace {

// A code point as UTF-8, by the table of RFC 3629.
std::string encoded(char32_t c) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | ((c >> shift) & 0x3f)); };
  if (c < 0x80) return {static_cast<char>(c)};
  if (c < 0x800) return {static_cast<char>(0xc0 | (c >> 6)), tail(0)};
  if (c < 0x10000) return {static_cast<char>(0xe0 | (c >> 12)), tail(6), tail(0)};
  return {static_cast<char>(0xf0 | (c >> 18)), tail(12), tail(6), tail(0)};
}

TEST(Printable, NothingThatATerminalActsOnIsLeft) {
  // ECMA-48's control characters, and those that Unicode's annex 9 turns the reading order with.
  for (char32_t c = 0; c < 0xa0; ++c) {
    if (c >= 0x20 && c < 0x7f) continue;
    EXPECT_EQ(printable(encoded(c)).find_first_not_of("\\u0123456789abcdef"), std::string::npos)
        << std::hex << static_cast<unsigned>(c);
  }
  for (const char32_t c : {0x61c, 0x200e, 0x200f, 0x202a, 0x202b, 0x202c, 0x202d, 0x202e, 0x2066,
                           0x2067, 0x2068, 0x2069, 0x2028, 0x2029, 0xfeff, 0xe0041}) {
    EXPECT_EQ(printable(encoded(c)).front(), '\\') << std::hex << static_cast<unsigned>(c);
  }
  EXPECT_EQ(printable("a\x1b[2Jb\nc\xc2\x9b"), "a\\u001b[2Jb\\u000ac\\u009b");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\u0000b");
}

TEST(Printable, WhatPeopleWriteStays) {
  for (const std::string text :
       {"", "accepted 5 (0.4 %)", "\u00e9t\u00e9", "\u6298\u308a\u7d19", "\u05e9\u05dc\u05d5\u05dd",
        "\U0001f9a2", "back\\slash \"quoted\"", "\u2581\u2588"}) {
    EXPECT_EQ(printable(text), text);
    EXPECT_EQ(printable(printable(text)), text);
  }
  EXPECT_EQ(printable(printable("\x1b\xff")), printable("\x1b\xff"));
}

TEST(Printable, BytesThatAreNoUtf8AreNamed) {
  // A byte alone, a form too long, half of a pair, beyond the last code point, cut off.
  EXPECT_EQ(printable("\x9b"), "\\x9b");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");
  EXPECT_EQ(printable("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(printable("a\xe2\x82"), "a\\xe2\\x82");
}

// What XML 1.0 allows (its production 2), and nothing that turns the reading order.
TEST(Printable, XmlHasNoControlCharacters) {
  EXPECT_EQ(xml_text("a\x1b[2J\n\u202e<b>\x01\xff"),
            "a\\u001b[2J\\u000a\\u202e&lt;b&gt;\\u0001\\xff");
  EXPECT_EQ(xml_text("\u6298\u308a \u00b1 0.4"), "\u6298\u308a \u00b1 0.4");
}

TEST(Printable, JsonSaysTheSame) {
  const nlohmann::json value = {{"a\x7f", "x\xc2\x9b\u202e\u2028\U000e0041\x1b\n"},
                                {"b", "\u00e9"}};
  const std::string shown = printable_json(value.dump(1));
  EXPECT_EQ(nlohmann::json::parse(shown), value);
  EXPECT_EQ(printable_lines(shown), shown);
  EXPECT_EQ(shown.find("\xc2\x9b"), std::string::npos);
}

TEST(Printable, RowsOfCsvStayRows) {
  EXPECT_EQ(printable_csv("a,b\n1,\"x\n\x1b\"\"\n\"\n\x1b"),
            "a,b\n1,\"x\\u000a\\u001b\"\"\\u000a\"\n\\u001b");
}

TEST(Shortened, HeadAndTailOfWholeCharacters) {
  EXPECT_EQ(shortened("short", 20), "short");
  const std::string text = "begin " + std::string(1000, '.') + " end";
  const std::string shown = shortened(text, 50);
  EXPECT_LE(shown.size(), 50u);
  EXPECT_TRUE(shown.starts_with("begin ") && shown.ends_with(" end")) << shown;
  std::string accents;
  while (accents.size() < 1000) accents += "\u20ac";
  for (std::size_t most = 20; most < 40; ++most) {
    const std::string cut = shortened(accents, most);
    EXPECT_LE(cut.size(), most);
    EXPECT_EQ(printable(cut), cut) << "half a character";
  }
}

TEST(UserError, IsOneLineHoweverLongOrOddWhatItNames) {
  const UserError error(Cause::bad_input,
                        "evil\n\x1b[2Jmisalign: accepted 99999" + std::string(10000000, 'x'));
  const std::string sentence = error.what();
  EXPECT_EQ(sentence.find('\n'), std::string::npos);
  EXPECT_EQ(sentence.find('\x1b'), std::string::npos);
  EXPECT_LT(sentence.size(), 5000u);
}

TEST(JsonOf, NothingThatExhaustsTheStackOfWhoCopiesIt) {
  EXPECT_EQ(json_of("[1, {\"a\": 2}]"), Json::parse("[1, {\"a\": 2}]"));
  for (const Json& none : {Json(), Json(5), Json("no JSON"), Json("[1"), Json(""),
                           Json(std::string(1000000, '[') + std::string(1000000, ']'))}) {
    EXPECT_TRUE(json_of(none).is_null()) << none.dump().substr(0, 50);
  }
}

TEST(InputFaults, TwentyAreListedAndTheRestCounted) {
  InputFaults faults;
  for (int k = 0; k < 100000; ++k) {
    faults.add("fault " + std::to_string(k) + std::string(k == 0 ? 1000000 : 0, 'y'), "why\n",
               "do");
  }
  EXPECT_EQ(faults.count(), 100000u);
  EXPECT_EQ(faults.sentences().size(), kMostListed);
  try {
    faults.refuse("file\n.json");
    FAIL() << "nothing was refused";
  } catch (const UserError& error) {
    const std::string message = error.what();
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 21) << message;
    EXPECT_NE(message.find("100000 faults"), std::string::npos);
    EXPECT_NE(message.find("\n  and 99980 more"), std::string::npos) << message;
    EXPECT_LT(message.size(), 20000u);
  }
}

}  // namespace
}  // namespace misalign::schema
