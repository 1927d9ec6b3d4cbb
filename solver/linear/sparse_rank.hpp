// Finds the rank of a large sparse matrix.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace misalign::solver {

/// Number of singular values of `matrix` above `least`. Columns are eliminated in `order`, each
/// once; those with small entries only are put off. Each of these gives a vector, and the kernel,
/// or nearly so, consists of combinations of these vectors: the singular values of the matrix on
/// these few are counted. So the rank is never too large, and too small only if no pivot is small
/// and the matrix nearly singular nevertheless (Golub & Van Loan, Matrix Computations, 5.5.7;
/// compared with SVDs in tests).
int sparse_rank(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& order,
                double least);

}  // namespace misalign::solver
