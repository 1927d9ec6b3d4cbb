// The filling of one sheet's holes: its energy, forces and stiffness by the lengths of the
// diagonals.
#pragma once

#include <vector>

#include "solver/fill/fill.hpp"
#include "solver/fill/hole_energy.hpp"

namespace misalign::solver {

/// Diagonals of a sheet's holes, in the order of its mechanism: two for each hole.
struct HoleDiagonals {
  Eigen::VectorXd flat_mm;
  /// Lengths where springs or plates are relaxed, apart from preload or pre-stretch.
  Eigen::VectorXd rest_mm;
  /// The change of each next to flat: 1 longer, -1 shorter, 0 neither.
  Eigen::VectorXd sides;
  /// Product of the diagonals' vectors of each hole, which stays as it is (hole_energy.hpp); only
  /// plates need it.
  Eigen::VectorXd product_mm2;
};

/// Products of the diagonals' vectors of all holes of a flat sheet, mm^2.
Eigen::VectorXd diagonal_products_mm2(const Mechanism& mechanism, const FlatVertices& vertices_mm);
/// The same into memory that is there already.
void find_diagonal_products(const Mechanism& mechanism, const FlatVertices& vertices_mm,
                            Eigen::VectorXd& products_mm2);

class Filling {
 public:
  /// Nothing, in no hole.
  Filling() = default;
  /// Single springs and cut-outs must be on diagonals and holes of the sheet.
  Filling(const Fill& fill, const std::vector<Diagonal>& diagonals, const HoleDiagonals& holes) {
    fit(fill, diagonals, holes);
  }
  /// Becomes the filling of another sheet, in the memory that it has.
  void fit(const Fill& fill, const std::vector<Diagonal>& diagonals, const HoleDiagonals& holes);

  /// The same springs or plates in holes with other products of their diagonals (HoleDiagonals).
  Filling in_holes(const Eigen::VectorXd& product_mm2) const;

  /// Springs with these rates and free lengths, one a diagonal.
  static Filling of_springs(const Eigen::VectorXd& rates_n_per_mm, const Eigen::VectorXd& free_mm);

  Eigen::Index diagonals() const { return relaxed_mm_.size(); }
  Eigen::Index holes() const { return diagonals() / 2; }
  bool is_springs() const { return plates_.empty(); }

  /// Energy and derivatives of one hole's filling where its diagonals have these lengths.
  HoleEnergy hole(Eigen::Index hole, const Eigen::Vector2d& lengths_mm) const;

  double energy_n_mm(const Eigen::VectorXd& lengths_mm) const;
  /// Derivatives of the energy by the lengths: positive where the filling pulls.
  Eigen::VectorXd forces_n(const Eigen::VectorXd& lengths_mm) const;
  /// Second derivatives, N/mm: a block of two for each hole.
  Eigen::MatrixXd stiffness_n_per_mm(const Eigen::VectorXd& lengths_mm) const;

  /// Free length of each spring; of plates, the diagonals of the cut-outs.
  const Eigen::VectorXd& relaxed_mm() const { return relaxed_mm_; }
  /// Rate of each spring, N/mm; 0 for plates.
  const Eigen::VectorXd& rates_n_per_mm() const { return rates_n_per_mm_; }
  /// The plate of a hole.
  const PlateLaw& plate(Eigen::Index hole) const;

 private:
  Eigen::VectorXd relaxed_mm_, rates_n_per_mm_, product_mm2_;
  bool pull_only_ = false;
  std::vector<PlateLaw> plates_;
};

}  // namespace misalign::solver
