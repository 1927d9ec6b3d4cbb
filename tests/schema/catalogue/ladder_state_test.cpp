// The counts at the levels of a splitting search, of populations invented here, and each sheet
// once, against numbers made by hand.
#include "schema/catalogue/ladder_state.hpp"

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/certificate_table.hpp"
#include "schema/catalogue/ledger_check.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

constexpr std::uint64_t kTenBillion = 10'000'000'000;

// A sheet that a population meets: its number within the population, and which sheet it is.
struct Met {
  std::uint64_t number;
  int sheet;
};

class LadderTest : public CatalogueTest {
 protected:
  // Three levels above the first draws.
  static Campaign climbed(std::optional<std::uint64_t> most = {}) {
    Campaign campaign = changed(
        R"({"search": {"method": "splitting", "levels_deg": [150, 160.5, 170], "particles": 40,
            "sweeps": 5, "first_draws": 200}})");
    campaign.stop.accepted = most;
    return campaign;
  }
  static inline const std::vector<int> kScores = {150 * 1024, 160 * 1024 + 512, 170 * 1024};

  UnitRecord population(std::uint64_t number, const std::vector<LevelCount>& levels,
                        const std::vector<Met>& met = {}) const {
    UnitRecord unit;
    unit.range = {number * kTenBillion, (number + 1) * kTenBillion};
    unit.seconds = 1;
    unit.levels = levels;
    for (const auto& [at, sheet] : met) {
      unit.candidates.push_back(candidate(unit.range.lo + at));
      unit.candidates.back().shifts_mm(1, 11) = 0.4 * sheet;
      unit.candidates.back().metrics.deploys_from_sample = 170 + sheet;  // the sheet's own
    }
    unit.accepted = met.size();
    unit.rejected = kTenBillion - unit.accepted;
    return unit;
  }

  // 0 comes to the top by 1/4, 1/4 and 1/2; 1 dies at level 1, which half of its draws reach; 3
  // comes to the top by 1/8, 1/8 and 1. Sheet 2 is met three times, 3 twice.
  std::vector<UnitRecord> populations() const {
    return {population(0,
                       {{0, 200, 50, 50, 200, 50, 1, 0, 0.5},
                        {1, 40, 10, 8, 200, 120, 2, 0, 1},
                        {2, 40, 20, 5, 200, 90, 3, 1, 1.5},
                        {3, 40, 0, 0, 200, 33, 0, 1, 2}},
                       {{7, 1}, {90, 2}}),
            population(
                1, {{0, 200, 100, 100, 200, 100, 0, 1, 0.25}, {1, 40, 0, 0, 200, 140, 0, 1, 0.75}},
                {{5, 2}, {6, 3}}),
            population(3,
                       {{0, 200, 25, 25, 200, 25, 0, 0, 1},
                        {1, 40, 5, 4, 200, 80, 0, 0, 1},
                        {2, 40, 40, 4, 200, 70, 4, 2, 1},
                        {3, 40, 0, 0, 200, 7, 0, 1, 1}},
                       {{1, 3}, {2, 4}, {3, 2}})};
  }

  Catalogue open_of(const Campaign& campaign, const std::string& name = "a.db") const {
    return {path(name), campaign, mechanism_};
  }
  void write(const Campaign& campaign, const std::vector<UnitRecord>& units, bool at_once,
             const std::string& name = "a.db", bool with_levels = true) const {
    std::filesystem::remove(path(name));
    Catalogue catalogue = open_of(campaign, name);
    Goal goal{{0, 4 * kTenBillion}, {}, {}};
    goal.of_populations = true;
    catalogue.begin_run(kRun, goal);
    if (with_levels) catalogue.keep_levels(kScores, 0xFFFFFFFF);
    if (at_once) catalogue.commit(units);
    for (const UnitRecord& unit : units) {
      if (!at_once) catalogue.commit({unit});
    }
    catalogue.end_run("stopped");
  }

  using Rows = std::vector<std::vector<double>>;
  Rows rows(const std::string& sql, const std::string& name = "a.db") const {
    const auto database = open_for_reading(path(name));
    SQLite::Statement row(*database, sql);
    Rows all;
    while (row.executeStep()) {
      all.emplace_back();
      for (int k = 0; k < row.getColumnCount(); ++k) {
        all.back().push_back(row.getColumn(k).getDouble());
      }
    }
    return all;
  }
};

