// The search method "optimise": its keys, and what a catalogue keeps of it.
#include "schema/campaign/optimisation.hpp"

#include "schema/catalogue/ledger_check.hpp"
#include "schema/catalogue/named_queries.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "tests/schema/campaign_faults.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kFriction = "critical_friction_n_mm_per_mm";

Json optimising(const Json& patch = Json::object()) {
  Json value = with("{}");
  value["search"] = {{"method", "optimise"}, {"from_deg", 36}};
  value["search"].update(patch);
  return value;
}

TEST(Optimisation, IsReadAndWritten) {
  const Campaign campaign = read(
      optimising({{"subject_to",
                   {"miscut_margin_mm>=5e-2", " stroke_max <= 0.0600 ", "largest_force_n <= 20"}},
                  {"stiffness_n_per_mm", 2},
                  {"preload_n", 0.5},
                  {"grid_mm", 0.01},
                  {"least_slope_mm_per_deg", 0},
                  {"most_steps", 7u}}));
  const Optimisation& search = *campaign.search.optimisation;
  EXPECT_FALSE(campaign.search.splitting);
  EXPECT_TRUE(campaign.search.stores_sheets());
  EXPECT_EQ(search.goal, solver::goal_named("critical_friction_n_mm_per_mm"));
  EXPECT_EQ(search.bounds.stroke_max, 0.06);
  EXPECT_EQ(search.bounds.largest_force_n, 20);
  ASSERT_EQ(search.bounds.floors.size(), 1u);
  EXPECT_EQ(search.bounds.floors[0],
            (solver::OptimiseFloor{solver::goal_named("miscut_margin_mm"), 0.05}));
  EXPECT_EQ(search.most_steps, 7u);
  const Json json = campaign_json(campaign);
  EXPECT_EQ(json["search"]["subject_to"],
            Json({"stroke_max <= 0.06", "largest_force_n <= 20", "miscut_margin_mm >= 0.05"}));
  EXPECT_EQ(campaign_json(read(json)), json);
  EXPECT_EQ(identity(read(json)), identity(campaign));
  EXPECT_EQ(campaign_json(read(stored_configuration(campaign))), json);
}

// Both methods at once: populations find what is made better.
TEST(Optimisation, BeginsWithWhatPopulationsFind) {
  const Campaign campaign = read(optimising({{"starts", "splitting"},
                                             {"levels_deg", {150, 165}},
                                             {"particles", 50u},
                                             {"starts_of_population", 3u}}));
  ASSERT_TRUE(campaign.search.splitting && campaign.search.optimisation);
  EXPECT_EQ(campaign.search.splitting->levels_deg, (std::vector<double>{150, 165, 170}));
  EXPECT_EQ(campaign.search.optimisation->starts_of_population, 3u);
  const Json json = campaign_json(campaign);
  EXPECT_EQ(json["search"]["method"], "optimise");
  EXPECT_EQ(json["search"]["starts"], "splitting");
  EXPECT_EQ(campaign_json(read(json)), json);
  EXPECT_EQ(campaign_json(read(stored_configuration(campaign))), json);
  EXPECT_EQ(identity(read(json)), identity(campaign));
  // What it leaves out is as it was.
  EXPECT_EQ(identity(read(optimising({{"starts", "draws"}, {"starts_of_population", 16u}}))),
            identity(read(optimising())));
  EXPECT_FALSE(identity_json(read(optimising()))["search"].contains("starts"));
}

// What decides where a start ends is in the identity, each key; how it is written is not.
TEST(Optimisation, IsPartOfTheIdentity) {
  std::map<std::string, std::string> seen = {{identity(read(with("{}"))), "plain"}};
  const Json patches[] = {{},
                          {{"maximise", "miscut_margin_mm"}},
                          {{"subject_to", {"stroke_max <= 0.06"}}},
                          {{"subject_to", {"stroke_max <= 0.061"}}},
                          {{"subject_to", {"miscut_margin_mm >= 0.06"}}},
                          {{"from_deg", 37}},
                          {{"stiffness_n_per_mm", 49}},
                          {{"preload_n", 1}},
                          {{"shifts", "ternary"}},
                          {{"grid_mm", 0.1}},
                          {{"least_slope_mm_per_deg", 0.002}},
                          {{"most_steps", 199u}},
                          {{"starts", "splitting"}},
                          {{"starts", "splitting"}, {"starts_of_population", 17u}},
                          {{"starts", "splitting"}, {"particles", 17u}}};
  for (const Json& patch : patches) {
    const Json value = optimising(patch.is_null() ? Json::object() : patch);
    const auto [at, is_new] = seen.try_emplace(identity(read(value)), patch.dump());
    EXPECT_TRUE(is_new) << patch << " is the same as " << at->second;
  }
  EXPECT_EQ(identity(read(optimising({{"subject_to", {"stroke_max<=6e-2"}}}))),
            identity(read(optimising({{"subject_to", {"stroke_max <= 0.06"}}}))));
  // Catalogues of other methods are written as they were.
  EXPECT_FALSE(stored_configuration(read(with("{}"))).contains("search"));
  const Json splitting = stored_configuration(read(with(R"({"search": {"method": "splitting"}})")));
  EXPECT_FALSE(splitting["search"].contains("maximise"));
}

