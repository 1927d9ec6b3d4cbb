// Moves of splitting, where all sheets can be counted; and sheets as whole numbers.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <set>

#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/splitting/moves.hpp"
#include "search/splitting/piece.hpp"
#include "tests/search/splitting_campaigns.hpp"

namespace misalign::search {
namespace {

// How often sums of squares of so many standard normal variables exceed this: once in 10^6 times or
// more rarely (five standard deviations and what skewness adds).
bool is_by_chance(double chi_square, int freedom) {
  return chi_square <= freedom + 5 * std::sqrt(2.0 * freedom) + 10;
}

// What a move makes of a sheet.
using Move = std::function<void(StepWords, ShiftCode::Particle)>;

// The 3^4 sheets of two vertices of a 4 x 4 Miura-ori, which a mirror exchanges: one of the whole
// sheet, since no perforation with one degree of freedom has any.
class FewSheets {
 public:
  static constexpr std::size_t kShifts = 4, kSheets = 81;
  static constexpr double kThreshold_deg = 150;

  FewSheets()
      : campaign_(climbed_miura(kThreshold_deg, kClimbSeed, {{"vertices", {"A7", "A17"}}})),
        moves_(whole(campaign_)),
        scorers_(campaign_, widest_set()) {
    solver::ShiftBlock block{std::vector<double>(kShifts * kSheets), kSheets};
    for (std::size_t k = 0; k < kSheets; ++k) {
      moves_.code().write_mm(sheet(k), block.shifts_mm.data() + kShifts * k);
    }
    scores_ = scorers_.from(0).score(block);
  }

  static std::vector<std::uint8_t> sheet(std::size_t k) {
    std::vector<std::uint8_t> levels;
    for (std::size_t i = 0; i < kShifts; ++i, k /= 3) {
      levels.push_back(static_cast<std::uint8_t>(k % 3));
    }
    return levels;
  }
  static std::size_t number(ShiftCode::ConstParticle sheet) {
    std::size_t k = 0;
    for (std::size_t i = kShifts; i-- > 0;) k = 3 * k + sheet[i];
    return k;
  }

  /// The score that about a third of the sheets have.
  int level() const {
    std::vector<int> sorted = scores_;
    std::ranges::sort(sorted);
    return sorted[2 * kSheets / 3];
  }
  std::vector<std::size_t> from(int level) const {
    std::vector<std::size_t> sheets;
    for (std::size_t k = 0; k < kSheets; ++k) {
      if (scores_[k] >= level) sheets.push_back(k);
    }
    return sheets;
  }
  int score(std::size_t k) const { return scores_[k]; }

  Moves& moves() { return moves_; }
  LevelScorers& scorers() { return scorers_; }
  Move proposals() const {
    return [this](StepWords words, ShiftCode::Particle sheet) { moves_.propose(words, sheet); };
  }
  /// Proposals of which those are taken that stay above the level.
  Move confined(Move move, int level) const {
    return [this, move, level](StepWords words, ShiftCode::Particle sheet) {
      std::vector<std::uint8_t> tried(sheet.begin(), sheet.end());
      move(words, tried);
      if (scores_[number(tried)] >= level) std::ranges::copy(tried, sheet.begin());
    };
  }

  static schema::Campaign whole(schema::Campaign campaign) {
    campaign.pattern.base.holes.clear();
    EXPECT_EQ(
        solver::shift_symmetries(campaign.pattern.base, campaign.misalignment.vertices).size(), 1u);
    return campaign;
  }

