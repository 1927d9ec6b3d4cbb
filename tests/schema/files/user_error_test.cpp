#include "schema/files/user_error.hpp"

#include <gtest/gtest.h>

namespace misalign::schema {
namespace {

std::string in_brackets(std::string_view name, bool has_value) {
  return "[" + std::string(name) + (has_value ? "]=" : "]");
}

TEST(UserError, AnOptionFaultIsABadRequest) {
  const UserError flag(solver::OptionFault{"joined", {}, "why", "try"});
  EXPECT_EQ(flag.cause(), Cause::bad_request);
  EXPECT_STREQ(flag.what(), "joined: why; try");
  EXPECT_EQ(flag.sentence(in_brackets), "[joined]: why; try");
  const UserError angle(solver::OptionFault{"from_deg", "200", "why", "try"});
  EXPECT_STREQ(angle.what(), "from_deg=200: why; try");
  EXPECT_EQ(angle.sentence(in_brackets), "[from_deg]=200: why; try");
  // A value is there, though it is empty.
  const UserError empty(solver::OptionFault{"hold", "", "why", "try"});
  EXPECT_EQ(empty.sentence(in_brackets), "[hold]=: why; try");
}

TEST(UserError, EveryParameterOfASentenceIsNamed) {
  const UserError error(Cause::in_use, "a.db: give another " + parameter("catalogue") + ", or wait",
                        {"by " + parameter("storage", "network")}, 2);
  EXPECT_STREQ(error.what(),
               "a.db: give another catalogue, or wait\n  by storage=network\n  and 2 more");
  EXPECT_EQ(error.sentence(in_brackets),
            "a.db: give another [catalogue], or wait\n  by [storage]=network\n  and 2 more");
}

// What a name is put between does not reach people, also where a long sentence was cut within.
TEST(UserError, NoMarkIsShown) {
  for (std::size_t length = 0; length < 40; ++length) {
    std::string sentence(length, 'x');
    while (sentence.size() < 4000) sentence += parameter("output") + parameter("format", "csv");
    const UserError error(Cause::failure, sentence);
    for (const std::string& text : {std::string(error.what()), error.sentence(in_brackets)}) {
      EXPECT_EQ(text.find("\xef\xb7"), std::string::npos) << text;
    }
  }
}

}  // namespace
}  // namespace misalign::schema
