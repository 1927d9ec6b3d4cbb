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

Matrix3d cross_with(const Vector3d& a) {
  Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

// A function of a panel's four corners.
struct OfCorners {
  double value = 0;
  Eigen::Matrix<double, 12, 1> slope = Eigen::Matrix<double, 12, 1>::Zero();
  Eigen::Matrix<double, 12, 12> bend = Eigen::Matrix<double, 12, 12>::Zero();

  // Adds factor * (|to - from|^2 - flat^2).
  void add_square(double factor, int from, int to, const Vector3d& along, double flat_mm) {
    value += factor * (along.squaredNorm() - flat_mm * flat_mm);
    slope.segment<3>(3 * to) += 2 * factor * along;
    slope.segment<3>(3 * from) -= 2 * factor * along;
    for (int d = 0; d < 3; ++d) {
      bend(3 * to + d, 3 * to + d) += 2 * factor;
      bend(3 * from + d, 3 * from + d) += 2 * factor;
      bend(3 * to + d, 3 * from + d) -= 2 * factor;
      bend(3 * from + d, 3 * to + d) -= 2 * factor;
    }
  }
};

// Factor times six times the volume between the corners.
OfCorners volume(double factor, const Eigen::Matrix<double, 3, 4>& p) {
  const Vector3d a = p.col(1) - p.col(0), b = p.col(2) - p.col(0), c = p.col(3) - p.col(0);
  OfCorners of;
  of.value = factor * a.dot(b.cross(c));
  const std::array<Vector3d, 3> slopes{b.cross(c), c.cross(a), a.cross(b)};
  const std::array<Vector3d, 3> arms{a, b, c};
  for (int i = 0; i < 3; ++i) {
    of.slope.segment<3>(3 * (i + 1)) = factor * slopes[i];
    of.slope.head<3>() -= factor * slopes[i];
    const int next = (i + 1) % 3, third = (i + 2) % 3;
    const Matrix3d block = -factor * cross_with(arms[third]);  // d(slope i) / d(next)
    of.bend.block<3, 3>(3 * (i + 1), 3 * (next + 1)) = block;
    of.bend.block<3, 3>(3 * (next + 1), 3 * (i + 1)) = block.transpose();
  }
  for (int i = 1; i < 4; ++i) {  // the same for all moved together
    const Matrix3d sum = of.bend.block<3, 3>(3 * i, 3) + of.bend.block<3, 3>(3 * i, 6) +
                         of.bend.block<3, 3>(3 * i, 9);
    of.bend.block<3, 3>(3 * i, 0) = -sum;
    of.bend.block<3, 3>(0, 3 * i) = -sum.transpose();
    of.bend.block<3, 3>(0, 0) += sum;
  }
  return of;
}

Eigen::Matrix<double, 3, 4> corners_at(const Matrix3Xd& at_mm, const std::array<int, 4>& corners) {
  Eigen::Matrix<double, 3, 4> p;
  for (int i = 0; i < 4; ++i) p.col(i) = at_mm.col(corners[i]);
  return p;
}

// Adds stiffness / 2 value^2.
void add_elastic(double stiffness, const OfCorners& of, const std::array<int, 4>& corners,
                 ElasticEnergy& energy) {
  energy.n_mm += stiffness / 2 * of.value * of.value;
  for (int i = 0; i < 4; ++i) {
    energy.slope.segment<3>(3 * corners[i]) += stiffness * of.value * of.slope.segment<3>(3 * i);
    for (int j = 0; j < 4; ++j) {
      energy.bend.block<3, 3>(3 * corners[i], 3 * corners[j]) +=
          stiffness * (of.slope.segment<3>(3 * i) * of.slope.segment<3>(3 * j).transpose() +
                       of.value * of.bend.block<3, 3>(3 * i, 3 * j));
    }
  }
}

Vector3d mean_normal(const Eigen::Matrix<double, 3, 4>& p) {
  return (p.col(2) - p.col(0)).cross(p.col(3) - p.col(1));
}

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
      material_(material),
      thickness_mm_(thickness_mm) {
  const double e = material.e_mpa(), nu = material.poisson, t = thickness_mm;
  saddle_n_per_mm_.resize(static_cast<Index>(corners_.size()));
  panel_width_mm_ = 0;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    Outline outline;
    for (int i = 0; i < 4; ++i) {
      const int a = corners_[k][i], b = corners_[k][(i + 1) % 4];
      outline.corners_mm[i] = flat_mm_.col(a);
      outline.is_straight[i] = std::any_of(
          panels.folds.begin(), panels.folds.end(),
          [&](const auto& fold) { return std::minmax(fold.a, fold.b) == std::minmax(a, b); });
    }
    const SaddlePlate saddle = bend_into_saddle(outline.corners_mm, outline.is_straight, nu);
    const double thin = 1 + kFreeEdge * t * saddle.perimeter_mm / saddle.area_mm2;
    saddle_n_per_mm_(static_cast<Index>(k)) =
        e * t * t * t / 12 / (1 - nu * nu) * saddle.stiffness / thin;
    panel_width_mm_ = std::max(panel_width_mm_, std::sqrt(saddle.area_mm2));
    plates_.push_back(plate_of(outline.corners_mm, stiffer * e * t, nu));
    outlines_.push_back(outline);
  }
  for (const FoldLine& fold : panels.folds) {
    folds_.push_back({fold.left, fold.right, (flat_mm_.col(fold.a) - flat_mm_.col(fold.b)).norm()});
  }
  flat_lengths_mm_ = lengths_mm(flat_shape_mm());
}

