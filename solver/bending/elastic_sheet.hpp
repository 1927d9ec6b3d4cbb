// An elastic sheet as a structure of its vertices: panels bend into saddles and stretch a little,
// creases turn freely, the filling pulls on the holes' diagonals.
//
// Creases stay straight, since each lies in a panel that is stiff in its own plane; so panels act
// on each other through their corners, and the places x of the vertices determine everything:
//   energy = sum over panels of K q^2 / 2 + mu q^4 / 2 + edges and shears, squared
//          + sum over holes of the filling's energy.
// The first term is exact for saddles that are small beside the thickness. In larger ones the
// panel's middle plane has to stretch: mu = E t I / area^4, with I the volume under a clamped plate
// of that size, load over rigidity being 1 (von Karman's equation for w = q x y / area, edges free
// in the plane): 0.3 % of the energy in a square where q = t, 3 % where q = 3 t.
#pragma once

#include <Eigen/Geometry>
#include <cassert>
#include <vector>

#include "solver/bending/elastic_panel.hpp"
#include "solver/fill/filling.hpp"
#include "solver/model/panels.hpp"

namespace misalign::solver {

class ElasticSheet {
 public:
  /// Energy, its gradient and its second derivatives by all coordinates: those of vertex v from 3 v
  /// on.
  struct Energy {
    double n_mm = 0;
    Eigen::VectorXd slope;
    Eigen::MatrixXd bend;  ///< empty with first derivatives alone
  };
  enum class Derivatives { first, second };
  /// Those of each panel's sides and diagonals, a column each (ElasticPanel).
  using Squares = Eigen::Matrix<double, 6, Eigen::Dynamic>;

  /// `stiffer` multiplies the stiffness of panels in their planes, which approximates panels that
  /// only bend.
  ElasticSheet(const FlatVertices& flat_mm, const Panels& panels,
               const std::vector<Diagonal>& diagonals, const PanelMaterial& material,
               double thickness_mm, double stiffer = 1);

  Eigen::Index vertices() const { return flat_mm_.cols(); }
  Eigen::Index coordinates() const { return 3 * vertices(); }
  Eigen::Index panels() const { return static_cast<Eigen::Index>(plates_.size()); }
  Eigen::Index diagonals() const { return static_cast<Eigen::Index>(diagonals_.size()); }
  const std::array<int, 4>& corners(Eigen::Index panel) const {
    assert(panel >= 0 && panel < panels());
    return corners_[static_cast<std::size_t>(panel)];
  }
  double panel_width_mm() const { return panel_width_mm_; }
  Eigen::Matrix3Xd flat_shape_mm() const;

  /// Lengths of the diagonals in the flat sheet and here, and their derivatives, a row each.
  const Eigen::VectorXd& flat_lengths_mm() const { return flat_lengths_mm_; }
  Eigen::VectorXd lengths_mm(const Eigen::Matrix3Xd& at_mm) const;
  Eigen::MatrixXd length_slopes(const Eigen::Matrix3Xd& at_mm) const;
  /// Saddle q of each panel, and its derivatives.
  Eigen::VectorXd saddles_mm(const Eigen::Matrix3Xd& at_mm) const;
  Eigen::MatrixXd saddle_slopes(const Eigen::Matrix3Xd& at_mm) const;
  /// Saddle stiffness K of each panel, N/mm.
  const Eigen::VectorXd& saddle_n_per_mm() const { return saddle_n_per_mm_; }
  /// See ElasticPanel; takes some ms for a sheet.
  Eigen::VectorXd stress_mpa_per_mm() const;

  /// Sum over the creases of length times |fold angle| (mm): the work of dry friction is its moment
  /// per mm of crease times the change of this sum. Fold angles are those between the panels' mean
  /// normals, the cross products of their diagonals.
  double turned_mm(const Eigen::Matrix3Xd& at_mm) const;
  Eigen::VectorXd turned_slope(const Eigen::Matrix3Xd& at_mm) const;
  /// Adds `factor` times its second derivatives; no crease may be flat.
  void add_turned_bend(const Eigen::Matrix3Xd& at_mm, double factor, Eigen::MatrixXd& bend) const;

  /// Energy of the panels; add_filling adds that of the holes' filling, whose forces are less by
  /// `relief_n`. The products of the diagonals stay as they are, since edges hardly stretch.
  Energy panels_energy(const Eigen::Matrix3Xd& at_mm) const {
    return panels_energy(at_mm, squares_mm2(at_mm, 0 * at_mm), Derivatives::second);
  }
  /// The same, with second derivatives by the forces in the panels' planes at `squares_mm2`.
  Energy panels_energy(const Eigen::Matrix3Xd& at_mm, const Squares& squares_mm2,
                       Derivatives derivatives) const;
  Squares squares_mm2(const Eigen::Matrix3Xd& at_mm, const Eigen::Matrix3Xd& moved_mm) const;
  void add_filling(const Eigen::Matrix3Xd& at_mm, const Filling& filling,
                   const Eigen::VectorXd& relief_n, Energy& energy) const;

  /// Six coordinates of the first panel, ascending, that hold this shape still in space.
  std::vector<int> supports(const Eigen::Matrix3Xd& at_mm) const;

 private:
  struct Fold {
    int left, right;  // panels
    double length_mm;
  };
  // The panels of a crease: two diagonals of the left one, then of the right one, between vertices.
  struct FoldPlace {
    std::array<int, 4> tails, heads;
    Eigen::Matrix<double, 3, 4> diagonals_mm;
    Eigen::Matrix<double, 3, 2> normals;  // products of the diagonals
    Eigen::Vector3d axis;                 // about which the right normal is turned

    // The derivative of the angle by a normal.
    Eigen::Vector3d away(int side) const {
      const Eigen::Vector3d n = normals.col(side);
      return (side == 0 ? -1 : 1) * axis.cross(n) / n.squaredNorm();
    }
    Eigen::Matrix<double, 6, 1> by_diagonals(int side, const Eigen::Vector3d& v) const;
  };
  const ElasticPanel& plate(Eigen::Index panel) const {
    return plates_[static_cast<std::size_t>(panel)];
  }
  FoldPlace place_of(const Fold& fold, const Eigen::Matrix3Xd& at_mm) const;

  const FlatVertices flat_mm_;
  const std::vector<std::array<int, 4>> corners_;
  const std::vector<Diagonal> diagonals_;
  double panel_width_mm_;
  std::vector<ElasticPanel> plates_;
  std::vector<Fold> folds_;
  Eigen::VectorXd flat_lengths_mm_, saddle_n_per_mm_;
};

}  // namespace misalign::solver
