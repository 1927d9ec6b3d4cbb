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

VectorXd rates_of(const Springs& springs, const std::vector<Diagonal>& diagonals,
                  const VectorXd& sides) {
  VectorXd rates(std::ssize(diagonals));
  for (Index d = 0; d < rates.size(); ++d) {
    const SingleSpring* const single = single_on(springs, diagonals[static_cast<std::size_t>(d)]);
    rates(d) = single                           ? single->stiffness_n_per_mm
               : is_left_out(springs, d, sides) ? 0
                                                : springs.stiffness_n_per_mm;
    assert(rates(d) >= 0);
  }
  return rates;
}

VectorXd free_lengths_mm(const Springs& springs, const VectorXd& rates_n_per_mm,
                         const std::vector<Diagonal>& diagonals, const HoleDiagonals& holes) {
  VectorXd free_mm = holes.rest_mm;
  const VectorXd preload_n = springs.preload.forces_n(diagonals);
  for (Index d = 0; d < free_mm.size(); ++d) {
    const SingleSpring* const single = single_on(springs, diagonals[static_cast<std::size_t>(d)]);
    if (single && single->free_mm) {
      free_mm(d) = *single->free_mm;
    } else if (preload_n(d) != 0 && rates_n_per_mm(d) > 0) {
      free_mm(d) -= holes.sides(d) * preload_n(d) / rates_n_per_mm(d);
    }
  }
  return free_mm;
}

// The stress-free shapes: the holes at rest over the pre-stretch, or cut-outs of the flat holes.
std::vector<HoleShape> cut_outs_of(const RubberPlates& plates, const HoleDiagonals& holes) {
  assert(plates.prestretch > 0 && holes.product_mm2.size() == holes.rest_mm.size() / 2);
  const auto scaled = [&](const VectorXd& lengths_mm, Index hole, double first_ratio,
                          double second_ratio) {
    const double first_mm = first_ratio * lengths_mm(2 * hole),
                 second_mm = second_ratio * lengths_mm(2 * hole + 1);
    return HoleShape{first_mm * first_mm, second_mm * second_mm,
                     first_ratio * second_ratio * holes.product_mm2(hole)};
  };
  std::vector<HoleShape> shapes;
  for (Index h = 0; h < holes.product_mm2.size(); ++h) {
    shapes.push_back(scaled(holes.rest_mm, h, 1 / plates.prestretch, 1 / plates.prestretch));
  }
  for (const CutOut& cut_out : plates.cut_outs) {
    assert(cut_out.hole >= 0 && cut_out.hole < std::ssize(shapes));
    shapes[static_cast<std::size_t>(cut_out.hole)] =
        scaled(holes.flat_mm, cut_out.hole, cut_out.of_flat[0], cut_out.of_flat[1]);
  }
  return shapes;
}

}  // namespace

VectorXd diagonal_products_mm2(const Mechanism& mechanism, const FlatVertices& vertices_mm) {
  VectorXd products(mechanism.diagonal_count() / 2);
  for (Index h = 0; h < products.size(); ++h) {
    const auto along = [&](Index d) -> Vector2d {
      const Diagonal& diagonal = mechanism.diagonals[static_cast<std::size_t>(d)];
      return vertices_mm.col(diagonal.to) - vertices_mm.col(diagonal.from);
    };
    products(h) = along(2 * h).dot(along(2 * h + 1));
  }
  return products;
}

Filling::Filling(const Fill& fill, const std::vector<Diagonal>& diagonals,
                 const HoleDiagonals& holes)
    : relaxed_mm_(holes.rest_mm), product_mm2_(holes.product_mm2) {
  assert(holes.rest_mm.size() == std::ssize(diagonals) && diagonals.size() % 2 == 0);
  if (const auto* const springs = std::get_if<Springs>(&fill)) {
    rates_n_per_mm_ = rates_of(*springs, diagonals, holes.sides);
    relaxed_mm_ = free_lengths_mm(*springs, rates_n_per_mm_, diagonals, holes);
    pull_only_ = springs->pull_only;
  } else if (const auto* const plates = std::get_if<RubberPlates>(&fill)) {
    for (const HoleShape& cut_out : cut_outs_of(*plates, holes)) {
      const auto h = std::ssize(plates_);
      relaxed_mm_.segment<2>(2 * h) << std::sqrt(cut_out.first_mm2), std::sqrt(cut_out.second_mm2);
      plates_.emplace_back(plates->shear_mpa * plates->thickness_mm, cut_out);
    }
  } else {
    rates_n_per_mm_.setZero(relaxed_mm_.size());
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
