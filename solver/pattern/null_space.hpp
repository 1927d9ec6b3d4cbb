// Finds all solutions of homogeneous linear equations by one elimination in a fixed order: the
// same bits on every machine, since it only adds, multiplies and divides.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace misalign::solver {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct NullSpace {
  std::vector<int> free;  ///< unknowns that may be chosen, in ascending order
  RowMatrix basis;        ///< unknowns x free: what each unknown becomes when one of these is 1
};

/// Solutions of `equations` (rows x unknowns) times x = 0. Unknowns are eliminated in `order`, each
/// by the row in which it is largest, the first of equal ones, so that the free ones come late in
/// it. Entries of no more than `least_pivot` are zero.
NullSpace null_space(RowMatrix equations, const std::vector<int>& order, double least_pivot);

/// matrix x vector, each row summed from its first column on: the same bits on every machine.
Eigen::VectorXd product_in_order(const RowMatrix& matrix, const Eigen::VectorXd& vector);

}  // namespace misalign::solver
