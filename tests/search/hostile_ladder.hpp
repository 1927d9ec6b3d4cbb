// A catalogue of a splitting search to be made to lie, and all who read one.
#pragma once

#include <gtest/gtest.h>

#include <limits>

#include "schema/catalogue/named_queries.hpp"
#include "schema/catalogue/status_json.hpp"
#include "search/checks/merge.hpp"
#include "search/checks/verification_text.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/choice.hpp"
#include "search/terminal/ladder_text.hpp"
#include "search/terminal/status_text.hpp"
#include "tests/folder.hpp"
#include "tests/schema/catalogue_fixture.hpp"
#include "tests/search/climb_on.hpp"

namespace misalign::search {

class HostileLadder : public testing::Test {
 protected:
  // Two populations are done, of a third its first draws and level 1.
  void SetUp() override {
    climb(good_, 3, 2 * 5 + 3);  // a block at level 0, two at each above
    climb(whole_, 3);
    bytes_ = bytes_of(good_);
    digest_ = digest_of(whole_);
    ASSERT_EQ(rows("unit"), 2);
    ASSERT_EQ(rows("population"), 6);
    ASSERT_EQ(rows("piece"), 2);
  }

  std::int64_t rows(const std::string& table) const {
    return schema::open_for_reading(good_)->execAndGet("SELECT count(*) FROM " + table).getInt64();
  }
  static std::string digest_of(const std::string& path) {
    return schema::read_state(*schema::open_for_reading(path)).digest;
  }

  // So many populations are wanted, and at most so many blocks done.
  void climb(const std::string& path, std::uint64_t populations,
             int blocks = std::numeric_limits<int>::max()) {
    climb_on(path, climber_, schema::kRun, populations, blocks);
  }

  // The good one with these statements done to it, past keys and checks.
  std::string attacked(const std::string& sql) const {
    const std::string path = folder_.file("bad.db", bytes_);
    schema::change_rows(path, sql);
    return path;
  }

  // The sentence with which `work` ends, which has this cause; empty if it comes to its end.
  template <class Work>
  static std::string refused(const Work& work, schema::Cause cause = schema::Cause::bad_input) {
    try {
      work();
      return "";
    } catch (const schema::UserError& error) {
      EXPECT_EQ(error.cause(), cause) << error.what();
      return error.what();
    }
  }

  static void look(const std::string& path) {
    const auto database = schema::open_for_reading(path);
    for (const std::string& name : schema::named_queries()) {
      schema::query_table(*database, schema::named_query(name), schema::TableStyle::csv);
    }
    schema::query_table(*database, "SELECT * FROM ladder", schema::TableStyle::csv);
    const schema::CatalogueState state = schema::read_state(*database);
    EXPECT_LT(status_text(state, {}, Paint(false)).size(), 5000u);
    status_json(state).dump();
    ladder_json(state).dump();
    ladder_summary(state);
    next_step(state, path, "");
    if (state.ladder->levels.empty()) return;
    const std::string levels =
        schema::query_table(*database, ladder_sql(*state.ladder), schema::TableStyle::csv);
    EXPECT_EQ(std::ranges::count(levels, '\n'), 4);
  }
  static void take_out(const std::string& path) {
    const auto database = schema::open_for_reading(path);
    const schema::Campaign campaign = schema::read_campaign_of(*database, path);
    Choice choice;
    choice.best = 1000;
    for (const std::uint64_t draw : chosen_draws(*database, choice)) {
      shifts_of_number(*database, campaign, draw);
    }
  }
  std::string joined(const std::vector<std::string>& inputs) const {
    const std::string output = folder_.file("joined.db");
    std::filesystem::remove(output);
    std::string said;
    const std::string why = refused([&] {
      const MergeReport report = merge({output, inputs, schema::kRun, schema::Builds::same});
      for (const schema::Finding& finding : report.findings) said += finding.sentence + "\n";
    });
    return said + why;
  }
  static std::string verified(const std::string& path, std::uint64_t units = 0) {
    std::string said;
    const Verification found =
        verify(*schema::open_for_reading(path), path, {.sample = 1, .units = units});
    for (const schema::Finding& finding : found.findings) said += finding.sentence + "\n";
    EXPECT_NE(verification_text(found), "");
    return said;
  }

  void expect_word(const std::string& said, const std::string& word, const std::string& by) const {
    const std::string shown = by + " said: " + said.substr(0, 500);
    EXPECT_NE(said.find(word), std::string::npos) << shown;
    EXPECT_NE(said.find(folder_.file("bad.db")), std::string::npos) << shown;
  }
  // By all who read what became of populations.
  void expect_refused(const std::string& sql, const std::string& word) {
    SCOPED_TRACE(sql);
    const std::string path = attacked(sql);
    expect_word(refused([&] { look(path); }), word, "status");
    expect_word(verified(path), word, "verify");
    expect_word(joined({whole_, path}), "", "merge");  // it may have found something before
    EXPECT_FALSE(std::filesystem::exists(folder_.file("joined.db")));
    expect_word(refused([&] { climb(path, 3); }), word, "search");
  }

  const Folder folder_{"hostile_ladder"};
  const std::string good_ = folder_.file("good.db"), whole_ = folder_.file("whole.db");
  const schema::Campaign campaign_ = quick_climb();
  Climber climber_{campaign_, widest_set()};
  std::string bytes_, digest_;
};

}  // namespace misalign::search
