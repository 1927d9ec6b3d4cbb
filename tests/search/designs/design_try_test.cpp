#include "search/designs/design_try.hpp"

#include <gtest/gtest.h>

#include "schema/files/user_error.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

const DesignTry kPassing{"constructed",
                         DesignStage::refined,
                         {{"pattern", 1}},
                         "",
                         "thickness_mm 2",
                         {0.25, "static_margin", "Static margin"},
                         {}};
const DesignTry kNone{"drawn", DesignStage::rough, nullptr, "no draw deploys", "", {}, {}};

TEST(DesignLog, ALaterRunHasWhatWasFinished) {
  const Folder folder("design_log");
  const std::string path = folder.file("tried.json");
  {
    DesignLog log(path, "wish 1");
    EXPECT_EQ(log.find("one"), nullptr);
    log.add("one", {kPassing, kNone});
    log.add("two", {kNone});
  }
  const DesignLog log(path, "wish 1");
  ASSERT_NE(log.find("one"), nullptr);
  ASSERT_EQ(log.find("one")->size(), 2u);
  for (const auto& [kept, tried] : {std::pair(log.find("one")->front(), kPassing),
                                    std::pair(log.find("two")->front(), kNone)}) {
    EXPECT_EQ(design_try_json(kept), design_try_json(tried));
    EXPECT_EQ(kept.passes(), tried.passes());
  }
  EXPECT_EQ(log.find("three"), nullptr);
}

TEST(DesignLog, RefusesAnotherWishAndOtherFiles) {
  const Folder folder("design_log");
  const std::string path = folder.file("tried.json");
  DesignLog(path, "wish 1").add("one", {kPassing});
  EXPECT_THROW(DesignLog(path, "wish 2"), schema::UserError);
  for (const char* text : {"{}", "[1]", R"({"wish": "wish 1"})", "no JSON",
                           R"({"wish": "wish 1", "steps": {"one": [{"how": 3}]}})"}) {
    folder.file("tried.json", text);
    EXPECT_THROW(DesignLog(path, "wish 1"), schema::UserError) << text;
  }
}

TEST(DesignLog, AnEmptyPathWritesNothing) {
  DesignLog log("", "wish 1");
  log.add("one", {kNone});
  EXPECT_EQ(log.find("one")->size(), 1u);
}

}  // namespace
}  // namespace misalign::search
