// Symmetries of sheets. A perforated sheet with one degree of freedom has an even number of rows
// and of columns: a vertex in its middle, of whose four creases three are alike, so that no half
// turn and no mirror between them keeps it. A mirror along a crease exchanges panels and holes of
// a checkerboard. So what has symmetries here has no holes, or too many degrees of freedom; that
// turned sheets have the same verdicts is tested in tests/solver/invariance_test.cpp.
#include <algorithm>
#include <set>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "search/splitting/moves.hpp"
#include "solver/pattern/symmetry.hpp"
#include "tests/search/splitting_campaigns.hpp"

namespace misalign::search {
namespace {

enum class Holes { none, checkerboard };

solver::PerforatedSheet miura_of(int rows, int columns, Holes holes) {
  const auto shape = solver::MiuraShape::uniform(rows, columns, 80, 80, 40);
  solver::PerforatedSheet base;
  base.sheet = solver::miura_sheet(shape);
  if (holes == Holes::checkerboard) base.holes = solver::checkerboard(base.sheet, 1);
  base.folding = std::get<solver::BaseFolding>(
      solver::fold_sequentially(base.sheet, solver::miura_assignment(shape, base.sheet),
                                solver::default_pilot(base.sheet, base.holes)));
  return base;
}

std::vector<solver::ShiftSymmetry> symmetries_of(const solver::PerforatedSheet& base) {
  return solver::shift_symmetries(base, solver::interior_vertices(base.sheet));
}

Eigen::Matrix2d turn_of(const solver::ShiftSymmetry& symmetry) {
  const int swaps = symmetry.from[0] % 2;
  Eigen::Matrix2d turn = Eigen::Matrix2d::Zero();
  turn(0, swaps) = symmetry.negated[0] ? -1 : 1;
  turn(1, 1 - swaps) = symmetry.negated[1] ? -1 : 1;
  return turn;
}

std::vector<double> image_of(const std::vector<double>& shifts,
                             const solver::ShiftSymmetry& symmetry) {
  std::vector<double> image;
  for (std::size_t k = 0; k < shifts.size(); ++k) {
    const double shift = shifts[static_cast<std::size_t>(symmetry.from[k])];
    image.push_back(symmetry.negated[k] ? -shift : shift);
  }
  return image;
}

// Sheets where y -> -y, or half a turn, keeps all: found, and nothing else. With each its inverse:
// of all shifts different, some symmetry leads back.
TEST(Splitting, SymmetriesAreThoseOfTheSheet) {
  struct Case {
    int rows, columns;
    Holes holes;
    std::vector<Eigen::Matrix2d> turns;
  };
  const Eigen::Matrix2d mirror = Eigen::Vector2d(1, -1).asDiagonal();
  const Eigen::Matrix2d half_turn = -Eigen::Matrix2d::Identity();
  for (const Case& one : {Case{4, 4, Holes::checkerboard, {}},
                          {6, 6, Holes::checkerboard, {}},
                          {4, 4, Holes::none, {mirror}},
                          {6, 5, Holes::none, {mirror}},
                          {5, 5, Holes::checkerboard, {half_turn}},
                          {3, 4, Holes::none, {half_turn}},
                          {3, 4, Holes::checkerboard, {}}}) {
    SCOPED_TRACE(std::to_string(one.rows) + " x " + std::to_string(one.columns));
    const auto symmetries = symmetries_of(miura_of(one.rows, one.columns, one.holes));
    std::vector<Eigen::Matrix2d> turns;
    for (const auto& symmetry : symmetries) {
      turns.push_back(turn_of(symmetry));
      std::vector<double> shifts(symmetry.from.size());
      for (std::size_t k = 0; k < shifts.size(); ++k) shifts[k] = static_cast<double>(k) + 1;
      EXPECT_NE(image_of(shifts, symmetry), shifts) << "the identity";
      EXPECT_TRUE(std::ranges::any_of(symmetries, [&](const auto& back) {
        return image_of(image_of(shifts, symmetry), back) == shifts;
      }));
    }
    EXPECT_EQ(turns, one.turns);
  }
}

// No campaign that comes with the program mirrors its particles.
TEST(Splitting, CampaignsHaveNoSymmetries) {
  for (const char* name : {"miura-4x4", "miura-6x6", "miura-8x8", "miura-narrow-6x6", "ring-6x6",
                           "angle-array-6x6", "double-corrugation-6x6", "turned-quads-6x6"}) {
    const schema::Campaign campaign = schema::read_campaign_file(
        std::string(MISALIGN_SOURCE_DIR "/search/campaigns/") + name + ".json");
    EXPECT_TRUE(
        solver::shift_symmetries(campaign.pattern.base, campaign.misalignment.vertices).empty())
        << name;
  }
}

// Where each point of the first lies in the second.
std::vector<int> places_of(const solver::FlatVertices& points, const solver::FlatVertices& in) {
  std::vector<int> places;
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    Eigen::Index nearest = 0;
    EXPECT_LT((in.colwise() - points.col(v)).colwise().squaredNorm().minCoeff(&nearest), 1e-18);
    places.push_back(static_cast<int>(nearest));
  }
  return places;
}

// By coordinates: the shifted sheet turned, or turned over, is the sheet with the mirrored shifts.
TEST(Splitting, MirroredSheetsAreTheSameSheets) {
  for (const solver::PerforatedSheet& base :
       {miura_of(4, 4, Holes::none), miura_of(5, 5, Holes::checkerboard)}) {
    const std::vector<int> shifted = solver::interior_vertices(base.sheet);
    const schema::Misalignment misalignment{shifted, 0.4, schema::ShiftDistribution::uniform};
    const Eigen::Vector2d centre = base.sheet.vertices_mm.rowwise().mean();
    for (const auto& symmetry : symmetries_of(base)) {
      const auto turned = [&](const solver::FlatVertices& points) {
        return solver::FlatVertices((turn_of(symmetry) * (points.colwise() - centre)).colwise() +
                                    centre);
      };
      const auto to = places_of(turned(base.sheet.vertices_mm), base.sheet.vertices_mm);
      for (std::uint64_t draw = 0; draw < 20; ++draw) {
        solver::ShiftBlock block{std::vector<double>(2 * shifted.size()), 1};
        draw_shifts(misalignment, kClimbSeed, draw, block.shifts_mm.data());
        const solver::ShiftBlock image{image_of(block.shifts_mm, symmetry), 1};
        EXPECT_EQ(places_of(turned(displaced(base.sheet.vertices_mm, shifted, block, 0)),
                            displaced(base.sheet.vertices_mm, shifted, image, 0)),
                  to);
      }
    }
  }
}

// Of a sheet that has one, one proposal in sixteen or a few more is the image.
TEST(Splitting, ProposalsHaveImages) {
  schema::Campaign campaign = climbed_miura(150);
  campaign.pattern.base = miura_of(4, 4, Holes::none);
  const Moves moves(campaign);
  const auto symmetry = symmetries_of(campaign.pattern.base).at(0);
  const std::size_t shifts = moves.code().shifts();
  std::vector<std::uint8_t> sheet(shifts);
  constexpr std::uint32_t kProposals = 8000;
  int images = 0;
  for (std::uint32_t k = 0; k < kProposals; ++k) {
    moves.draw(StepWords(kClimbSeed, 0, 0, 0, k), sheet);
    std::vector<std::uint8_t> tried = sheet;
    moves.propose(StepWords(kClimbSeed, 0, 1, 1, k), tried);
    std::vector<double> shifts_mm(shifts), tried_mm(shifts);
    moves.code().write_mm(sheet, shifts_mm.data());
    moves.code().write_mm(tried, tried_mm.data());
    images += image_of(shifts_mm, symmetry) == tried_mm;
  }
  EXPECT_NEAR(images, kProposals / 16.0, 5 * std::sqrt(kProposals / 16.0));
}

}  // namespace
}  // namespace misalign::search
