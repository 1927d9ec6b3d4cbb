// Computes with points and straight edges in the plane: coincidence, crossings, convexity.
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

/// Returns the z component of the cross product of two vectors in the plane.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Returns whether a loop turns left at every corner: convex, counter-clockwise, no three on a
/// line.
bool is_convex(const PlanePoints& points, std::span<const int> loop);

/// Returns pairs of points, each with the lesser number first, that are no farther apart than
/// `within` in x and in y; at most `most` of them.
std::vector<std::pair<int, int>> coinciding(const PlanePoints& points, double within,
                                            std::size_t most);

/// Returns pairs of edges that share a point which is not a common end; at most `most`.
std::vector<std::pair<std::pair<int, int>, std::pair<int, int>>> crossing(const PlanePoints& points,
                                                                          const PlaneEdges& edges,
                                                                          std::size_t most);

/// Returns the median of at least one value, the upper of two.
double median(std::vector<double> values);

}  // namespace misalign::schema
