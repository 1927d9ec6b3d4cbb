#include "solver/pattern/isometric_pair.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

namespace misalign::solver {
namespace {

// The error is squared by each step: from 0.1 mm on panels of 80 mm five are usual.
constexpr int kMostPairSteps = 12;
constexpr double kCongruent_widths = 1e-13;
// Damping as a share of the largest diagonal entry: constraints may depend on one another.
constexpr double kPairDamping = 1e-13;

std::vector<std::array<int, 4>> kept_panels(const CreasePattern& sheet,
                                            const std::vector<int>& holes) {
  std::vector<std::array<int, 4>> kept;
  for (int f = 0; f < sheet.facet_count(); ++f) {
    if (!std::ranges::binary_search(holes, f)) {
      kept.push_back(sheet.facets[static_cast<std::size_t>(f)]);
    }
  }
  return kept;
}

// Six times the volume of the tetrahedron of a panel's corners.
double spanned_volume(const std::array<int, 4>& corners, const FoldedVertices& at) {
  const Eigen::Vector3d b = at.col(corners[1]) - at.col(corners[0]),
                        c = at.col(corners[2]) - at.col(corners[0]),
                        d = at.col(corners[3]) - at.col(corners[0]);
  return b.cross(c).dot(d);
}

// Constraints of congruent panels: squared lengths of edges and of a diagonal each, and volumes of
// the folded panels. Unknowns are flat places, then folded ones, in panel widths.
class Congruence {
 public:
  Congruence(const CreasePattern& sheet, const std::vector<int>& holes)
      : vertices_(sheet.vertex_count()), panels_(kept_panels(sheet, holes)) {
    std::set<std::pair<int, int>> lengths;
    for (const auto& corners : panels_) {
      for (std::size_t k = 0; k < 4; ++k) {
        lengths.insert(std::minmax(corners[k], corners[(k + 1) % 4]));
      }
      lengths.insert(std::minmax(corners[0], corners[2]));
    }
    lengths_.assign(lengths.begin(), lengths.end());
  }

  Eigen::Index rows() const { return std::ssize(lengths_) + std::ssize(panels_); }

  void evaluate(const Eigen::VectorXd& at, Eigen::VectorXd& residual,
                Eigen::SparseMatrix<double>& jacobian) const {
    const Eigen::Map<const FlatVertices> flat(at.data(), 2, vertices_);
    const FoldedVertices folded = at.tail(3 * vertices_).reshaped(3, vertices_);
    std::vector<Eigen::Triplet<double>> entries;
    residual.resize(rows());
    int row = 0;
    for (const auto& [a, b] : lengths_) {
      const Eigen::Vector2d u = flat.col(a) - flat.col(b);
      const Eigen::Vector3d v = folded.col(a) - folded.col(b);
      residual(row) = (u.squaredNorm() - v.squaredNorm()) / 2;
      for (int k = 0; k < 2; ++k)
        add_difference(row, flat_column(a, k), flat_column(b, k), u(k), entries);
      for (int k = 0; k < 3; ++k) {
        add_difference(row, folded_column(a, k), folded_column(b, k), -v(k), entries);
      }
      ++row;
    }
    for (const auto& corners : panels_) {
      residual(row) = spanned_volume(corners, folded);
      const Eigen::Vector3d b = folded.col(corners[1]) - folded.col(corners[0]),
                            c = folded.col(corners[2]) - folded.col(corners[0]),
                            d = folded.col(corners[3]) - folded.col(corners[0]);
      const std::array<Eigen::Vector3d, 3> slopes = {c.cross(d), d.cross(b), b.cross(c)};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        for (int k = 0; k < 3; ++k) {
          add_difference(row, folded_column(corners[corner + 1], k), folded_column(corners[0], k),
                         slopes[corner](k), entries);
        }
      }
      ++row;
    }
    jacobian.resize(rows(), at.size());
    jacobian.setFromTriplets(entries.begin(), entries.end());
  }

