// The catalogue: whatever the order of work, nothing is lost or counted twice.
#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/ledger_check.hpp"
#include "schema/catalogue/named_queries.hpp"
#include "schema/records/fault_sample.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

TEST_F(CatalogueTest, OrderAndSizeOfUnitsDoNotMatter) {
  const Goal goal{{0, kEndOfDraws}, 8000, {}};
  const std::vector<std::vector<DrawRange>> kOrders = {
      {{0, 1000}, {1000, 2000}, {2000, 3000}, {3500, 5000}, {5000, 8000}},
      {{7000, 8000}, {3500, 3501}, {1500, 3000}, {3501, 7000}, {0, 1500}},
  };
  for (std::size_t k = 0; k < kOrders.size(); ++k) {
    Catalogue catalogue = open(std::to_string(k));
    catalogue.begin_run(kRun, goal);
    for (const DrawRange& range : kOrders[k]) catalogue.commit({unit(range.lo, range.hi)});
    std::vector<DrawRange> ascending = kOrders[k];
    std::sort(ascending.begin(), ascending.end(),
              [](const DrawRange& a, const DrawRange& b) { return a.lo < b.lo; });
    EXPECT_EQ(catalogue.done(), ascending);
    catalogue.end_run("stopped");
  }
  const auto accepted = [](std::uint64_t lo, std::uint64_t hi) {
    std::uint64_t n = 0;
    for (std::uint64_t draw = lo; draw < hi; ++draw) n += is_accepted(draw);
    return n;
  };
  for (const char* name : {"0", "1"}) {
    const CatalogueState s = state(name);
    EXPECT_EQ(s.draws, 7500u);
    EXPECT_EQ(s.draws_in_ledger, 7500u);
    EXPECT_EQ(s.accepted, accepted(0, 3000) + accepted(3500, 8000));
    EXPECT_EQ(s.accepted + s.rejected + s.undecided, s.draws);
    EXPECT_GT(s.undecided, 0u);
    EXPECT_EQ(s.gaps, (std::vector<DrawRange>{{3000, 3500}}));
    EXPECT_EQ(s.digest, expected({{0, 3000}, {3500, 8000}}));
    EXPECT_EQ(s.faults.at("not_monotone").rows, 7u);  // 0, 1024, ..., 7168 without 3072
    EXPECT_EQ(s.goal_end, 8000u);
    EXPECT_EQ(count("screened", name), 1);
    EXPECT_EQ(count_deploying_from(*open_for_reading(path(name)), 0),
              static_cast<std::uint64_t>(s.accepted));
  }
}

TEST_F(CatalogueTest, WhatLiesPastTheGoalIsNotCounted) {
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 10000, {}});
    catalogue.commit({unit(0, 6000)});
    catalogue.commit({unit(6000, 10000)});
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 7500, {}});  // cuts the second unit in two
  }
  const CatalogueState s = state();
  EXPECT_EQ(s.draws, 7500u);
  EXPECT_EQ(s.draws_in_ledger, 10000u);
  EXPECT_TRUE(s.gaps.empty());
  EXPECT_EQ(s.digest, expected({{0, 7500}}));
}

TEST_F(CatalogueTest, GapsOfARange) {
  Catalogue catalogue = open();
  catalogue.begin_run(kRun, {{1000, 5000}, {}, {}});
  EXPECT_EQ(state().gaps, (std::vector<DrawRange>{{1000, 5000}}));
  catalogue.commit({unit(500, 1500)});   // reaches in from below
  catalogue.commit({unit(4500, 5500)});  // and out at the end
  catalogue.commit({unit(6000, 7000)});
  EXPECT_EQ(state().gaps, (std::vector<DrawRange>{{1500, 4500}}));
  catalogue.commit({unit(2000, 3000)});
  EXPECT_EQ(state().gaps, (std::vector<DrawRange>{{1500, 2000}, {3000, 4500}}));
  EXPECT_EQ(query_table(*open_for_reading(path()), "SELECT * FROM gaps", TableStyle::csv),
            "lo,hi\n1500,2000\n3000,4500\n");
}

