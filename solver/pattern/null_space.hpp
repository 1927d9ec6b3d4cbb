// Finds all solutions of homogeneous linear equations by one elimination in a fixed order: the
// same bits on every machine, since it only adds, multiplies and divides.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace misalign::solver {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct NullSpace {
  std::vector<int> free;  ///< free unknowns, ascending
  RowMatrix basis;        ///< unknowns x free: each unknown's value when one free unknown is 1
};

/// Solutions x of `equations` (rows x unknowns) times x = 0. Unknowns are eliminated in `order`,
/// each by the (first) row in which it is largest, so that free unknowns come late in `order`.
/// Entries up to `least_pivot` count as zero.
NullSpace null_space(RowMatrix equations, const std::vector<int>& order, double least_pivot);

/// matrix x vector, each row summed from its first column on: the same bits on every machine.
Eigen::VectorXd product_in_order(const RowMatrix& matrix, const Eigen::VectorXd& vector);

}  // namespace misalign::solver
