// The catalogue: whatever the order of work, nothing is lost or counted twice, the digest is what
// the contract says, and whoever reads cannot write.
#include "schema/catalogue.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <random>

#include "schema/carried_files.hpp"
#include "schema/result_table.hpp"

namespace misalign::schema {
namespace {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"  // 128 bits, to check arithmetic made of two halves
using Wide = unsigned __int128;
#pragma GCC diagnostic pop

std::string little_endian(Wide value, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text.push_back(static_cast<char>(value >> (8 * k) & 0xff));
  return text;
}

Wide xxh3(const std::string& bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return static_cast<Wide>(hash.high64) << 64 | hash.low64;
}

std::string hex_of(Wide value) {
  std::string text;
  for (int shift = 124; shift >= 0; shift -= 4) {
    text.push_back("0123456789abcdef"[static_cast<int>(value >> shift & 15)]);
  }
  return text;
}

/// The contract's digest, from bytes written here.
std::string expected_digest(const std::string& identity, const std::vector<DrawRange>& merged,
                            const std::vector<std::pair<std::uint64_t, int>>& accepted,
                            std::uint64_t undecided) {
  std::string bytes = identity;
  for (const DrawRange& range : merged) {
    bytes += little_endian(range.lo, 8) + little_endian(range.hi, 8);
  }
  Wide sum = 0;
  for (const auto& [draw, sample] : accepted) {
    sum += xxh3(little_endian(draw, 8) + little_endian(static_cast<unsigned>(sample), 4));
  }
  bytes += little_endian(accepted.size(), 8) + little_endian(undecided, 8) + little_endian(sum, 16);
  return hex_of(xxh3(bytes));
}

Wide as_wide(const CandidateSum& sum) {
  Wide value = 0;
  const auto bytes = sum.bytes();
  for (int k = 15; k >= 0; --k) value = value << 8 | bytes[k];
  return value;
}

CandidateSum as_sum(Wide value) {
  const std::string bytes = little_endian(value, 16);
  return CandidateSum::from_bytes(reinterpret_cast<const unsigned char*>(bytes.data()));
}

TEST(CandidateSum, IsTheSumModulo2To128) {
  const Wide one = 1, all = ~Wide{0};
  const Wide kValues[] = {0,   one,      (one << 64) - 1, one << 64,      (one << 127) + 5,
                          all, all - 41, all << 64,       (one << 64) + 7};
  for (const Wide a : kValues) {
    EXPECT_TRUE(as_wide(as_sum(a)) == a);
    for (const Wide b : kValues) {
      CandidateSum ab = as_sum(a), ba = as_sum(b);
      ab.add(as_sum(b));
      ba.add(as_sum(a));
      EXPECT_TRUE(as_wide(ab) == a + b) << hex_of(a) << " + " << hex_of(b);
      EXPECT_TRUE(ab == ba);
    }
  }
}

TEST(CandidateSum, AddsTheHashOfDrawAndSample) {
  constexpr std::pair<std::uint64_t, int> kCandidates[] = {
      {0, 1}, {1, 0}, {77, 156}, {1ULL << 40, 180}, {kEndOfDraws - 1, 18000}};
  CandidateSum forward, backward;
  Wide sum = 0;
  for (const auto& [draw, sample] : kCandidates) {
    forward.add(draw, sample);
    sum += xxh3(little_endian(draw, 8) + little_endian(static_cast<unsigned>(sample), 4));
    EXPECT_TRUE(as_wide(forward) == sum) << draw;
  }
  for (auto at = std::rbegin(kCandidates); at != std::rend(kCandidates); ++at) {
    backward.add(at->first, at->second);
  }
  EXPECT_TRUE(forward == backward);
}

TEST(Digest, IsMadeOfTheBytesOfTheContract) {
  const std::string identity(32, 'e');
  CandidateSum sum;
  sum.add(5, 170);
  sum.add(4096, 180);
  const std::vector<DrawRange> merged = {{0, 4096}, {4096 + 7, kEndOfDraws}};
  EXPECT_EQ(catalogue_digest(identity, merged, 2, 3, sum),
            expected_digest(identity, merged, {{5, 170}, {4096, 180}}, 3));
  EXPECT_EQ(catalogue_digest(identity, {}, 0, 0, {}), expected_digest(identity, {}, {}, 0));
  EXPECT_EQ(hex(hash_of("misalign")), hex_of(xxh3("misalign")));
}

TEST(MergedUpTo, JoinsAndCuts) {
  struct Case {
    std::vector<DrawRange> ranges;
    std::uint64_t end;
    std::vector<DrawRange> merged;
  };
  const Case kCases[] = {
      {{}, 10, {}},
      {{{0, 5}}, 10, {{0, 5}}},
      {{{0, 5}, {5, 10}}, 10, {{0, 10}}},
      {{{0, 5}, {5, 7}, {7, 9}}, 100, {{0, 9}}},
      {{{0, 5}, {6, 10}}, 10, {{0, 5}, {6, 10}}},
      {{{0, 5}, {5, 10}}, 7, {{0, 7}}},
      {{{0, 5}, {5, 10}}, 5, {{0, 5}}},
      {{{0, 5}, {6, 10}}, 6, {{0, 5}}},
      {{{3, 5}}, 3, {}},
      {{{3, 5}}, 0, {}},
      {{{0, 1}, {kEndOfDraws - 1, kEndOfDraws}},
       kEndOfDraws,
       {{0, 1}, {kEndOfDraws - 1, kEndOfDraws}}},
  };
  for (const Case& c : kCases) EXPECT_EQ(merged_up_to(c.ranges, c.end), c.merged) << c.end;
}

TEST(Goal, PlannedEnd) {
  EXPECT_EQ((Goal{{0, 100}, {}, {}}.planned_end()), 100u);
  EXPECT_EQ((Goal{{0, 100}, 40, {}}.planned_end()), 40u);
  EXPECT_EQ((Goal{{50, 100}, 40, {}}.planned_end()), 90u);
  EXPECT_EQ((Goal{{50, 100}, 60, {}}.planned_end()), 100u);
  EXPECT_EQ((Goal{{50, kEndOfDraws}, kEndOfDraws, {}}.planned_end()), kEndOfDraws);
}

const RunInfo kRun{"host", "0", "none", "g++", "-O2", "golden", 2};

class CatalogueTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("misalign_" + std::string(test->name()) + "_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name = "a.db") const { return folder_ / name; }

  /// An invented science of draws, so that what a catalogue must say is known without one.
  static bool is_accepted(std::uint64_t draw) { return draw % 97 == 5; }
  static bool is_undecided(std::uint64_t draw) { return draw % 1009 == 3; }
  static int sample_of(std::uint64_t draw) { return 170 + static_cast<int>(draw % 11); }

  Candidate candidate(std::uint64_t draw) const {
    Candidate c{draw, {}, Eigen::Matrix2Xd::Zero(2, campaign_.pattern.base.sheet.vertex_count())};
    c.metrics.deploys_from_sample = sample_of(draw);
    c.metrics.deploys_from_deg = sample_of(draw);
    c.metrics.elongation.assign(mechanism_.diagonals.size(), 0.25);
    c.shifts_mm(0, 9) = 0.4;
    return c;
  }

  UnitRecord unit(std::uint64_t lo, std::uint64_t hi,
                  const std::function<bool(std::uint64_t)>& accepted = is_accepted) const {
    UnitRecord record;
    record.range = {lo, hi};
    record.seconds = 0.5;
    for (std::uint64_t draw = lo; draw < hi; ++draw) {
      const solver::Verdict verdict{7, solver::Fault::not_monotone, 0};
      if (accepted(draw)) {
        record.candidates.push_back(candidate(draw));
      } else if (is_undecided(draw)) {
        record.undecided.push_back(
            {draw, {7, solver::Fault::undecided, -1, solver::PathEnd::stalled}});
      } else {
        ++record.rejected;
        ++record.screened[{static_cast<int>(solver::Fault::not_monotone), 8}];
      }
      if (draw % kFaultSampleEvery == 0) record.fault_sample.push_back({draw, verdict});
    }
    record.accepted = record.candidates.size();
    return record;
  }

  CatalogueState state(const std::string& name = "a.db") const {
    return read_state(*open_for_reading(path(name)));
  }

  std::int64_t count(const std::string& from, const std::string& name = "a.db") const {
    return open_for_reading(path(name))->execAndGet("SELECT count(*) FROM " + from).getInt64();
  }

  /// What the digest must be for these ranges.
  std::string expected(const std::vector<DrawRange>& merged) const {
    std::vector<std::pair<std::uint64_t, int>> accepted;
    std::uint64_t undecided = 0;
    for (const DrawRange& range : merged) {
      for (std::uint64_t draw = range.lo; draw < range.hi; ++draw) {
        if (is_accepted(draw)) accepted.emplace_back(draw, sample_of(draw));
        undecided += !is_accepted(draw) && is_undecided(draw);
      }
    }
    return expected_digest(identity(campaign_), merged, accepted, undecided);
  }

  Catalogue open(const std::string& name = "a.db") const {
    return {path(name), campaign_, mechanism_};
  }

  static solver::Mechanism mechanism_of(const Campaign& campaign) {
    const auto& base = campaign.pattern.base;
    return solver::build_mechanism(base.sheet, base.holes, base.folding);
  }

  static Campaign changed(const char* patch) {
    Json json = campaign_json(default_campaign());
    json.merge_patch(Json::parse(patch));
    return read_campaign(json, "test");
  }

  /// The UserError of a call: its exit code (0 if there was none) and its sentence.
  struct Refusal {
    int exit_code;
    std::string sentence;
  };
  static Refusal refusal(const std::function<void()>& call) {
    try {
      call();
      return {0, ""};
    } catch (const UserError& error) {
      return {error.exit_code(), error.what()};
    }
  }

  const Campaign campaign_ = default_campaign();
  const solver::Mechanism mechanism_ = mechanism_of(campaign_);
  std::filesystem::path folder_;
};

TEST_F(CatalogueTest, OrderAndSizeOfUnitsDoNotMatter) {
  const Goal goal{{0, kEndOfDraws}, 8000, {}};
  const std::vector<std::vector<DrawRange>> kOrders = {
      {{0, 1000}, {1000, 2000}, {2000, 3000}, {3500, 5000}, {5000, 8000}},
      {{7000, 8000}, {3500, 3501}, {1500, 3000}, {3501, 7000}, {0, 1500}},
  };
  for (std::size_t k = 0; k < kOrders.size(); ++k) {
    Catalogue catalogue = open(std::to_string(k));
    catalogue.begin_run(kRun, goal);
    for (const DrawRange& range : kOrders[k]) catalogue.commit(unit(range.lo, range.hi), 1);
    catalogue.end_run("stopped");
    std::vector<DrawRange> ascending = kOrders[k];
    std::sort(ascending.begin(), ascending.end(),
              [](const DrawRange& a, const DrawRange& b) { return a.lo < b.lo; });
    EXPECT_EQ(catalogue.done(), ascending);
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
    EXPECT_EQ(s.faults.at("not_monotone"), 7u);  // 0, 1024, ..., 7168 without 3072
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
    catalogue.commit(unit(0, 6000), 1);
    catalogue.commit(unit(6000, 10000), 2);
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
  catalogue.commit(unit(500, 1500), 1);   // reaches in from below
  catalogue.commit(unit(4500, 5500), 1);  // and out at the end
  catalogue.commit(unit(6000, 7000), 1);
  EXPECT_EQ(state().gaps, (std::vector<DrawRange>{{1500, 4500}}));
  catalogue.commit(unit(2000, 3000), 1);
  EXPECT_EQ(state().gaps, (std::vector<DrawRange>{{1500, 2000}, {3000, 4500}}));
}

TEST_F(CatalogueTest, OverlapsAreRefusedWhole) {
  Catalogue catalogue = open();
  catalogue.begin_run(kRun, {{0, kEndOfDraws}, 8000, {}});
  catalogue.commit(unit(1000, 2000), 1);
  catalogue.commit(unit(4000, 5000), 1);
  const CatalogueState before = state();
  constexpr DrawRange kOverlaps[] = {{1000, 2000}, {0, 1001},   {1999, 3000}, {1200, 1300},
                                     {0, 8000},    {500, 2500}, {3000, 4001}};
  for (const DrawRange& range : kOverlaps) {
    EXPECT_THROW(catalogue.commit(unit(range.lo, range.hi), 1), SQLite::Exception) << range.lo;
  }
  EXPECT_EQ(state().digest, before.digest);
  EXPECT_EQ(state().draws_in_ledger, 2000u);
  EXPECT_EQ(count("candidate WHERE draw < 1000 OR draw BETWEEN 2000 AND 3999"), 0);
  // Neighbours that only touch are no overlap.
  EXPECT_NO_THROW(catalogue.commit(unit(2000, 4000), 1));
  EXPECT_NO_THROW(catalogue.commit(unit(0, 1000), 1));
}

TEST_F(CatalogueTest, AUnitAndWhatBelongsToItAreOneTransaction) {
  Catalogue catalogue = open();
  catalogue.begin_run(kRun, {{0, kEndOfDraws}, 8000, {}});
  catalogue.commit(unit(0, 2048), 1);
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
    EXPECT_THROW(catalogue.commit(bad[k], 1), SQLite::Exception) << k;
    for (std::size_t t = 0; t < before.size(); ++t) EXPECT_EQ(count(kTables[t]), before[t]) << k;
    EXPECT_EQ(screened(), screened_before);
  }
  catalogue.commit(unit(2048, 4096), 1);  // and the good one still goes in
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
    catalogue.commit(unit(0, 4096, accepted), 1);
    catalogue.commit(unit(8192, 16384, accepted), 1);
    // Three are known, but the draws before the third are not all done.
    EXPECT_EQ(catalogue.goal_end(), 40000u);
    catalogue.commit(unit(4096, 8191, accepted), 1);
    EXPECT_EQ(catalogue.goal_end(), 40000u);  // draw 8191 is still missing
    EXPECT_EQ(state().goal_end, 40000u);
    catalogue.commit(unit(8191, 8192, accepted), 1);
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

TEST_F(CatalogueTest, AnotherCampaignIsRefusedAndNamed) {
  open();
  const std::pair<const char*, const char*> kOthers[] = {
      {R"({"seed": 2})", "/seed"},
      {R"({"accept": {"deploys_from_deg": 150}})", "/accept"},
      {R"({"misalignment": {"levels": "uniform"}})", "/misalignment"},
      {R"({"pattern": {"holes": "checkerboard-even"}})", "/pattern"},
  };
  for (const auto& [patch, named] : kOthers) {
    const Campaign other = changed(patch);
    const auto mechanism = mechanism_of(other);
    const Refusal r = refusal([&] { Catalogue(path(), other, mechanism); });
    EXPECT_EQ(r.exit_code, kExitOtherCampaign) << patch;
    EXPECT_NE(r.sentence.find(named), std::string::npos) << r.sentence;
    EXPECT_EQ(r.sentence.find(path()), 0u) << r.sentence;
  }
  // What is outside the identity makes no other campaign, and the last run's wins.
  const Campaign renamed = changed(R"({"name": "renamed", "stop": {"draws": 5}})");
  {
    Catalogue catalogue(path(), renamed, mechanism_);
    catalogue.begin_run(kRun, {});
  }
  EXPECT_EQ(state().name, "renamed");
  EXPECT_EQ(identity(read_campaign_of(*open_for_reading(path()), path())), identity(campaign_));
}

TEST_F(CatalogueTest, OtherFilesAreRefusedAndLeftAlone) {
  const auto read_all = [](const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  std::ofstream(path("short")) << "hello\n";
  std::ofstream(path("long")) << std::string(10000, 'x');
  SQLite::Database(path("foreign"), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE mine (x)");
  for (const char* name : {"short", "long", "foreign"}) {
    const std::string before = read_all(path(name));
    EXPECT_EQ(refusal([&] { open(name); }).exit_code, kExitBadInput) << name;
    EXPECT_EQ(refusal([&] { open_for_reading(path(name)); }).exit_code, kExitBadInput) << name;
    EXPECT_EQ(read_all(path(name)), before) << name;
  }
  std::ofstream(path("empty"));
  for (const char* name : {"absent", "empty", "."}) {
    EXPECT_EQ(refusal([&] { open_for_reading(path(name)); }).exit_code, kExitBadInput) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(path("absent")));
  EXPECT_EQ(refusal([&] { open("empty"); }).exit_code, 0);  // as a killed search may leave it
  EXPECT_EQ(refusal([&] { open("no/folder.db"); }).exit_code, kExitFailure);
}

TEST_F(CatalogueTest, NewerSchemaIsRefused) {
  open();
  SQLite::Database(path(), SQLite::OPEN_READWRITE)
      .exec("PRAGMA user_version = " + std::to_string(kSchemaVersion + 1));
  for (const Refusal& r : {refusal([&] { open(); }), refusal([&] { open_for_reading(path()); })}) {
    EXPECT_EQ(r.exit_code, kExitOtherCampaign);
    EXPECT_NE(r.sentence.find("schema version"), std::string::npos) << r.sentence;
  }
}

TEST_F(CatalogueTest, VersionAndKindAreThoseOfTheHeader) {
  open();
  SQLite::Database database(path());
  EXPECT_EQ(database.execAndGet("PRAGMA user_version").getInt(), kSchemaVersion);
  EXPECT_EQ(database.execAndGet("PRAGMA application_id").getInt(), kApplicationId);
}

TEST_F(CatalogueTest, OneWriterAtATime) {
  {
    Catalogue first = open();
    first.begin_run(kRun, {{0, kEndOfDraws}, 4096, {}});
    const Refusal r = refusal([&] { open(); });
    EXPECT_EQ(r.exit_code, kExitInUse);
    EXPECT_EQ(r.sentence.find(path()), 0u) << r.sentence;
    first.commit(unit(0, 4096), 0);   // the attempt did it no harm
    EXPECT_EQ(state().draws, 4096u);  // and readers never wait
  }
  EXPECT_EQ(refusal([&] { open(); }).exit_code, 0);
}

TEST_F(CatalogueTest, ReadersCannotWrite) {
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 4096, {}});
    catalogue.commit(unit(0, 4096), 0);
  }
  const CatalogueState before = state();
  const auto database = open_for_reading(path());
  const std::string elsewhere = path("elsewhere.db");
  const std::string kWrites[] = {
      "INSERT INTO screened VALUES ('x', 1, 1)",
      "UPDATE campaign SET goal_end = 1",
      "DELETE FROM candidate",
      "DROP TABLE candidate",
      "CREATE TABLE t (x)",
      "CREATE TEMP TABLE t (x)",
      "ATTACH '" + elsewhere + "' AS other",
      "VACUUM INTO '" + elsewhere + "'",
      "PRAGMA user_version = 9",
      "PRAGMA application_id = 9",
      "PRAGMA writable_schema = ON",
      "PRAGMA journal_mode = DELETE",
      "PRAGMA query_only = OFF",
      "SELECT load_extension('x')",
  };
  for (const std::string& sql : kWrites) {
    EXPECT_THROW(
        {
          SQLite::Statement statement(*database, sql);
          while (statement.executeStep()) {
          }
        },
        SQLite::Exception)
        << sql;
    EXPECT_EQ(refusal([&] { query_table(*database, sql, TableStyle::json); }).exit_code, kExitUsage)
        << sql;
  }
  EXPECT_FALSE(std::filesystem::exists(elsewhere));
  EXPECT_EQ(state().digest, before.digest);
  EXPECT_EQ(state().goal_end, before.goal_end);
}

TEST_F(CatalogueTest, QueriesThatAreNoneAreRefused) {
  open();
  const auto database = open_for_reading(path());
  for (const char* sql :
       {"", "   ", "-- nothing", ";", "SELEKT 1", "SELECT * FROM nowhere", "SELECT 1; SELECT 2",
        "SELECT 1; nonsense", "SELECT 1; DROP TABLE unit", "BEGIN", "SELECT abs('x', 1)"}) {
    for (const TableStyle style : {TableStyle::aligned, TableStyle::json, TableStyle::csv}) {
      const Refusal r = refusal([&] { query_table(*database, sql, style); });
      EXPECT_EQ(r.exit_code, kExitUsage) << sql;
      EXPECT_NE(r.sentence.find(named_query_list()), std::string::npos) << r.sentence;
    }
  }
  for (const char* sql : {"SELECT 1 AS x", "SELECT 1 AS x;", " SELECT 1 AS x ; -- done\n"}) {
    EXPECT_EQ(query_table(*database, sql, TableStyle::csv), "x\n1\n") << sql;
  }
}

TEST_F(CatalogueTest, NamedQueriesRunOnAnyCatalogue) {
  open("empty.db");
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 8192, {}});
    catalogue.commit(unit(0, 8192), 0);
  }
  int queries = 0;
  for (const CarriedFile& file : carried_files()) {
    const std::filesystem::path query = file.path;
    if (query.parent_path() != "schema/queries") continue;
    ++queries;
    EXPECT_EQ(named_query(query.stem()), file.text);
    EXPECT_NE(named_query_list().find(query.stem()), std::string::npos);
    const auto filled = open_for_reading(path()), empty = open_for_reading(path("empty.db"));
    for (const TableStyle style : {TableStyle::aligned, TableStyle::json, TableStyle::csv}) {
      EXPECT_EQ(refusal([&] { query_table(*empty, file.text, style); }).sentence, "") << query;
    }
    EXPECT_FALSE(Json::parse(query_table(*filled, file.text, TableStyle::json)).empty()) << query;
  }
  EXPECT_GE(queries, 5);
  EXPECT_EQ(named_query("no such query"), "");
  EXPECT_EQ(named_query("../catalogue"), "");
}

