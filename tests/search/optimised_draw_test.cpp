// Draws of an optimising search: where they end, against the optimisation of single sheets.
#include "search/sheets/optimised_draw.hpp"

#include <gtest/gtest.h>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/models.hpp"
#include "search/sheets/row_certifier.hpp"
#include "solver/design/worth.hpp"

namespace misalign::search {
namespace {

using schema::Json;

class OptimisedDraws : public testing::Test {
 protected:
  static schema::Campaign campaign(const Json& search, const Json& misalignment = Json::object()) {
    Json value = {{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                  {"accept", {{"deploys_from_deg", 150}}},
                  {"misalignment", misalignment},
                  {"search", {{"method", "optimise"}, {"from_deg", 36}}}};
    value["search"].update(search);
    return schema::read_campaign(value, "a test");
  }
  static schema::Campaign plain(schema::Campaign campaign) {
    campaign.search = {};
    return campaign;
  }
  static schema::UnitRecord ends(const schema::Campaign& campaign, const schema::DrawRange& range) {
    DrawEvaluator evaluator(campaign);
    optimise_if_asked(evaluator);
    return work_off(evaluator, range);
  }
};

// Each candidate is what optimise() makes of the plain campaign's, and nothing else changes.
TEST_F(OptimisedDraws, EndWhereSingleSheetsDo) {
  for (const Json& search :
       {Json::object(), Json({{"shifts", "ternary"}}), Json({{"grid_mm", 0.1}}),
        Json({{"maximise", "miscut_margin_mm"}, {"from_deg", nullptr}}),
        Json({{"subject_to", {"stroke_max <= 0.05"}}, {"most_steps", 3u}})}) {
    SCOPED_TRACE(search.dump());
    const schema::Campaign asked = campaign(search);
    DrawEvaluator drawn(plain(asked));
    const schema::UnitRecord starts = work_off(drawn, {0, 16}), kept = ends(asked, {0, 16});
    EXPECT_EQ(kept.accepted_draws(), starts.accepted_draws());
    EXPECT_EQ(kept.rejected, starts.rejected);
    EXPECT_EQ(kept.screened, starts.screened);
    ASSERT_EQ(kept.fault_sample.size(), starts.fault_sample.size());
    ASSERT_GT(starts.candidates.size(), 4u);
    const solver::Model model = model_of(asked);
    solver::SheetSolver solver(model);
    const solver::OptimiseOptions options = asked_of_ends(asked);
    int better = 0, outside = 0;
    for (std::size_t k = 0; k < kept.candidates.size(); ++k) {
      const schema::Candidate& end = kept.candidates[k];
      const solver::Sheet start(solver, starts.candidates[k].shifts_mm);
      const auto found = solver::optimise(start, options);
      ASSERT_TRUE(end.ascent);
      EXPECT_TRUE(can_be_kept(asked, end.shifts_mm)) << end.draw;
      const solver::Sheet sheet(solver, end.shifts_mm);
      EXPECT_EQ(end.metrics.deploys_from_sample, sheet.history().verdict.deploys_from_sample);
      if (!found.study) {
        ++outside;
        EXPECT_EQ(end.ascent->ended, "breaks_a_limit");
        EXPECT_FALSE(end.ascent->start_value);
        EXPECT_EQ(end.shifts_mm, start.shifts_mm());
        EXPECT_GT(starts.candidates[k].metrics.stroke_max, 0.05);
        continue;
      }
      EXPECT_EQ(end.shifts_mm, found.study->best().shifts_mm) << end.draw;
      EXPECT_EQ(end.ascent->end_value, found.study->best().value);
      EXPECT_EQ(end.ascent->start_value, found.study->start().value);
      EXPECT_EQ(end.ascent->steps, found.study->steps());
      EXPECT_EQ(end.ascent->sheets_folded, found.study->looks);
      EXPECT_EQ(end.ascent->limited_by.has_value(), found.study->limits.has_value());
      better += end.ascent->steps > 0;
      if (end.ascent->steps == 0) continue;
      EXPECT_GE(end.metrics.deploys_from_sample, 150);
      EXPECT_TRUE(solver::goes_all_the_way(sheet, options));
      if (options.stroke_limit) {
        EXPECT_LE(end.metrics.stroke_max, *options.stroke_limit);
      }
    }
    EXPECT_GT(better, 3);
    EXPECT_EQ(outside > 0, options.stroke_limit.has_value());
  }
}

// Cut anywhere, and gone on with: whole blocks count, what was on its way is done again.
TEST_F(OptimisedDraws, GoOnWhereTheyWereCut) {
  const schema::Campaign asked = campaign({{"shifts", "ternary"}});
  const schema::UnitRecord whole = ends(asked, {0, 12});
  DrawEvaluator evaluator(asked);
  optimise_if_asked(evaluator);
  std::vector<schema::Candidate> candidates;
  std::uint64_t next = 0, rejected = 0;
  int cut = 0;
  for (int blocks = 1; next < 12; ++blocks) {
    UnitWork work(evaluator, {next, 12});
    for (int k = 0; k < blocks && !work.finished(); ++k) work.run_next_block();
    cut += !work.finished();
    const schema::UnitRecord part = work.take();
    EXPECT_EQ(part.range.lo, next);
    EXPECT_EQ(part.range.size(), part.accepted + part.rejected + part.undecided.size());
    EXPECT_EQ(part.accepted, part.candidates.size());
    for (const schema::Candidate& one : part.candidates) {
      EXPECT_TRUE(one.ascent) << "a draw that is not where it ends";
      candidates.push_back(one);
    }
    rejected += part.rejected;
    next = part.range.hi;
  }
  EXPECT_GT(cut, 0);
  EXPECT_EQ(rejected, whole.rejected);
  ASSERT_EQ(candidates.size(), whole.candidates.size());
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    EXPECT_EQ(candidates[k].draw, whole.candidates[k].draw);
    EXPECT_EQ(candidates[k].shifts_mm, whole.candidates[k].shifts_mm);
  }
}

TEST_F(OptimisedDraws, AreCertifiedAtTheirEnds) {
  schema::Campaign asked = campaign(Json::object());
  asked.certify = true;
  DrawEvaluator evaluator(asked);
  optimise_if_asked(evaluator);
  certify_if_asked(evaluator);
  const schema::UnitRecord unit = work_off(evaluator, {0, 8});
  ASSERT_GT(unit.candidates.size(), 1u);
  RowCertifier certifier(asked.pattern, evaluator.model());
  for (const schema::Candidate& end : unit.candidates) {
    ASSERT_TRUE(end.certificate);
    EXPECT_FALSE(certifier.row_fault(end.shifts_mm, *end.certificate)) << "of another sheet";
    if (end.ascent->steps == 0) continue;
    EXPECT_GE(end.certificate->certified_deg, 150);
  }
}

// Builds that end elsewhere do not work on one catalogue; of other campaigns verdicts suffice.
TEST_F(OptimisedDraws, HaveAFingerprintOfTheirOwn) {
  const schema::Campaign asked = campaign(Json::object());
  const std::string own = fingerprint(asked, "verdicts");
  EXPECT_EQ(own.size(), std::string("verdicts-").size() + 32);
  EXPECT_EQ(own.rfind("verdicts-", 0), 0u);
  EXPECT_EQ(fingerprint(campaign({{"maximise", "miscut_margin_mm"}}), "verdicts"), own);
  EXPECT_EQ(fingerprint(plain(asked), "verdicts"), "verdicts");
}

// Members of the parallel family stay members.
TEST_F(OptimisedDraws, StayWithinTheFamily) {
  Json value = campaign_json(campaign(Json::object()));
  value["misalignment"] = {{"kind", "parallel"}, {"vertices", "all"}};
  value["path"] = {{"sample_deg", 1}, {"end_deg", 179}};
  value["accept"]["deploys_from_deg"] = 179;
  // The larger sheet's steps end at the amplitude, which programs pass by their rounding.
  for (const auto& [facets, draws] : {std::pair{4, schema::DrawRange{0, 12}}, {8, {6, 9}}}) {
    value["pattern"]["rows"] = value["pattern"]["columns"] = facets;
    const schema::Campaign asked = schema::read_campaign(value, "a test");
    const schema::UnitRecord unit = ends(asked, draws);
    ASSERT_GE(unit.candidates.size(), 3u) << facets;
    int better = 0;
    for (const schema::Candidate& end : unit.candidates) {
      EXPECT_TRUE(can_be_kept(asked, end.shifts_mm)) << facets << ", draw " << end.draw;
      EXPECT_EQ(end.metrics.deploys_from_sample, 179);
      better += end.ascent->steps > 0;
    }
    EXPECT_GT(better, 0) << facets;
  }
}

Eigen::Matrix2Xd on_its_grid(const Eigen::Matrix2Xd& shifts_mm) {
  return (shifts_mm.array() / 0.1).round() * 0.1;
}

TEST_F(OptimisedDraws, WhatIsKeptIsWithinWhatIsAsked) {
  const schema::Campaign free = campaign(Json::object()),
                         ternary = campaign({{"shifts", "ternary"}}),
                         gridded = campaign({{"grid_mm", 0.1}});
  Eigen::Matrix2Xd shifts_mm = shifts_of_draw(free, 3);
  const int vertex = free.misalignment.vertices[2];
  EXPECT_TRUE(can_be_kept(ternary, shifts_mm));
  shifts_mm(0, vertex) = 0.3;
  EXPECT_TRUE(can_be_kept(free, shifts_mm));
  EXPECT_FALSE(can_be_kept(ternary, shifts_mm));
  EXPECT_FALSE(can_be_drawn(free, shifts_mm));
  shifts_mm(0, vertex) = 3 * 0.1;
  EXPECT_TRUE(can_be_kept(gridded, on_its_grid(shifts_mm)));
  shifts_mm(0, vertex) = 0.33;
  EXPECT_FALSE(can_be_kept(gridded, shifts_mm));
  shifts_mm(0, vertex) = 0.41;
  EXPECT_FALSE(can_be_kept(free, shifts_mm));
  shifts_mm(0, vertex) = 0;
  shifts_mm(0, 0) = 0.1;  // a corner, which is not shifted
  EXPECT_FALSE(can_be_kept(free, shifts_mm));
}

}  // namespace
}  // namespace misalign::search