// What was rejected of the sample is told by what makes a candidate, not by looking for one.
TEST_F(CatalogueTest, RejectedAreTheSampledDrawsOfNoCandidate) {
  Catalogue catalogue = open();
  catalogue.begin_run(kRun, {});
  catalogue.commit({unit(40000, 60000)});
  const std::string sampled = "fault_sample WHERE draw NOT IN (SELECT draw FROM candidate)";
  EXPECT_EQ(count("fault_sample JOIN candidate USING (draw)"), 1);
  ASSERT_EQ(state().faults.size(), 1u);
  EXPECT_EQ(state().faults.at("not_monotone").rows, 18u);
  EXPECT_EQ(state().faults.at("not_monotone").draws, 18 * 1024);
  EXPECT_EQ(count(sampled), 18);
  const Json rows = Json::parse(
      query_table(*open_for_reading(path()), named_query("rejections"), TableStyle::json));
  EXPECT_EQ(rows, (Json{{{"first_fault", "not_monotone"},
                         {"from_deg", 0},
                         {"sampled", 18},
                         {"draws", 18 * 1024},
                         {"share", 1.0}}}));
}

TEST_F(CatalogueTest, SpeedIsThatOfTheLastRun) {
  Catalogue catalogue = open();
  EXPECT_EQ(state().draws_per_s, 0);
  for (const std::uint64_t lo : {0, 10000}) {
    catalogue.begin_run(kRun, {});
    catalogue.commit({unit(lo, lo + 1000), unit(lo + 1000, lo + 1000 + lo / 10 + 500)});
  }
  // 2,500 draws in twice half a second, on two ranks.
  EXPECT_EQ(state().draws_per_s, 5000);
  catalogue.begin_run(kRun, {});  // nothing committed yet
  EXPECT_EQ(state().draws_per_s, 5000);
}

// The largest where ranks differ, and at once: a run may be killed.
TEST_F(CatalogueTest, ARunKeepsTheLevelOfItsTables) {
  Catalogue catalogue = open();
  const auto kept = [&] {
    return open_for_reading(catalogue.path())
        ->execAndGet("SELECT group_concat(ifnull(tables_deg, 'none')) FROM run")
        .getString();
  };
  catalogue.begin_run(kRun, {});
  std::uint64_t lo = 0;
  for (const auto& [tables_deg, expected] : std::vector<std::pair<double, std::string>>{
           {0, "none"}, {115, "115.0"}, {130.5, "130.5"}, {115, "130.5"}}) {
    UnitRecord done = unit(lo, lo + 1000);
    done.tables_deg = tables_deg;
    catalogue.commit({done});
    EXPECT_EQ(kept(), expected);
    lo += 1000;
  }
  catalogue.begin_run(kRun, {});
  EXPECT_EQ(kept(), "130.5,none");
}

TEST_F(CatalogueTest, OverlapsAreRefusedWhole) {
  Catalogue catalogue = open();
  catalogue.begin_run(kRun, {{0, kEndOfDraws}, 8000, {}});
  catalogue.commit({unit(1000, 2000)});
  catalogue.commit({unit(4000, 5000)});
  const CatalogueState before = state();
  constexpr DrawRange kOverlaps[] = {{1000, 2000}, {0, 1001},   {1999, 3000}, {1200, 1300},
                                     {0, 8000},    {500, 2500}, {3000, 4001}};
  for (const DrawRange& range : kOverlaps) {
    EXPECT_THROW(catalogue.commit({unit(range.lo, range.hi)}), UserError) << range.lo;
  }
  EXPECT_EQ(state().digest, before.digest);
  EXPECT_EQ(state().draws_in_ledger, 2000u);
  EXPECT_EQ(count("candidate WHERE draw < 1000 OR draw BETWEEN 2000 AND 3999"), 0);
  // Neighbours that only touch are no overlap.
  EXPECT_NO_THROW(catalogue.commit({unit(2000, 4000)}));
  EXPECT_NO_THROW(catalogue.commit({unit(0, 1000)}));
}