TEST(Optimisation, BoundsOfDistancesAreUpperOnes) {
  OptimiseBounds bounds;
  EXPECT_FALSE(add_bound("shape_max_mm <= 0.5", bounds));
  ASSERT_EQ(bounds.floors.size(), 1u);
  EXPECT_EQ(bounds.floors[0].goal->in_unit(bounds.floors[0].least), 0.5);
  EXPECT_EQ(bounds_json(bounds), Json({"shape_max_mm <= 0.5"}));
  const auto fault = add_bound("shape_rms_mm >= 0.5", bounds);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->why, "shape_rms_mm needs an upper bound");
}

TEST(Optimisation, WhatCannotBeIsSaid) {
  const std::pair<Json, std::vector<std::string>> kSaid[] = {
      {{{"maximise", "critical_friction"}},
       {"search.maximise", "did you mean critical_friction_n_mm_per_mm?"}},
      {{{"maximise", "static_friction_n_mm_per_mm"}}, {"libraries", "misalign optimise"}},
      {{{"subject_to", "stroke_max <= 0.06"}}, {"is no list", "[\"stroke_max <= 0.06\"]"}},
      {{{"subject_to", {"stroke_max < 0.06"}}}, {"is no constraint"}},
      {{{"subject_to", {"stroke_max <= 1e"}}}, {"is no constraint"}},
      {{{"subject_to", {"stroke_max >= 0.06"}}}, {"needs an upper bound", "stroke_max <="}},
      {{{"subject_to", {"miscut_margin_mm <= 0.06"}}}, {"needs a lower bound"}},
      {{{"subject_to", {"strokemax <= 0.06"}}}, {"did you mean stroke_max?"}},
      {{{"subject_to", {"stroke_max <= 2"}}}, {"between 1e-06 and 1"}},
      {{{"subject_to", {"stroke_max <= 0.06", "stroke_max <= 0.05"}}}, {"twice"}},
      {{{"subject_to", {"static_friction_n_mm_per_mm >= 1"}}}, {"libraries"}},
      {{{"subject_to", {std::string(kFriction) + " >= 0.01"}}}, {"is the objective already"}},
      {{{"subject_to", {7}}}, {"is no text"}},
      {{{"from_deg", nullptr}}, {"search.from_deg", "36"}},
      {{{"maximise", "energy_n_mm"}, {"from_deg", nullptr}}, {"search.from_deg"}},
      {{{"from_deg", 171}}, {"lies above accept.deploys_from_deg = 170"}},
      {{{"maximise", "miscut_margin_mm"},
        {"from_deg", nullptr},
        {"subject_to", {"largest_force_n <= 20"}}},
       {"search.from_deg"}},
      {{{"shifts", "binary"}}, {"free"}},
      {{{"shifts", "ternary"}, {"grid_mm", 0.1}}, {"applies only to free shifts"}},
      {{{"grid_mm", 0.03}}, {"does not divide misalignment.amplitude_mm = 0.4"}},
      {{{"most_steps", 0u}}, {"leaves every draw as it is"}},
      {{{"method", "plain"}}, {"has no objective, constraints"}},
      {{{"method", "splitting"}}, {"has no objective, constraints"}},
      {{{"particles", 9u}}, {"search.starts = \"draws\"", "has no levels, particles"}},
      {{{"starts", "levels"}}, {"search.starts", "are no starts", "splitting"}},
      {{{"starts_of_population", 9u}}, {"search.starts = \"draws\"", "are of no population"}},
      {{{"starts", "splitting"}, {"starts_of_population", 0u}}, {"leaves no start"}},
      {{{"starts", "splitting"}, {"levels_deg", {171}}}, {"lies above accept.deploys_from_deg"}},
      {{{"starts", "splitting"}, {"particles", 1u}}, {"search.particles", "at least 2"}},
      {{{"starts", "splitting"}, {"particles", 1000000u}, {"sweeps", 10000u}},
       {"more than a population has numbers for"}},
      {{{"starts", "splitting"}, {"method", "splitting"}}, {"has no objective, constraints"}},
      {{{"starts", "splitting"}, {"method", "plain"}}, {"has no objective, constraints"}}};
  for (const auto& [patch, words] : kSaid) {
    SCOPED_TRACE(patch.dump());
    expect_fault(optimising(patch), words);
  }
  EXPECT_EQ(faults_of(optimising({{"maximise", "x"}, {"subject_to", {"y <= 1"}}, {"shifts", "z"}}))
                .size(),
            3u)
      << "all at once";
  // A margin needs no angle.
  EXPECT_TRUE(
      faults_of(optimising({{"maximise", "miscut_margin_mm"}, {"from_deg", nullptr}})).empty());
}

