#include "search/draws/parallel_draw.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "search/draws/random_words.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::search {
namespace {

// Returns whether coordinate k is an epsilon whose delta is the coordinate before it.
bool is_epsilon_beside_delta(const std::vector<solver::ParallelCoordinate>& coordinates,
                             std::size_t k) {
  using Kind = solver::ParallelCoordinate::Kind;
  return k > 0 && coordinates[k].kind == Kind::epsilon && coordinates[k - 1].kind == Kind::delta &&
         coordinates[k].hole == coordinates[k - 1].hole;
}

// Returns whether delta epsilon > 0 at every hole.
bool has_like_signs(const Eigen::VectorXd& hole_changes_mm) {
  for (Eigen::Index h = 0; h < hole_changes_mm.size(); h += 2) {
    if (!(hole_changes_mm(h) * hole_changes_mm(h + 1) > 0)) return false;
  }
  return true;
}

// Rounding allowance of a multiple that just fits.
constexpr double kRoom = 1 + 1e-9;

// Returns one of the whole numbers `from` to `to`.
double whole_number(std::uint32_t word, double from, double to) {
  constexpr double kWords = 4294967296.0;
  return from + std::floor(word / kWords * (to - from + 1));
}

// Draws coordinates on a grid one after another: each is a multiple of its step that keeps the
// shifts, with the coordinates before it, within the amplitude.
class GridMember {
 public:
  explicit GridMember(const schema::Misalignment& misalignment)
      : draws_(*misalignment.parallel),
        basis_(draws_.family->basis()),
        most_mm_(misalignment.amplitude_mm * kRoom),
        moved_mm_(Eigen::VectorXd::Zero(basis_.rows())) {}

  void begin() { moved_mm_.setZero(); }
  /// Draws coordinate k; `sign` is 0 or the required sign.
  double take(std::uint32_t word, Eigen::Index k, double sign) {
    double least = -std::numeric_limits<double>::infinity(), most = -least;
    for (Eigen::Index i = 0; i < moved_mm_.size(); ++i) {
      const double by_mm = draws_.steps_mm(k) * basis_(i, k);
      if (std::abs(by_mm) < 0.5 * draws_.grid_mm) continue;  // nothing but rounding
      const double up = (std::copysign(most_mm_, by_mm) - moved_mm_(i)) / by_mm;
      const double down = (-std::copysign(most_mm_, by_mm) - moved_mm_(i)) / by_mm;
      least = std::max(least, std::ceil(down)), most = std::min(most, std::floor(up));
    }
    if (sign > 0) least = 0;
    if (sign < 0) most = 0;
    const double value_mm = draws_.steps_mm(k) * whole_number(word, least, most);
    moved_mm_ += value_mm * basis_.col(k);
    return value_mm;
  }

 private:
  const schema::ParallelDraws& draws_;
  const solver::RowMatrix& basis_;
  const double most_mm_;
  Eigen::VectorXd moved_mm_;  // shifts so far, x and y in turn
};

}  // namespace

void draw_member(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 double* shifts_mm, std::uint32_t stream) {
  assert(misalignment.parallel && misalignment.parallel->family);
  const schema::ParallelDraws& draws = *misalignment.parallel;
  const solver::ParallelFamily& family = *draws.family;
  const double most_mm = misalignment.amplitude_mm;
  const auto dimension = static_cast<std::uint32_t>(family.dimension());
  Eigen::VectorXd coordinates_mm(dimension);
  GridMember on_grid(misalignment);
  std::uint32_t block = 0;
  for (std::uint32_t t = 0; t < kMostTries; ++t) {
    on_grid.begin();
    for (std::uint32_t k = 0; k < dimension; k += 4) {
      const auto words = philox_block(seed, draw, block++, stream);
      for (std::uint32_t i = 0; i < 4 && k + i < dimension; ++i) {
        const bool is_paired =
            draws.like_signs && is_epsilon_beside_delta(family.coordinates(), k + i);
        const double delta_mm = is_paired ? coordinates_mm(k + i - 1) : 0;
        double& value_mm = coordinates_mm(k + i);
        if (draws.grid_mm > 0) {
          value_mm = on_grid.take(words[i], k + i, delta_mm);
        } else {
          value_mm = uniform_share(words[i]) * most_mm;
          if (is_paired) value_mm = std::copysign(value_mm, delta_mm);
        }
      }
    }
    if (!draws.like_signs || has_like_signs(family.hole_changes_mm(coordinates_mm))) break;
  }
  Eigen::Matrix2Xd all_mm = family.shifts_mm(coordinates_mm);
  if (draws.grid_mm > 0) {
    all_mm = (all_mm / draws.grid_mm).array().round() * draws.grid_mm;
  } else if (const double largest_mm = all_mm.cwiseAbs().maxCoeff(); largest_mm > most_mm) {
    all_mm *= most_mm / largest_mm;
  }
  for (const int vertex : misalignment.vertices) {
    *shifts_mm++ = all_mm(0, vertex);
    *shifts_mm++ = all_mm(1, vertex);
  }
}

}  // namespace misalign::search
