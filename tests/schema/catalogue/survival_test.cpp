// Survival by angle against made-up curves whose every share is known.
#include "schema/catalogue/survival.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

struct SampledRow {
  int sample;
  double weight;
};

Survival survival_of(const std::vector<SampledRow>& rows) {
  Survival survival(1, 180);
  for (const SampledRow& row : rows) survival.add(row.sample, WeightedCount::of(1, row.weight));
  return survival;
}

TEST(Survival, IsACountOfTheDraws) {
  std::mt19937_64 random(21);
  std::vector<SampledRow> rows;
  for (int k = 0; k < 400; ++k) {
    rows.push_back(
        {static_cast<int>(random() % 150), std::ldexp(1024, static_cast<int>(random() % 4))});
  }
  const Survival survival = survival_of(rows);
  const auto naive = [&](int sample) {
    double all = 0, deep = 0;
    for (const SampledRow& row : rows) {
      all += row.weight;
      if (row.sample >= sample) deep += row.weight;
    }
    return deep / all;
  };
  int deepest = 0;
  for (const SampledRow& row : rows) deepest = std::max(deepest, row.sample);
  EXPECT_EQ(survival.deepest(), deepest);
  for (int sample = 0; sample <= 180; ++sample) {
    EXPECT_NEAR(share(survival.from(sample), survival.all()), naive(sample), 1e-12);
  }
  for (const double wanted : {0.5, 0.1, 0.02}) {
    int expected = 0;
    for (int sample = 0; sample <= 180; ++sample) {
      if (naive(sample) >= wanted) expected = sample;
    }
    EXPECT_EQ(survival.sample_of_share(wanted), expected) << wanted;
  }
  EXPECT_EQ(survival.sample_of_share(0.001), std::nullopt);  // less than one row in a thousand
}

TEST(Survival, TooFewDrawsSayNothing) {
  EXPECT_EQ(survival_of({}).guess(170), std::nullopt);
  EXPECT_EQ(survival_of({}).sample_of_share(0.5), std::nullopt);
  EXPECT_EQ(survival_of({}).deepest(), 0);
  EXPECT_EQ(survival_of({}).sample_to_try(0.001), std::nullopt);
  EXPECT_EQ(survival_of({{40, 1024}, {50, 1024}}).guess(170), std::nullopt);
  // A quarter of 31 draws is no tail, of 32 it is.
  std::vector<SampledRow> few;
  for (int k = 0; k < 31; ++k) few.push_back({50 + k, 1024});
  EXPECT_EQ(survival_of(few).guess(170), std::nullopt);
  few.push_back({100, 1024});
  EXPECT_NE(survival_of(few).guess(170), std::nullopt);
  // All of them fail before the first sample.
  EXPECT_EQ(survival_of(std::vector<SampledRow>(100, {0, 1024})).guess(170), std::nullopt);
  // Outside the path: its ends.
  EXPECT_EQ(survival_of({{-7, 1024}, {999, 1024}}).deepest(), 180);
}

// Curves that fall as a power of tan(angle / 2): P(deploys from A or more) = (t0 / t)^power.
class ParetoCurve {
 public:
  ParetoCurve(double from_deg, double power) : t0_(t(from_deg)), power_(power) {}
  double share_from(double deg) const { return std::min(1.0, std::pow(t0_ / t(deg), power_)); }
  int some_sample(std::mt19937_64& random) const {
    const double u = 1 - std::uniform_real_distribution(0.0, 1.0)(random);
    const double deg = 2 * std::atan(t0_ * std::pow(u, -1 / power_)) * 180 / std::numbers::pi;
    return static_cast<int>(std::floor(deg));
  }

 private:
  static double t(double deg) { return std::tan(deg * std::numbers::pi / 360); }
  double t0_, power_;
};

TEST(Survival, GuessesOfCurvesThatAreKnown) {
  for (const auto& [from_deg, power, asked_sample] :
       {std::tuple{40.0, 2.0, 175}, std::tuple{90.0, 4.0, 175}, std::tuple{20.0, 3.0, 150},
        std::tuple{130.0, 6.0, 170}}) {
    const ParetoCurve curve(from_deg, power);
    for (const bool mixed : {false, true}) {
      int held = 0;
      double log_off = 0;
      constexpr int kTimes = 200;
      for (unsigned seed = 0; seed < kTimes; ++seed) {
        std::mt19937_64 random(seed);
        std::vector<SampledRow> rows;
        for (int k = 0; k < 600; ++k) {
          rows.push_back({curve.some_sample(random), k < 300 && mixed ? 1024.0 : 2048.0});
        }
        const Survival survival = survival_of(rows);
        const auto guess = survival.guess(asked_sample);
        ASSERT_TRUE(guess);
        const double truth = curve.share_from(asked_sample);
        held += guess->low <= truth && truth <= guess->high;
        log_off += std::log(guess->rate / truth);
        ASSERT_LT(guess->low, guess->rate);
        ASSERT_LE(guess->rate, guess->high);
      }
      EXPECT_GT(held, 0.85 * kTimes) << power << " " << mixed;
      EXPECT_LT(std::abs(log_off / kTimes), std::log(2)) << power << " " << mixed;
    }
  }
}

// What to try: the angle that a thousandth of the draws survives, whether seen or guessed.
TEST(Survival, OneInAThousand) {
  const ParetoCurve curve(40, 3);
  for (const int draws : {300, 20000}) {
    std::mt19937_64 random(5);
    std::vector<SampledRow> rows;
    for (int k = 0; k < draws; ++k) rows.push_back({curve.some_sample(random), 1024});
    const Survival survival = survival_of(rows);
    const auto sample = survival.sample_to_try(0.001);
    ASSERT_TRUE(sample);
    EXPECT_GT(curve.share_from(*sample), 0.001 / 4) << draws;
    EXPECT_LT(curve.share_from(*sample), 0.001 * 4) << draws;
  }
}

using SurvivalOfCatalogue = CatalogueTest;

// By SQL alone, and from a catalogue whose program gave all rows 1024 draws to stand for.
TEST_F(SurvivalOfCatalogue, ReadsRowsWithTheirWeights) {
  const std::string old =
      std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/catalogue-7-from-3.db";
  const Campaign campaign = read_campaign_of(*open_for_reading(old), old);
  const Survival before = read_survival(*open_for_reading(old));
  EXPECT_EQ(before.all().rows, 3u);
  EXPECT_EQ(before.all().draws, 3 * 1024);
  EXPECT_EQ(before.deepest(), 178);
  std::filesystem::copy_file(old, path());
  { Catalogue catalogue(path(), campaign, mechanism_of(campaign)); }
  SQLite::Database(path(), SQLite::OPEN_READWRITE)
      .exec("UPDATE fault_sample SET stands_for = 4096 WHERE draw = 268435456");
  const Survival after = read_survival(*open_for_reading(path()));
  EXPECT_EQ(after.all().draws, 6 * 1024);
  EXPECT_EQ(after.from(105).draws, 2 * 1024);
  EXPECT_EQ(after.from(104).draws, 6 * 1024);
}

}  // namespace
}  // namespace misalign::schema
