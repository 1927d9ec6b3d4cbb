// Catalogues of a splitting search whose rows lie, given to whoever reads them: a sentence and the
// right exit code, or what is right in spite of them.
#include "tests/search/hostile_ladder.hpp"

#include "tests/bench/cpu_seconds.hpp"

namespace misalign::search {
namespace {

TEST_F(HostileLadder, TheGoodOneIsGoneOnWith) {
  const std::string path = attacked("SELECT 1");
  EXPECT_EQ(refused([&] { look(path); }), "");
  EXPECT_EQ(refused([&] { take_out(path); }), "");
  EXPECT_EQ(verified(path, 2), "");
  EXPECT_EQ(joined({path, whole_}), "");
  EXPECT_EQ(digest_of(folder_.file("joined.db")), digest_);
  climb(path, 3);
  EXPECT_EQ(digest_of(path), digest_);
  EXPECT_EQ(verified(path), "");
}

TEST_F(HostileLadder, PopulationsThatDoNotAddUp) {
  const std::string kSet = "UPDATE population SET ";
  for (const char* lie :
       {"survivors = -1", "survivors = particles + 1", "survivors = 1 << 40", "particles = 0",
        "particles = -1", "particles = 1 << 40", "ancestors = survivors + 1", "ancestors = 0",
        "ancestors = -1", "tried = -1", "tried = taken - 1", "taken = -1", "undecided = 1 << 62",
        "undecided = -1", "met = -1", "seconds = -1", "seconds = 9e999"}) {
    expect_refused(kSet + lie + " WHERE unit = 0 AND level = 1",
                   "population 0 does not add up at level 1");
  }
  const std::string kOf1 = " WHERE unit = 10000000000 AND level = ";
  expect_refused("DELETE FROM population" + kOf1 + "0", "population 1 does not add up at level 1");
  expect_refused("DELETE FROM population" + kOf1 + "1", "population 1 does not add up at level 2");
  expect_refused("DELETE FROM population" + kOf1 + "2", "population 1 has not come to its end");
  expect_refused(kSet + "ancestors = ancestors + 1" + kOf1 + "1 AND ancestors < survivors; " +
                     kSet + "ancestors = 1" + kOf1 + "0",
                 "population 1 does not add up at level 1");
  expect_refused(kSet + "level = -1" + kOf1 + "0", "population 1 does not add up at level -1");
  // Beyond the last level.
  expect_refused(kSet + "survivors = 1, ancestors = 1" + kOf1 +
                     "2; INSERT INTO population SELECT unit, 3, particles, 0, 0, tried, taken, "
                     "undecided, met, seconds FROM population" +
                     kOf1 + "2",
                 "population 1 does not add up at level 3");
}

TEST_F(HostileLadder, PopulationsAndUnitsThatDoNotBelongTogether) {
  const std::string kCopy =
      "particles, survivors, ancestors, tried, taken, undecided, met, seconds FROM population "
      "WHERE unit = 0";
  expect_refused("DELETE FROM population WHERE unit = 0", "population 0 has not come to its end");
  expect_refused("DELETE FROM unit WHERE lo = 0", "population 0 is in no unit");
  expect_refused("INSERT INTO population SELECT 50000000000, level, " + kCopy,
                 "population 5 is in no unit");
  expect_refused("INSERT INTO population SELECT -1, level, " + kCopy, "is in no unit");
  // Two units for one population, one for two, and one of numbers that lie across two.
  const std::string kShorter =
      "UPDATE unit SET hi = 5000000000, rejected = 5000000000 - accepted WHERE lo = 0";
  expect_refused(kShorter, "unit 0 is no population");
  expect_refused(kShorter +
                     "; INSERT INTO unit (lo, hi, run, worker, accepted, rejected, undecided, "
                     "seconds, digest_part) SELECT 5000000000, 10000000000, run, worker, 0, "
                     "5000000000, 0, 0, zeroblob(16) FROM unit WHERE lo = 0; INSERT INTO "
                     "population SELECT 5000000000, level, " +
                     kCopy,
                 "unit 0 is no population");
  expect_refused(
      "DELETE FROM unit WHERE lo > 0; DELETE FROM population WHERE unit > 0; DELETE FROM sheet "
      "WHERE draw >= 10000000000; DELETE FROM candidate WHERE draw >= 10000000000; UPDATE unit SET "
      "hi = 20000000000, rejected = 20000000000 - accepted",
      "unit 0 is no population");
  expect_refused(
      "UPDATE unit SET lo = lo + 1, hi = hi + 1 WHERE lo > 0; UPDATE population SET unit = unit + "
      "1 WHERE unit > 0",
      "unit 10000000001 is no population");
}

TEST_F(HostileLadder, LevelsThatAreNone) {
  const std::string kSet = "UPDATE level SET ";
  for (const char* lie :
       {"score = 0", "score = -5", "score = 1 << 40", "score = score + 1", "score = 27 * 1024",
        "deploys_from_deg = 9e999", "deploys_from_deg = -20", "number = 0", "number = -1"}) {
    expect_refused(kSet + lie + " WHERE number = 1", "is none of its campaign");
  }
  // Above the criterion, and below it.
  expect_refused(kSet + "score = score + 1024, deploys_from_deg = 28 WHERE number = 2",
                 "level 2 is none of its campaign");
  expect_refused(kSet + "score = score - 1024, deploys_from_deg = 26 WHERE number = 2",
                 "last level is not its campaign's criterion");
  expect_refused(kSet + "number = 3 WHERE number = 2", "level 3 is none of its campaign");
  expect_refused("DELETE FROM level WHERE number = 2",
                 "last level is not its campaign's criterion");
  expect_refused("DELETE FROM level", "does not add up at level 1");
  expect_refused(
      "DELETE FROM level; DELETE FROM population WHERE level > 0; UPDATE population SET survivors "
      "= 0, ancestors = 0",
      "populations without levels");
  // More than any campaign has, each of them possible.
  expect_refused(
      "DELETE FROM level; WITH RECURSIVE n (k) AS (VALUES (1) UNION ALL SELECT k + 1 FROM n WHERE "
      "k "
      "< 27648) INSERT INTO level SELECT k, k, k / 1024.0 FROM n",
      "level 257 is none of its campaign");
}

// What only those see who know the campaign.
TEST_F(HostileLadder, LevelsAndParticlesOfAnotherCampaign) {
  const std::string other =
      attacked("UPDATE level SET score = 19 * 1024, deploys_from_deg = 19 WHERE number = 1");
  EXPECT_EQ(refused([&] { look(other); }), "");
  EXPECT_NE(verified(other).find("level.score"), std::string::npos);
  EXPECT_NE(joined({other}).find("level.score"), std::string::npos);
  EXPECT_NE(refused([&] { climb(other, 3); }).find("do not fit its campaign"), std::string::npos);
  const std::string more = attacked("UPDATE population SET particles = 21 WHERE level = 1");
  EXPECT_NE(verified(more).find("level 1, particles is 21 as stored, 20"), std::string::npos);
}

// Counts that add up and are others: found where a population is made again, or compared.
TEST_F(HostileLadder, CountsOfAnotherPopulation) {
  for (const auto& [name, lie] : std::initializer_list<std::pair<const char*, const char*>>{
           {"taken", "taken = taken - 1"},
           {"undecided", "undecided = undecided + 1, taken = taken - 1"},
           {"met", "met = met + 1"},
           {"ancestors", "ancestors = ancestors - 1"}}) {
    SCOPED_TRACE(lie);
    const std::string path =
        attacked("UPDATE population SET " + std::string(lie) + " WHERE unit = 0 AND level = 1");
    const std::string count = "population 0: level 1, " + std::string(name) + " is ";
    EXPECT_EQ(verified(path), "");  // nothing else can know
    EXPECT_NE(verified(path, 2).find(count), std::string::npos) << verified(path, 2);
    EXPECT_NE(joined({path, whole_}).find(count), std::string::npos);
    EXPECT_NE(joined({whole_, path}).find(count), std::string::npos);
  }
  // Of these the campaign knows.
  for (const auto& [name, lie] : std::initializer_list<std::pair<const char*, const char*>>{
           {"level 1, tried", "tried = tried + 1 WHERE level = 1"},
           {"level 0, tried", "tried = tried + 1 WHERE level = 0"},
           {"level 0, taken", "taken = taken - 1 WHERE level = 0"}}) {
    const std::string path = attacked("UPDATE population SET " + std::string(lie));
    EXPECT_NE(verified(path).find(name), std::string::npos) << lie << ": " << verified(path);
  }
}

TEST_F(HostileLadder, GoalsThatPopulationsCannotHave) {
  for (const char* lie :
       {"goal_accepted = 5", "goal_accepted = 0", "range_lo = 5", "goal_end = 30000000001",
        "goal_relative_error = -1", "range_lo = 1, goal_accepted = 7, goal_relative_error = 0.1"}) {
    const std::string path =
        attacked("UPDATE campaign SET range_hi = 1 << 62, " + std::string(lie));
    SCOPED_TRACE(lie);
    expect_word(refused([&] { look(path); }), "goal", "status");
    expect_word(verified(path), "goal", "verify");
    expect_word(joined({path, whole_}), "goal", "merge");
    EXPECT_EQ(refused([&] { climb(path, 3); }), "");  // a run's own goal wins
    EXPECT_EQ(digest_of(path), digest_);
  }
}

TEST_F(HostileLadder, SheetsThatNoDrawHas) {
  const std::string kSet = "UPDATE candidate SET displacements_mm = ";
  for (const char* lie :
       {"'nonsense'", "'[]'", "'[[0, 0]]'", "'{\"A1\": [0.1, 0]}'", "'{\"A10\": [0.4]}'",
        "'{\"A10\": [0.39999, 0]}'", "'{\"A10\": [1e308, 0]}'", "'{\"A10\": [1e999, 0]}'",
        "'{\"A10\": [null, 0]}'", "'{\"Z99\": [0.4, 0]}'", "'{\"\": [0.4, 0]}'",
        "replace(hex(zeroblob(50000)), '0', '[')"}) {
    SCOPED_TRACE(lie);
    const std::string path =
        attacked(kSet + lie + " WHERE draw = (SELECT min(draw) FROM candidate)");
    EXPECT_NE(refused([&] { take_out(path); }).find("has no displacements of its campaign"),
              std::string::npos);
    const std::string said = verified(path);
    EXPECT_NE(said.find("sheet.hash"), std::string::npos) << said;
    EXPECT_NE(said.find("displacements_mm"), std::string::npos) << said;
    EXPECT_NE(joined({path, whole_}).find("sheet.hash"), std::string::npos);
  }
  EXPECT_EQ(refused([&] { climb(folder_.file("bad.db"), 3); }), "");  // nobody looks at it again
}

// Hashes that are others', missing, too short, of no candidate; and a sheet twice.
TEST_F(HostileLadder, SheetsThatAreNotThemselves) {
  const std::pair<const char*, const char*> kLies[] = {
      {"UPDATE sheet SET hash = x'00'", "sheet.hash"},
      {"UPDATE sheet SET hash = zeroblob(16)", "sheet.hash"},
      {"UPDATE sheet SET hash = zeroblob(1000000) WHERE draw = (SELECT min(draw) FROM sheet)",
       "sheet.hash"},
      {"DELETE FROM sheet", "sheet.hash"},
      {"UPDATE sheet SET draw = -draw - 1", "table sheet"},
      {"INSERT INTO candidate SELECT 9999999999, unit, deploys_from_sample, deploys_from_deg, "
       "fold_limit_deg, elongation_min, elongation_max, stroke_min, stroke_max, "
       "slope_min_mm_per_deg, stretch_sq_mm2, singular_value_min, residual_max, "
       "isometry_error_mm, kawasaki_defect_deg, shifted_vertices, increasing, decreasing, "
       "displacements_mm, elongation, slope_between_min_mm_per_deg, bump_deg, miscut_margin_mm, "
       "reverses_at_deg, energy_deploys_from_deg, energy_friction_n_mm_per_mm FROM candidate "
       "WHERE unit = 0 LIMIT 1; INSERT INTO sheet SELECT "
       "9999999999, hash FROM sheet ORDER BY draw LIMIT 1",
       "\"that of draw"},
  };
  for (const auto& [sql, word] : kLies) {
    SCOPED_TRACE(sql);
    const std::string path = attacked(sql);
    EXPECT_EQ(refused([&] { look(path); }), "");
    EXPECT_NE(verified(path).find(word), std::string::npos) << verified(path);
    EXPECT_NE(joined({path, whole_}).find(word), std::string::npos);
    refused([&] { climb(path, 3); });
  }
  // Each of many is looked up, and not against all others.
  const std::string path = attacked(
      "WITH RECURSIVE n (k) AS (VALUES (25000000000) UNION ALL SELECT k + 1 FROM n WHERE k < "
      "25000020000) INSERT INTO sheet SELECT k, (SELECT hash FROM sheet ORDER BY draw LIMIT 1) "
      "FROM n");
  const double begin_s = bench::cpu_seconds();
  EXPECT_EQ(refused([&] { climb(path, 3); }), "");
  EXPECT_LT(bench::cpu_seconds() - begin_s, 2);
}

// Rows in the way of what a search writes, and counts that its writing would take below 0.
TEST_F(HostileLadder, RowsInTheWay) {
  const auto of_whole = [&](const std::string& sql) {
    return schema::open_for_reading(whole_)->execAndGet(sql).getString();
  };
  // A number that population 2 will need.
  const std::string number =
      of_whole("SELECT draw FROM candidate WHERE draw >= 20000000000 ORDER BY draw LIMIT 1");
  // A sheet that population 0 will meet is one of population 1's, whose unit has none.
  const std::string hash = of_whole("SELECT hex(hash) FROM sheet ORDER BY draw LIMIT 1");
  const std::string kOf0 = " >= 0 AND draw < 10000000000; ";
  for (const std::string& sql :
       {"UPDATE candidate SET draw = " + number + " WHERE draw = (SELECT min(draw) FROM candidate)",
        "DELETE FROM sheet WHERE draw" + kOf0 + "DELETE FROM candidate WHERE draw" + kOf0 +
            "DELETE FROM population WHERE unit = 0; DELETE FROM unit WHERE lo = 0; UPDATE unit SET "
            "accepted = 0, rejected = hi - lo; UPDATE sheet SET hash = x'" +
            hash + "' WHERE draw = (SELECT min(draw) FROM sheet)"}) {
    SCOPED_TRACE(sql);
    const std::string path = attacked(sql);
    EXPECT_EQ(refused([&] { look(path); }), "");
    EXPECT_NE(verified(path), "");
    expect_word(refused([&] { climb(path, 3); }), "contradict", "search");
  }
}

}  // namespace
}  // namespace misalign::search
