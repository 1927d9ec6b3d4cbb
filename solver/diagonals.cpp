#include "solver/diagonals.hpp"

namespace misalign::solver {
namespace {

double distance(const Vec3<double>& p, const Vec3<double>& q) {
  const Vec3<double> d = p - q;
  return std::sqrt(dot(d, d));
}

// The corners of a hole in the frame of the facet where its loop begins.
std::array<Vec3<double>, 4> corner_points(const Mechanism& mechanism,
                                          const SheetGeometry<double>& geometry,
                                          const FoldState<double>& state, const Loop& loop) {
  std::array<Vec3<double>, 4> points{};
  Pose<double> pose = Pose<double>::identity();
  int next = 0;
  for (int corner = 0; corner < 4; ++corner) {
    for (; next < loop.arrival[corner]; ++next) {
      const Passage& passage = loop.passages[next];
      pose = pose.then_rotate(passage_rotation(mechanism, geometry, state, passage),
                              flat_point(geometry, passage.vertex));
    }
    points[corner] = pose * flat_point(geometry, loop.corners[corner]);
  }
  return points;
}

}  // namespace

void flat_lengths(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                  double* lengths) {
  for (const Diagonal& diagonal : mechanism.diagonals) {
    *lengths++ = distance(flat_point(geometry, diagonal.from), flat_point(geometry, diagonal.to));
  }
}

void folded_lengths(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                    const FoldState<double>& state, double* lengths) {
  int known_loop = -1;
  std::array<Vec3<double>, 4> corners{};
  for (const Diagonal& diagonal : mechanism.diagonals) {
    if (diagonal.loop != known_loop) {
      known_loop = diagonal.loop;
      corners = corner_points(mechanism, geometry, state, mechanism.loops[known_loop]);
    }
    *lengths++ = distance(corners[diagonal.from_corner], corners[diagonal.to_corner]);
  }
}

}  // namespace misalign::solver