TEST_F(CatalogueTest, AUnitAndWhatBelongsToItAreOneTransaction) {
  Catalogue catalogue = open();
  catalogue.begin_run(kRun, {{0, kEndOfDraws}, 8000, {}});
  catalogue.commit({unit(0, 2048)});
  const char* const kTables[] = {"unit", "candidate", "undecided", "fault_sample"};
  std::vector<std::int64_t> before;
  for (const char* table : kTables) before.push_back(count(table));
  const auto screened = [&] {
    return open_for_reading(path())->execAndGet("SELECT sum(draws) FROM screened").getInt64();
  };
  const std::int64_t screened_before = screened();

  std::vector<UnitRecord> bad(4, unit(2048, 4096));
  bad[0].candidates.back() = bad[0].candidates.front();             // a draw twice, after good ones
  bad[1].rejected += 1;                                             // counts do not add up
  bad[2].fault_sample.back().draw += 1;                             // not a multiple of 1024
  bad[3].screened[{static_cast<int>(solver::Fault::none), 1}] = 0;  // the last thing written
  for (std::size_t k = 0; k < bad.size(); ++k) {
    EXPECT_THROW(catalogue.commit({bad[k]}), UserError) << k;
    for (std::size_t t = 0; t < before.size(); ++t) EXPECT_EQ(count(kTables[t]), before[t]) << k;
    EXPECT_EQ(screened(), screened_before);
  }
  catalogue.commit({unit(2048, 4096)});  // and the good one still goes in
  EXPECT_EQ(state().digest, expected({{0, 4096}}));
}

TEST_F(CatalogueTest, AcceptedGoalWaitsForThePrefix) {
  const auto accepted = [](std::uint64_t draw) {
    return draw == 10 || draw == 5000 || draw == 5001 || draw == 9000 || draw == 9500;
  };
  const Goal goal{{0, kEndOfDraws}, 40000, 3};
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, goal);
    EXPECT_EQ(catalogue.goal_end(), 40000u);
    catalogue.commit({unit(0, 4096, accepted)});
    catalogue.commit({unit(8192, 16384, accepted)});
    // Three are known, but the draws before the third are not all done.
    EXPECT_EQ(catalogue.goal_end(), 40000u);
    catalogue.commit({unit(4096, 8191, accepted)});
    EXPECT_EQ(catalogue.goal_end(), 40000u);  // draw 8191 is still missing
    EXPECT_EQ(state().goal_end, 40000u);
    catalogue.commit({unit(8191, 8192, accepted)});
    EXPECT_EQ(catalogue.goal_end(), 8192u);  // 10, 5000, 5001: the second granule of 4096
  }
  CatalogueState s = state();
  EXPECT_EQ(s.goal_end, 8192u);
  EXPECT_EQ(s.accepted, 3u);
  EXPECT_EQ(s.draws, 8192u);
  EXPECT_EQ(s.draws_in_ledger, 16384u);
  EXPECT_TRUE(s.gaps.empty());
  Catalogue again = open();
  struct Case {
    Goal goal;
    std::uint64_t end;
  };
  const Case kCases[] = {
      {goal, 8192},
      {{{0, kEndOfDraws}, 40000, 0}, 0},
      {{{0, kEndOfDraws}, 40000, 1}, 4096},
      {{{0, kEndOfDraws}, 40000, 4}, 12288},
      {{{0, kEndOfDraws}, 40000, 5}, 12288},
      {{{0, kEndOfDraws}, 40000, 6}, 40000},
      {{{0, kEndOfDraws}, 12000, 4}, 12000},  // the wanted draws end first
      {{{11, kEndOfDraws}, 40000, 2}, 8203},  // granules count from the range's start
      {{{0, 5002}, {}, 3}, 5002},
  };
  for (const Case& c : kCases) {
    again.begin_run(kRun, c.goal);
    EXPECT_EQ(again.goal_end(), c.end);
    EXPECT_EQ(state().goal_end, c.end);
  }
}