TEST_F(LadderTest, CountsAndRatesAreThoseOfItsPopulations) {
  const Campaign campaign = climbed();
  write(campaign, populations(), true);
  const LadderState ladder = read_ladder(*open_for_reading(path()), kEndOfDraws);
  EXPECT_EQ(ladder.populations, 3u);
  struct Expected {
    double deg, rate;
    std::uint64_t reached, particles, survivors, ancestors, tried, taken, undecided, met;
    double seconds, largest_part;
  };
  const std::vector<Expected> kLevels = {
      {0, 1, 3, 600, 175, 175, 600, 175, 1, 1, 1.75, 1.0 / 3},
      {150, 7.0 / 24, 3, 120, 15, 12, 600, 340, 2, 1, 2.75, 4.0 / 7},
      {160.5, 5.0 / 192, 2, 80, 60, 9, 400, 160, 7, 3, 2.5, 4.0 / 5},
      {170, 1.0 / 64, 2, 80, 0, 0, 400, 40, 0, 2, 3, 2.0 / 3}};
  ASSERT_EQ(ladder.levels.size(), kLevels.size());
  for (std::size_t k = 0; k < kLevels.size(); ++k) {
    const LadderLevel& level = ladder.levels[k];
    const Expected& expected = kLevels[k];
    EXPECT_EQ(level.deploys_from_deg, expected.deg) << k;
    EXPECT_DOUBLE_EQ(level.rate.mean, expected.rate) << k;
    EXPECT_EQ(level.rate.populations, 3u);
    EXPECT_EQ(level.rate.reached, expected.reached) << k;
    EXPECT_DOUBLE_EQ(level.rate.largest_part, expected.largest_part) << k;
    EXPECT_FALSE(level.rate.interval);
    EXPECT_EQ(level.particles, expected.particles) << k;
    EXPECT_EQ(level.survivors, expected.survivors) << k;
    EXPECT_EQ(level.ancestors, expected.ancestors) << k;
    EXPECT_EQ(level.tried, expected.tried) << k;
    EXPECT_EQ(level.taken, expected.taken) << k;
    EXPECT_EQ(level.undecided, expected.undecided) << k;
    EXPECT_EQ(level.met, expected.met) << k;
    EXPECT_DOUBLE_EQ(level.seconds, expected.seconds) << k;
  }
  EXPECT_EQ(ladder.rate(), &ladder.levels.back().rate);
  // The view, for people, says the same.
  const Rows view = rows(
      "SELECT level, coalesce(deploys_from_deg, 0), rate, populations_here, particles, survivors, "
      "ancestors, tried, taken, undecided, met, worker_seconds FROM ladder ORDER BY level");
  ASSERT_EQ(view.size(), kLevels.size());
  for (std::size_t k = 0; k < view.size(); ++k) {
    const Expected& e = kLevels[k];
    const std::vector<double> expected = {static_cast<double>(k),
                                          e.deg,
                                          e.rate,
                                          static_cast<double>(e.reached),
                                          static_cast<double>(e.particles),
                                          static_cast<double>(e.survivors),
                                          static_cast<double>(e.ancestors),
                                          static_cast<double>(e.tried),
                                          static_cast<double>(e.taken),
                                          static_cast<double>(e.undecided),
                                          static_cast<double>(e.met),
                                          e.seconds};
    for (std::size_t column = 0; column < expected.size(); ++column) {
      EXPECT_DOUBLE_EQ(view[k][column], expected[column]) << k << ", column " << column;
    }
  }
}

