#include "search/terminal/terminal.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <optional>

#include "search/terminal/screen.hpp"

namespace misalign::search {
namespace {

// Environment variables as a test wants them, and as they were after it.
class TerminalTest : public testing::Test {
 protected:
  void TearDown() override {
    for (const auto& [name, value] : before_) put(name, value);
  }
  void set(const std::string& name, const std::optional<std::string>& value) {
    const char* now = std::getenv(name.c_str());
    before_.emplace(name, now ? std::optional<std::string>(now) : std::nullopt);
    put(name, value);
  }

 private:
  static void put(const std::string& name, const std::optional<std::string>& value) {
    value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
  }
  std::map<std::string, std::optional<std::string>> before_;
};

TEST_F(TerminalTest, ColorsAreWantedOnTerminalsOnly) {
  set("TERM", "xterm");
  set("NO_COLOR", std::nullopt);
  EXPECT_TRUE(colors_wanted(ColorMode::automatic, true));
  EXPECT_FALSE(colors_wanted(ColorMode::automatic, false));
  EXPECT_FALSE(colors_wanted(ColorMode::never, true));
  EXPECT_TRUE(colors_wanted(ColorMode::always, false));
  set("NO_COLOR", "");  // no-color.org: counts if it is not empty
  EXPECT_TRUE(colors_wanted(ColorMode::automatic, true));
  set("NO_COLOR", "1");
  EXPECT_FALSE(colors_wanted(ColorMode::automatic, true));
  EXPECT_TRUE(colors_wanted(ColorMode::always, true));  // asked for by name
  set("NO_COLOR", std::nullopt);
  for (const char* name : {"dumb", ""}) {
    set("TERM", name);
    EXPECT_FALSE(colors_wanted(ColorMode::automatic, true)) << name;
  }
}

TEST_F(TerminalTest, TheFirstLocaleThatIsSetCounts) {
  set("LC_ALL", std::nullopt);
  set("LC_CTYPE", std::nullopt);
  set("LANG", std::nullopt);
  EXPECT_FALSE(locale_is_utf8());
  for (const char* name : {"de_CH.UTF-8", "C.utf8", "en_US.Utf-8"}) {
    set("LANG", name);
    EXPECT_TRUE(locale_is_utf8()) << name;
  }
  set("LC_CTYPE", "de_CH.ISO-8859-1");
  EXPECT_FALSE(locale_is_utf8());
  set("LC_ALL", "C.UTF-8");
  EXPECT_TRUE(locale_is_utf8());
  set("LC_ALL", "");
  EXPECT_FALSE(locale_is_utf8());
}

TEST_F(TerminalTest, ThePager) {
  set("PAGER", std::nullopt);
  EXPECT_EQ(pager_command(), "less");
  set("PAGER", "more -s");
  EXPECT_EQ(pager_command(), "more -s");
  for (const char* none : {"", "cat"}) {
    set("PAGER", none);
    EXPECT_EQ(pager_command(), "") << none;
  }
}

TEST(Paint, MarksWordsOrLeavesThem) {
  EXPECT_EQ(Paint(false).bold("word"), "word");
  const std::string bold = Paint(true).bold("word");
  EXPECT_EQ(bold.front(), '\x1b');
  EXPECT_NE(bold.find("word\x1b[0m"), std::string::npos);
  EXPECT_NE(Paint(true).good("x"), Paint(true).bad("x"));
}

}  // namespace
}  // namespace misalign::search
