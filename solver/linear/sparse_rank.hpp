// The rank of a large sparse matrix.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace misalign::solver {

/// How many singular values of `matrix` are above `least`. Columns are eliminated in `order`, each
/// once; those in which nothing is left but small entries are put off. Whatever is in the kernel,
/// or near it, is then a combination of the vectors that each of them gives: the singular values of
/// the matrix on these few are those that are counted. So it never finds a rank too large; too
/// small it would be only if none of the pivots were small and the matrix nearly singular
/// nevertheless (Golub & Van Loan, Matrix Computations, 5.5.7; compared with SVDs in tests).
int sparse_rank(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& order,
                double least);

}  // namespace misalign::solver
