// Invariance of a verdict: the unit of length, where the sheet lies and from which side it is seen,
// and how its vertices are numbered.
#include "tests/solver/viewed_family.hpp"

namespace misalign::solver {
namespace {

/// A family as it is read back in this view, and draws of it.
class ViewedFamily {
 public:
  ViewedFamily(const CarriedFamily& family, const View& view)
      : view_(view), original_(view.number.size()), family_(seen_base(family, view)) {
    for (std::size_t v = 0; v < original_.size(); ++v)
      original_[view.number[v]] = static_cast<int>(v);
  }

  const CarriedFamily& family() const { return family_; }

  /// Its verdicts on draws that were made for the family as it was.
  std::vector<std::string> verdicts(const CarriedFamily& family, ShiftBlock block) const {
    for (std::size_t i = 0; i < block.shifts_mm.size(); i += 2) {
      const Eigen::Vector2d shift(block.shifts_mm[i], block.shifts_mm[i + 1]);
      Eigen::Vector2d::Map(&block.shifts_mm[i]) = view_.linear * shift;
    }
    std::vector<int> shifted;
    for (const int v : family.shifted_vertices) shifted.push_back(view_.number[v]);
    PathPlanOptions options;
    options.end_deg = family.end_deg();
    const Model sheets(family_.base, shifted, options, 1);
    const auto batch = make_batch(available_instruction_sets().back(), sheets);
    std::vector<std::string> all;
    for (const Verdict& verdict : batch->judge(block)) all.push_back(words_of(verdict));
    return all;
  }

 private:
  // In the vertices as they were called.
  std::string words_of(const Verdict& verdict) const {
    const auto line = [&](int from, int to) {
      const auto [a, b] = std::minmax(original_[from], original_[to]);
      return line_label(a, b);
    };
    std::string where;
    if (verdict.where >= 0 && (verdict.first_fault == Fault::not_monotone ||
                               verdict.first_fault == Fault::inactive_diagonal)) {
      const Diagonal& diagonal = family_.mechanism.diagonals[verdict.where];
      where = line(diagonal.from, diagonal.to);
    } else if (verdict.where >= 0) {
      const Crease& crease = family_.mechanism.creases[verdict.where];
      where = line(crease.a, crease.b);
    }
    return "D " + std::to_string(verdict.deploys_from_sample) + ", " +
           fault_name(verdict.first_fault) + " " + where;
  }

  const View view_;
  std::vector<int> original_;
  const CarriedFamily family_;
};

class Invariance : public testing::TestWithParam<std::string> {
 protected:
  void expect_unchanged(const View& view) const {
    const ViewedFamily seen(family_, view);
    EXPECT_EQ(seen.verdicts(family_, block_), expected_) << "seed " << kSeed;
  }

  const CarriedFamily family_{GetParam()};
  const ShiftBlock block_ = family_.draws(kFewer > 1 ? 3 : 30, kSeed);
  const std::vector<std::string> expected_ =
      ViewedFamily(family_, View(family_)).verdicts(family_, block_);
};

TEST_P(Invariance, OfTheUnitOfLength) {
  for (const double scale : {1e-3, 1e3}) {
    SCOPED_TRACE(scale);
    View view(family_);
    view.linear *= scale;
    expect_unchanged(view);
  }
}

TEST_P(Invariance, WhereTheSheetLies) {
  for (const double far_mm : {1e4, 1e5}) {
    SCOPED_TRACE(far_mm);
    View view(family_);
    view.offset_mm = {far_mm, -far_mm};
    expect_unchanged(view);
  }
}

TEST_P(Invariance, TurnedByHalf) {
  View view(family_);
  view.linear *= -1;
  expect_unchanged(view);
}

TEST_P(Invariance, Mirrored) {
  View view(family_);
  view.linear(0, 0) = -1;
  expect_unchanged(view);
}

TEST_P(Invariance, SeenFromBelow) {
  View view(family_);
  view.linear(0, 0) = -1;
  view.from_below = true;
  EXPECT_EQ(ViewedFamily(family_, view).family().base.folding.side(), -family_.base.folding.side());
  expect_unchanged(view);
}

TEST_P(Invariance, OfTheNumbersOfVertices) {
  View view(family_);
  std::shuffle(view.number.begin(), view.number.end(), std::mt19937(kSeed));
  expect_unchanged(view);
}

INSTANTIATE_TEST_SUITE_P(Carried, Invariance, testing::ValuesIn(carried_families()), family_word);

}  // namespace
}  // namespace misalign::solver
