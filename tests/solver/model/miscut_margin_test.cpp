// The miscut margin, against another solver's differences, and in lanes against the scalar code.
#include "solver/model/miscut_margin.hpp"

#include <limits>
#include <xsimd/xsimd.hpp>

#include "solver/kinematics/lane_state.hpp"
#include "solver/linear/pivot_order.hpp"
#include "tests/solver/blocks.hpp"
#include "tests/solver/vertex_coordinates.hpp"

namespace misalign::solver {
namespace {

constexpr int kThreshold = 110;

TEST(MarginSamples, EndAtTheThreshold) {
  EXPECT_EQ(margin_samples(1, 170), (std::vector{20, 40, 60, 80, 100, 120, 140, 160, 170}));
  EXPECT_EQ(margin_samples(1, 60), (std::vector{20, 40, 60}));
  EXPECT_EQ(margin_samples(1, 7), (std::vector{7}));
  EXPECT_EQ(margin_samples(0.5, 100), (std::vector{40, 80, 100}));
  EXPECT_EQ(margin_samples(45, 3), (std::vector{1, 2, 3}));
  // Where the factors are worth nothing nothing is asked of them.
  EXPECT_EQ(margin_samples(1, 180).back(), 179);
  EXPECT_EQ(margin_samples(45, 4), (std::vector{1, 2, 3}));
}

// Lengths (mm) of the diagonals of a sheet that is cut like this, its pilot held, from vertex
// coordinates alone.
Eigen::VectorXd lengths_of(const TestSheet& sheet, const FlatVertices& flat_mm,
                           const Eigen::Matrix3Xd& near_mm, double pilot_deg) {
  Eigen::VectorXd lengths_mm(sheet.mechanism.diagonal_count());
  if (pilot_deg == 0) {
    for (int d = 0; d < lengths_mm.size(); ++d) {
      const Diagonal& diagonal = sheet.mechanism.diagonals[d];
      lengths_mm[d] = (flat_mm.col(diagonal.from) - flat_mm.col(diagonal.to)).norm();
    }
    return lengths_mm;
  }
  const VertexCoordinates folded(sheet.base, flat_mm, near_mm, pilot_deg);
  for (int d = 0; d < lengths_mm.size(); ++d) {
    const Diagonal& diagonal = sheet.mechanism.diagonals[d];
    lengths_mm[d] = folded.distance_mm(diagonal.from, diagonal.to);
  }
  return lengths_mm;
}

// Least move over root of the sum of squares of its differences, every stretch and diagonal.
double margin_by_differences_mm(const TestSheet& sheet, const FlatVertices& flat_mm) {
  constexpr double kStep_mm = 0.01;
  const FoldedShape shape(sheet.base.sheet, sheet.base.holes, sheet.mechanism);
  SheetGeometry<double> geometry;
  place(sheet.mechanism, flat_mm, geometry);
  std::map<int, Eigen::Matrix3Xd> folded_mm;
  const StationVisitor keep_shape = [&](const Station& station, const PathPoint& point) {
    folded_mm[station.sample] = shape.vertices_mm(geometry, point.state);
  };
  record_history(Model(sheet.base), flat_mm, &keep_shape);
  Eigen::VectorXd last_mm;
  Eigen::MatrixXd last_rows;
  double least_mm = 1e9;
  for (const int sample : {0, 20, 40, 60, 80, 100, 110}) {
    const Eigen::Matrix3Xd& near_mm = folded_mm[sample];
    const Eigen::VectorXd lengths_mm = lengths_of(sheet, flat_mm, near_mm, sample);
    Eigen::MatrixXd rows(lengths_mm.size(), flat_mm.size());
    for (Eigen::Index k = 0; k < flat_mm.size(); ++k) {
      FlatVertices more = flat_mm, less = flat_mm;
      more.data()[k] += kStep_mm;
      less.data()[k] -= kStep_mm;
      rows.col(k) =
          (lengths_of(sheet, more, near_mm, sample) - lengths_of(sheet, less, near_mm, sample)) /
          (2 * kStep_mm);
    }
    if (sample > 0) {
      const Eigen::VectorXd moved_mm = (lengths_mm - last_mm).cwiseAbs();
      const Eigen::VectorXd rates = (rows - last_rows).rowwise().norm();
      least_mm = std::min(least_mm, moved_mm.cwiseQuotient(rates).minCoeff());
    }
    last_mm = lengths_mm;
    last_rows = rows;
  }
  return least_mm;
}

// A history with its margin up to this sample, by the scalar code.
FoldingHistory history_to(const TestSheet& sheet, int threshold, const FlatVertices& vertices_mm) {
  return record_history(Model(sheet.base, {}, {}, threshold), vertices_mm);
}

TEST(MiscutMargin, EqualsDifferencesOfVertexCoordinates) {
  const DrawableSheet sheets(4, 4);
  const ShiftBlock block = sheets.draws(12, kSeed);
  double worst = 0;
  int seen = 0;
  for (int i = 0; i < block.sheets && seen < 2; ++i) {
    const FlatVertices vertices_mm = sheets.vertices(block, i);
    const FoldingHistory history = history_to(sheets, kThreshold, vertices_mm);
    if (history.verdict.deploys_from_sample < kThreshold) continue;
    ++seen;
    const double expected_mm = margin_by_differences_mm(sheets, vertices_mm);
    ASSERT_TRUE(history.miscut_margin_mm);
    EXPECT_GT(expected_mm, 0);
    worst = std::max(worst, std::abs(*history.miscut_margin_mm / expected_mm - 1));
  }
  EXPECT_EQ(seen, 2);
  RecordProperty("worst", scientific(worst));
  EXPECT_LE(worst, 1e-4);  // of second differences: (step / size of a panel)^2, over what is left
}

TEST(MiscutMargin, NoneWhereThePathEndsBefore) {
  const DrawableSheet sheets(6, 6);
  const Json table = golden("table1_odd.json");
  const FlatVertices vertices_mm = sheets.shifted(table.at("displacements_mm"));
  EXPECT_TRUE(history_to(sheets, 156, vertices_mm).miscut_margin_mm);
  EXPECT_FALSE(history_to(sheets, 157, vertices_mm).miscut_margin_mm) << "beyond its fold limit";
  EXPECT_FALSE(history_to(sheets, 0, vertices_mm).miscut_margin_mm) << "not asked for";
}

template <class T>
void see(MiscutMargin<T>& margin, const DrawableSheet& sheets, const Elimination& elimination,
         const SheetGeometry<T>& geometry, const FoldState<T>& state) {
  SparseLu<T> factors(elimination);
  std::vector<T> residual(sheets.mechanism.equations, T(0));
  evaluate(sheets.mechanism, geometry, state, residual.data(), factors.entries());
  factors.factorize();
  margin.see(state, factors);
}

// A number that is none would be less than nothing, and so leave the margin of the best sheet of
// all.
TEST(MiscutMargin, NoneWhereTheSolverFailed) {
  const DrawableSheet sheets(4, 4);
  const Elimination elimination =
      plan_elimination(sheets.mechanism, sheets.base.folding, sheets.base.sheet.vertices_mm);
  const FlatVertices vertices_mm = sheets.vertices(sheets.draws(1, kSeed), 0);
  const FoldingHistory history = history_to(sheets, 60, vertices_mm);
  ASSERT_TRUE(history.miscut_margin_mm);
  SheetGeometry<double> geometry;
  place(sheets.mechanism, vertices_mm, geometry);
  const auto margin_mm = [&](const std::vector<FoldState<double>>& states) {
    MiscutMargin<double> margin(sheets.mechanism);
    margin.begin(geometry);
    for (const FoldState<double>& state : states) see(margin, sheets, elimination, geometry, state);
    return margin.mm(0);
  };
  EXPECT_EQ(margin_mm(history.margin_states), history.miscut_margin_mm);
  for (std::size_t failed = 0; failed < history.margin_states.size(); ++failed) {
    for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      auto states = history.margin_states;
      states[failed].creases.front().c = wrong;
      EXPECT_EQ(margin_mm(states), std::nullopt) << failed << ", " << wrong;
    }
  }
}

// One lane at a time: what failed in one is not held against the others.
TEST(MiscutMargin, EveryLaneFailsByItself) {
  const DrawableSheet sheets(4, 4);
  const Elimination elimination =
      plan_elimination(sheets.mechanism, sheets.base.folding, sheets.base.sheet.vertices_mm);
  const FlatVertices vertices_mm = sheets.vertices(sheets.draws(1, kSeed), 0);
  const FoldingHistory history = history_to(sheets, 60, vertices_mm);
  using T = xsimd::batch<double>;
  SheetGeometry<double> geometry;
  place(sheets.mechanism, vertices_mm, geometry);
  auto wide = lane_geometry<T>(sheets.mechanism);
  for (int i = 0; i < kLanes<T>; ++i) put_lane(geometry, wide, i);
  MiscutMargin<T> margin(sheets.mechanism);
  for (int failing = 0; failing < kLanes<T>; ++failing) {
    margin.begin(wide);
    auto state = flat_state<T>(sheets.mechanism);
    for (const FoldState<double>& one : history.margin_states) {
      for (int i = 0; i < kLanes<T>; ++i) put_lane(one, state, i);
      lane(state.creases.front().c, failing) = std::nan("");
      see(margin, sheets, elimination, wide, state);
    }
    for (int i = 0; i < kLanes<T>; ++i) {
      EXPECT_EQ(margin.mm(i).has_value(), i != failing) << i;
      EXPECT_NEAR(margin.mm(i).value_or(*history.miscut_margin_mm), *history.miscut_margin_mm, 1e-9)
          << i;
    }
  }
}

TEST(MiscutMargin, LanesAreTheScalarCode) {
  const DrawableSheet sheets(6, 6);
  const Model model = sheets.with_threshold(kThreshold);
  for (const int count : {1, 11}) {  // less than a register, and more than one
    const ShiftBlock block = sheets.draws(count, kSeed + static_cast<unsigned>(count));
    std::vector<FoldingHistory> alone;
    for (int i = 0; i < count; ++i) {
      alone.push_back(record_history(model, sheets.vertices(block, i)));
    }
    for (const auto set : available_instruction_sets()) {
      const auto batch = make_batch(set, model);
      const auto& histories = batch->record(block);
      for (int i = 0; i < count; ++i) {
        const FoldingHistory& one = alone[i];
        ASSERT_EQ(one.miscut_margin_mm.has_value(), histories[i].miscut_margin_mm.has_value());
        if (!one.miscut_margin_mm) continue;
        EXPECT_NEAR(*histories[i].miscut_margin_mm / *one.miscut_margin_mm, 1, 1e-9)
            << instruction_set_name(set) << ", sheet " << i << " of " << count;
      }
    }
  }
}

}  // namespace
}  // namespace misalign::solver
