#include "search/terminal/progress_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "schema/files/input.hpp"
#include "search/terminal/long_work.hpp"

namespace misalign::search {
namespace {

ProgressReport report(std::uint64_t draws, std::uint64_t left) {
  ProgressReport report;
  report.counts.standing = {draws, draws / 1000, schema::Standing::Best{172, 345}};
  report.counts.draws_left = left;
  report.counts.limited = true;
  report.counts.draws_of_run = draws;
  report.elapsed_s = 100;
  report.draws_per_s = 2000;
  report.draws_per_s_mean = 1000;
  return report;
}

bool holds(const std::string& line, const std::string& part) {
  return line.find(part) != std::string::npos;
}

TEST(ProgressStyle, ABarOnlyWhereSomebodyWatches) {
  using enum ProgressStyle;
  EXPECT_EQ(resolved(automatic, true, false), bar);
  EXPECT_EQ(resolved(automatic, true, true), plain);  // mpirun: not even a terminal says so
  EXPECT_EQ(resolved(automatic, false, false), plain);
  for (const auto style : {plain, bar, json, none}) {
    EXPECT_EQ(resolved(style, false, true), style);
    EXPECT_EQ(resolved(style, true, false), style);
  }
}

TEST(ProgressText, PlainSaysEverything) {
  const std::string line = plain_line(report(100000, 300000));
  for (const char* part : {"1 min 40 s: ", "100000 of 400000 draws", "2000 draws/s",
                           "100 accepted (0.1 %)", "best 172 deg (draw 345)", "2 min 30 s left"}) {
    EXPECT_TRUE(holds(line, part)) << part << " is not in: " << line;
  }
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(ProgressText, WhatIsNotKnownIsNotSaid) {
  ProgressReport none = report(0, 1000);
  none.counts.standing = {};
  none.draws_per_s = none.draws_per_s_mean = none.elapsed_s = 0;
  for (const std::string& line : {plain_line(none), bar_line(none, 200)}) {
    EXPECT_FALSE(holds(line, "best")) << line;
    EXPECT_FALSE(holds(line, "left")) << line;
    EXPECT_FALSE(holds(line, "nan") || holds(line, "inf")) << line;
  }
  ProgressReport endless = report(1000, schema::kEndOfDraws - 1000);
  endless.counts.limited = false;
  for (const std::string& line : {plain_line(endless), bar_line(endless, 200)}) {
    EXPECT_FALSE(holds(line, " of ") || holds(line, "left")) << line;
  }
  EXPECT_TRUE(schema::Json::parse(json_line(endless))["draws_left"].is_null());
  EXPECT_TRUE(schema::Json::parse(json_line(none))["best"].is_null());
  EXPECT_TRUE(schema::Json::parse(json_line(none))["rate"].is_null());
}

// Of populations: their number, and what is under way; no share of accepted ones.
TEST(ProgressText, CountsPopulations) {
  ProgressReport climbing = report(3, 97);
  climbing.counts.of = "populations";
  climbing.counts.under_way = "population 3 at level 2 of 10";
  climbing.counts.standing.accepted = 5463;
  const std::string bar = bar_line(climbing, 200), plain = plain_line(climbing);
  for (const char* part :
       {"3 of 100 populations", "population 3 at level 2 of 10", "best 172 deg", "left"}) {
    EXPECT_TRUE(holds(plain, part)) << part << " is not in: " << plain;
    EXPECT_TRUE(holds(bar, part)) << part << " is not in: " << bar;
  }
  for (const std::string& line : {bar, plain}) {
    EXPECT_FALSE(holds(line, "draws")) << line;
    EXPECT_EQ(line.find("accepted ("), std::string::npos) << line;
  }
  climbing.counts.under_way.clear();
  EXPECT_TRUE(holds(bar_line(climbing, 200), "between populations"));
  const schema::Json json = schema::Json::parse(json_line(climbing));
  EXPECT_EQ(json["populations"], 3);
  EXPECT_EQ(json["populations_left"], 97);
  EXPECT_EQ(json["under_way"], climbing.counts.under_way);
  EXPECT_FALSE(json.contains("draws") || json.contains("rate"));
}

TEST(ProgressText, OfCertificatesNothingIsAccepted) {
  ProgressReport some = report(300, 700);
  some.counts.of = "certificates";
  some.counts.standing.best.reset();
  for (const std::string& line : {plain_line(some), bar_line(some, 200)}) {
    EXPECT_TRUE(holds(line, "certificates")) << line;
    EXPECT_TRUE(holds(line, "/s")) << line;
    EXPECT_TRUE(holds(line, " left")) << line;
    EXPECT_FALSE(holds(line, "accepted") || holds(line, "population")) << line;
  }
  for (int width = 0; width < 60; ++width) {
    EXPECT_LE(bar_line(some, width).size(), static_cast<std::size_t>(width));
  }
}

TEST(ProgressText, TheBarFitsAnyWidth) {
  const ProgressReport now = report(12345678, 87654322);
  std::size_t last = 0;
  for (int width = 0; width <= 120; ++width) {
    const std::string line = bar_line(now, width);
    EXPECT_LE(line.size(), static_cast<std::size_t>(width));
    EXPECT_GE(line.size(), last) << "a wider terminal shows less";
    last = line.size();
  }
  const std::string whole = bar_line(now, 120);
  for (const char* part : {"12.3 M of 100 M draws (12 %)", "2.00 k/s", "12.3 k accepted (0.1 %)",
                           "best 172 deg (draw 345)", "12 h 10 min left"}) {
    EXPECT_TRUE(holds(whole, part)) << part << " is not in: " << whole;
  }
  EXPECT_TRUE(holds(bar_line(now, 79), "left")) << "how long it takes is not left out early";
}

TEST(ProgressText, NeverAllDoneBeforeTheEnd) {
  EXPECT_TRUE(holds(bar_line(report(999999999, 1), 120), "(99 %)"));
  EXPECT_TRUE(holds(bar_line(report(1000, 0), 120), "(100 %)"));
  EXPECT_TRUE(holds(bar_line(report(0, 0), 120), "(100 %)"));  // nothing was wanted
}

TEST(ProgressText, ShortNumbersKeepThreeDigits) {
  // Across every border of a unit and of a digit.
  for (const auto& [draws, shown] : std::vector<std::pair<std::uint64_t, std::string>>{
           {0, "0 draws"},
           {999, "999 draws"},
           {1000, "1.00 k draws"},
           {9994, "9.99 k draws"},
           {9996, "10.0 k draws"},
           {99949, "99.9 k draws"},
           {99951, "100 k draws"},
           {999499, "999 k draws"},
           {999501, "1.00 M draws"},
           {9223372036854775807ULL, "9.22 E draws"}}) {
    ProgressReport now = report(draws, 0);
    now.counts.limited = false;
    EXPECT_EQ(bar_line(now, 200).substr(0, shown.size()), shown);
  }
}

TEST(ProgressText, JsonForPrograms) {
  ProgressReport now = report(100000, 300000);
  const schema::Json json = schema::Json::parse(json_line(now));
  const schema::Json expected = {{"elapsed_s", 100.0},
                                 {"draws", 100000},
                                 {"draws_left", 300000},
                                 {"draws_per_s", 2000.0},
                                 {"draws_per_s_mean", 1000.0},
                                 {"accepted", 100},
                                 {"rate", 0.001},
                                 {"best", {{"deploys_from_deg", 172.0}, {"draw", 345}}},
                                 {"left_s", 150.0},
                                 {"last", false}};
  EXPECT_EQ(json, expected);
  EXPECT_EQ(json_line(now).find('\n'), std::string::npos);
  now.last = true;
  EXPECT_TRUE(schema::Json::parse(json_line(now))["last"]);
}

TEST(ProgressText, TheLastLineHasTheMean) {
  ProgressReport last = report(100000, 0);
  last.last = true;
  EXPECT_TRUE(holds(plain_line(last), ", 1000 draws/s")) << plain_line(last);
  EXPECT_FALSE(holds(plain_line(last), "left")) << plain_line(last);
}

// A run that may take three minutes does not say that it has hours left.
TEST(ProgressText, TimeLeftKnowsTheRunsEnd) {
  ProgressReport now = report(100000, 300000);  // 150 s of draws are left, after 100 s
  now.counts.max_time_s = 160;
  for (const std::string& line : {plain_line(now), bar_line(now, 200)}) {
    EXPECT_TRUE(holds(line, "1 min 0 s left")) << line;
  }
  EXPECT_EQ(schema::Json::parse(json_line(now))["left_s"], 60);
  now.counts.max_time_s = 1000;  // the draws are done before
  EXPECT_EQ(schema::Json::parse(json_line(now))["left_s"], 150);
  now.counts.limited = false;  // no end of draws, or no speed yet: the time's is known
  EXPECT_EQ(schema::Json::parse(json_line(now))["left_s"], 900);
  EXPECT_TRUE(holds(plain_line(now), "15 min 0 s left")) << plain_line(now);
  now.counts.max_time_s = 90;
  EXPECT_EQ(schema::Json::parse(json_line(now))["left_s"], 0);
}

TEST(RecentSpeed, IsThatOfTheLastSeconds) {
  RecentSpeed speed;
  EXPECT_EQ(speed.draws_per_s(), 0);
  // 100 draws/s, handed in every 5 s; looked at five times a second.
  for (int k = 1; k <= 500; ++k) {
    const double now_s = 0.2 * k;
    speed.see(now_s, static_cast<std::uint64_t>(now_s / 5 + 1e-9) * 500);
    if (now_s > 15) {
      EXPECT_NEAR(speed.draws_per_s(), 100, 35) << now_s;
    }
  }
  // From now on none: after a while that shows, which a mean of 100 s would hide.
  for (int k = 501; k <= 600; ++k) speed.see(0.2 * k, 10000);
  EXPECT_EQ(speed.draws_per_s(), 0);
}

TEST(WorkLine, SaysWhatIsKnown) {
  EXPECT_EQ(work_line({"contact is under way", 0, 0, 12, 12}), "12 s: contact is under way");
  EXPECT_EQ(work_line({"sheets let go", 40, 0, 12, 10}), "12 s: 40 sheets let go");
  // 30 s for 40 of 200: 120 s for the others.
  EXPECT_EQ(work_line({"sheets written", 40, 200, 62, 30}),
            "1 min 2 s: 40 of 200 sheets written, 2 min 0 s left");
  EXPECT_EQ(work_line({"sheets written", 0, 200, 62, 30}), "1 min 2 s: 0 of 200 sheets written");
  EXPECT_EQ(work_line({"sheets written", 200, 200, 62, 30}),
            "1 min 2 s: 200 of 200 sheets written");
}

TEST(RecentSpeed, TwoLooksAtOnce) {
  RecentSpeed speed;
  speed.see(0, 10);
  speed.see(0, 20);
  EXPECT_EQ(speed.draws_per_s(), 0);  // not known
  speed.see(1, 120);
  speed.see(1, 120);
  EXPECT_TRUE(std::isfinite(speed.draws_per_s()));
  EXPECT_NEAR(speed.draws_per_s(), 110, 15);
}

}  // namespace
}  // namespace misalign::search
