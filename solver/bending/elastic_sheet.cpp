#include "solver/bending/elastic_sheet.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Corners = ElasticPanel::Corners;

Corners corners_at(const Matrix3Xd& at_mm, const std::array<int, 4>& corners) {
  Corners p;
  for (int i = 0; i < 4; ++i) p.col(i) = at_mm.col(corners[i]);
  return p;
}

}  // namespace

ElasticSheet::ElasticSheet(const FlatVertices& flat_mm, const Panels& panels,
                           const std::vector<Diagonal>& diagonals, const PanelMaterial& material,
                           double thickness_mm, double stiffer)
    : flat_mm_(flat_mm),
      corners_(panels.corners),
      diagonals_(diagonals),
      panel_width_mm_(0),
      saddle_n_per_mm_(static_cast<Index>(corners_.size())) {
  for (const std::array<int, 4>& corners : corners_) {
    std::array<Eigen::Vector2d, 4> corners_mm;
    std::array<bool, 4> is_straight{};
    for (int i = 0; i < 4; ++i) {
      const int a = corners[i], b = corners[(i + 1) % 4];
      corners_mm[i] = flat_mm_.col(a);
      is_straight[i] = std::any_of(panels.folds.begin(), panels.folds.end(), [&](const auto& fold) {
        return std::minmax(fold.a, fold.b) == std::minmax(a, b);
      });
    }
    plates_.emplace_back(corners_mm, is_straight, material, thickness_mm, stiffer);
    saddle_n_per_mm_(std::ssize(plates_) - 1) = plates_.back().saddle_n_per_mm();
    panel_width_mm_ = std::max(panel_width_mm_, std::sqrt(plates_.back().area_mm2()));
  }
  for (const FoldLine& fold : panels.folds) {
    folds_.push_back({fold.left, fold.right, (flat_mm_.col(fold.a) - flat_mm_.col(fold.b)).norm()});
  }
  flat_lengths_mm_ = lengths_mm(flat_shape_mm());
}

VectorXd ElasticSheet::stress_mpa_per_mm() const {
  VectorXd stress(panels());
  for (Index k = 0; const ElasticPanel& plate : plates_) stress(k++) = plate.stress_mpa_per_mm();
  return stress;
}

Matrix3Xd ElasticSheet::flat_shape_mm() const {
  Matrix3Xd shape_mm = Matrix3Xd::Zero(3, vertices());
  shape_mm.topRows<2>() = flat_mm_;
  return shape_mm;
}

VectorXd ElasticSheet::lengths_mm(const Matrix3Xd& at_mm) const {
  VectorXd lengths(diagonals());
  for (Index d = 0; d < diagonals(); ++d) {
    const Diagonal& at = diagonals_[static_cast<std::size_t>(d)];
    lengths(d) = (at_mm.col(at.to) - at_mm.col(at.from)).norm();
  }
  return lengths;
}

MatrixXd ElasticSheet::length_slopes(const Matrix3Xd& at_mm) const {
  MatrixXd slopes = MatrixXd::Zero(diagonals(), coordinates());
  for (Index d = 0; d < diagonals(); ++d) {
    const Diagonal& at = diagonals_[static_cast<std::size_t>(d)];
    const Vector3d along = (at_mm.col(at.to) - at_mm.col(at.from)).normalized();
    slopes.block<1, 3>(d, 3 * at.to) = along;
    slopes.block<1, 3>(d, 3 * at.from) = -along;
  }
  return slopes;
}

VectorXd ElasticSheet::saddles_mm(const Matrix3Xd& at_mm) const {
  VectorXd saddles(panels());
  for (Index k = 0; k < panels(); ++k) {
    saddles(k) = plate(k).saddle(corners_at(at_mm, corners(k))).value;
  }
  return saddles;
}

MatrixXd ElasticSheet::saddle_slopes(const Matrix3Xd& at_mm) const {
  MatrixXd slopes = MatrixXd::Zero(panels(), coordinates());
  for (Index k = 0; k < panels(); ++k) {
    const ElasticPanel::Function saddle = plate(k).saddle(corners_at(at_mm, corners(k)));
    for (int i = 0; i < 4; ++i) {
      slopes.block<1, 3>(k, 3 * corners(k)[i]) = saddle.slope.segment<3>(3 * i);
    }
  }
  return slopes;
}

