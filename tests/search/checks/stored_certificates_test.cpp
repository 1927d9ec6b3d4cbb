// Certificates in catalogues that are joined and verified.
#include <gtest/gtest.h>

#include <filesystem>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "search/checks/merge.hpp"
#include "search/checks/verification_text.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "solver/certificate/certifier.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

class StoredCertificates : public testing::Test {
 protected:
  // Short paths, of which some deploy.
  static schema::Campaign campaign() {
    return schema::read_campaign(
        schema::Json::parse(R"({"pattern": {"family": "miura", "rows": 4, "columns": 4},
                                "path": {"end_deg": 60}, "accept": {"deploys_from_deg": 50}})"),
        "test");
  }

  std::string path(const std::string& name) const { return folder_.file(name); }

  /// A catalogue of one unit; its candidates certified up to `asked_deg`.
  void make(const std::string& name, const schema::DrawRange& range, double asked_deg) {
    schema::UnitRecord unit = work_off(evaluator_, range);
    const schema::Campaign& campaign = evaluator_.campaign();
    const solver::Model model(campaign.pattern.base, campaign.path());
    solver::Certifier certifier(model);
    for (schema::Candidate& candidate : unit.candidates) {
      const auto certificate = certifier.certify(
          campaign.pattern.base.sheet.vertices_mm + candidate.shifts_mm, asked_deg);
      candidate.certificate =
          schema::certificate_row(campaign.pattern, evaluator_.mechanism(), candidate.draw,
                                  candidate.shifts_mm, certificate, 0.25);
    }
    schema::Catalogue catalogue(path(name), campaign, evaluator_.mechanism());
    catalogue.begin_run(run_, {{0, 60}, {}, {}});
    catalogue.commit({unit});
    catalogue.end_run("stopped");
  }
  MergeReport join() {
    std::filesystem::remove(path("all.db"));
    return merge({path("all.db"), {path("a.db"), path("b.db")}, run_, schema::Builds::same});
  }
  Verification look(const std::string& name) const {
    return verify(*schema::open_for_reading(path(name)), path(name), {.sample = {}});
  }
  void change(const std::string& name, const std::string& sql) const {
    SQLite::Database(path(name), SQLite::OPEN_READWRITE).exec(sql);
  }
  std::int64_t number(const std::string& name, const std::string& sql) const {
    return schema::open_for_reading(path(name))->execAndGet(sql).getInt64();
  }

  DrawEvaluator evaluator_{campaign()};
  const schema::RunInfo run_{"host", "0", "none", "g++", "-O2", "golden", 1};
  const Folder folder_{"certificates"};
};

TEST_F(StoredCertificates, AreJoinedTheFartherOneOfTwoSlow) {
  make("a.db", {0, 40}, 30);
  make("b.db", {20, 60}, 45);
  const MergeReport report = join();
  for (const schema::Finding& finding : report.findings) ADD_FAILURE() << finding.sentence;
  EXPECT_EQ(report.faulty_certificates, 0u);
  EXPECT_GT(number("all.db", "SELECT count(*) FROM candidate"), 20);
  EXPECT_EQ(number("all.db", "SELECT count(*) FROM candidates WHERE certified_deg IS NULL"), 0);
  EXPECT_EQ(number("all.db",
                   "SELECT count(*) FROM certificate WHERE (draw < 20) != (asked_deg = "
                   "30)"),
            0);
  const Verification v = look("all.db");
  EXPECT_TRUE(v.good());
  EXPECT_EQ(v.certificates.of, v.candidates);
  EXPECT_EQ(v.certificates.checked, v.candidates);
}

TEST_F(StoredCertificates, SpoiltOnesAreFoundAndNotTakenOver) {
  make("a.db", {0, 30}, 30);
  make("b.db", {20, 50}, 45);
  const std::int64_t draw = number("b.db", "SELECT min(draw) FROM certificate WHERE draw >= 30");
  const std::string where = " WHERE draw = " + std::to_string(draw);
  change("b.db", "UPDATE certificate SET certified_deg = certified_deg - 1e-9" + where);
  const Verification v = look("b.db");
  ASSERT_EQ(v.findings.size(), 1u);
  EXPECT_EQ(v.findings[0].details.at("where"), "draw " + std::to_string(draw));
  EXPECT_EQ(v.findings[0].details.at("column"), "certificate");
  EXPECT_EQ(v.certificates.checked + 1, v.certificates.of);
  const std::string of_all =
      std::to_string(v.certificates.checked) + " of " + std::to_string(v.certificates.of);
  EXPECT_NE(verification_text(v).find("certificates " + of_all), std::string::npos);
  const MergeReport report = join();
  for (const schema::Finding& finding : report.findings) ADD_FAILURE() << finding.sentence;
  EXPECT_EQ(report.faulty_certificates, 1u);
  EXPECT_EQ(number("all.db", "SELECT count(*) FROM certificate" + where), 0);
  EXPECT_EQ(number("all.db", "SELECT count(*) FROM candidates WHERE certified_deg IS NULL"), 1);
  EXPECT_TRUE(look("all.db").good());
}

}  // namespace
}  // namespace misalign::search