TEST(Optimisation, FitsHowDrawsAreShifted) {
  const auto with_draws = [](const Json& search, const char* misalignment) {
    Json value = optimising(search);
    value["misalignment"] = Json::parse(misalignment);
    return value;
  };
  expect_fault(with_draws({{"shifts", "ternary"}}, R"({"levels": "uniform"})"), {"uniform"});
  expect_fault(with_draws({{"grid_mm", 0.1}}, R"({"levels": "uniform"})"), {"uniform"});
  EXPECT_TRUE(faults_of(with_draws({{"grid_mm", 0.1}}, R"({"amplitude_mm": 0.3})")).empty());
  EXPECT_TRUE(faults_of(with_draws(Json::object(), R"({"levels": "uniform"})")).empty());
}

// XXH3's canonical order of bytes, in which a sheet's hash is kept.
std::string backwards(const std::string& bytes) { return {bytes.rbegin(), bytes.rend()}; }

// Draws with the sheets at which they end.
class OptimisedCatalogue : public CatalogueTest {
 protected:
  UnitRecord ended(std::uint64_t lo, std::uint64_t hi) const {
    UnitRecord record = unit(lo, hi);
    for (Candidate& one : record.candidates) {
      const double value = static_cast<double>(one.draw % 3);
      one.shifts_mm(1, 9) = 0.1 * value;  // so that there are three ends
      const double start = value / static_cast<double>(2 + one.draw);
      one.ascent = AscentRecord{start, value, 2, 30, "no_step_is_better", "{}"};
      if (one.draw % 3 == 0) one.ascent = AscentRecord{{}, {}, 0, 0, "breaks_a_limit", {}};
    }
    return record;
  }
  Catalogue open_optimising(const std::string& name = "a.db") const {
    return {path(name), optimising_, mechanism_};
  }
  std::vector<std::string> findings(const char* damage) const {
    std::filesystem::copy_file(path(), path("damaged.db"),
                               std::filesystem::copy_options::overwrite_existing);
    SQLite::Database(path("damaged.db"), SQLite::OPEN_READWRITE).exec(damage);
    std::vector<std::string> sentences;
    for (const Finding& finding :
         check_ledger(*open_for_reading(path("damaged.db")), optimising_)) {
      sentences.push_back(finding.sentence);
    }
    return sentences;
  }

  const Campaign optimising_ = read(optimising());
};