TEST_F(LadderTest, PopulationsBeyondTheGoalDoNotCount) {
  const Campaign campaign = climbed();
  write(campaign, populations(), false);
  const auto database = open_for_reading(path());
  const LadderState two = read_ladder(*database, 3 * kTenBillion);
  EXPECT_EQ(two.populations, 2u);
  EXPECT_DOUBLE_EQ(two.levels[1].rate.mean, 3.0 / 8);
  EXPECT_DOUBLE_EQ(two.rate()->mean, 1.0 / 64);
  EXPECT_EQ(two.rate()->reached, 1u);
  EXPECT_EQ(two.levels[2].particles, 40u);
  const LadderState none = read_ladder(*database, 0);
  EXPECT_EQ(none.populations, 0u);
  ASSERT_EQ(none.levels.size(), 4u);
  EXPECT_EQ(none.rate()->mean, 0);
  EXPECT_EQ(none.rate()->reached, 0u);
}

TEST_F(LadderTest, BeforeThePilotIsDoneNothingIsKnown) {
  const Campaign campaign = climbed();
  write(campaign, {}, true, "a.db", false);
  const LadderState ladder = read_ladder(*open_for_reading(path()), kEndOfDraws);
  EXPECT_EQ(ladder.populations, 0u);
  EXPECT_TRUE(ladder.levels.empty());
  EXPECT_EQ(ladder.rate(), nullptr);
  EXPECT_TRUE(rows("SELECT * FROM ladder").empty());
}

// The digest's bytes by its definition; a sheet's hash is canonical, its highest byte first.
std::string hash_bytes(const Candidate& candidate) {
  std::string bytes = little_endian(xxh3(displacements_json(candidate.shifts_mm).dump()), 16);
  return {bytes.rbegin(), bytes.rend()};
}

TEST_F(LadderTest, ASheetKeepsItsLeastNumberWhateverTheOrder) {
  const Campaign campaign = climbed();
  std::vector<UnitRecord> units = populations();
  Wide sum = 0;
  for (const UnitRecord& unit : units) {
    for (const LevelCount& level : unit.levels) {
      sum +=
          xxh3("unit " + std::to_string(unit.range.lo) + " level " + std::to_string(level.level) +
               ": " + std::to_string(level.survivors) + " of " + std::to_string(level.particles));
    }
  }
  const Candidate* const kKept[] = {&units[0].candidates[0], &units[0].candidates[1],
                                    &units[1].candidates[1], &units[2].candidates[1]};
  Rows expected;
  for (const Candidate* candidate : kKept) {
    const int sample = candidate->metrics.deploys_from_sample;
    sum += xxh3(little_endian(candidate->draw, 8) +
                little_endian(static_cast<unsigned>(sample), 4) + hash_bytes(*candidate));
    expected.push_back({static_cast<double>(candidate->draw), static_cast<double>(sample)});
  }
  EXPECT_EQ(
      expected,
      (Rows{{7, 171}, {90, 172}, {1.0 * kTenBillion + 6, 173}, {3.0 * kTenBillion + 2, 174}}));
  const std::string digest =
      hex_of(xxh3(identity(campaign) + little_endian(0, 8) + little_endian(2 * kTenBillion, 8) +
                  little_endian(3 * kTenBillion, 8) + little_endian(4 * kTenBillion, 8) +
                  little_endian(4, 8) + little_endian(0, 8) + little_endian(sum, 16)));

  std::vector<std::size_t> order = {0, 1, 2};
  do {
    std::vector<UnitRecord> ordered;
    for (const std::size_t k : order) ordered.push_back(units[k]);
    const bool at_once = order[0] == 2;
    SCOPED_TRACE(std::to_string(order[0]) + std::to_string(order[1]) +
                 (at_once ? ", at once" : ""));
    write(campaign, ordered, at_once);
    EXPECT_EQ(rows("SELECT draw, deploys_from_sample FROM candidate ORDER BY draw"), expected);
    EXPECT_EQ(count("sheet"), 4);
    EXPECT_EQ(rows("SELECT accepted, rejected + accepted FROM unit ORDER BY lo"),
              (Rows{{2, 1.0 * kTenBillion}, {1, 1.0 * kTenBillion}, {1, 1.0 * kTenBillion}}));
    EXPECT_EQ(state().accepted, 4u);
    EXPECT_EQ(state().digest, digest);
    EXPECT_TRUE(check_ledger(*open_for_reading(path()), campaign).empty());
  } while (std::next_permutation(order.begin(), order.end()));
}