double ElasticSheet::turned_mm(const Matrix3Xd& at_mm) const {
  double sum = 0;
  for (const Fold& fold : folds_) {
    const Eigen::Matrix<double, 3, 2> n = place_of(fold, at_mm).normals;
    sum += fold.length_mm * std::atan2(n.col(0).cross(n.col(1)).norm(), n.col(0).dot(n.col(1)));
  }
  return sum;
}

ElasticSheet::FoldPlace ElasticSheet::place_of(const Fold& fold, const Matrix3Xd& at_mm) const {
  FoldPlace place;
  for (int k = 0; k < 4; ++k) {
    const std::array<int, 4>& c = corners(k < 2 ? fold.left : fold.right);
    place.tails[k] = c[k % 2], place.heads[k] = c[k % 2 + 2];
    place.diagonals_mm.col(k) = at_mm.col(place.heads[k]) - at_mm.col(place.tails[k]);
  }
  for (int side = 0; side < 2; ++side) {
    place.normals.col(side) =
        place.diagonals_mm.col(2 * side).cross(place.diagonals_mm.col(2 * side + 1));
  }
  place.axis = place.normals.col(0).cross(place.normals.col(1)).normalized();
  return place;
}

// Derivatives of a side's normal along v second its two diagonals.
Vector6d ElasticSheet::FoldPlace::by_diagonals(int side, const Vector3d& v) const {
  Vector6d derivatives;
  derivatives << diagonals_mm.col(2 * side + 1).cross(v), v.cross(diagonals_mm.col(2 * side));
  return derivatives;
}

VectorXd ElasticSheet::turned_slope(const Matrix3Xd& at_mm) const {
  VectorXd slope = VectorXd::Zero(coordinates());
  for (const Fold& fold : folds_) {
    const FoldPlace place = place_of(fold, at_mm);
    for (int side = 0; side < 2; ++side) {
      const Vector6d rates = fold.length_mm * place.by_diagonals(side, place.away(side));
      for (int k = 0; k < 2; ++k) {
        slope.segment<3>(3 * place.heads[2 * side + k]) += rates.segment<3>(3 * k);
        slope.segment<3>(3 * place.tails[2 * side + k]) -= rates.segment<3>(3 * k);
      }
    }
  }
  return slope;
}

// Second derivatives of the angle between two vectors: with parts a along a vector, b away from the
// other in their plane and c across it, each over the vector's length, the angle grows by
//   b0 + b1 - a0 b0 - a1 b1 + (c0^2 + c1^2) cot / 2 - c0 c1 / sin.
void ElasticSheet::add_turned_bend(const Matrix3Xd& at_mm, double factor, MatrixXd& bend) const {
  for (const Fold& fold : folds_) {
    const FoldPlace place = place_of(fold, at_mm);
    const double cosine = place.normals.col(0).normalized().dot(place.normals.col(1).normalized()),
                 sine = std::sqrt(1 - cosine * cosine);
    Eigen::Matrix<double, 12, 12> second = Eigen::Matrix<double, 12, 12>::Zero();
    std::array<Vector6d, 2> across;
    for (int side = 0; side < 2; ++side) {
      const Vector3d n = place.normals.col(side), away = place.away(side);
      const Vector6d a = place.by_diagonals(side, n / n.squaredNorm()),
                     b = place.by_diagonals(side, away);
      across[side] = place.by_diagonals(side, place.axis / n.norm());
      auto block = second.block<6, 6>(6 * side, 6 * side);
      block = across[side] * across[side].transpose() * (cosine / sine) - a * b.transpose() -
              b * a.transpose();
      for (int d = 0; d < 3; ++d) {  // a normal is a product of diagonals
        const Vector3d turn = Vector3d::Unit(d).cross(away);
        block.block<3, 1>(0, 3 + d) += turn;
        block.block<1, 3>(3 + d, 0) += turn.transpose();
      }
    }
    second.topRightCorner<6, 6>() = across[0] * across[1].transpose() / -sine;
    second.bottomLeftCorner<6, 6>() = second.topRightCorner<6, 6>().transpose();
    second *= factor * fold.length_mm;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        add_ends(place.heads[i], place.tails[i], place.heads[j], place.tails[j],
                 second.block<3, 3>(3 * i, 3 * j), bend);
      }
    }
  }
}

