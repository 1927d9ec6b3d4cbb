#include "solver/kinematics/loose_sheet.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {
namespace {

// The smallest rotation that takes the unit vector u to v: half way between 1 and the quaternion of
// twice the angle.
Mat3<double> rotation_between(const Vec3<double>& u, const Vec3<double>& v) {
  const Vec3<double> axis = cross(u, v);
  return Quaternion<double>{1 + dot(u, v), axis.x, axis.y, axis.z}.normalized().matrix();
}

}  // namespace

void loosen(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
            const JointOffsets& offsets, double scale, LooseSheet<double>& sheet) {
  assert(offsets.creases_a.size() == mechanism.creases.size());
  assert(offsets.creases_b.size() == mechanism.creases.size());
  assert(offsets.balls.size() == mechanism.balls.size());
  static_cast<SheetGeometry<double>&>(sheet) = geometry;
  sheet.creases.clear();
  for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
    const Crease& crease = mechanism.creases[i];
    const Vec3<double> a = flat_point(geometry, crease.a), b = flat_point(geometry, crease.b);
    const Vec3<double> along = {geometry.axis_x[crease.edge], geometry.axis_y[crease.edge], 0};
    const Vec3<double> off_a = scale * offsets.creases_a[i];
    const Vec3<double> line = b - a + (scale * offsets.creases_b[i] - off_a);
    const Mat3<double> tilt = rotation_between(along, 1 / std::sqrt(dot(line, line)) * line);
    sheet.creases.push_back({tilt, a + off_a - tilt * a});
  }
  sheet.balls.clear();
  for (const Vec3<double>& off : offsets.balls) {
    sheet.balls.push_back({Mat3<double>::identity(), scale * off});
  }
}

// S Rot(-rho) = S Rot(-top) Rot(top - rho), the last about the line's other direction.
void count_pilot_down(const Mechanism& mechanism, const HalfAngle<double>& top,
                      LooseSheet<double>& sheet) {
  assert(sheet.creases.size() == mechanism.creases.size());  // loosened before
  const Crease& pilot = mechanism.creases[mechanism.pilot];
  double &x = sheet.axis_x[pilot.edge], &y = sheet.axis_y[pilot.edge];
  Pose<double>& displaced = sheet.creases[mechanism.pilot];
  displaced = displaced.then_rotate(crease_rotation(top, x, y, 1), flat_point(sheet, pilot.a));
  x = -x;
  y = -y;
}

double vertex_gap(const Mechanism& mechanism, const LooseSheet<double>& sheet,
                  const FoldState<double>& state) {
  double largest = 0;
  assert(state.creases.size() == mechanism.creases.size());
  for (const Loop& loop : mechanism.loops) {
    if (loop.hole >= 0) continue;
    Pose<double> pose = Pose<double>::identity();
    for (const Passage& passage : loop.passages) {
      displace_before(sheet, passage, pose);
      pose = pose.then_rotate(passage_rotation(mechanism, sheet, state, passage),
                              flat_point(sheet, passage.vertex));
      displace_after(sheet, passage, pose);
    }
    const Vec3<double> vertex = flat_point(sheet, loop.passages.front().vertex);
    largest = std::max(largest, distance(pose * vertex, vertex));
  }
  return largest;
}

}  // namespace misalign::solver
