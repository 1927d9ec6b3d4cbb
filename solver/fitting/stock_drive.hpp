// Friction that springs of a table, with links, overcome along a way.
#pragma once

#include <vector>

#include "solver/fitting/spring_program.hpp"
#include "solver/fitting/stock_options.hpp"

namespace misalign::solver {

/// A diagonal's spring: type in the table, and link in steps.
struct StockPick {
  int diagonal, type, link;
};

/// The places of a way, and what springs overcome there. `table` and `options` must outlive it.
class StockDrive {
 public:
  StockDrive(const FoldingWay& way, double from_deg, const std::vector<StockSpring>& table,
             const StockOptions& options);

  Eigen::Index places() const { return demand_.size(); }
  double pilot_deg(Eigen::Index place) const { return pilot_deg_(place); }
  /// Returns whether friction has to be overcome at a place; elsewhere the energy has to fall.
  bool counts(Eigen::Index place) const {
    return pilot_deg_(place) > options_.to_deg - kSameAngle_deg;
  }
  /// Friction to overcome at each place, N mm per mm.
  const Eigen::VectorXd& demand() const { return demand_; }
  /// Friction that one spring overcomes at each place.
  Eigen::VectorXd gains(const StockPick& pick) const;
  Eigen::VectorXd gains(const std::vector<StockPick>& picks) const;

  /// Links of a type on a diagonal, and its picks that no other link exceeds at every place.
  LinkRange links(int diagonal, int type) const;
  std::vector<StockPick> picks(int diagonal, int type) const;

  double least_mm(int diagonal) const { return least_mm_(diagonal); }
  double most_mm(int diagonal) const { return most_mm_(diagonal); }
  int diagonals() const { return static_cast<int>(least_mm_.size()); }
  bool pulls(int type) const {
    return table_[static_cast<std::size_t>(type)].action == SpringAction::pulls;
  }
  int types() const { return static_cast<int>(table_.size()); }

 private:
  const std::vector<StockSpring>& table_;
  const StockOptions& options_;
  Eigen::VectorXd pilot_deg_, demand_, least_mm_, most_mm_;
  // Places x diagonals: gains per force, and these times the length.
  Eigen::MatrixXd per_n_, lengths_per_n_;
};

}  // namespace misalign::solver