TEST_F(CatalogueTest, DisplacementsAndDiagonalsViews) {
  constexpr unsigned kSeed = 7;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> shift_mm(-0.4, 0.4);
  UnitRecord record;
  record.range = {0, 8};
  record.rejected = 6;
  record.accepted = 2;
  for (const std::uint64_t draw : {2, 5}) record.candidates.push_back(candidate(draw));
  for (Eigen::Index v = 0; v < record.candidates[1].shifts_mm.cols(); v += 2) {
    record.candidates[1].shifts_mm.col(v) << shift_mm(random), shift_mm(random);
  }
  record.candidates[1].shifts_mm.col(0) << 0, -0.1;  // one zero coordinate is still a shift
  for (std::size_t d = 0; d < mechanism_.diagonals.size(); ++d) {
    record.candidates[1].metrics.elongation[d] =
        (d % 2 ? 1 : -1) * 0.001 * static_cast<double>(d + 1);
  }
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 8, {}});
    catalogue.commit({record});
  }
  const auto database = open_for_reading(path());
  std::map<std::pair<std::uint64_t, std::string>, std::pair<double, double>> expected, found;
  for (const Candidate& c : record.candidates) {
    for (Eigen::Index v = 0; v < c.shifts_mm.cols(); ++v) {
      if (c.shifts_mm.col(v).isZero(0)) continue;
      expected[{c.draw, "A" + std::to_string(v + 1)}] = {c.shifts_mm(0, v), c.shifts_mm(1, v)};
    }
  }
  SQLite::Statement rows(*database, "SELECT draw, vertex, dx_mm, dy_mm FROM displacements");
  while (rows.executeStep()) {
    found[{static_cast<std::uint64_t>(rows.getColumn(0).getInt64()),
           rows.getColumn(1).getString()}] = {rows.getColumn(2).getDouble(),
                                              rows.getColumn(3).getDouble()};
  }
  ASSERT_EQ(found.size(), expected.size()) << "seed " << kSeed;
  for (const auto& [key, shift] : expected) {
    EXPECT_EQ(found.at(key), shift) << key.second << ", seed " << kSeed;
  }

  SQLite::Statement diagonals(
      *database,
      "SELECT diagonal, hole_row, hole_column, from_vertex, to_vertex, "
      "elongation, direction FROM diagonals WHERE draw = 5 ORDER BY diagonal");
  std::size_t d = 0;
  for (; diagonals.executeStep(); ++d) {
    const solver::Diagonal& diagonal = mechanism_.diagonals.at(d);
    const int hole = campaign_.pattern.base.holes.at(d / 2);  // two of each hole, holes in order
    EXPECT_EQ(diagonals.getColumn(0).getInt(), static_cast<int>(d));
    EXPECT_EQ(diagonals.getColumn(1).getInt(), hole / 6);
    EXPECT_EQ(diagonals.getColumn(2).getInt(), hole % 6);
    EXPECT_EQ(diagonals.getColumn(3).getString(), "A" + std::to_string(diagonal.from + 1));
    EXPECT_EQ(diagonals.getColumn(4).getString(), "A" + std::to_string(diagonal.to + 1));
    // Elongations are kept to nine decimals.
    EXPECT_NEAR(diagonals.getColumn(5).getDouble(), record.candidates[1].metrics.elongation[d],
                1e-9);
    EXPECT_EQ(diagonals.getColumn(6).getString(), d % 2 ? "increasing" : "decreasing");
  }
  EXPECT_EQ(d, mechanism_.diagonals.size());
  EXPECT_EQ(count("diagonals"), static_cast<std::int64_t>(2 * d));
}

TEST_F(CatalogueTest, CandidateColumnsHoldTheirMetrics) {
  UnitRecord record;
  record.range = {0, 2};
  record.accepted = 2;
  record.candidates = {candidate(0), candidate(1)};
  solver::Metrics& m = record.candidates[0].metrics;
  int next = 100;  // all different, so that no two columns can be exchanged
  schema::each_metric(m, [&](const auto&, auto& value) {
    value = static_cast<std::conditional_t<std::is_same_v<decltype(value), int&>, int, double>>(
        ++next + 0.5);
  });
  record.candidates[1].metrics.slope_min_mm_per_deg.reset();
  record.candidates[1].metrics.slope_between_min_mm_per_deg.reset();
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 2, {}});
    catalogue.commit({record});
  }
  const auto database = open_for_reading(path());
  const Json rows = Json::parse(
      query_table(*database, "SELECT * FROM candidate ORDER BY draw", TableStyle::json));
  const Json expected = metrics_json(m);
  for (const auto& [name, value] : expected.items()) EXPECT_EQ(rows[0].at(name), value) << name;
  const std::pair<const char*, double> kColumns[] = {
      {"deploys_from_deg", m.deploys_from_deg},
      {"fold_limit_deg", m.fold_limit_deg},
      {"elongation_min", m.elongation_min},
      {"elongation_max", m.elongation_max},
      {"stroke_min", m.stroke_min},
      {"stroke_max", m.stroke_max},
      {"slope_min_mm_per_deg", *m.slope_min_mm_per_deg},
      {"slope_between_min_mm_per_deg", *m.slope_between_min_mm_per_deg},
      {"bump_deg", *m.bump_deg},
      {"miscut_margin_mm", *m.miscut_margin_mm},
      {"increasing", m.increasing},
      {"decreasing", m.decreasing}};
  for (const auto& [name, value] : kColumns) EXPECT_EQ(rows[0].at(name), value) << name;
  for (const char* name : {"slope_min_mm_per_deg", "slope_between_min_mm_per_deg", "bump_deg"}) {
    EXPECT_TRUE(rows[1].at(name).is_null()) << name;
  }
}