// The shear angle of a parallelogram with sides a, b and diagonals d1, d2: of d2^2 - d1^2 =
// -4 a b cos, without what comes from longer sides.
ElasticSheet::Plate ElasticSheet::plate_of(const std::array<Eigen::Vector2d, 4>& corners_mm,
                                           double modulus_n_per_mm, double poisson) {
  Plate plate{};
  const Eigen::Vector2d one = corners_mm[2] - corners_mm[0], other = corners_mm[3] - corners_mm[1];
  plate.area_mm2 = (one.x() * other.y() - one.y() * other.x()) / 2;
  const double cotangent = (one.squaredNorm() - other.squaredNorm()) / (4 * plate.area_mm2);
  for (int i = 0; i < 6; ++i) {
    const int from = i < 4 ? i : i - 4, to = i < 4 ? (i + 1) % 4 : i - 2;
    const double length = (corners_mm[to] - corners_mm[from]).norm();
    plate.bars[i] = {from, to, length};
    if (i < 4) {
      plate.side_n_per_mm[i] = kEdgeShare * modulus_n_per_mm * plate.area_mm2 / (length * length);
      plate.shear[i] = cotangent / (4 * length * length);
    }
  }
  plate.shear[4] = -1 / (4 * plate.area_mm2);
  plate.shear[5] = 1 / (4 * plate.area_mm2);
  plate.stretch_n_per_mm3 =
      modulus_n_per_mm * volume_under_clamped(corners_mm) / std::pow(plate.area_mm2, 4);
  plate.shear_n_mm = modulus_n_per_mm / (2 * (1 + poisson)) * plate.area_mm2;
  return plate;
}

VectorXd ElasticSheet::stress_mpa_per_mm() const {
  const double nu = material_.poisson;
  VectorXd stress(panels());
  for (Index k = 0; const auto& [corners_mm, is_straight] : outlines_) {
    stress(k++) = saddle_stress(corners_mm, is_straight, nu, kStressDegree);
  }
  return material_.e_mpa() * thickness_mm_ / 2 / (1 - nu * nu) * stress;
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
    const double area = plates_[static_cast<std::size_t>(k)].area_mm2;
    saddles(k) = volume(1 / area, corners_at(at_mm, corners(k))).value;
  }
  return saddles;
}

MatrixXd ElasticSheet::saddle_slopes(const Matrix3Xd& at_mm) const {
  MatrixXd slopes = MatrixXd::Zero(panels(), coordinates());
  for (Index k = 0; k < panels(); ++k) {
    const double area = plates_[static_cast<std::size_t>(k)].area_mm2;
    const OfCorners of = volume(1 / area, corners_at(at_mm, corners(k)));
    for (int i = 0; i < 4; ++i) {
      slopes.block<1, 3>(k, 3 * corners(k)[i]) = of.slope.segment<3>(3 * i);
    }
  }
  return slopes;
}

double ElasticSheet::turned_mm(const Matrix3Xd& at_mm) const {
  double sum = 0;
  for (const Fold& fold : folds_) {
    sum += fold.length_mm * angle_of_normals(mean_normal(corners_at(at_mm, corners(fold.one))),
                                             mean_normal(corners_at(at_mm, corners(fold.other))));
  }
  return sum;
}

