#include "solver/fill/filling.hpp"

#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

const SingleSpring* single_on(const Springs& springs, const Diagonal& diagonal) {
  const auto is_its = [&](const SingleSpring& spring) { return spring.is_on(diagonal); };
  const auto at = std::ranges::find_if(springs.single, is_its);
  return at == springs.single.end() ? nullptr : &*at;
}

// Returns whether a diagonal has none of these springs, because its hole has one alone.
bool is_left_out(const Springs& springs, Index d, const VectorXd& sides) {
  if (springs.on == SpringsOn::all) return false;
  const Index first = d - d % 2;
  return d != (sides(first) <= 0 && sides(first + 1) > 0 ? first + 1 : first);
}

double rate_n_per_mm(const Springs& springs, const Diagonal& diagonal, Index d,
                     const VectorXd& sides) {
  if (const SingleSpring* const single = single_on(springs, diagonal)) {
    return single->stiffness_n_per_mm;
  }
  return is_left_out(springs, d, sides) ? 0 : springs.stiffness_n_per_mm;
}

double free_length_mm(const Springs& springs, const Diagonal& diagonal, double rate_n_per_mm,
                      double rest_mm, double side) {
  const SingleSpring* const single = single_on(springs, diagonal);
  if (single && single->free_mm) return *single->free_mm;
  const double preload_n = springs.preload.force_n(diagonal);
  if (preload_n == 0 || rate_n_per_mm == 0) return rest_mm;
  return rest_mm - side * preload_n / rate_n_per_mm;
}

// The stress-free shape: the hole at rest over the pre-stretch, or a cut-out of the flat hole.
HoleShape cut_out_of(const RubberPlates& plates, Index hole, const HoleDiagonals& holes) {
  assert(plates.prestretch > 0);
  const auto is_its = [&](const CutOut& cut_out) { return cut_out.hole == hole; };
  const auto single = std::ranges::find_if(plates.cut_outs, is_its);
  const bool is_single = single != plates.cut_outs.end();
  const double usual = 1 / plates.prestretch;
  const Vector2d ratio =
      is_single ? Vector2d(single->of_flat[0], single->of_flat[1]) : Vector2d(usual, usual);
  const VectorXd& lengths_mm = is_single ? holes.flat_mm : holes.rest_mm;
  const Vector2d mm = ratio.cwiseProduct(lengths_mm.segment<2>(2 * hole));
  return {mm(0) * mm(0), mm(1) * mm(1), ratio.prod() * holes.product_mm2(hole)};
}

}  // namespace

VectorXd diagonal_products_mm2(const Mechanism& mechanism, const FlatVertices& vertices_mm) {
  VectorXd products_mm2;
  find_diagonal_products(mechanism, vertices_mm, products_mm2);
  return products_mm2;
}

void find_diagonal_products(const Mechanism& mechanism, const FlatVertices& vertices_mm,
                            VectorXd& products_mm2) {
  products_mm2.resize(mechanism.diagonal_count() / 2);
  for (Index h = 0; h < products_mm2.size(); ++h) {
    const auto along = [&](Index d) -> Vector2d {
      const Diagonal& diagonal = mechanism.diagonals[static_cast<std::size_t>(d)];
      return vertices_mm.col(diagonal.to) - vertices_mm.col(diagonal.from);
    };
    products_mm2(h) = along(2 * h).dot(along(2 * h + 1));
  }
}

void Filling::fit(const Fill& fill, const std::vector<Diagonal>& diagonals,
                  const HoleDiagonals& holes) {
  assert(holes.rest_mm.size() == std::ssize(diagonals) && diagonals.size() % 2 == 0);
  relaxed_mm_ = holes.rest_mm;
  product_mm2_ = holes.product_mm2;
  rates_n_per_mm_.setZero(relaxed_mm_.size());
  plates_.clear();
  if (const auto* const springs = std::get_if<Springs>(&fill)) {
    pull_only_ = springs->pull_only;
    for (Index d = 0; d < relaxed_mm_.size(); ++d) {
      const Diagonal& diagonal = diagonals[static_cast<std::size_t>(d)];
      rates_n_per_mm_(d) = rate_n_per_mm(*springs, diagonal, d, holes.sides);
      assert(rates_n_per_mm_(d) >= 0);
      relaxed_mm_(d) =
          free_length_mm(*springs, diagonal, rates_n_per_mm_(d), holes.rest_mm(d), holes.sides(d));
    }
  } else if (const auto* const plates = std::get_if<RubberPlates>(&fill)) {
    assert(product_mm2_.size() == relaxed_mm_.size() / 2);
    for (Index h = 0; h < product_mm2_.size(); ++h) {
      const HoleShape cut_out = cut_out_of(*plates, h, holes);
      relaxed_mm_.segment<2>(2 * h) << std::sqrt(cut_out.first_mm2), std::sqrt(cut_out.second_mm2);
      plates_.emplace_back(plates->shear_mpa * plates->thickness_mm, cut_out);
    }
  }
}

Filling Filling::of_springs(const VectorXd& rates_n_per_mm, const VectorXd& free_mm) {
  assert(rates_n_per_mm.size() == free_mm.size() && free_mm.size() % 2 == 0);
  Filling filling;
  filling.rates_n_per_mm_ = rates_n_per_mm;
  filling.relaxed_mm_ = free_mm;
  return filling;
}

Filling Filling::in_holes(const VectorXd& product_mm2) const {
  assert(product_mm2.size() == holes());
  Filling filling = *this;
  filling.product_mm2_ = product_mm2;
  return filling;
}

HoleEnergy Filling::hole(Index hole, const Vector2d& lengths_mm) const {
  assert(hole >= 0 && hole < holes());
  if (!is_springs()) return plate(hole).at(lengths_mm, product_mm2_(hole));
  HoleEnergy energy;
  for (Index k = 0; k < 2; ++k) {
    const Index d = 2 * hole + k;
    const double longer_mm = lengths_mm(k) - relaxed_mm_(d);
    if (pull_only_ && longer_mm <= 0) continue;
    energy.n_mm += rates_n_per_mm_(d) / 2 * longer_mm * longer_mm;
    energy.force_n(k) = rates_n_per_mm_(d) * longer_mm;
    energy.n_per_mm(k, k) = rates_n_per_mm_(d);
  }
  return energy;
}

double Filling::energy_n_mm(const VectorXd& lengths_mm) const {
  double sum = 0;
  for (Index h = 0; h < holes(); ++h) sum += hole(h, lengths_mm.segment<2>(2 * h)).n_mm;
  return sum;
}

VectorXd Filling::forces_n(const VectorXd& lengths_mm) const {
  VectorXd forces_n(diagonals());
  for (Index h = 0; h < holes(); ++h) {
    forces_n.segment<2>(2 * h) = hole(h, lengths_mm.segment<2>(2 * h)).force_n;
  }
  return forces_n;
}

Eigen::MatrixXd Filling::stiffness_n_per_mm(const VectorXd& lengths_mm) const {
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(diagonals(), diagonals());
  for (Index h = 0; h < holes(); ++h) {
    blocks.block<2, 2>(2 * h, 2 * h) = hole(h, lengths_mm.segment<2>(2 * h)).n_per_mm;
  }
  return blocks;
}

const PlateLaw& Filling::plate(Index hole) const {
  assert(hole >= 0 && hole < std::ssize(plates_));
  return plates_[static_cast<std::size_t>(hole)];
}

}  // namespace misalign::solver
