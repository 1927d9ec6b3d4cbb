// Certificates in a run without MPI: jobs that are cut short, messages, what is said; and
// candidates that are certified as they are found.
#include <gtest/gtest.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/exchange/certify_json.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/models.hpp"
#include "search/ranks/certify_task.hpp"
#include "search/sheets/certify_text.hpp"
#include "search/sheets/whole_program.hpp"
#include "solver/certificate/certificate_check.hpp"
#include "solver/records/record_sheet.hpp"
#include "tests/solver/record_path.hpp"

namespace misalign::search {
namespace {

schema::Campaign campaign_to_certify(bool certify = false) {
  return schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                                {"accept", {{"deploys_from_deg", 150}}},
                                {"certify", certify}},
                               "a test");
}

class Certificates : public testing::Test {
 protected:
  CertifyOrder order_of(std::size_t sheet) const {
    const std::uint64_t draw = 10 + sheet;
    return {draw, kAsked_deg, shifts_of_draw(campaign_, draw)};
  }
  schema::CertificateRecord certified(std::size_t sheet) {
    const CertifyOrder order = order_of(sheet);
    return certifier_.certify(order.draw, order.shifts_mm, order.asked_deg);
  }

  static constexpr double kAsked_deg = 20;
  const schema::Campaign campaign_ = campaign_to_certify();
  const solver::Model model_ = model_of(campaign_);
  RowCertifier certifier_{campaign_.pattern, model_};
};

// Without the seconds that it took.
schema::CertificateRecord timeless(schema::CertificateRecord row) {
  row.seconds = 0;
  return row;
}

TEST_F(Certificates, OfEverySheetOnceThoughJobsAreCutShort) {
  constexpr std::size_t kSheets = 12;
  std::vector<int> kept(kSheets);
  std::vector<schema::CertificateRecord> rows(kSheets);
  CertifyTask task(certifier_,
                   {kSheets, [&](std::size_t k) { return order_of(k); },
                    [&](std::vector<CertifyList::Done> done) {
                      for (auto& one : done) {
                        ++kept[one.sheet];
                        rows[one.sheet] = std::move(*one.result.made);
                      }
                    }},
                   3);
  EXPECT_FALSE(task.complete());
  for (bool cut = true; task.anything_open(); cut = !cut) {
    std::optional<Bytes> jobs[3];
    for (const int worker : {1, 2}) jobs[worker] = task.assign(worker);
    for (const int worker : {1, 2}) {
      ASSERT_EQ(task.has_job(worker), jobs[worker].has_value());
      if (!jobs[worker]) continue;
      CertifyWork work(certifier_, unpack_orders(*jobs[worker]));
      // The first job of worker 1 comes back empty, as if a signal had come at once.
      while (!work.finished() && !(cut && worker == 1)) work.run_next_block();
      SentResults sent = work.take();
      sent.was_stopped = cut;
      EXPECT_EQ(task.take_back(worker, pack(sent)), cut);
      EXPECT_FALSE(task.has_job(worker));
    }
    if (task.anything_open()) {
      EXPECT_TRUE(task.compute_one_block());
    }
    task.commit();
  }
  EXPECT_TRUE(task.complete());
  EXPECT_FALSE(task.compute_one_block());
  task.commit_all();
  EXPECT_EQ(task.rows_waiting(), 0u);
  EXPECT_EQ(kept, std::vector<int>(kSheets, 1));
  EXPECT_EQ(task.counts().standing.draws, kSheets);
  for (std::size_t k = 0; k < kSheets; ++k) EXPECT_EQ(timeless(rows[k]), timeless(certified(k)));
}

