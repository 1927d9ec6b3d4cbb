#include "search/draws/parallel_draw.hpp"

#include <cassert>
#include <cmath>

#include "search/draws/random_words.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::search {
namespace {

// A hole whose delta and epsilon are two coordinates, side by side, gets them of like signs.
void make_alike(const std::vector<solver::ParallelCoordinate>& of, Eigen::VectorXd& values_mm) {
  using Kind = solver::ParallelCoordinate::Kind;
  for (std::size_t k = 1; k < of.size(); ++k) {
    if (of[k].kind != Kind::epsilon || of[k - 1].kind != Kind::delta) continue;
    if (of[k].hole != of[k - 1].hole) continue;
    const auto at = static_cast<Eigen::Index>(k);
    values_mm(at) = std::copysign(values_mm(at), values_mm(at - 1));
  }
}

// delta epsilon > 0 at every hole.
bool has_like_signs(const Eigen::VectorXd& hole_changes_mm) {
  for (Eigen::Index h = 0; h < hole_changes_mm.size(); h += 2) {
    if (!(hole_changes_mm(h) * hole_changes_mm(h + 1) > 0)) return false;
  }
  return true;
}

}  // namespace

void draw_member(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 double* shifts_mm, std::uint32_t stream) {
  assert(misalignment.parallel && misalignment.parallel->family);
  const solver::ParallelFamily& family = *misalignment.parallel->family;
  const double most_mm = misalignment.amplitude_mm;
  const auto dimension = static_cast<std::uint32_t>(family.dimension());
  const bool like_signs = misalignment.parallel->like_signs;
  Eigen::VectorXd coordinates_mm(dimension);
  std::uint32_t block = 0;
  for (std::uint32_t t = 0; t < kMostTries; ++t) {
    for (std::uint32_t k = 0; k < dimension; k += 4) {
      const auto words = philox_block(seed, draw, block++, stream);
      for (std::uint32_t i = 0; i < 4 && k + i < dimension; ++i) {
        coordinates_mm(k + i) = uniform_share(words[i]) * most_mm;
      }
    }
    if (!like_signs) break;
    make_alike(family.coordinates(), coordinates_mm);
    if (has_like_signs(family.hole_changes_mm(coordinates_mm))) break;
  }
  Eigen::Matrix2Xd all_mm = family.shifts_mm(coordinates_mm);
  const double largest_mm = all_mm.cwiseAbs().maxCoeff();
  if (largest_mm > most_mm) all_mm *= most_mm / largest_mm;
  for (const int vertex : misalignment.vertices) {
    *shifts_mm++ = all_mm(0, vertex);
    *shifts_mm++ = all_mm(1, vertex);
  }
}

}  // namespace misalign::search
