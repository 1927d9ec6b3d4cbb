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

using Corners = ElasticPanel::Corners;

Corners corners_at(const Matrix3Xd& at_mm, const std::array<int, 4>& corners) {
  Corners p;
  for (int i = 0; i < 4; ++i) p.col(i) = at_mm.col(corners[i]);
  return p;
}

// Adds the energy stiffness / 2 value^2.
void add_elastic(double stiffness, const ElasticPanel::Function& function,
                 const std::array<int, 4>& corners, ElasticSheet::Energy& energy) {
  energy.n_mm += stiffness / 2 * function.value * function.value;
  for (int i = 0; i < 4; ++i) {
    energy.slope.segment<3>(3 * corners[i]) +=
        stiffness * function.value * function.slope.segment<3>(3 * i);
    for (int j = 0; j < 4; ++j) {
      energy.bend.block<3, 3>(3 * corners[i], 3 * corners[j]) +=
          stiffness *
          (function.slope.segment<3>(3 * i) * function.slope.segment<3>(3 * j).transpose() +
           function.value * function.bend.block<3, 3>(3 * i, 3 * j));
    }
  }
}

Vector3d mean_normal(const Corners& p) { return (p.col(2) - p.col(0)).cross(p.col(3) - p.col(1)); }

double angle_of_normals(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
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
    sum += fold.length_mm * angle_of_normals(mean_normal(corners_at(at_mm, corners(fold.left))),
                                             mean_normal(corners_at(at_mm, corners(fold.right))));
  }
  return sum;
}

// Derivatives of a crease's fold angle by the corners of both panels, four each.
Eigen::Matrix<double, 3, 8> ElasticSheet::fold_slope(const Fold& fold,
                                                     const Matrix3Xd& at_mm) const {
  const std::array<Corners, 2> p{corners_at(at_mm, corners(fold.left)),
                                 corners_at(at_mm, corners(fold.right))};
  const Vector3d n0 = mean_normal(p[0]), n1 = mean_normal(p[1]);
  const Vector3d axis = n0.cross(n1).normalized();
  Eigen::Matrix<double, 3, 8> slope;
  for (int side = 0; side < 2; ++side) {
    const Vector3d& n = side == 0 ? n0 : n1;
    // The angle grows as n goes away from the other normal.
    const Vector3d away = (side == 0 ? -1 : 1) * axis.cross(n) / n.squaredNorm();
    const Vector3d diagonal_a = p[side].col(2) - p[side].col(0),
                   diagonal_b = p[side].col(3) - p[side].col(1);
    const Vector3d by_a = fold.length_mm * diagonal_b.cross(away),
                   by_b = fold.length_mm * away.cross(diagonal_a);
    slope.col(4 * side) = -by_a;
    slope.col(4 * side + 1) = -by_b;
    slope.col(4 * side + 2) = by_a;
    slope.col(4 * side + 3) = by_b;
  }
  return slope;
}

VectorXd ElasticSheet::turned_slope(const Matrix3Xd& at_mm) const {
  VectorXd slope = VectorXd::Zero(coordinates());
  for (const Fold& fold : folds_) {
    const auto rates = fold_slope(fold, at_mm);
    for (int i = 0; i < 8; ++i) {
      const int vertex = corners(i < 4 ? fold.left : fold.right)[i % 4];
      slope.segment<3>(3 * vertex) += rates.col(i);
    }
  }
  return slope;
}

void ElasticSheet::add_turned_bend(const Matrix3Xd& at_mm, double factor, MatrixXd& bend) const {
  const double step_mm = 1e-5 * panel_width_mm_;
  Matrix3Xd moved = at_mm;
  for (const Fold& fold : folds_) {
    const auto vertex_of = [&](int i) { return corners(i < 4 ? fold.left : fold.right)[i % 4]; };
    for (int i = 0; i < 8; ++i) {
      const int vertex = vertex_of(i);
      // Both panels' corners on the crease are moved together, once.
      bool seen = false;
      for (int j = 0; j < i; ++j) seen = seen || vertex_of(j) == vertex;
      if (seen) continue;
      for (int d = 0; d < 3; ++d) {
        moved(d, vertex) = at_mm(d, vertex) + step_mm;
        Eigen::Matrix<double, 3, 8> rate = fold_slope(fold, moved);
        moved(d, vertex) = at_mm(d, vertex) - step_mm;
        rate -= fold_slope(fold, moved);
        moved(d, vertex) = at_mm(d, vertex);
        rate *= factor / (2 * step_mm);
        for (int k = 0; k < 8; ++k) {
          bend.block<3, 1>(3 * vertex_of(k), 3 * vertex + d) += rate.col(k) / 2;
          bend.block<1, 3>(3 * vertex + d, 3 * vertex_of(k)) += rate.col(k).transpose() / 2;
        }
      }
    }
  }
}

ElasticSheet::Energy ElasticSheet::panels_energy(const Matrix3Xd& at_mm) const {
  Energy energy{0, VectorXd::Zero(coordinates()), MatrixXd::Zero(coordinates(), coordinates())};
  for (Index k = 0; k < panels(); ++k) {
    plate(k).each_elastic(corners_at(at_mm, corners(k)),
                          [&](double stiffness, const auto& function) {
                            add_elastic(stiffness, function, corners(k), energy);
                          });
  }
  return energy;
}

void ElasticSheet::add_filling(const Matrix3Xd& at_mm, const Filling& filling,
                               const VectorXd& relief_n, Energy& energy) const {
  const VectorXd lengths = lengths_mm(at_mm);
  const auto along = [&](const Diagonal& at) -> Vector3d {
    return (at_mm.col(at.to) - at_mm.col(at.from)).normalized();
  };
  const auto add_block = [&](const Diagonal& row, const Diagonal& column, const Matrix3d& block) {
    energy.bend.block<3, 3>(3 * row.to, 3 * column.to) += block;
    energy.bend.block<3, 3>(3 * row.from, 3 * column.from) += block;
    energy.bend.block<3, 3>(3 * row.to, 3 * column.from) -= block;
    energy.bend.block<3, 3>(3 * row.from, 3 * column.to) -= block;
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
      add_block(at, at, force_n / lengths(d) * (Matrix3d::Identity() - pull * pull.transpose()));
      for (Index l = 0; l < 2; ++l) {
        const Diagonal& column = diagonals_[static_cast<std::size_t>(2 * h + l)];
        add_block(at, column, hole.n_per_mm(k, l) * pull * along(column).transpose());
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