TEST_F(Certificates, AndFindingsArriveAsTheyWereSent) {
  CertifyOrder order = order_of(3);
  order.stored = certified(3);
  const std::vector<CertifyOrder> orders = unpack_orders(pack(std::vector{order_of(1), order}));
  ASSERT_EQ(orders.size(), 2u);
  EXPECT_FALSE(orders[0].stored);
  EXPECT_EQ(orders[1].stored, order.stored);
  EXPECT_EQ(orders[1].shifts_mm, order.shifts_mm);
  EXPECT_EQ(orders[1].asked_deg, kAsked_deg);

  SentResults sent;
  sent.seconds = 0.25;
  sent.results.push_back({certified(4), {}});
  sent.results.push_back({{}, schema::CertificateFinding{7, {{1.5, 2}}, "a reason"}});
  sent.results.push_back({{}, schema::CertificateFinding{8, {}, ""}});
  sent.results.push_back({});
  const SentResults came = unpack_results(pack(sent));
  ASSERT_EQ(came.results.size(), 4u);
  EXPECT_EQ(came.seconds, 0.25);
  EXPECT_EQ(came.results[0].made, sent.results[0].made);
  EXPECT_EQ(came.results[1].finding->sentence(), "draw 7, 1.5 to 2 deg: a reason");
  EXPECT_FALSE(came.results[2].finding->interval);
  EXPECT_FALSE(came.results[3].made || came.results[3].finding);
  // Bytes that end too early are no rows.
  Bytes cut = pack(sent);
  cut.resize(cut.size() / 2);
  EXPECT_LT(unpack_results(cut).results.size(), 5u);
}

TEST_F(Certificates, AreCheckedAndSpoiltOnesFound) {
  const CertifyOrder order = order_of(5);
  const schema::CertificateRecord good = certified(5);
  EXPECT_FALSE(certifier_.check(order.shifts_mm, good));
  schema::CertificateRecord spoilt = good;
  spoilt.proof[60] ^= 1;
  ASSERT_TRUE(certifier_.check(order.shifts_mm, spoilt));
  EXPECT_FALSE(certifier_.check(order.shifts_mm, spoilt)->interval);
  // A false claim under a hash of its own.
  schema::CertificateRecord other = certified(6);
  other.draw = good.draw;
  other.hash = schema::certificate_hash(campaign_.pattern, order.shifts_mm, other);
  ASSERT_FALSE(certifier_.row_fault(order.shifts_mm, other));
  const auto finding = certifier_.check(order.shifts_mm, other);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->draw, good.draw);
  EXPECT_TRUE(finding->interval);
}

// Newton's method does not come to it from the base's first states.
TEST(FarFromTheBase, CertificatesBeginWithThePathsOwnStates) {
  const schema::Campaign campaign =
      schema::read_campaign_file(MISALIGN_SOURCE_DIR "/search/campaigns/turned-quads-6x6.json");
  const solver::Model model = model_of(campaign);
  RowCertifier certifier(campaign.pattern, model);
  for (const std::uint64_t draw : {102617u, 208194u}) {
    const auto row = certifier.certify(draw, shifts_of_draw(campaign, draw), 60);
    EXPECT_EQ(row.certified_deg, 60) << draw;
    EXPECT_FALSE(certifier.row_fault(shifts_of_draw(campaign, draw), row));
  }
}

// There a diagonal turns back less than 1e-5 degrees before its fold limit, and no closing interval
// has room: what is shorter proves nothing, and what is longer cannot be proven.
TEST(NextToAFoldLimit, CertificatesEnd) {
  const std::pair<const char*, std::uint64_t> kSheets[] = {{"miura-4x4", 308},
                                                           {"miura-6x6", 992187}};
  for (const auto& [name, draw] : kSheets) {
    const schema::Campaign campaign = schema::read_campaign_file(
        MISALIGN_SOURCE_DIR "/search/campaigns/" + std::string(name) + ".json");
    const solver::Model model = model_of(campaign);
    const Eigen::Matrix2Xd shifts_mm = shifts_of_draw(campaign, draw);
    RowCertifier certifier(campaign.pattern, model);
    const schema::CertificateRecord row = certifier.certify(draw, shifts_mm, 180);
    EXPECT_EQ(row.end, "unclear_slope") << name;
    // What the path's own turning point says, whose angle is found by arc length.
    const double limit_deg =
        solver::record_path(model, campaign.pattern.base.sheet.vertices_mm + shifts_mm)
            .path.fold_limit_deg;
    EXPECT_LT(row.certified_deg, limit_deg) << name;
    EXPECT_GT(row.certified_deg, limit_deg - 1e-4) << name;
    if (draw == 308) {
      EXPECT_FALSE(certifier.check(shifts_mm, row));
    }
  }
}

