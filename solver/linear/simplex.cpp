#include "solver/linear/simplex.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

// Gains and entries below this are rounding: entries of these programs are about 1.
constexpr double kNoGain = 1e-9;
constexpr double kLeastEntry = 1e-9;
// Largest violation of a bound for the sake of a larger pivot, since small ones spoil the tableau
// (Harris 1973).
constexpr double kPassed = 1e-10;
// Number of pivots without gain after which Bland's rule applies, which cannot cycle: the first
// column that gains is taken, not the best.
constexpr int kIdlePivots = 50;

class Tableau {
 public:
  explicit Tableau(const LinearProgram& program)
      : rows_(static_cast<int>(program.rows.rows())),
        variables_(static_cast<int>(program.rows.cols())),
        cells_(RowMatrix::Zero(rows_ + 1, variables_ + 1)) {
    cells_.topLeftCorner(rows_, variables_) = program.rows;
    cells_.topRightCorner(rows_, 1) = program.bounds;
    cells_.bottomLeftCorner(1, variables_) = -program.gain.transpose();
    for (int k = 0; k < variables_; ++k) outside_.push_back(k);
    for (int r = 0; r < rows_; ++r) inside_.push_back(variables_ + r);
  }

  // Column with the largest gain, or with `first` the first that gains; -1 if there is none.
  int entering(bool first) const {
    int best = -1;
    double most = kNoGain;
    for (int k = 0; k < variables_; ++k) {
      const double gain = -cells_(rows_, k);
      const auto at = static_cast<std::size_t>(k);
      if (first) {
        const bool earlier = best < 0 || outside_[at] < outside_[static_cast<std::size_t>(best)];
        if (gain > kNoGain && earlier) best = k;
      } else if (gain > most) {
        best = k;
        most = gain;
      }
    }
    return best;
  }

  // Row that limits the column; -1 if none does. Of the rows that limit it most the one with the
  // largest pivot; by Bland's rule, without tolerance, that of the first variable.
  int leaving(int column, bool first) const {
    const auto ratio = [&](int r, double passed) {
      return (cells_(r, variables_) + passed) / cells_(r, column);
    };
    double least = std::numeric_limits<double>::infinity();
    for (int r = 0; r < rows_; ++r) {
      if (cells_(r, column) > kLeastEntry) least = std::min(least, ratio(r, first ? 0 : kPassed));
    }
    int best = -1;
    for (int r = 0; r < rows_; ++r) {
      if (cells_(r, column) <= kLeastEntry || ratio(r, 0) > least) continue;
      const auto at = static_cast<std::size_t>(r);
      const bool goes_before =
          best < 0 || (first ? inside_[at] < inside_[static_cast<std::size_t>(best)]
                             : cells_(r, column) > cells_(best, column));
      if (goes_before) best = r;
    }
    return best;
  }

  void exchange(int row, int column) {
    const double pivot = cells_(row, column);
    for (int k = 0; k <= variables_; ++k) cells_(row, k) /= pivot;
    cells_(row, column) = 1 / pivot;
    for (int r = 0; r <= rows_; ++r) {
      const double factor = cells_(r, column);
      if (r == row || factor == 0) continue;
      for (int k = 0; k <= variables_; ++k) {
        if (k != column) cells_(r, k) -= factor * cells_(row, k);
      }
      cells_(r, column) = -factor * cells_(row, column);
    }
    std::swap(inside_[static_cast<std::size_t>(row)], outside_[static_cast<std::size_t>(column)]);
  }

  double value() const { return cells_(rows_, variables_); }

  LinearOptimum optimum(LinearOptimum::StopReason end, int pivots) const {
    LinearOptimum optimum{end,    Eigen::VectorXd::Zero(variables_), value(), {},
                          pivots, Eigen::VectorXd::Zero(rows_)};
    for (int r = 0; r < rows_; ++r) {
      const int variable = inside_[static_cast<std::size_t>(r)];
      if (variable < variables_) optimum.x(variable) = std::max(0.0, cells_(r, variables_));
    }
    for (int k = 0; k < variables_; ++k) {
      const int variable = outside_[static_cast<std::size_t>(k)];
      if (variable >= variables_ && cells_(rows_, k) > kNoGain) {
        optimum.binding.push_back(variable - variables_);
        optimum.price(variable - variables_) = cells_(rows_, k);
      }
    }
    std::sort(optimum.binding.begin(), optimum.binding.end());
    return optimum;
  }

 private:
  const int rows_, variables_;
  RowMatrix cells_;  // bounds in the last column, gains in the last row
  std::vector<int> outside_, inside_;
};

}  // namespace

LinearOptimum maximize(const LinearProgram& program) {
  assert((program.bounds.array() >= 0).all());
  Tableau tableau(program);
  const int most = 50 * static_cast<int>(program.rows.rows() + program.rows.cols());
  int idle = 0;
  for (int pivots = 0; pivots < most; ++pivots) {
    const bool is_idle = idle >= kIdlePivots;
    const int column = tableau.entering(is_idle);
    if (column < 0) return tableau.optimum(LinearOptimum::StopReason::optimal, pivots);
    const int row = tableau.leaving(column, is_idle);
    if (row < 0) return tableau.optimum(LinearOptimum::StopReason::unbounded, pivots);
    const double before = tableau.value();
    tableau.exchange(row, column);
    idle = tableau.value() > before ? 0 : idle + 1;
  }
  return tableau.optimum(LinearOptimum::StopReason::too_long, most);
}

}  // namespace misalign::solver