 private:
  static void add_difference(int row, int plus, int minus, double slope,
                             std::vector<Eigen::Triplet<double>>& entries) {
    entries.emplace_back(row, plus, slope);
    entries.emplace_back(row, minus, -slope);
  }
  static int flat_column(int vertex, int k) { return 2 * vertex + k; }
  int folded_column(int vertex, int k) const { return 2 * vertices_ + 3 * vertex + k; }

  const int vertices_;
  const std::vector<std::array<int, 4>> panels_;
  std::vector<std::pair<int, int>> lengths_;
};

}  // namespace

LengthMisfit largest_length_misfit(const CreasePattern& sheet, const std::vector<int>& holes,
                                   const FoldedVertices& folded_mm) {
  LengthMisfit worst;
  for (const auto& corners : kept_panels(sheet, holes)) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        const auto [a, b] = std::minmax(corners[i], corners[k]);
        const LengthMisfit misfit{a, b,
                                  (sheet.vertices_mm.col(a) - sheet.vertices_mm.col(b)).norm(),
                                  (folded_mm.col(a) - folded_mm.col(b)).norm()};
        if (worst.from < 0 || misfit.mm() > worst.mm()) worst = misfit;
      }
    }
  }
  return worst;
}

PlaneMisfit largest_plane_misfit(const CreasePattern& sheet, const std::vector<int>& holes,
                                 const FoldedVertices& folded_mm) {
  PlaneMisfit worst;
  for (int f = 0; f < sheet.facet_count(); ++f) {
    if (std::ranges::binary_search(holes, f)) continue;
    const auto& v = sheet.facets[static_cast<std::size_t>(f)];
    const Eigen::Vector3d across = folded_mm.col(v[2]) - folded_mm.col(v[0]),
                          other = folded_mm.col(v[3]) - folded_mm.col(v[1]);
    const double off_mm = std::abs(spanned_volume(v, folded_mm)) / across.cross(other).norm();
    if (worst.facet < 0 || !(off_mm <= worst.mm)) worst = {f, off_mm};
  }
  return worst;
}

std::optional<IsometricPair> nearest_isometric_pair(const CreasePattern& sheet,
                                                    const std::vector<int>& holes,
                                                    const FoldedVertices& folded_mm) {
  const Eigen::Index count = sheet.vertices_mm.cols();
  const double width_mm = sheet.panel_width_mm;
  assert(folded_mm.cols() == count && width_mm > 0);
  Eigen::VectorXd at(5 * count), residual;
  at << sheet.vertices_mm.reshaped() / width_mm, folded_mm.reshaped() / width_mm;
  const Congruence congruence(sheet, holes);
  Eigen::SparseMatrix<double> jacobian;
  for (int k = 0;; ++k) {
    congruence.evaluate(at, residual, jacobian);
    if (residual.lpNorm<Eigen::Infinity>() <= kCongruent_widths) break;
    if (k == kMostPairSteps || !residual.allFinite()) return std::nullopt;
    Eigen::SparseMatrix<double> normal = jacobian * jacobian.transpose();
    const double damping = kPairDamping * Eigen::VectorXd(normal.diagonal()).maxCoeff();
    for (Eigen::Index r = 0; r < normal.rows(); ++r) normal.coeffRef(r, r) += damping;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(normal);
    if (factor.info() != Eigen::Success) return std::nullopt;
    at -= jacobian.transpose() * factor.solve(residual);
  }
  IsometricPair pair{at.head(2 * count).reshaped(2, count) * width_mm,
                     at.tail(3 * count).reshaped(3, count) * width_mm, 0};
  pair.moved_mm =
      std::sqrt(std::max((pair.flat_mm - sheet.vertices_mm).colwise().squaredNorm().maxCoeff(),
                         (pair.folded_mm - folded_mm).colwise().squaredNorm().maxCoeff()));
  return pair;
}

}  // namespace misalign::solver