// And where catalogues are joined, whichever is first.
TEST_F(LadderTest, JoinedCataloguesKeepTheLeastNumber) {
  const Campaign campaign = climbed();
  const std::vector<UnitRecord> units = populations();
  write(campaign, units, true, "all.db");
  write(campaign, {units[2]}, true, "late.db");
  write(campaign, {units[1], units[0]}, true, "early.db");
  for (const bool late_first : {false, true}) {
    std::filesystem::remove(path("joined.db"));
    {
      Catalogue catalogue = open_of(campaign, "joined.db");
      for (const bool is_late : {late_first, !late_first}) {
        const auto other = open_for_reading(path(is_late ? "late.db" : "early.db"));
        catalogue.take_over(*other, units_done(*other));
      }
      Goal goal{{0, 4 * kTenBillion}, {}, {}};
      goal.of_populations = true;
      catalogue.begin_run(kRun, goal);
      catalogue.end_run("merged");
    }
    EXPECT_EQ(state("joined.db").digest, state("all.db").digest);
    const std::string sql = "SELECT draw FROM candidate ORDER BY draw";
    EXPECT_EQ(rows(sql, "joined.db"),
              (Rows{{7}, {90}, {1.0 * kTenBillion + 6}, {3.0 * kTenBillion + 2}}));
    EXPECT_EQ(read_ladder(*open_for_reading(path("joined.db")), kEndOfDraws).rate()->mean,
              1.0 / 64);
  }
}

// What is known of the last population's sheets, some of which earlier ones turn out to have met.
class KnownSheets : public LadderTest {
 protected:
  static constexpr std::uint64_t kThree = 3 * kTenBillion;  // sheets 3, 4 and 2

  CertificateRecord certificate(const Candidate& of, double certified_deg) const {
    solver::Certificate made{
        certified_deg, {}, solver::CertificateEnd::to_the_end, -1, false, {}, {}};
    made.intervals.push_back(
        {0, certified_deg, true, 0.25, solver::flat_state<double>(mechanism_)});
    return certificate_row(campaign.pattern, mechanism_, of.draw, of.shifts_mm, made, 0.5);
  }
  // Of every candidate that is there, the farther and the more the later its population is.
  void study(const std::vector<Candidate>& candidates, double certified_deg,
             const std::string& name) const {
    Catalogue catalogue = open_of(campaign, name);
    for (const Candidate& candidate : candidates) {
      const auto sheet = static_cast<double>(candidate.metrics.deploys_from_sample - 170);
      catalogue.keep(std::vector{certificate(candidate, certified_deg + sheet)});
      catalogue.keep(std::vector<Yield>{{candidate.draw, 0.1, 10, 5, 0}}, "b");
      const auto trials = static_cast<std::uint64_t>(100 * certified_deg + sheet);
      catalogue.keep(std::vector<Yield>{{candidate.draw, 0.05, trials, 9, 0}}, "b");
    }
    catalogue.close();
  }
  // That of the four sheets 2, 3 and 4 are known, as they were in population 3, under these
  // numbers.
  void expect_known(const std::string& name, const std::vector<Candidate>& under) const {
    const auto database = open_for_reading(path(name));
    for (const Candidate& candidate : under) {
      const int sheet = candidate.metrics.deploys_from_sample - 170;
      EXPECT_EQ(read_certificate(*database, candidate.draw), certificate(candidate, 100 + sheet));
      const auto trials = static_cast<std::uint64_t>(10000 + sheet);
      EXPECT_EQ(read_yields(*database, candidate.draw),
                (std::vector<Yield>{{candidate.draw, 0.05, trials, 9, 0},
                                    {candidate.draw, 0.1, 10, 5, 0}}));
    }
    EXPECT_EQ(count("certificate", name), static_cast<std::int64_t>(under.size()));
    EXPECT_EQ(count("yield", name), static_cast<std::int64_t>(2 * under.size()));
    EXPECT_TRUE(check_ledger(*database, campaign).empty());
    EXPECT_TRUE(check_certificates(*database, campaign).findings.empty());
  }

  const Campaign campaign = climbed();
  const std::vector<UnitRecord> units = populations();
};