 private:
  const schema::Campaign campaign_;
  Moves moves_;
  LevelScorers scorers_;
  std::vector<int> scores_;
};

// Not reversible: a level up, always.
void go_up(StepWords words, ShiftCode::Particle sheet) {
  std::uint8_t& level = sheet[words.next_below(sheet.size())];
  level = static_cast<std::uint8_t>((level + 1) % 3);
}

// Nearly reversible: up in 11 of 20 moves.
void go_up_more_often(StepWords words, ShiftCode::Particle sheet) {
  std::uint8_t& level = sheet[words.next_below(sheet.size())];
  level = static_cast<std::uint8_t>((level + (words.next_below(20) < 11 ? 1 : 2)) % 3);
}

// Whether each way between two of these sheets is as likely as the way back. As many moves begin at
// either: the difference of two counts has their sum as its variance, or less.
bool is_reversible(const Move& move, const std::vector<std::size_t>& sheets) {
  const auto moves = static_cast<std::uint32_t>(20000 / kFewer);
  std::map<std::pair<std::size_t, std::size_t>, double> counts;
  for (const std::size_t k : sheets) {
    for (std::uint32_t i = 0; i < moves; ++i) {
      std::vector<std::uint8_t> sheet = FewSheets::sheet(k);
      move(StepWords(kClimbSeed, static_cast<std::uint32_t>(k), 1, 1, i), sheet);
      ++counts[{k, FewSheets::number(sheet)}];
    }
  }
  double chi_square = 0;
  int pairs = 0;
  for (std::size_t a = 0; a < FewSheets::kSheets; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double there = counts[{a, b}], back = counts[{b, a}];
      if (there + back < 10) continue;
      chi_square += (there - back) * (there - back) / (there + back);
      ++pairs;
    }
  }
  return pairs > 0 && is_by_chance(chi_square, pairs);
}

// Whether these sheets, and no others, are as frequent as each other.
bool is_uniform_on(const std::vector<std::size_t>& sheets, const std::vector<std::size_t>& seen) {
  std::map<std::size_t, double> counts;
  for (const std::size_t k : sheets) counts[k] = 0;
  const double expected = static_cast<double>(seen.size()) / static_cast<double>(sheets.size());
  for (const std::size_t k : seen) {
    if (!counts.contains(k)) return false;
    ++counts[k];
  }
  double chi_square = 0;
  for (const auto& [k, count] : counts) {
    chi_square += (count - expected) * (count - expected) / expected;
  }
  return is_by_chance(chi_square, static_cast<int>(sheets.size()) - 1);
}

// Whether particles that begin as each of these sheets, equally often, end so.
bool keeps_uniform(const Move& move, const std::vector<std::size_t>& sheets) {
  const auto particles = static_cast<std::uint32_t>(2000 / kFewer);
  constexpr std::uint32_t kSteps = 5;
  std::vector<std::size_t> seen;
  for (const std::size_t k : sheets) {
    for (std::uint32_t i = 0; i < particles; ++i) {
      std::vector<std::uint8_t> sheet = FewSheets::sheet(k);
      for (std::uint32_t step = 1; step <= kSteps; ++step) {
        move(StepWords(kClimbSeed, static_cast<std::uint32_t>(k), 2, step, i), sheet);
      }
      seen.push_back(FewSheets::number(sheet));
    }
  }
  return is_uniform_on(sheets, seen);
}

TEST(Splitting, ProposalsAreReversible) {
  FewSheets few;
  const std::vector<std::size_t> all = few.from(kUndecided), some = few.from(few.level());
  ASSERT_EQ(all.size(), FewSheets::kSheets);
  EXPECT_TRUE(is_reversible(few.proposals(), all));
  EXPECT_TRUE(is_reversible(few.confined(few.proposals(), few.level()), some));
  EXPECT_FALSE(is_reversible(go_up, all)) << "which the check must see";
  EXPECT_FALSE(is_reversible(go_up_more_often, all));
}

TEST(Splitting, MovesWithinALevelKeepItUniform) {
  FewSheets few;
  const int level = few.level();
  const std::vector<std::size_t> sheets = few.from(level);
  ASSERT_GT(sheets.size(), 10u);
  ASSERT_LT(sheets.size(), 40u);
  EXPECT_TRUE(keeps_uniform(few.confined(few.proposals(), level), sheets));
  EXPECT_FALSE(keeps_uniform(few.proposals(), sheets)) << "not confined";
  EXPECT_FALSE(keeps_uniform(few.confined(go_up, level), sheets)) << "not reversible";
}

// The same of the work on a piece: it moves particles, and keeps them above the level.
TEST(Splitting, PiecesKeepTheirLevelUniformSlow) {
  FewSheets few;
  const int level = few.level();
  const std::vector<std::size_t> sheets = few.from(level);
  const auto copies = static_cast<std::uint32_t>(kFewer > 1 ? 4 : 60);
  PieceOrder order{0, 1, 0, 0, level, level, false, false, {}};
  std::vector<std::size_t> before, after;
  for (const std::size_t k : sheets) {
    for (std::uint32_t i = 0; i < copies; ++i, ++order.hi) {
      order.here.sheets.add(FewSheets::sheet(k));
      order.here.scores.push_back(few.score(k));
      before.push_back(k);
    }
  }
  PieceWork work(few.moves(), 4, few.scorers(), {}, order);
  while (!work.finished()) work.run_next_block();
  const PieceResult result = work.take();
  ASSERT_EQ(result.there.count(), before.size()) << "all are above the level still";
  std::size_t moved = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    after.push_back(FewSheets::number(result.there.sheets[k]));
    moved += after[k] != before[k];
    EXPECT_EQ(result.there.scores[k], few.score(after[k]));
  }
  EXPECT_GT(moved, before.size() / 4);
  EXPECT_EQ(result.tried, 4 * before.size());
  EXPECT_TRUE(is_uniform_on(sheets, after));
}

