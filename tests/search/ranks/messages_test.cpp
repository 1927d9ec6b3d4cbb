#include "search/ranks/messages.hpp"

#include <gtest/gtest.h>

#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/metric_table.hpp"

namespace misalign::search {
namespace {

// Ranks compare it: a metric more, elsewhere or of another type makes it another one.
TEST(Messages, LayoutNamesEveryMetricWithItsSizeInOrder) {
  const std::string layout = message_layout();
  std::size_t last = 0;
  for (const schema::MetricEntry& entry : schema::metric_table()) {
    const std::size_t at = layout.find(" " + std::string(entry.name) + ":");
    ASSERT_NE(at, std::string::npos) << entry.name;
    EXPECT_GT(at, last) << entry.name;
    last = at;
  }
  EXPECT_NE(layout.find("deploys_from_sample:4"), std::string::npos);
  EXPECT_NE(layout.find("miscut_margin_mm:16"), std::string::npos);
}

TEST(Messages, AUnitArrivesAsItWasSent) {
  schema::UnitRecord unit;
  unit.range = {schema::kEndOfDraws - 10, schema::kEndOfDraws};
  unit.accepted = 2;
  unit.rejected = 7;
  unit.seconds = 0.125;
  unit.tables_deg = 130.5;
  for (const std::uint64_t draw : {1ULL, 2ULL}) {
    solver::Metrics metrics{};
    int next = 100;  // every metric another number, or none
    schema::each_metric(metrics, [&](const auto&, auto& value) {
      ++next;
      if constexpr (requires { value.reset(); }) {
        if (draw == 1) value = next + 1 / 3.0;
      } else {
        value = static_cast<std::decay_t<decltype(value)>>(next + 1 / 3.0);
      }
    });
    metrics.elongation = {0.1, -0.2, 1e-300};
    unit.candidates.push_back({draw, metrics, Eigen::Matrix2Xd::Random(2, 49)});
  }
  unit.candidates[1].certificate = {
      2, 120.5, 170, "reversal", "A10-A18", true, 31, 0.5, std::string("\0proof", 6), "hash"};
  unit.candidates[0].ascent = {0.25, {}, 7, 31, "most_steps", "{}"};
  unit.undecided.push_back({9, {3, solver::Fault::undecided, -1, solver::PathEnd::stalled}});
  unit.fault_sample.push_back({1024, {7, solver::Fault::not_monotone, 5}});
  unit.screened = {{{4, 12}, 3}, {{1, 0}, 1ULL << 60}};

  EXPECT_FALSE(unpack_unit(pack({unit, false})).was_stopped);
  const SentUnit sent_back = unpack_unit(pack({unit, true}));
  EXPECT_TRUE(sent_back.was_stopped);
  const schema::UnitRecord& got = sent_back.unit;
  EXPECT_EQ(got.range, unit.range);
  EXPECT_EQ(got.accepted, 2u);
  EXPECT_EQ(got.rejected, 7u);
  EXPECT_EQ(got.seconds, 0.125);
  EXPECT_EQ(got.tables_deg, 130.5);
  ASSERT_EQ(got.candidates.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    const solver::Metrics &sent = unit.candidates[k].metrics, &came = got.candidates[k].metrics;
    EXPECT_EQ(got.candidates[k].draw, unit.candidates[k].draw);
    EXPECT_EQ(came.deploys_from_sample, 101);
    EXPECT_EQ(schema::metrics_json(came), schema::metrics_json(sent));
    EXPECT_EQ(came.elongation, sent.elongation);
    EXPECT_EQ(got.candidates[k].shifts_mm, unit.candidates[k].shifts_mm);
    EXPECT_EQ(got.candidates[k].certificate, unit.candidates[k].certificate);
    EXPECT_EQ(got.candidates[k].ascent, unit.candidates[k].ascent);
  }
  ASSERT_EQ(got.undecided.size(), 1u);
  EXPECT_EQ(got.undecided[0].verdict.path_end, solver::PathEnd::stalled);
  ASSERT_EQ(got.fault_sample.size(), 1u);
  EXPECT_EQ(got.fault_sample[0].draw, 1024u);
  EXPECT_EQ(got.fault_sample[0].verdict.where, 5);
  EXPECT_EQ(got.screened, unit.screened);
}

TEST(Messages, ALengthThatMpiCannotCountIsRefused) {
  EXPECT_EQ(message_length(100, 100), 100);
  EXPECT_EQ(message_length(0x7fffffff), 0x7fffffff);
  constexpr std::pair<std::size_t, std::size_t> kTooLong[] = {
      {101, 100}, {0x80000000, 0x7fffffff}, {5ULL << 30, 0x7fffffff}};
  for (const auto& [bytes, most] : kTooLong) {
    try {
      message_length(bytes, most);
      ADD_FAILURE() << bytes << " were sent";
    } catch (const schema::UserError& error) {
      EXPECT_EQ(error.cause(), schema::Cause::failure);
      EXPECT_NE(std::string(error.what()).find("unit_draws"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace misalign::search