TEST_F(CatalogueTest, TablesInThreeStyles) {
  open();
  const auto database = open_for_reading(path());
  const std::string sql =
      "SELECT 'a,b' AS \"x,y\", 'say \"hi\"' AS quote, 'two' || char(10) || 'lines' AS line, "
      "char(13) AS cr, 0.1 AS real, NULL AS none, -7 AS whole, ' plain' AS plain";
  // RFC 4180, with \n between records.
  EXPECT_EQ(query_table(*database, sql, TableStyle::csv),
            "\"x,y\",quote,line,cr,real,none,whole,plain\n"
            "\"a,b\",\"say \"\"hi\"\"\",\"two\nlines\",\"\r\",0.1,,-7, plain\n");
  const Json expected = {{{"x,y", "a,b"},
                          {"quote", "say \"hi\""},
                          {"line", "two\nlines"},
                          {"cr", "\r"},
                          {"real", 0.1},
                          {"none", nullptr},
                          {"whole", -7},
                          {"plain", " plain"}}};
  EXPECT_EQ(Json::parse(query_table(*database, sql, TableStyle::json)), expected);
  EXPECT_EQ(
      query_table(*database, "SELECT 'b' AS name, 5 AS n UNION ALL SELECT 'long', 10 ORDER BY n",
                  TableStyle::aligned),
      "name   n\n"
      "b      5\n"
      "long  10\n");
  EXPECT_EQ(query_table(*database, "SELECT 1 AS x WHERE 0", TableStyle::csv), "x\n");
  EXPECT_EQ(query_table(*database, "SELECT 1 AS x WHERE 0", TableStyle::json), "[]\n");
  // CSV and JSON keep every bit of a real.
  const double third = 1.0 / 3;
  EXPECT_EQ(std::stod(query_table(*database, "SELECT 1.0 / 3 AS x", TableStyle::csv).substr(2)),
            third);
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
    catalogue.commit(record, 0);
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
  // All different, so that no two columns can be exchanged.
  m = {171, 171.5, 172.5, -0.1, 0.2, 0.3, 0.4, 0.5,         6.5,
       7.5, 8.5,   9.5,   10.5, 11,  12,  13,  m.elongation};
  record.candidates[1].metrics.slope_min_mm_per_deg.reset();
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 2, {}});
    catalogue.commit(record, 0);
  }
  const auto database = open_for_reading(path());
  const Json rows = Json::parse(
      query_table(*database, "SELECT * FROM candidate ORDER BY draw", TableStyle::json));
  const std::pair<const char*, double> kColumns[] = {{"deploys_from_sample", 171},
                                                     {"deploys_from_deg", 171.5},
                                                     {"fold_limit_deg", 172.5},
                                                     {"elongation_min", -0.1},
                                                     {"elongation_max", 0.2},
                                                     {"stroke_min", 0.3},
                                                     {"stroke_max", 0.4},
                                                     {"slope_min_mm_per_deg", 0.5},
                                                     {"stretch_sq_mm2", 6.5},
                                                     {"singular_value_min", 7.5},
                                                     {"residual_max", 8.5},
                                                     {"isometry_error_mm", 9.5},
                                                     {"kawasaki_defect_deg", 10.5},
                                                     {"shifted_vertices", 11},
                                                     {"increasing", 12},
                                                     {"decreasing", 13}};
  for (const auto& [name, value] : kColumns) EXPECT_EQ(rows[0].at(name), value) << name;
  EXPECT_TRUE(rows[1].at("slope_min_mm_per_deg").is_null());
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
    catalogue.commit(record, 0);
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

}  // namespace
}  // namespace misalign::schema
