// Catalogues of every schema since release 1.0.0: they are verified as what they are, and joined
// with what this program finds.
#include "tests/older_catalogues.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <span>

#include "schema/catalogue/catalogue_state.hpp"
#include "search/checks/merge.hpp"
#include "search/checks/verification_text.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/golden_verdicts.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

class OlderCatalogues : public testing::TestWithParam<OlderCatalogue> {
 protected:
  void SetUp() override { std::filesystem::copy_file(GetParam().path(), path("old.db")); }

  std::string path(const std::string& name) const { return folder_.file(name); }
  schema::CatalogueState state(const std::string& name) const {
    return schema::read_state(*schema::open_for_reading(path(name)));
  }
  void expect_good(const std::string& name) const {
    const auto database = schema::open_for_reading(path(name));
    const Verification v = verify(*database, path(name), {.sample = {}, .units = 100});
    for (const auto& finding : v.findings) ADD_FAILURE() << name << ": " << finding.sentence;
    EXPECT_GT(v.checked.size(), 10u);
    EXPECT_EQ(v.units.checked, v.units.of);
    // Draw 19 of the fixture has a bump by the cubics of then, and none by today's function.
    if (GetParam().first == 2) {
      EXPECT_GE(v.not_comparable, 1u);
      EXPECT_EQ(v.other_definitions, (std::set<std::string>{"bump_deg"}));
      EXPECT_NE(verification_text(v).find("bump_deg"), std::string::npos);
    }
  }
  schema::Campaign campaign() const {
    return schema::read_campaign_of(*schema::open_for_reading(path("old.db")), "fixture");
  }

  const schema::RunInfo run_{"host", "0",
                             "none", "g++",
                             "-O2",  golden_verdicts(solver::available_instruction_sets().back()),
                             1};
  const Folder folder_{"older"};
};

TEST_P(OlderCatalogues, AreVerifiedAsWhatTheyAreSlow) {
  expect_good("old.db");
  const schema::Campaign campaign = this->campaign();
  const DrawEvaluator evaluator(campaign);
  { schema::Catalogue(path("old.db"), campaign, evaluator.mechanism()); }
  expect_good("old.db");  // and after they are brought up to date
}

TEST_P(OlderCatalogues, AreJoinedWithAFreshRun) {
  DrawEvaluator evaluator(campaign());
  const schema::CatalogueState old = state("old.db");
  {
    schema::Catalogue fresh(path("fresh.db"), evaluator.campaign(), evaluator.mechanism());
    fresh.begin_run(run_, old.goal);
    // Units of other sizes: some of both are taken, others compared.
    for (std::uint64_t lo = 0; lo < old.goal_end;) {
      const std::uint64_t hi = std::min(old.goal_end, lo + (lo == 0 ? 20 : 30));
      fresh.commit({work_off(evaluator, {lo, hi})});
      lo = hi;
    }
    fresh.end_run("complete");
  }
  EXPECT_EQ(state("fresh.db").digest.size(), 32u);
  for (const auto& order : {std::vector{"old.db", "fresh.db"}, {"fresh.db", "old.db"}}) {
    const MergeReport report =
        merge({path("all.db"), {path(order[0]), path(order[1])}, run_, schema::Builds::same});
    for (const auto& finding : report.findings) ADD_FAILURE() << finding.sentence;
    EXPECT_EQ(report.compared, old.goal_end);
    EXPECT_EQ(state("all.db").digest, state("fresh.db").digest);
    const auto database = schema::open_for_reading(path("all.db"));
    for (const auto& finding : verify(*database, "all.db", {.sample = {}}).findings) {
      ADD_FAILURE() << finding.sentence;
    }
    std::filesystem::remove(path("all.db"));
  }
}

std::string first_name(const testing::TestParamInfo<OlderCatalogue>& info) {
  return std::to_string(info.param.first) + "_" + std::to_string(info.param.version);
}
const std::span kAllOlder(kOlderCatalogues);
INSTANTIATE_TEST_SUITE_P(SlowOnes, OlderCatalogues,
                         testing::ValuesIn(kAllOlder.begin(), kAllOlder.end() - 1), first_name);
INSTANTIATE_TEST_SUITE_P(Last, OlderCatalogues, testing::Values(kAllOlder.back()), first_name);

}  // namespace
}  // namespace misalign::search
