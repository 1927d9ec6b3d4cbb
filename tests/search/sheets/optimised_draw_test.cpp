// Draws of an optimising search: where they end, against the optimisation of single sheets.
#include "search/sheets/optimised_draw.hpp"

#include <gtest/gtest.h>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/golden_verdicts.hpp"
#include "search/draws/models.hpp"
#include "search/ranks/piece_messages.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/whole_program.hpp"
#include "search/splitting/climber.hpp"
#include "solver/optimise/objective.hpp"

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
  static solver::InstructionSet widest() { return solver::available_instruction_sets().back(); }
  static schema::UnitRecord ends(const schema::Campaign& campaign, const schema::DrawRange& range) {
    DrawEvaluator evaluator(campaign, widest(), kWholeProgram);
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
      if (!found) {
        ++outside;
        EXPECT_EQ(end.ascent->ended, "breaks_a_limit");
        EXPECT_FALSE(end.ascent->start_value);
        EXPECT_EQ(end.shifts_mm, start.shifts_mm());
        EXPECT_GT(starts.candidates[k].metrics.stroke_max, 0.05);
        continue;
      }
      EXPECT_EQ(end.shifts_mm, found->best().shifts_mm) << end.draw;
      EXPECT_EQ(end.ascent->end_value, found->best().value);
      EXPECT_EQ(end.ascent->start_value, found->start().value);
      EXPECT_EQ(end.ascent->steps, found->steps());
      EXPECT_EQ(end.ascent->sheets_folded, found->evaluations);
      EXPECT_EQ(end.ascent->limited_by.has_value(), found->limits.has_value());
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
  DrawEvaluator evaluator(asked, widest(), kWholeProgram);
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
  DrawEvaluator evaluator(asked, widest(), kWholeProgram);
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
  const std::string own = fingerprint(asked, "verdicts", kWholeProgram);
  EXPECT_EQ(own.size(), std::string("verdicts-").size() + 32);
  EXPECT_EQ(own.rfind("verdicts-", 0), 0u);
  EXPECT_EQ(fingerprint(campaign({{"maximise", "miscut_margin_mm"}}), "verdicts", kWholeProgram),
            own);
  EXPECT_EQ(fingerprint(plain(asked), "verdicts", kWholeProgram), "verdicts");
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

// ---- Starts that populations find ----

class SheetsOfPopulations : public OptimisedDraws {
 protected:
  const schema::Campaign asked_ = campaign({{"starts", "splitting"},
                                            {"levels_deg", {120, 150}},
                                            {"particles", 20u},
                                            {"sweeps", 2u},
                                            {"first_draws", 60u},
                                            {"starts_of_population", 5u},
                                            {"shifts", "ternary"},
                                            {"subject_to", {"stroke_max <= 0.05"}}});
  const Ladder ladder_ = named_ladder(asked_);
  Climber climber_{asked_, widest(), kWholeProgram};

  // In orders of so many particles; the first ascents are cut after so many blocks.
  PopulationRecord in_pieces(std::uint32_t most, int blocks) {
    Population population(ladder_, 3);
    cut_ = 0;
    while (!population.is_done()) {
      PieceOrder order = *population.take(most);
      const std::uint32_t end = order.hi;
      EXPECT_EQ(population.is_at_ends(), !order.starts.empty());
      PieceWork work = climber_.start(unpack_order(pack(order)));
      for (int k = 0; k < blocks && !work.finished(); ++k) work.run_next_block();
      const bool is_cut = population.is_at_ends() && !work.finished() && ++cut_ <= 3;
      while (!is_cut && !work.finished()) work.run_next_block();
      population.add(end, unpack_piece(pack(SentPiece{work.take(), false})).result);
    }
    return population.record();
  }
  int cut_ = 0;  // of the last record
};

// The first ones that the splitting campaign meets, each where optimise() ends; and nothing else
// changes.
TEST_F(SheetsOfPopulations, EndWhereSingleSheetsDo) {
  EXPECT_EQ(ladder_.starts, 5u);
  schema::Campaign splitting = asked_;
  splitting.search.optimisation.reset();
  Climber plain(splitting, widest());
  const PopulationRecord found = climbed(named_ladder(splitting), 3, plain),
                         kept = climbed(ladder_, 3, climber_);
  ASSERT_GT(found.found.size(), 5u);
  ASSERT_EQ(kept.found.size(), 5u);
  ASSERT_EQ(kept.levels.size(), found.levels.size());
  for (std::size_t k = 0; k < kept.levels.size(); ++k) {
    EXPECT_EQ(kept.levels[k].survivors, found.levels[k].survivors);
    EXPECT_EQ(kept.levels[k].met, found.levels[k].met);
  }
  const solver::Model model = model_of(asked_);
  solver::SheetSolver solver(model);
  int better = 0;
  for (std::size_t k = 0; k < kept.found.size(); ++k) {
    EXPECT_EQ(kept.found[k].origin, found.found[k].origin);
    const schema::Candidate& end = kept.found[k].candidate;
    const solver::Sheet start(solver, found.found[k].candidate.shifts_mm);
    const auto alone = solver::optimise(start, asked_of_ends(asked_));
    ASSERT_TRUE(end.ascent);
    EXPECT_EQ(bool(alone), end.ascent->ended != "breaks_a_limit");
    EXPECT_EQ(end.shifts_mm, alone ? alone->best().shifts_mm : start.shifts_mm());
    better += end.ascent->steps > 0;
    if (!alone) continue;
    EXPECT_EQ(end.ascent->start_value, alone->start().value);
    EXPECT_EQ(end.ascent->end_value, alone->best().value);
  }
  EXPECT_GT(better, 0);
}

// However it is cut, and whichever rank does what.
TEST_F(SheetsOfPopulations, ArePiecesThatDoNotMatter) {
  const PopulationRecord whole = climbed(ladder_, 3, climber_);
  for (const auto& [most, blocks] : {std::pair{1000u, 1000000}, {7u, 0}, {3u, 1}}) {
    const PopulationRecord record = in_pieces(most, blocks);
    EXPECT_TRUE(blocks > 0 || cut_ > 3) << "none was begun again";
    ASSERT_EQ(record.found.size(), whole.found.size());
    for (std::size_t k = 0; k < whole.found.size(); ++k) {
      EXPECT_EQ(record.found[k].origin, whole.found[k].origin);
      EXPECT_EQ(record.found[k].candidate.shifts_mm, whole.found[k].candidate.shifts_mm);
      EXPECT_EQ(record.found[k].candidate.ascent, whole.found[k].candidate.ascent);
    }
  }
}

// What a file keeps of them is taken as it was, and made again where it lies.
TEST_F(SheetsOfPopulations, PiecesThatLieAreMadeAgain) {
  Population population(ladder_, 3);
  while (!population.is_at_ends()) {
    PieceOrder order = *population.take(kBeyondAll);
    const std::uint32_t end = order.hi;
    PieceWork work = climber_.start(std::move(order));
    while (!work.finished()) work.run_next_block();
    PieceResult result = work.take(), other = result;
    if (result.level == 0) {
      ASSERT_FALSE(result.met.empty());
      other.met[0].candidate.ascent.emplace().ended = "most_steps";
      EXPECT_FALSE(Population(ladder_, 3).restore(other)) << "an end among draws";
      EXPECT_TRUE(Population(ladder_, 3).restore(result));
    }
    population.add(end, std::move(result));
  }
  PieceWork work = climber_.start(*population.take(1));
  while (!work.finished()) work.run_next_block();
  const PieceResult good = work.take();
  PieceResult nothing;
  nothing.level = good.level;
  Population again = population;
  again.add(1, nothing);  // then it is open again
  const auto is_taken = [&](const PieceResult& result) {
    const Bytes bytes = pack(SentPiece{result, false});
    auto kept = unpack_kept({bytes.begin(), bytes.end()}, asked_, climber_.moves().code(),
                            climber_.mechanism());
    return kept && Population(again).restore(std::move(*kept));
  };
  EXPECT_TRUE(is_taken(good));
  using Lie = void (*)(PieceResult&);
  const std::pair<const char*, Lie> kLies[] = {
      {"no end", [](PieceResult& piece) { piece.met.clear(); }},
      {"no ascent", [](PieceResult& piece) { piece.met[0].candidate.ascent.reset(); }},
      {"another's", [](PieceResult& piece) { piece.lo = 1, piece.hi = 2; }},
      {"none that there is",
       [](PieceResult& piece) { piece.lo = 8, piece.hi = 9, piece.met[0].particle = 8; }},
      {"a survivor", [](PieceResult& piece) { piece.survivors = {0}; }},
      {"a shift", [](PieceResult& piece) { piece.met[0].candidate.shifts_mm(0, 6) = 0.1; }},
      {"an end that is none",
       [](PieceResult& piece) { piece.met[0].candidate.ascent->ended = "tired"; }},
      {"steps", [](PieceResult& piece) { piece.met[0].candidate.ascent->steps = -1; }},
      {"a value",
       [](PieceResult& piece) {
         piece.met[0].candidate.ascent->end_value = std::numeric_limits<double>::quiet_NaN();
       }},
      {"what limits it",
       [](PieceResult& piece) { piece.met[0].candidate.ascent->limited_by = "{"; }}};
  for (const auto& [what, lie] : kLies) {
    PieceResult result = good;
    lie(result);
    EXPECT_FALSE(is_taken(result)) << what;
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