// ---- Sheets as whole numbers ----

TEST(Splitting, CodesAreThePlainDrawsShifts) {
  for (const char* levels : {"ternary", "uniform"}) {
    const schema::Campaign campaign = climbed_miura(150, kClimbSeed, {{"levels", levels}});
    const ShiftCode code(campaign.misalignment);
    const bool is_ternary = std::string(levels) == "ternary";
    EXPECT_EQ(code.bytes(), code.shifts() * (is_ternary ? 1 : 4));
    std::mt19937 words(kClimbSeed);
    std::vector<std::uint8_t> sheet(code.bytes()), opposite(code.bytes()), again(code.bytes());
    std::vector<double> shifts_mm(code.shifts()), opposite_mm(shifts_mm), again_mm(shifts_mm);
    for (int i = 0; i < 100; ++i) {
      std::vector<double> expected;
      for (std::size_t k = 0; k < code.shifts(); ++k) {
        const auto word = static_cast<std::uint32_t>(words());
        code.draw(sheet, k, word);
        expected.push_back(campaign.misalignment.amplitude_mm *
                           (is_ternary ? ternary_level(word) : uniform_share(word)));
      }
      const std::size_t last = code.shifts() - 1;
      for (std::size_t k = 0; k <= last; ++k) code.copy(opposite, k, sheet, last - k, true);
      for (std::size_t k = 0; k <= last; ++k) code.copy(again, k, opposite, last - k, true);
      EXPECT_EQ(again, sheet);
      code.write_mm(sheet, shifts_mm.data());
      code.write_mm(opposite, opposite_mm.data());
      EXPECT_EQ(shifts_mm, expected) << levels;
      for (std::size_t k = 0; k <= last; ++k) EXPECT_EQ(opposite_mm[k], -shifts_mm[last - k]);
    }
  }
}

// Every other level half the time; a uniform shift as a draw has it.
TEST(Splitting, RedrawsChangeOneShift) {
  for (const char* levels : {"ternary", "uniform"}) {
    const ShiftCode code(climbed_miura(150, kClimbSeed, {{"levels", levels}}).misalignment);
    std::mt19937 words(kClimbSeed);
    std::vector<std::uint8_t> sheet(code.bytes()), drawn(code.bytes());
    std::array<int, 3> steps{};
    for (int i = 0; i < 4000; ++i) {
      const std::vector<std::uint8_t> before = sheet;
      const std::size_t k = words() % code.shifts();
      const auto word = static_cast<std::uint32_t>(words());
      code.redraw(sheet, k, word);
      if (code.is_ternary()) {
        ++steps[static_cast<std::size_t>(sheet[k] - before[k] + 3) % 3];
        sheet[k] = before[k];
      } else {
        drawn = before;
        code.draw(drawn, k, word);
        EXPECT_EQ(sheet, drawn);
        sheet = before;
      }
      EXPECT_EQ(sheet, before) << "all others";
      for (std::size_t j = 0; j < code.shifts(); ++j) {
        code.draw(sheet, j, static_cast<std::uint32_t>(words()));
      }
    }
    if (!code.is_ternary()) continue;
    EXPECT_EQ(steps[0], 0);
    EXPECT_NEAR(steps[1], 2000, 5 * std::sqrt(1000));
  }
}

}  // namespace
}  // namespace misalign::search