TEST(CertificateRows, AnswerWhatAnotherOneWouldNotAnswerBetter) {
  schema::CertificateRecord row;
  row.asked_deg = 170;
  row.end = "reversal";
  EXPECT_TRUE(answers(row, 170, {.contact = false}));
  EXPECT_TRUE(answers(row, 160, {.contact = false}));
  EXPECT_FALSE(answers(row, 171, {.contact = false}));
  EXPECT_FALSE(answers(row, 170, {.contact = true}));
  row.contact = true;
  EXPECT_TRUE(answers(row, 170, {.contact = true}));
  EXPECT_TRUE(answers(row, 170, {.contact = false}));
  row.end = "contact";  // without panels it may go farther
  EXPECT_TRUE(answers(row, 170, {.contact = true}));
  EXPECT_FALSE(answers(row, 170, {.contact = false}));
}

// A design is outside a campaign's identity: its filling may be another than that of the proof.
TEST(CertificateRows, ByTheEnergyOfADesignAnswerNothing) {
  schema::CertificateRecord row;
  row.asked_deg = 170;
  row.end = "reversal";
  solver::Certificate by_energy;
  by_energy.criterion = solver::CertifiedBy::energy;
  const schema::Campaign diagonals = campaign_to_certify();
  row.proof = solver::encode(solver::build_mechanism(diagonals.pattern.base), by_energy);
  schema::Campaign energy = campaign_to_certify();
  energy.energy = schema::EnergyAcceptance{solver::Fill{solver::Springs{}}};
  EXPECT_FALSE(answers(row, 170, claims_of(diagonals)));
  EXPECT_FALSE(answers(row, 170, claims_of(diagonals, solver::CertifiedBy::energy)));
  EXPECT_TRUE(answers(row, 170, claims_of(energy)));
}

// Whether the second opinion asks for an interval in which what ends a certificate happens.
bool needs_closing(solver::CertificateEnd end) {
  const schema::Campaign campaign = campaign_to_certify();
  const solver::Model model = model_of(campaign);
  solver::Certificate nothing;
  nothing.asked_deg = end == solver::CertificateEnd::to_the_end ? 0 : 90;
  nothing.end = end;
  const auto fault =
      solver::check_certificate(model, campaign.pattern.base.sheet.vertices_mm, nothing);
  return fault && fault->what.find("needs a closing piece") != std::string::npos;
}

TEST(CertificateText, NeverSaysMoreThanIsCertified) {
  schema::CertificateRecord row;
  row.draw = 7;
  row.certified_deg = 156.15499;
  row.asked_deg = 180;
  row.end = "reversal";
  row.place = "A10-A18";
  row.intervals = 28;
  row.proof = std::string(2000, 'x');
  const schema::NamedCertificate sheet = schema::named_certificate("draw 7", row, true);
  EXPECT_EQ(sheet.bytes, 2000u);
  const std::string text = certified_text(sheet);
  EXPECT_NE(text.find("to 156.1549 deg of 180 requested;"), std::string::npos) << text;
  EXPECT_NE(text.find("A10-A18 reverses"), std::string::npos) << text;
  row.intervals = 0;
  row.certified_deg = 0;
  row.end = "flat_branch";
  EXPECT_NE(
      certified_text(schema::named_certificate("draw 7", row, true)).find("nothing is certified"),
      std::string::npos);
  for (int tenths = 1; tenths < 1800; ++tenths) {
    row.certified_deg = row.asked_deg = tenths * 0.1;
    row.end = "to_the_end";
    row.intervals = 1;
    const std::string whole = certified_text(schema::named_certificate("draw 7", row, true));
    EXPECT_LT(whole.find(" deg, as requested"),
              std::string("draw 7: certified from flat to 123.4x").size())
        << whole;
  }
  const schema::Json json = schema::certified_json(sheet);
  EXPECT_FALSE(json.contains("proof"));
  EXPECT_EQ(json["certified_deg"], 156.15499);
  EXPECT_EQ(json["bytes"], 2000);
}