TEST_F(CatalogueTest, FaultsSayWhereAndWhen) {
  UnitRecord record;
  record.range = {0, 5 * kFaultSampleEvery};
  using solver::Fault;
  const solver::Diagonal& diagonal = mechanism_.diagonals[3];
  const solver::Crease& crease = mechanism_.creases[4];
  struct Case {
    solver::Verdict verdict;
    Json fault_deg, where;
  };
  const auto joined = [](int a, int b) {
    return "A" + std::to_string(a + 1) + "-A" + std::to_string(b + 1);
  };
  const Case kCases[] = {
      {{112, Fault::not_monotone, 3}, 113.0, joined(diagonal.from, diagonal.to)},
      {{0, Fault::over_folded, 4}, 1.0, joined(crease.a, crease.b)},
      {{179, Fault::assignment_flipped, 4}, 180.0, joined(crease.a, crease.b)},
      {{156, Fault::fold_limit}, 157.0, nullptr},
      {{180, Fault::none}, nullptr, nullptr},
  };
  for (std::size_t k = 0; k < std::size(kCases); ++k) {
    record.fault_sample.push_back({k * kFaultSampleEvery, kCases[k].verdict});
  }
  record.rejected = record.range.size();
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {});
    catalogue.commit({record});
  }
  const Json rows = Json::parse(query_table(
      *open_for_reading(path()), "SELECT * FROM fault_sample ORDER BY draw", TableStyle::json));
  ASSERT_EQ(rows.size(), std::size(kCases));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k]["deploys_from_sample"], kCases[k].verdict.deploys_from_sample);
    EXPECT_EQ(rows[k]["first_fault"], solver::fault_name(kCases[k].verdict.first_fault));
    EXPECT_EQ(rows[k]["fault_deg"], kCases[k].fault_deg) << k;
    EXPECT_EQ(rows[k]["where"], kCases[k].where) << k;
  }
}

// What a run says of itself while it goes on, and what the next one begins with, agree.
TEST_F(CatalogueTest, StandingIsThatOfTheWholeLedger) {
  Standing seen;
  const auto same = [&](const Standing& standing) {
    EXPECT_EQ(standing.draws, seen.draws);
    EXPECT_EQ(standing.accepted, seen.accepted);
    ASSERT_EQ(standing.best.has_value(), seen.best.has_value());
    if (!seen.best) return;
    EXPECT_EQ(standing.best->deploys_from_deg, seen.best->deploys_from_deg);
    EXPECT_EQ(standing.best->draw, seen.best->draw);
  };
  Catalogue catalogue = open();
  catalogue.begin_run(kRun, {{0, kEndOfDraws}, 100000, {}});
  same(catalogue.standing());
  for (const std::uint64_t lo : {20000, 0, 10000}) {  // in any order
    seen.add(unit(lo, lo + 5000));
    catalogue.commit({unit(lo, lo + 5000)});
    same(catalogue.standing());
  }
  EXPECT_EQ(seen.draws, 15000u);
  std::uint64_t best = 0;
  while (!is_accepted(best) || sample_of(best) != 180) ++best;
  EXPECT_EQ(seen.best->draw, best);
  EXPECT_EQ(seen.best->deploys_from_deg, 180);
}

}  // namespace
}  // namespace misalign::schema
