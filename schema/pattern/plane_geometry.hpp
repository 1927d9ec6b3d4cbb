// Points and straight edges in the plane: which coincide, which cross, what is convex.
#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace misalign::schema {

using PlanePoints = std::vector<Eigen::Vector2d>;
/// Ends in order -> assignment.
using PlaneEdges = std::map<std::pair<int, int>, std::string>;

/// The z component of the cross product of two vectors in the plane.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether the way round goes left at every corner: convex, counterclockwise, no three on a line.
bool is_convex(const PlanePoints& points, std::span<const int> loop);

/// Pairs of points, each with the lesser number first, that are no farther apart than `within` in x
/// and in y; no more than `most` of them.
std::vector<std::pair<int, int>> coinciding(const PlanePoints& points, double within,
                                            std::size_t most);

/// Pairs of edges that have a point in common which is not a common end; no more than `most`.
std::vector<std::pair<std::pair<int, int>, std::pair<int, int>>> crossing(const PlanePoints& points,
                                                                          const PlaneEdges& edges,
                                                                          std::size_t most);

/// The middle one by size, the upper of two; there is one at least.
double median(std::vector<double> values);

}  // namespace misalign::schema
