// Every family of base patterns: its folding found again by other means and in other steps.
#include "tests/solver/families.hpp"

#include <optional>

#include "solver/continuation/homotopy.hpp"
#include "solver/continuation/path_follower.hpp"
#include "solver/linear/pivot_order.hpp"
#include "tests/solver/vertex_coordinates.hpp"

namespace misalign::solver {
namespace {

constexpr int kSheetsOfEach = kFewer > 1 ? 1 : 4;

class Families : public testing::TestWithParam<std::string> {};

// Diagonals of the paths' every tenth degree to 150 (beyond it another branch may be near, see
// Model) or to the fold limit by the path follower, and from coordinates that start near the base
// folding at 1 degree and know nothing of it afterwards. Closed to 1e-12, lengths are open by 1e-12
// panel widths over the smallest singular value, which is 1e-4 beside a fold limit: 1e-6 mm. But
// the last correction of either solver squares what was left, and 1e-16 does no harm: worst of
// 1,400 paths 2e-11 mm, limit 1e-9.
TEST_P(Families, DiagonalsAreThoseOfVertexCoordinates) {
  const CarriedFamily whole(GetParam());
  double worst_mm = 0;
  for (const CarriedFamily& family : {whole, CarriedFamily(cut_down(whole.base, 4, 4))}) {
    PathPlanOptions options;
    options.sample_deg = 10;
    options.end_deg = std::min(150.0, family.end_deg());
    const Model model(family.base, options);
    const FoldedShape shape(family.base.sheet, family.base.holes, family.mechanism);
    const auto start = base_state(family.mechanism, family.base.folding,
                                  family.base.sheet.vertices_mm, half_angle_of_deg(1));
    SheetGeometry<double> geometry;
    const ShiftBlock block = family.draws(kSheetsOfEach, kSeed);
    for (int i = 0; i < block.sheets; ++i) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", sheet " + std::to_string(i));
      const FlatVertices flat_mm = family.vertices(block, i);
      const auto history = record_history(model, flat_mm);
      EXPECT_GE(history.stations.size(), 5u);
      place(family.mechanism, flat_mm, geometry);
      VertexCoordinates coordinates(family.base, flat_mm, shape.vertices_mm(geometry, start), 1);
      for (std::size_t k = 0; k < history.stations.size(); ++k) {
        ASSERT_TRUE(coordinates.fold_to(history.stations[k].pilot_deg));
        for (int d = 0; d < family.mechanism.diagonal_count(); ++d) {
          const Diagonal& diagonal = family.mechanism.diagonals[d];
          const double difference_mm = coordinates.distance_mm(diagonal.from, diagonal.to) -
                                       history.length_mm(static_cast<Eigen::Index>(k), d);
          worst_mm = std::max(worst_mm, std::abs(difference_mm));
        }
      }
    }
  }
  EXPECT_LE(worst_mm, 1e-9);
  RecordProperty("worst_mm", scientific(worst_mm));
}

/// Diagonals at a pilot angle; nothing where it was no station.
std::optional<Eigen::RowVectorXd> lengths_at(const FoldingHistory& history, double pilot_deg) {
  for (std::size_t k = 0; k < history.stations.size(); ++k) {
    if (std::abs(history.stations[k].pilot_deg - pilot_deg) < 1e-9) {
      return history.length_mm.row(static_cast<Eigen::Index>(k));
    }
  }
  return std::nullopt;
}

std::vector<FoldingHistory> record(const CarriedFamily& family, PathPlanOptions options,
                                   const ShiftBlock& block) {
  options.end_deg = family.end_deg();
  const Model sheets = family.with(options);
  return std::move(make_batch(available_instruction_sets().back(), sheets)->record(block));
}

// Largest difference of a diagonal over the multiples of `every_deg` up to `last_deg` that both
// saw.
double largest_difference_mm(const FoldingHistory& one, const FoldingHistory& other,
                             double every_deg, double last_deg) {
  double largest = 0;
  for (double at_deg = every_deg; at_deg <= last_deg + 1e-9; at_deg += every_deg) {
    const auto here = lengths_at(one, at_deg), there = lengths_at(other, at_deg);
    if (here && there) largest = std::max(largest, (*here - *there).cwiseAbs().maxCoeff());
  }
  return largest;
}

// Every verdict is the same in steps of 0.1 to 20 degrees, and the lengths up to it: worst of
// 280 sheets 4e-11 mm, limit 1e-9. Past the verdict a long step can lead across a gap between two
// curves (see path_follower_test.cpp).
TEST_P(Families, StepsOfTheSolverDoNotMatterSlow) {
  const CarriedFamily whole(GetParam());
  double worst_mm = 0;
  for (const CarriedFamily& family : {whole, CarriedFamily(cut_down(whole.base, 4, 4))}) {
    const ShiftBlock block = family.draws(kSheetsOfEach, kSeed);
    for (const double sample_deg : {1.0, 20.0}) {
      PathPlanOptions usual;
      usual.sample_deg = sample_deg;
      const auto expected = record(family, usual, block);
      for (const double step_deg : {0.1, 0.3, 1.0, 3.0, 7.0, 20.0}) {
        for (const bool look : {false, true}) {
          PathPlanOptions options = usual;
          // Steps longer than a sample are those of the samples.
          if (!look && step_deg > sample_deg) continue;
          (look ? options.look_deg : options.longest_step_deg) = step_deg;
          const auto histories = record(family, options, block);
          for (int i = 0; i < block.sheets; ++i) {
            SCOPED_TRACE("samples " + std::to_string(sample_deg) + ", steps " +
                         std::to_string(step_deg) + ", sheet " + std::to_string(i));
            EXPECT_EQ(decision(histories[i].verdict), decision(expected[i].verdict));
            const double last_deg = sample_deg * (expected[i].verdict.deploys_from_sample + 1);
            worst_mm = std::max(
                worst_mm, largest_difference_mm(histories[i], expected[i], sample_deg, last_deg));
          }
        }
      }
    }
  }
  EXPECT_LE(worst_mm, 1e-9);
  RecordProperty("worst_mm", scientific(worst_mm));
}