TEST_F(KnownSheets, KeepWhatIsKnownUnderASmallerNumber) {
  write(campaign, {units[2]}, true);
  study(units[2].candidates, 100, "a.db");
  const auto go_on = [&](const UnitRecord& unit) {
    Catalogue catalogue = open_of(campaign);
    catalogue.begin_run(kRun, {{0, 4 * kTenBillion}, {}, {}});
    catalogue.commit({unit});
    catalogue.end_run("stopped");
  };
  go_on(units[1]);
  expect_known("a.db", {units[1].candidates[0], units[1].candidates[1], units[2].candidates[1]});
  go_on(units[0]);
  expect_known("a.db", {units[0].candidates[1], units[1].candidates[1], units[2].candidates[1]});
}

TEST_F(KnownSheets, AreJoinedWhicheverIsFirst) {
  write(campaign, {units[2]}, true, "late.db");
  study(units[2].candidates, 100, "late.db");
  write(campaign, {units[0], units[1]}, true, "early.db");
  // Less is known under the smaller number.
  study({units[0].candidates[1]}, 90, "early.db");
  for (const bool late_first : {false, true}) {
    std::filesystem::remove(path("joined.db"));
    {
      Catalogue catalogue = open_of(campaign, "joined.db");
      const std::string names[] = {late_first ? "late.db" : "early.db",
                                   late_first ? "early.db" : "late.db"};
      for (const std::string& name : names) {
        const auto other = open_for_reading(path(name));
        catalogue.take_over(*other, units_done(*other));
      }
      catalogue.begin_run(kRun, {{0, 4 * kTenBillion}, {}, {}});
      for (const std::string& name : names) {
        const auto other = open_for_reading(path(name));
        catalogue.take_over_yields(*other);
        EXPECT_EQ(catalogue.take_over_certificates(*other), 0u);
      }
      catalogue.end_run("merged");
    }
    expect_known("joined.db",
                 {units[0].candidates[1], units[1].candidates[1], units[2].candidates[1]});
  }
}

// A certificate that was changed is not made good by a new number.
TEST_F(KnownSheets, SpoiltCertificatesStayBehind) {
  write(campaign, {units[2]}, true, "late.db");
  study(units[2].candidates, 100, "late.db");
  change_rows(path("late.db"), "UPDATE certificate SET proof = zeroblob(length(proof))");
  std::filesystem::copy_file(path("late.db"), path("more.db"));
  {
    Catalogue catalogue = open_of(campaign, "more.db");
    catalogue.begin_run(kRun, {{0, 4 * kTenBillion}, {}, {}});
    catalogue.commit({units[0]});
    catalogue.end_run("stopped");
  }
  EXPECT_EQ(count("certificate", "more.db"), 2);
  EXPECT_FALSE(read_certificate(*open_for_reading(path("more.db")), 90));
  write(campaign, {units[0]}, true, "early.db");
  Catalogue early = open_of(campaign, "early.db");
  EXPECT_EQ(early.take_over_certificates(*open_for_reading(path("late.db"))), 1u);
  early.close();
  EXPECT_EQ(count("certificate", "early.db"), 0);
}

// Of no more than two the first two, although later populations were there first.
TEST_F(LadderTest, OnlySoManyAreKeptWhateverTheOrder) {
  const Campaign campaign = climbed(2);
  const std::vector<UnitRecord> units = populations();
  std::vector<std::size_t> order = {0, 1, 2};
  do {
    write(campaign, {units[order[0]], units[order[1]], units[order[2]]}, false);
    EXPECT_EQ(rows("SELECT draw FROM candidate ORDER BY draw"), (Rows{{7}, {90}}));
    EXPECT_EQ(rows("SELECT accepted FROM unit ORDER BY lo"), (Rows{{2}, {0}, {0}}));
    EXPECT_TRUE(check_ledger(*open_for_reading(path()), campaign).empty());
    EXPECT_EQ(read_ladder(*open_for_reading(path()), kEndOfDraws).levels[2].met, 3u);
  } while (std::next_permutation(order.begin(), order.end()));
}

}  // namespace
}  // namespace misalign::schema