TEST_F(OptimisedCatalogue, KeepsWhereDrawsEnd) {
  {
    Catalogue catalogue = open_optimising();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 8192, {}});
    catalogue.commit({ended(0, 4096), ended(4096, 8192)});
  }
  const auto database = open_for_reading(path());
  std::uint64_t candidates = 0, of_none = 0, of_two = 0, first = kEndOfDraws;
  Wide sum = 0;
  for (const UnitRecord& record : {ended(0, 4096), ended(4096, 8192)}) {
    for (const Candidate& one : record.candidates) {
      ++candidates;
      of_none += one.draw % 3 == 0;
      if (one.draw % 3 == 2) {
        ++of_two;
        first = std::min(first, one.draw);
      }
      const std::string sheet = displacements_json(one.shifts_mm).dump();
      sum += xxh3(little_endian(one.draw, 8) +
                  little_endian(static_cast<unsigned>(one.metrics.deploys_from_sample), 4) +
                  backwards(little_endian(xxh3(sheet), 16)));
    }
  }
  const CatalogueState state = read_state(*database);
  EXPECT_EQ(state.digest, hex_of(xxh3(identity(optimising_) + little_endian(0, 8) +
                                      little_endian(8192, 8) + little_endian(candidates, 8) +
                                      little_endian(state.undecided, 8) + little_endian(sum, 16))));
  EXPECT_EQ(state.accepted, candidates);
  ASSERT_TRUE(state.ends);
  EXPECT_EQ(state.ends->goal, kFriction);
  EXPECT_EQ(state.ends->sheets, 3u);
  EXPECT_EQ(state.ends->best, 2);
  EXPECT_EQ(state.ends->kept_as_drawn, of_none);
  const Json ends = Json::parse(query_table(*database, named_query("ends"), TableStyle::json));
  ASSERT_EQ(ends.size(), 3u);
  EXPECT_EQ(ends[0]["end_value"], 2);
  EXPECT_EQ(ends[0]["starts"], of_two);
  EXPECT_EQ(ends[0]["draw"], first);
  EXPECT_EQ(ends[0]["start_value"], 2 / static_cast<double>(2 + first)) << "the first one's";
  EXPECT_EQ(ends[2]["end_value"], nullptr);
  EXPECT_TRUE(check_ledger(*database, optimising_).empty());

  EXPECT_FALSE(findings("DELETE FROM ascent WHERE draw = (SELECT min(draw) FROM ascent)").empty());
  EXPECT_FALSE(
      findings("UPDATE ascent SET end_value = start_value / 2 WHERE start_value > 0").empty());
  EXPECT_FALSE(findings("UPDATE sheet SET hash = zeroblob(16)").empty());
  EXPECT_FALSE(
      findings("UPDATE candidate SET displacements_mm = '{\"A10\":[0.4,0.3]}' WHERE draw = "
               "(SELECT max(draw) FROM candidate)")
          .empty());
}

TEST_F(OptimisedCatalogue, IsJoinedDrawByDraw) {
  for (const auto& [name, lo] : {std::pair{"a.db", 0}, {"b.db", 4096}}) {
    Catalogue catalogue = open_optimising(name);
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 8192, {}});
    const auto first = static_cast<std::uint64_t>(lo);
    catalogue.commit({ended(first, first + 4096)});
  }
  {
    Catalogue all = open_optimising("all.db"), joined = open_optimising("joined.db");
    all.begin_run(kRun, {{0, kEndOfDraws}, 8192, {}});
    all.commit({ended(0, 4096), ended(4096, 8192)});
    joined.take_over(*open_for_reading(path("b.db")), {{4096, 8192}});
    joined.take_over(*open_for_reading(path("a.db")), {{0, 4096}});
    joined.begin_run(kRun, {{0, kEndOfDraws}, 8192, {}});
  }
  EXPECT_EQ(state("joined.db").digest, state("all.db").digest);
  EXPECT_EQ(count("ascent", "joined.db"), count("ascent", "all.db"));
  EXPECT_EQ(count("sheet", "joined.db"), count("candidate", "joined.db"));
}

TEST(UnitRecord, IsAddedBehindAnother) {
  UnitRecord first, next;
  first.range = {10, 20};
  first.accepted = 1;
  first.rejected = 9;
  first.candidates.push_back({12, {}, {}});
  first.screened = {{{1, 2}, 9}};
  next.range = {20, 25};
  next.accepted = 2;
  next.rejected = 2;
  next.candidates = {{20, {}, {}}, {24, {}, {}}};
  next.undecided.push_back({21, {}});
  next.fault_sample.push_back({22, {}});
  next.screened = {{{1, 2}, 1}, {{1, 3}, 1}};
  first.add(std::move(next));
  EXPECT_EQ(first.range, (DrawRange{10, 25}));
  EXPECT_EQ(first.accepted + first.rejected + first.undecided.size(), 15u);
  EXPECT_EQ(first.accepted_draws(), (std::vector<std::uint64_t>{12, 20, 24}));
  EXPECT_EQ(first.fault_sample.size(), 1u);
  EXPECT_EQ((first.screened[{1, 2}]), 10u);
}

}  // namespace
}  // namespace misalign::schema
