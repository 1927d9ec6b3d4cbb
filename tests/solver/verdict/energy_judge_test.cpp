#include "solver/verdict/energy_judge.hpp"

#include "solver/fill/filling.hpp"
#include "tests/solver/blocks.hpp"
#include "tests/solver/energy_by_coordinates.hpp"

namespace misalign::solver {
namespace {

constexpr double kRate_n_per_mm = 50;
constexpr double kPanelWidth_mm = 80;

EnergyCriterion springs(int from_sample = 0, double friction = 0, double moment = 0) {
  Springs fill;
  fill.stiffness_n_per_mm = kRate_n_per_mm;
  return {fill, from_sample, friction, moment};
}

// Lengths at samples are invented: flat diagonals are all of length 1.
class InventedLengths : public testing::Test {
 protected:
  const DrawableSheet sheet{4, 4};
  const std::size_t diagonals = sheet.mechanism.diagonals.size();
  const std::vector<double> flat = std::vector<double>(diagonals, 1.0);

  std::vector<double> longer(double by_widths) const {
    std::vector<double> lengths = flat;
    for (double& length : lengths) length += by_widths;
    return lengths;
  }
};

// All diagonals move by the band, just less and just more.
TEST_F(InventedLengths, EnergyRisesBeyondTheBand) {
  EnergyJudge judge(sheet.mechanism, springs());
  for (const double share : {0.9, 1.1}) {
    judge.begin(flat, nullptr);
    judge.look(longer(0.01));
    ASSERT_TRUE(judge.rises());
    judge.take();
    judge.look(longer(0.01 + share * kStepBand_widths));
    EXPECT_EQ(judge.rises(), share > 1) << share;
  }
}

TEST_F(InventedLengths, RoundingDrivesNothing) {
  EnergyJudge judge(sheet.mechanism, springs());
  judge.begin(flat, nullptr);
  judge.look(longer(1e-14));
  EXPECT_FALSE(judge.rises());
  judge.look(longer(3e-12));
  EXPECT_TRUE(judge.rises());
}

TEST_F(InventedLengths, TheDiagonalThatGivesMostPullsBack) {
  EnergyJudge judge(sheet.mechanism, springs());
  judge.begin(flat, nullptr);
  std::vector<double> lengths = longer(0.01);
  judge.look(lengths);
  judge.take();
  lengths[0] += 0.001;
  lengths[1] -= 0.002;
  lengths[2] -= 0.003;
  judge.look(lengths);
  EXPECT_FALSE(judge.rises());
  EXPECT_EQ(judge.pulls_back(), 2);
}

// Errors leave a step open that is shorter than they make it.
TEST_F(InventedLengths, ErrorsLeaveAShortStepOpen) {
  EnergyJudge judge(sheet.mechanism, springs());
  for (const double error_widths : {1e-7, 3e-7}) {
    const std::vector<double> errors(diagonals, error_widths);
    judge.begin(flat, nullptr);
    judge.look(longer(0.01), &errors);
    judge.take();
    judge.look(longer(0.01 + 4e-7), &errors);
    EXPECT_TRUE(judge.rises());
    EXPECT_EQ(judge.is_decisive(), error_widths < 2e-7) << error_widths;
  }
}

// E = k/2 n (x w)^2 at x widths; creases turn by t at sample 1 and 2 t at sample 2.
TEST_F(InventedLengths, TheMarginIsTheLeastRatio) {
  const double x_mm = 0.01 * kPanelWidth_mm;
  const double unit_n_mm = kRate_n_per_mm / 2 * static_cast<double>(diagonals) * x_mm * x_mm;
  // The energy rises by 4 units over 20 mm from flat, and by 3 over 5 mm from sample 1.
  const double from_flat = 4 * unit_n_mm / 20, from_first = 3 * unit_n_mm / 5;
  const double least = std::min(from_flat, from_first);
  for (const double share : {1 - 1e-9, 1 + 1e-9}) {
    EnergyJudge judge(sheet.mechanism, springs(2, share * least));
    judge.begin(flat, &sheet.geometry);
    judge.look(longer(0.01));
    judge.set_turning(15);
    judge.take();
    judge.look(longer(0.02));
    judge.set_turning(20);
    EXPECT_EQ(judge.drive().is_met(), std::optional(share < 1));
    EXPECT_NEAR(judge.drive().value, 1 / share, 1e-12);
  }
}

// An energy that falls is enough where the turning does not fall towards flat.
TEST_F(InventedLengths, CreasesThatFoldBackDemandNothing) {
  EnergyJudge judge(sheet.mechanism, springs(2, 1e-3));
  judge.begin(flat, &sheet.geometry);
  judge.look(longer(0.01));
  judge.set_turning(20);
  judge.take();
  judge.look(longer(0.01001));
  judge.set_turning(19);
  EXPECT_EQ(judge.drive().is_met(), std::optional(true));
}

TEST_F(InventedLengths, TheMomentIsForceTimesSlope) {
  const double slope = 0.1;  // widths per rad
  const double moment_n_mm = static_cast<double>(diagonals) * kRate_n_per_mm * 0.01 *
                             kPanelWidth_mm * slope * kPanelWidth_mm;
  for (const double share : {1 - 1e-9, 1 + 1e-9}) {
    EnergyJudge judge(sheet.mechanism, springs(1, 0, share * moment_n_mm));
    judge.begin(flat, nullptr);
    judge.look(longer(0.01));
    judge.set_slopes(std::vector<double>(diagonals, slope));
    EXPECT_EQ(judge.drive().is_met(), std::optional(share < 1));
    judge.set_slopes(std::vector<double>(diagonals, slope), 1e-6);
    EXPECT_EQ(judge.drive().is_met(), std::nullopt);
  }
}

// A filling made by hand for one sheet: units, sides and products.
TEST(EnergyJudge, HasTheEnergyOfTheSheetsFilling) {
  const DrawableSheet sheet(4, 4);
  const FlatVertices vertices_mm = sheet.vertices(sheet.draws(1, kSeed), 0);
  const FoldingHistory history = sheet.history(vertices_mm);
  SheetGeometry<double> geometry;
  place(sheet.mechanism, vertices_mm, geometry);
  HoleDiagonals holes;
  const auto count = static_cast<Eigen::Index>(history.flat_mm.size());
  holes.flat_mm = holes.rest_mm = Eigen::Map<const Eigen::VectorXd>(history.flat_mm.data(), count);
  const Eigen::VectorXd first_mm = history.length_mm.row(0);
  holes.sides = (first_mm - holes.flat_mm).cwiseSign();
  holes.product_mm2 = diagonal_products_mm2(sheet.mechanism, vertices_mm);
  const Diagonal& one = sheet.mechanism.diagonals[1];
  Springs preloaded, single, wires, one_a_hole;
  preloaded.preload.each_n = 3;
  single.single = {{one.from, one.to, 7, history.flat_mm[1] - 2}};
  wires.pull_only = true;
  one_a_hole.on = SpringsOn::one_a_hole;
  RubberPlates plates;
  plates.prestretch = 1.1;
  for (const Fill& fill : {Fill(Springs{}), Fill(preloaded), Fill(single), Fill(wires),
                           Fill(one_a_hole), Fill(plates), Fill(NoFill{})}) {
    const Filling filling(fill, sheet.mechanism.diagonals, holes);
    EnergyJudge judge(sheet.mechanism, {fill});
    const auto in_widths = [&](const Eigen::VectorXd& mm) {
      const Eigen::VectorXd widths = mm / kPanelWidth_mm;
      return std::vector<double>(widths.begin(), widths.end());
    };
    judge.begin(in_widths(holes.flat_mm), &geometry);
    judge.look(in_widths(first_mm));
    const Eigen::VectorXd lengths_mm = history.length_mm.row(100);
    const double n_mm = filling.energy_n_mm(lengths_mm);
    EXPECT_NEAR(judge.energy_n_mm(in_widths(lengths_mm)), n_mm, 1e-9 * (1 + n_mm)) << fill.index();
  }
}

struct EnergyDraws {
  int panels;
  double amplitude_mm;
  int from_sample;
  double friction_n_mm_per_mm;
  int draws;
};
void PrintTo(const EnergyDraws& drawn, std::ostream* out) {
  *out << drawn.panels << "x" << drawn.panels << " from " << drawn.from_sample;
}

class EnergyVerdicts : public testing::TestWithParam<EnergyDraws> {};

// Every instruction set, by its verdicts, its records and its rejections.
TEST_P(EnergyVerdicts, AreThoseOfVertexCoordinates) {
  const EnergyDraws& drawn = GetParam();
  const DrawableSheet sheet(drawn.panels, drawn.panels);
  Criterion criterion;
  criterion.energy = springs(drawn.from_sample, drawn.friction_n_mm_per_mm);
  const Model model(sheet.base, sheet.shifted_vertices, {}, drawn.from_sample, criterion);
  const ShiftBlock block = sheet.draws(drawn.draws / kFewer, kSeed, drawn.amplitude_mm);
  CoordinateJudge dense(model, kRate_n_per_mm, 1);
  std::vector<CoordinateVerdict> expected;
  for (int i = 0; i < block.sheets; ++i) expected.push_back(dense.judge(sheet.vertices(block, i)));
  for (const InstructionSet set : available_instruction_sets()) {
    const auto batch = make_batch(set, model);
    const std::vector<Verdict> verdicts = batch->judge(block);
    const std::vector<PathRecord> records = batch->measure(block);
    const std::vector<Rejection> rejections = batch->reject(block);
    const auto by_energy = std::ranges::count_if(rejections, [](const Rejection& rejection) {
      return rejection.fault == Fault::energy_rises || rejection.fault == Fault::weak_drive;
    });
    EXPECT_GT(by_energy, 0);
    for (int i = 0; i < block.sheets; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const CoordinateVerdict& right = expected[k];
      EXPECT_EQ(verdicts[k].deploys_from_sample, right.deploys_from_sample) << i;
      EXPECT_EQ(fault_name(verdicts[k].first_fault), std::string(fault_name(right.first_fault)))
          << i;
      const Verdict& recorded = records[k].verdict;  // of a path that may go on beyond the fault
      EXPECT_EQ(recorded.deploys_from_sample, right.deploys_from_sample) << i;
      EXPECT_EQ(recorded.first_fault, verdicts[k].first_fault) << i;
      EXPECT_EQ(recorded.where, verdicts[k].where) << i;
      if (rejections[k].fault == Fault::none) continue;
      EXPECT_LT(right.deploys_from_sample, drawn.from_sample) << i << words(rejections[k]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, EnergyVerdicts,
                         testing::Values(EnergyDraws{4, 0.4, 170, 0.3, 40},
                                         EnergyDraws{4, 4, 150, 5, 40},
                                         EnergyDraws{6, 0.4, 170, 0.5, 30},
                                         EnergyDraws{6, 4, 140, 10, 20}));

// Records of the diagonals' criterion follow the energy beyond the angle where a diagonal reverses.
TEST(EnergyVerdict, RecordsGoOnBeyondTheDiagonals) {
  const DrawableSheet sheet(6, 6);
  Criterion by_energy;
  by_energy.energy = springs(180);
  const Model model(sheet.base, sheet.shifted_vertices, {}, 60),
      energies(sheet.base, sheet.shifted_vertices, {}, 180, by_energy);
  const ShiftBlock block = sheet.draws(20 / kFewer, kSeed, 0.4);
  CoordinateJudge dense(energies, kRate_n_per_mm, 1);
  for (const InstructionSet set : available_instruction_sets()) {
    const std::vector<PathRecord> records = make_batch(set, model)->measure(block);
    int beyond = 0;
    for (int i = 0; i < block.sheets; ++i) {
      const PathRecord& record = records[static_cast<std::size_t>(i)];
      if (record.verdict.deploys_from_sample < 60) continue;
      const int right = dense.judge(sheet.vertices(block, i)).deploys_from_sample;
      EXPECT_EQ(record.energy_deploys_from_sample, right) << i;
      beyond += right > record.verdict.deploys_from_sample;
    }
    EXPECT_GT(beyond, 0);
  }
}

TEST(EnergyVerdict, AnUnshiftedSheetIsNotDriven) {
  const DrawableSheet sheet(6, 6);
  Criterion criterion;
  criterion.energy = springs(100);
  const Model model(sheet.base, sheet.shifted_vertices, {}, 100, criterion);
  const ShiftBlock block = sheet.draws(1, kSeed, 0);
  for (const InstructionSet set : available_instruction_sets()) {
    const Verdict verdict = make_batch(set, model)->judge(block).front();
    EXPECT_EQ(verdict.deploys_from_sample, 0);
    EXPECT_EQ(verdict.first_fault, Fault::energy_rises);
  }
}

}  // namespace
}  // namespace misalign::solver