ElasticSheet::Squares ElasticSheet::squares_mm2(const Matrix3Xd& at_mm,
                                                const Matrix3Xd& moved_mm) const {
  Squares squares(6, panels());
  for (Index k = 0; k < panels(); ++k) {
    squares.col(k) =
        plate(k).squares_mm2(corners_at(at_mm, corners(k)), corners_at(moved_mm, corners(k)));
  }
  return squares;
}

ElasticSheet::Energy ElasticSheet::panels_energy(const Matrix3Xd& at_mm, const Squares& squares_mm2,
                                                 Derivatives derivatives) const {
  const Index bends = derivatives == Derivatives::second ? coordinates() : 0;
  Energy energy{0, VectorXd::Zero(coordinates()), MatrixXd::Zero(bends, bends)};
  for (Index k = 0; k < panels(); ++k) {
    const std::array<int, 4>& c = corners(k);
    const ElasticPanel::Function panel = plate(k).energy(corners_at(at_mm, c), squares_mm2.col(k));
    energy.n_mm += panel.value;
    for (int i = 0; i < 4; ++i) {
      energy.slope.segment<3>(3 * c[i]) += panel.slope.segment<3>(3 * i);
      for (int j = 0; j < 4 && bends > 0; ++j) {
        energy.bend.block<3, 3>(3 * c[i], 3 * c[j]) += panel.bend.block<3, 3>(3 * i, 3 * j);
      }
    }
  }
  return energy;
}

void ElasticSheet::add_filling(const Matrix3Xd& at_mm, const Filling& filling,
                               const VectorXd& relief_n, Energy& energy) const {
  const VectorXd lengths = lengths_mm(at_mm);
  const auto along = [&](const Diagonal& at) -> Vector3d {
    return (at_mm.col(at.to) - at_mm.col(at.from)).normalized();
  };
  for (Index h = 0; h < filling.holes(); ++h) {
    const HoleEnergy hole = filling.hole(h, lengths.segment<2>(2 * h));
    energy.n_mm += hole.n_mm;
    for (Index k = 0; k < 2; ++k) {
      const Index d = 2 * h + k;
      const Diagonal& at = diagonals_[static_cast<std::size_t>(d)];
      const Vector3d pull = along(at);
      const double force_n = hole.force_n(k) - relief_n(d);
      energy.slope.segment<3>(3 * at.to) += force_n * pull;
      energy.slope.segment<3>(3 * at.from) -= force_n * pull;
      if (energy.bend.size() == 0) continue;
      add_ends(at.to, at.from, at.to, at.from,
               force_n / lengths(d) * (Matrix3d::Identity() - pull * pull.transpose()),
               energy.bend);
      for (Index l = 0; l < 2; ++l) {
        const Diagonal& column = diagonals_[static_cast<std::size_t>(2 * h + l)];
        add_ends(at.to, at.from, column.to, column.from,
                 hole.n_per_mm(k, l) * pull * along(column).transpose(), energy.bend);
      }
    }
  }
}

// Holds a corner in all directions, the next across the side, and the third out of the plane.
std::vector<int> ElasticSheet::supports(const Matrix3Xd& at_mm) const {
  const auto& c = corners_.front();
  const Vector3d along = at_mm.col(c[1]) - at_mm.col(c[0]),
                 other = at_mm.col(c[3]) - at_mm.col(c[0]);
  int free = 0, across = 0;
  along.cwiseAbs().maxCoeff(&free);
  along.cross(other).cwiseAbs().maxCoeff(&across);
  std::vector<int> held{3 * c[0], 3 * c[0] + 1, 3 * c[0] + 2, 3 * c[3] + across};
  for (int d = 0; d < 3; ++d) {
    if (d != free) held.push_back(3 * c[1] + d);
  }
  std::sort(held.begin(), held.end());
  return held;
}

}  // namespace misalign::solver