TEST(CertificateText, OfManyIsASummary) {
  std::vector<schema::NamedCertificate> sheets;
  for (int k = 0; k < 30; ++k) {
    schema::CertificateRecord row;
    row.end = k < 10 ? "reversal" : "to_the_end";
    row.certified_deg = k < 10 ? 150 + k : 170;
    row.intervals = 20;
    sheets.push_back(schema::named_certificate("draw " + std::to_string(k), row, k > 4));
  }
  const std::string text = certified_text(sheets);
  for (const char* part : {"reversal", "to_the_end", "all", "; 5 existed already"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
  EXPECT_EQ(text.find("draw"), std::string::npos);
  sheets.resize(2);
  EXPECT_NE(certified_text(sheets).find("draw 1: "), std::string::npos);
}

TEST(CertificateText, OfACheckSaysWhatHasNone) {
  schema::CertificateCheck check{2, 2, 1, {}, {{"to_the_end", 2}}};
  EXPECT_EQ(check_text(check),
            "2 certificates checked: all hold, up to their certified angles; 1 sheet without a "
            "certificate\nproven ends: 2 (to_the_end 2)\n");
  EXPECT_EQ(schema::check_json(check)["good"], true);
  check = {1, 3, 0, {{9, {}, "why"}}};
  const std::string text = check_text(check);
  EXPECT_NE(text.find("draw 9: why\n"), std::string::npos) << text;
  EXPECT_NE(text.find("of 3 (stopped)"), std::string::npos) << text;
  EXPECT_EQ(schema::check_json(check)["good"], false);
}

// An end is proven by a closing interval, or by having come to the angle that was asked for.
TEST(CertificateText, OfACheckSaysWhichEndsAreProven) {
  schema::CertificateCheck check{8, 8, 0, {}};
  for (int k = 0; k < solver::kCertificateEnds; ++k) {
    const auto end = static_cast<solver::CertificateEnd>(k);
    check.ends[solver::name_of(end)] = 1;
    const bool by_itself = end == solver::CertificateEnd::to_the_end;
    EXPECT_EQ(solver::is_proven(end), by_itself || needs_closing(end)) << solver::name_of(end);
  }
  EXPECT_EQ(check_text(check),
            "8 certificates checked: all hold, up to their certified angles\n"
            "proven ends: 4 (over_folded 1, reversal 1, sign_changed 1, to_the_end 1)\n"
            "unproven ends: 4 (contact 1, flat_branch 1, fold_limit 1, unclear_slope 1); the proof "
            "merely stops there\n");
  EXPECT_EQ(schema::check_json(check)["ends"]["proven"].size(), 4u);
  EXPECT_EQ(schema::check_json(check)["ends"]["unproven"]["fold_limit"], 1);
}

// As the search goes: accepted ones alone, up to their D, with what `certify` would make.
TEST(CertifiedDraws, AreTheCandidatesAndAsOtherwise) {
  const schema::Campaign campaign = campaign_to_certify(true);
  const solver::Model model = model_of(campaign);
  RowCertifier certifier(campaign.pattern, model);
  const solver::InstructionSet widest = solver::available_instruction_sets().back();
  DrawEvaluator certifying(campaign, widest, kWholeProgram),
      plain(campaign_to_certify(), widest, kWholeProgram);
  const schema::UnitRecord unit = work_off(certifying, {0, 40}), other = work_off(plain, {0, 40});
  ASSERT_GT(unit.candidates.size(), 2u);
  ASSERT_EQ(unit.candidates.size(), other.candidates.size());
  EXPECT_EQ(unit.screened, other.screened);
  EXPECT_GT(certifying.bytes_of_candidate(), plain.bytes_of_candidate());
  for (std::size_t k = 0; k < unit.candidates.size(); ++k) {
    const schema::Candidate& candidate = unit.candidates[k];
    EXPECT_FALSE(other.candidates[k].certificate);
    ASSERT_TRUE(candidate.certificate);
    const schema::CertificateRecord again =
        certifier.certify(candidate.draw, shifts_of_draw(campaign, candidate.draw),
                          candidate.metrics.deploys_from_sample * campaign.sample_deg);
    EXPECT_EQ(timeless(*candidate.certificate), timeless(again));
  }
}

}  // namespace
}  // namespace misalign::search
