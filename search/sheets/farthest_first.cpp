#include "search/sheets/farthest_first.hpp"

#include <algorithm>
#include <limits>

namespace misalign::search {

std::vector<int> farthest_first(const Eigen::MatrixXd& points, std::size_t count) {
  count = std::min(count, static_cast<std::size_t>(points.cols()));
  std::vector<int> taken;
  Eigen::RowVectorXd nearest_sq =
      Eigen::RowVectorXd::Constant(points.cols(), std::numeric_limits<double>::infinity());
  Eigen::Index next = 0;
  while (taken.size() < count) {
    taken.push_back(static_cast<int>(next));
    const Eigen::RowVectorXd to_it_sq =
        (points.colwise() - points.col(next)).colwise().squaredNorm();
    nearest_sq = nearest_sq.cwiseMin(to_it_sq);
    nearest_sq[next] = -1;  // never again, be others as near as they like
    nearest_sq.maxCoeff(&next);
  }
  return taken;
}

}  // namespace misalign::search