// Of one crease by the corners of both panels, four each.
Eigen::Matrix<double, 3, 8> ElasticSheet::fold_slope(const Fold& fold,
                                                     const Matrix3Xd& at_mm) const {
  const std::array<Eigen::Matrix<double, 3, 4>, 2> p{corners_at(at_mm, corners(fold.one)),
                                                     corners_at(at_mm, corners(fold.other))};
  const Vector3d n0 = mean_normal(p[0]), n1 = mean_normal(p[1]);
  const Vector3d axis = n0.cross(n1).normalized();
  Eigen::Matrix<double, 3, 8> slope;
  for (int side = 0; side < 2; ++side) {
    const Vector3d& n = side == 0 ? n0 : n1;
    // The angle grows as n goes away from the other normal.
    const Vector3d away = (side == 0 ? -1 : 1) * axis.cross(n) / n.squaredNorm();
    const Vector3d one = p[side].col(2) - p[side].col(0), other = p[side].col(3) - p[side].col(1);
    const Vector3d by_one = fold.length_mm * other.cross(away),
                   by_other = fold.length_mm * away.cross(one);
    slope.col(4 * side) = -by_one;
    slope.col(4 * side + 1) = -by_other;
    slope.col(4 * side + 2) = by_one;
    slope.col(4 * side + 3) = by_other;
  }
  return slope;
}

VectorXd ElasticSheet::turned_slope(const Matrix3Xd& at_mm) const {
  VectorXd slope = VectorXd::Zero(coordinates());
  for (const Fold& fold : folds_) {
    const auto of = fold_slope(fold, at_mm);
    for (int i = 0; i < 8; ++i) {
      const int vertex = corners(i < 4 ? fold.one : fold.other)[i % 4];
      slope.segment<3>(3 * vertex) += of.col(i);
    }
  }
  return slope;
}

void ElasticSheet::add_turned_bend(const Matrix3Xd& at_mm, double factor, MatrixXd& bend) const {
  const double step_mm = 1e-5 * panel_width_mm_;
  Matrix3Xd moved = at_mm;
  for (const Fold& fold : folds_) {
    const auto vertex_of = [&](int i) { return corners(i < 4 ? fold.one : fold.other)[i % 4]; };
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

void ElasticSheet::add_plate(std::size_t panel, const Matrix3Xd& at_mm,
                             ElasticEnergy& energy) const {
  const Plate& plate = plates_[panel];
  const auto p = corners_at(at_mm, corners_[panel]);
  OfCorners shear;
  for (int i = 0; i < 6; ++i) {
    const Bar& bar = plate.bars[i];
    const Vector3d along = p.col(bar.to) - p.col(bar.from);
    shear.add_square(plate.shear[i], bar.from, bar.to, along, bar.flat_mm);
    if (i >= 4) continue;
    OfCorners side;
    side.add_square(1 / (2 * bar.flat_mm), bar.from, bar.to, along, bar.flat_mm);
    add_elastic(plate.side_n_per_mm[i], side, corners_[panel], energy);
  }
  add_elastic(plate.shear_n_mm, shear, corners_[panel], energy);
  const OfCorners saddle = volume(1 / plate.area_mm2, p);
  OfCorners squared;
  squared.value = saddle.value * saddle.value;
  squared.slope = 2 * saddle.value * saddle.slope;
  squared.bend = 2 * (saddle.slope * saddle.slope.transpose() + saddle.value * saddle.bend);
  add_elastic(plate.stretch_n_per_mm3, squared, corners_[panel], energy);
  add_elastic(saddle_n_per_mm_(static_cast<Index>(panel)), saddle, corners_[panel], energy);
}

ElasticEnergy ElasticSheet::panels_energy(const Matrix3Xd& at_mm) const {
  ElasticEnergy energy{0, VectorXd::Zero(coordinates()),
                       MatrixXd::Zero(coordinates(), coordinates())};
  for (std::size_t k = 0; k < plates_.size(); ++k) add_plate(k, at_mm, energy);
  return energy;
}

void ElasticSheet::add_springs(const Matrix3Xd& at_mm, double n_per_mm, const VectorXd& relaxed_mm,
                               ElasticEnergy& energy) const {
  for (Index d = 0; d < diagonals(); ++d) {
    const Diagonal& at = diagonals_[static_cast<std::size_t>(d)];
    const Vector3d between = at_mm.col(at.to) - at_mm.col(at.from);
    const double length = between.norm(), pull = length - relaxed_mm(d);
    const Vector3d along = between / length;
    energy.n_mm += n_per_mm / 2 * pull * pull;
    energy.slope.segment<3>(3 * at.to) += n_per_mm * pull * along;
    energy.slope.segment<3>(3 * at.from) -= n_per_mm * pull * along;
    const Matrix3d outer = along * along.transpose();
    const Matrix3d block = n_per_mm * (outer + pull / length * (Matrix3d::Identity() - outer));
    energy.bend.block<3, 3>(3 * at.to, 3 * at.to) += block;
    energy.bend.block<3, 3>(3 * at.from, 3 * at.from) += block;
    energy.bend.block<3, 3>(3 * at.to, 3 * at.from) -= block;
    energy.bend.block<3, 3>(3 * at.from, 3 * at.to) -= block;
  }
}

// A corner in all directions, the next one but for along the side, and across at the third.
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
