#include "solver/linear/sparse_rank.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

namespace misalign::solver {
namespace {

// Smallest share that a pivot has of its column's largest entry; of such entries that in the
// shortest row is taken.
constexpr double kPivotShare = 0.1;

// Columns without a larger entry are put off. The least singular values of sheets with full rank
// are 1e-4 and more, so that none can hide among the pivots; a larger bound costs little.
constexpr double kLeastPivot = 1e-2;

struct Nonzero {
  int column;
  double value;
};
using Row = std::vector<Nonzero>;

class ColumnElimination {
 public:
  explicit ColumnElimination(const Eigen::SparseMatrix<double>& matrix)
      : rows_(matrix.rows()), rows_in_(matrix.cols()) {
    for (int column = 0; column < matrix.cols(); ++column) {
      for (Eigen::SparseMatrix<double>::InnerIterator at(matrix, column); at; ++at) {
        rows_[at.row()].push_back({column, at.value()});
        rows_in_[column].push_back(static_cast<int>(at.row()));
      }
    }
  }

  // Returns false if the column is put off.
  bool eliminate(int column) {
    double largest = 0;
    for (const int row : rows_in_[column])
      largest = std::max(largest, std::abs(value(row, column)));
    if (!(largest > kLeastPivot)) return false;
    int pivot = -1;
    for (const int row : rows_in_[column]) {
      if (std::abs(value(row, column)) < kPivotShare * largest) continue;
      if (pivot < 0 || rows_[row].size() < rows_[pivot].size()) pivot = row;
    }
    const Row pivot_row = std::move(rows_[pivot]);
    for (const Nonzero& entry : pivot_row) std::erase(rows_in_[entry.column], pivot);
    const double pivot_value = find(pivot_row, column)->value;
    for (const int row : rows_in_[column]) {
      subtract(value(row, column) / pivot_value, pivot_row, column, row);
    }
    rows_in_[column].clear();
    pivots_.push_back({column, pivot_row});
    return true;
  }

  // x with x[column] = 1, the other columns that were put off zero, and the rows of all pivots
  // satisfied.
  Eigen::VectorXd kernel_vector(int column) const {
    Eigen::VectorXd x = Eigen::VectorXd::Unit(static_cast<Eigen::Index>(rows_in_.size()), column);
    for (auto pivot = pivots_.rbegin(); pivot != pivots_.rend(); ++pivot) {
      double sum = 0, pivot_value = 1;
      for (const Nonzero& entry : pivot->second) {
        if (entry.column == pivot->first) {
          pivot_value = entry.value;
        } else {
          sum += entry.value * x[entry.column];
        }
      }
      x[pivot->first] = -sum / pivot_value;
    }
    return x;
  }

 private:
  static Row::const_iterator find(const Row& row, int column) {
    return std::lower_bound(row.begin(), row.end(), column,
                            [](const Nonzero& entry, int c) { return entry.column < c; });
  }
  double value(int row, int column) const { return find(rows_[row], column)->value; }

  // Merges two rows in column order; the row's entry in `column` goes.
  void subtract(double factor, const Row& pivot_row, int column, int row) {
    const Row& old = rows_[row];
    merged_.clear();
    auto next = old.begin();
    for (const Nonzero& entry : pivot_row) {
      while (next != old.end() && next->column < entry.column) merged_.push_back(*next++);
      const bool is_there = next != old.end() && next->column == entry.column;
      const double before = is_there ? (next++)->value : 0;
      if (entry.column == column) continue;
      merged_.push_back({entry.column, before - factor * entry.value});
      if (!is_there) rows_in_[entry.column].push_back(row);
    }
    merged_.insert(merged_.end(), next, old.end());
    rows_[row] = merged_;
  }

  std::vector<Row> rows_;
  std::vector<std::vector<int>> rows_in_;  // per column
  std::vector<std::pair<int, Row>> pivots_;
  Row merged_;  // workspace
};

}  // namespace

int sparse_rank(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& order,
                double least) {
  ColumnElimination elimination(matrix);
  std::vector<int> put_off;
  for (const int column : order) {
    if (!elimination.eliminate(column)) put_off.push_back(column);
  }
  // Later pivots may have left entries that are large enough.
  std::erase_if(put_off, [&](int column) { return elimination.eliminate(column); });
  const int columns = static_cast<int>(matrix.cols()), few = static_cast<int>(put_off.size());
  if (few == 0 || matrix.rows() == 0) return columns - few;
  Eigen::MatrixXd kernel(columns, few);
  for (int k = 0; k < few; ++k) kernel.col(k) = elimination.kernel_vector(put_off[k]);
  Eigen::HouseholderQR<Eigen::MatrixXd> qr(kernel);
  const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(columns, few);
  const Eigen::MatrixXd images = matrix * basis;
  const Eigen::HouseholderQR<Eigen::MatrixXd> triangle(images);
  const Eigen::MatrixXd r = triangle.matrixQR()
                                .topRows(std::min(few, static_cast<int>(images.rows())))
                                .triangularView<Eigen::Upper>();
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(r).singularValues();
  return columns - few + static_cast<int>((values.array() > least).count());
}

}  // namespace misalign::solver
