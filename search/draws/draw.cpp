#include "search/draws/draw.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "search/draws/parallel_draw.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::search {
namespace {

double shift_mm(const schema::Misalignment& misalignment, std::uint32_t word) {
  if (misalignment.distribution == schema::ShiftDistribution::ternary) {
    return ternary_level(word) * misalignment.amplitude_mm;
  }
  return uniform_share(word) * misalignment.amplitude_mm;
}

// Rounding error of a member's conditions and of its largest shift, over the amplitude.
constexpr double kMemberRounding = 1e-9;

// Returns whether the shift is a whole multiple of the grid's step; 0 means no grid.
bool is_on_grid(double shift_mm, double grid_mm) {
  return grid_mm == 0 || std::round(shift_mm / grid_mm) * grid_mm == shift_mm;
}

// Returns whether the shift is a ternary level, or a share that its random word reproduces.
bool can_be_drawn(const schema::Misalignment& misalignment, double shift_mm) {
  assert(misalignment.amplitude_mm > 0);
  const double share = shift_mm / misalignment.amplitude_mm;
  if (misalignment.distribution == schema::ShiftDistribution::ternary) {
    return share == 0 || shift_mm == misalignment.amplitude_mm ||
           shift_mm == -misalignment.amplitude_mm;
  }
  if (misalignment.parallel) {
    return is_on_grid(shift_mm, misalignment.parallel->grid_mm) &&
           std::abs(share) <= 1 + kMemberRounding;
  }
  constexpr double kMostShare = 1 - 1e-10;  // the words end 2^-32 before 1
  if (!(std::abs(share) <= kMostShare)) return false;
  const auto word = static_cast<std::uint32_t>((share + 1) * 2147483648.0);
  return uniform_share(word) * misalignment.amplitude_mm == shift_mm;
}

}  // namespace

void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 double* shifts_mm, std::uint32_t stream) {
  if (misalignment.parallel) return draw_member(misalignment, seed, draw, shifts_mm, stream);
  const std::size_t words = 2 * misalignment.vertices.size();
  for (std::size_t k = 0; k < words; k += 4) {
    const auto block = philox_block(seed, draw, static_cast<std::uint32_t>(k / 4), stream);
    const std::size_t count = std::min<std::size_t>(4, words - k);
    for (std::size_t i = 0; i < count; ++i) {
      shifts_mm[k + i] = shift_mm(misalignment, block[i]);
    }
  }
}

void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t first,
                 std::uint64_t draws, double* shifts_mm) {
  const std::size_t words = 2 * misalignment.vertices.size();
  std::uint64_t draw = 0;
  for (; !misalignment.parallel && draw + kDrawsAtOnce <= draws; draw += kDrawsAtOnce) {
    double* const of_first = shifts_mm + draw * words;
    for (std::size_t k = 0; k < words; k += 4) {
      WordsOfDraws block;
      philox_blocks(seed, first + draw, static_cast<std::uint32_t>(k / 4), kDrawStream, block);
      const std::size_t count = std::min<std::size_t>(4, words - k);
      for (std::size_t s = 0; s < kDrawsAtOnce; ++s) {
        double* const to = of_first + s * words + k;
        for (std::size_t i = 0; i < count; ++i) to[i] = shift_mm(misalignment, block[i][s]);
      }
    }
  }
  for (; draw < draws; ++draw) {
    draw_shifts(misalignment, seed, first + draw, shifts_mm + draw * words);
  }
}

void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 Eigen::Matrix2Xd& shifts_mm) {
  assert(misalignment.vertices.empty() || misalignment.vertices.back() < shifts_mm.cols());
  Eigen::Matrix2Xd drawn(2, misalignment.vertices.size());
  draw_shifts(misalignment, seed, draw, drawn.data());
  for (std::size_t k = 0; k < misalignment.vertices.size(); ++k) {
    shifts_mm.col(misalignment.vertices[k]) = drawn.col(static_cast<Eigen::Index>(k));
  }
}

Eigen::Matrix2Xd shifts_of_draw(const schema::Campaign& campaign, std::uint64_t draw) {
  Eigen::Matrix2Xd shifts_mm =
      Eigen::Matrix2Xd::Zero(2, campaign.pattern.base.sheet.vertex_count());
  draw_shifts(campaign.misalignment, campaign.seed, draw, shifts_mm);
  return shifts_mm;
}

namespace {

// Returns whether `can_be` holds for each shift and no other vertex is shifted. Shifts of a
// campaign of parallel draws must be a member of the family.
template <class CanBe>
bool are_shifts(const schema::Campaign& campaign, const Eigen::Matrix2Xd& shifts_mm,
                const CanBe& can_be) {
  if (shifts_mm.cols() != campaign.pattern.base.sheet.vertex_count()) return false;
  Eigen::Matrix2Xd others_mm = shifts_mm;
  for (const int vertex : campaign.misalignment.vertices) {
    if (!std::ranges::all_of(shifts_mm.col(vertex), can_be)) return false;
    others_mm.col(vertex).setZero();
  }
  if (!(others_mm.array() == 0).all()) return false;
  return !campaign.misalignment.parallel ||
         solver::parallel_misfit(campaign.pattern.base, shifts_mm).mm <=
             kMemberRounding * campaign.misalignment.amplitude_mm;
}

}  // namespace

bool can_be_drawn(const schema::Campaign& campaign, const Eigen::Matrix2Xd& shifts_mm) {
  return are_shifts(campaign, shifts_mm,
                    [&](double shift_mm) { return can_be_drawn(campaign.misalignment, shift_mm); });
}

bool can_be_kept(const schema::Campaign& campaign, const Eigen::Matrix2Xd& shifts_mm) {
  if (campaign.search.shape) {
    return are_shifts(campaign, shifts_mm, [](double shift_mm) { return std::isfinite(shift_mm); });
  }
  if (!campaign.search.optimisation) return can_be_drawn(campaign, shifts_mm);
  const schema::Optimisation& ends = *campaign.search.optimisation;
  const double most_mm = (1 + kMemberRounding) * campaign.misalignment.amplitude_mm;
  return are_shifts(campaign, shifts_mm, [&](double shift_mm) {
    if (ends.ternary) return can_be_drawn(campaign.misalignment, shift_mm);
    return is_on_grid(shift_mm, ends.grid_mm.value_or(0)) && std::abs(shift_mm) <= most_mm;
  });
}

}  // namespace misalign::search
