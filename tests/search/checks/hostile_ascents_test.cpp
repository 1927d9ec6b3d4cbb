// Rows of ascents that were changed, with all that follows from them: verify finds each, and so
// does a merge with a catalogue that holds the same draws.
#include <gtest/gtest.h>

#include <filesystem>

#include "schema/campaign/campaign_file.hpp"
#include "search/checks/merge.hpp"
#include "search/checks/verify.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/sheets/whole_program.hpp"
#include "tests/folder.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::search {
namespace {

class HostileAscents : public testing::Test {
 protected:
  void SetUp() override {
    const schema::Campaign campaign = schema::read_campaign(
        schema::Json::parse(R"({"pattern": {"family": "miura", "rows": 4, "columns": 4},
          "accept": {"deploys_from_deg": 150},
          "search": {"method": "optimise", "from_deg": 36}})"),
        "test");
    DrawEvaluator evaluator(campaign, solver::available_instruction_sets().back(), kWholeProgram);
    schema::Catalogue catalogue(good_, campaign, evaluator.mechanism());
    catalogue.begin_run(schema::kRun, {{0, kDraws}, {}, {}});
    catalogue.commit({work_off(evaluator, {0, kDraws})});
    catalogue.end_run("complete");
  }

  // With this done to the row of the first end that took steps.
  std::string changed(const std::string& assignments) const {
    const std::string path = folder_.file("bad.db", bytes_of(good_));
    schema::change_rows(path, "UPDATE ascent SET " + assignments +
                                  " WHERE draw = (SELECT min(draw) FROM ascent WHERE steps > 0)");
    return path;
  }
  static std::string sentences(const std::vector<schema::Finding>& findings) {
    std::string all;
    for (const schema::Finding& finding : findings) all += finding.sentence + "\n";
    return all;
  }
  static std::string findings(const std::string& path, std::uint64_t units) {
    VerifyOptions options;
    options.units = units;
    return sentences(verify(*schema::open_for_reading(path), path, options).findings);
  }
  std::string merged_with(const std::string& other) const {
    std::filesystem::remove(folder_.file("all.db"));
    const MergeOptions options{
        folder_.file("all.db"), {good_, other}, schema::kRun, schema::Builds::mixed};
    return sentences(merge(options).findings);
  }

  static constexpr std::uint64_t kDraws = 4;
  const Folder folder_{"hostile_ascents"};
  const std::string good_ = folder_.file("good.db");
};

TEST_F(HostileAscents, RowsThatDoNotAddUpAreFound) {
  ASSERT_EQ(findings(good_, 1), "");
  for (const char* lie :
       {"start_value = NULL", "end_value = NULL", "start_value = NULL, end_value = NULL",
        "end_value = start_value", "end_value = 9e999", "start_value = -1", "steps = 0",
        "steps = 200", "steps = -1", "sheets_folded = 0", "ended = 'breaks_a_limit'",
        "ended = 'has_no_value'",
        "ended = iif(ended = 'most_steps', 'no_step_is_better', 'most_steps')",
        "start_value = start_value * 1.001", "end_value = end_value * 1.001",
        "ended = 'has_no_value', start_value = NULL, end_value = NULL, steps = 0, sheets_folded = "
        "0, "
        "limited_by = NULL"}) {
    SCOPED_TRACE(lie);
    const std::string path = changed(lie);
    EXPECT_NE(findings(path, 0), "");
  }
}

TEST_F(HostileAscents, RowsThatAddUpAreFoundByMakingThemAgain) {
  ASSERT_EQ(merged_with(folder_.file("twin.db", bytes_of(good_))), "");
  for (const char* lie : {"steps = steps + 1", "limited_by = NULL", "limited_by = '{}'",
                          "sheets_folded = sheets_folded + 1",
                          "limited_by = json_set(limited_by, '$.per_mm_of_amplitude', 1.0)"}) {
    SCOPED_TRACE(lie);
    const std::string path = changed(lie);
    EXPECT_NE(findings(path, 1).find("ascent."), std::string::npos);
  }
  EXPECT_NE(merged_with(changed("steps = steps + 1")).find("ascent.steps"), std::string::npos);
}

}  // namespace
}  // namespace misalign::search