// The same of samples of 0.1 to 20 degrees, up to the verdict at 1 degree: worst of 700
// sheets 2e-11 mm.
TEST_P(Families, SamplesDoNotMoveThePathSlow) {
  const CarriedFamily family(GetParam());
  const ShiftBlock block = family.draws(kSheetsOfEach, kSeed);
  std::vector<std::vector<FoldingHistory>> by_sample;
  for (const double sample_deg : {1.0, 0.1, 5.0, 20.0}) {
    PathPlanOptions options;
    options.sample_deg = sample_deg;
    options.longest_step_deg = sample_deg;
    by_sample.push_back(record(family, options, block));
  }
  double worst_mm = 0;
  for (int i = 0; i < block.sheets; ++i) {
    const auto& usual = by_sample[0][i];
    const double last_deg = std::max(20, usual.verdict.deploys_from_sample);
    for (const auto& histories : by_sample) {
      EXPECT_TRUE(lengths_at(histories[i], 20));
      worst_mm = std::max(worst_mm, largest_difference_mm(histories[i], usual, 1, last_deg));
    }
  }
  EXPECT_LE(worst_mm, 1e-9);
  RecordProperty("worst_mm", scientific(worst_mm));
}

// No path needs dense matrices: one of these angle-array sheets opens again at its second step.
TEST_P(Families, FixedOrderFollowsEveryPath) {
  const CarriedFamily family(GetParam());
  PathPlanOptions options;
  options.end_deg = family.end_deg();
  const Model sheets = family.with(options);
  const auto batch = make_batch(available_instruction_sets().back(), sheets);
  for (const Verdict& verdict : batch->judge(family.draws(100 / kFewer, kSeed))) {
    EXPECT_NE(verdict.first_fault, Fault::undecided);
  }
}

/// Follows a plan from a state near its first station, and keeps the states at its stations.
class Walked {
 public:
  Walked(const CarriedFamily& family, const SheetGeometry<double>& geometry, const PathPlan& plan,
         const FoldState<double>& start)
      : elimination_(
            plan_elimination(family.mechanism, family.base.folding, family.base.sheet.vertices_mm)),
        follower_(family.mechanism, elimination_),
        point_(family.mechanism) {
    follower_.follow({&geometry, &start, &plan}, *this);
  }
  PathPoint& point() { return point_; }
  bool wants_slopes() const { return false; }
  bool see(const Station&, int) {
    states.push_back(point_.state);
    return true;
  }
  void ended(const PathResult& result, int) { path = result; }

  std::vector<FoldState<double>> states;
  PathResult path{};

 private:
  const Elimination elimination_;
  PathFollower<double> follower_;
  PathPoint point_;
};

// Up to nine tenths of the way and back down, degree by degree: every crease at every station is
// where it was on the way up. Worst of 1,400 sheets 1.3e-11 rad, limit 1e-10.
TEST_P(Families, ThereAndBackAgain) {
  const CarriedFamily whole(GetParam());
  double worst_rad = 0;
  for (const CarriedFamily& family : {whole, CarriedFamily(cut_down(whole.base, 4, 4))}) {
    PathPlanOptions options;
    options.end_deg = family.end_deg();
    const PathPlan plan = family.plan(options);
    const ShiftBlock block = family.draws(kSheetsOfEach, kSeed);
    const Elimination elimination =
        plan_elimination(family.mechanism, family.base.folding, family.base.sheet.vertices_mm);
    ShiftHomotopy<double> homotopy(family.mechanism, elimination, plan,
                                   family.base.sheet.vertices_mm);
    StartFinder::FarStart start(family.mechanism);
    const SheetGeometry<double>& geometry = start.geometry;
    for (int i = 0; i < block.sheets; ++i) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", sheet " + std::to_string(i));
      place(family.mechanism, family.vertices(block, i), start.geometry);
      homotopy.find({&start, 1});
      ASSERT_EQ(start.end, PathEnd::end_reached);
      const Walked up(family, geometry, plan, start.state);
      const auto stations =
          static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(up.states.size()));
      ASSERT_GE(stations, 45);
      PathPlan down;
      down.stations.assign(plan.stations.rend() - stations, plan.stations.rend());
      const Walked back(family, geometry, down, up.states[stations - 1]);
      ASSERT_EQ(back.path.end, PathEnd::end_reached);
      for (std::ptrdiff_t k = 0; k < stations; ++k) {
        const double turn = largest_half_sine(up.states[k], back.states[stations - 1 - k]);
        worst_rad = std::max(worst_rad, 2 * turn);
      }
    }
  }
  EXPECT_LE(worst_rad, 1e-10);
  RecordProperty("worst_rad", scientific(worst_rad));
}

INSTANTIATE_TEST_SUITE_P(Carried, Families, testing::ValuesIn(carried_families()), family_word);

}  // namespace
}  // namespace misalign::solver
