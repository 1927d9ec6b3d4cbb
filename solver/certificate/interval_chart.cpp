#include "solver/certificate/interval_chart.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

Ball quotient(const Ball& a, const Ball& b) { return a * reciprocal(b); }

// tan of half the angle from `from` to `to`.
Ball turn_between(const HalfAngle<double>& from, const HalfAngle<Ball>& to) {
  return quotient(to.s * Ball(from.c) - to.c * Ball(from.s),
                  to.c * Ball(from.c) + to.s * Ball(from.s));
}

Ball tangent_of(double angle_deg) {
  const HalfAngle<Ball> half = half_angle_ball(angle_deg);
  return quotient(half.s, half.c);
}

Ball squared_tangent_of(double angle_deg) {
  if (angle_deg == 0) return Ball(0.0);
  const Ball tangent = tangent_of(angle_deg);
  return tangent * tangent;
}

// A ball joint's quaternion at its unknowns.
GradedQuaternion<double> quaternion_at(const Chart::Ball& at, const double* turns) {
  GradedQuaternion<double> q = at.middle;
  for (int k = 0; k < 3; ++k) {
    q = {q.w + turns[k] * at.rate[k].w, q.x + turns[k] * at.rate[k].x,
         q.y + turns[k] * at.rate[k].y, q.z + turns[k] * at.rate[k].z};
  }
  return q;
}

Chart::Ball turned_from(const Quaternion<double>& q) {
  return {{q.w, q.x, q.y, q.z},
          {{{-q.x, q.w, -q.z, q.y}, {-q.y, q.z, q.w, -q.x}, {-q.z, -q.y, q.x, q.w}}}};
}

struct FlatVector {
  Ball x, y;

  FlatVector(const FlatVertices& vertices_mm, int from, int to)
      : x(Ball(vertices_mm(0, to)) - Ball(vertices_mm(0, from))),
        y(Ball(vertices_mm(1, to)) - Ball(vertices_mm(1, from))) {}
  Ball length() const { return square_root(x * x + y * y); }
  void scale_to(const Ball& scaled) {
    const Ball norm = length();
    x = quotient(x * scaled, norm);
    y = quotient(y * scaled, norm);
  }
};

// Ends of springs are seen from the corner of the panel that carries each.
void add_spring_ends(const Mechanism& mechanism, const FlatVertices& vertices_mm,
                     SheetGeometry<Ball>& geometry) {
  assert(mechanism.springs.in_mid_plane());
  const Ball width(mechanism.panel_width_mm);
  for (const Loop& loop : mechanism.loops) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      if (loop.hole < 0) {
        geometry.x.emplace_back(0.0);
        geometry.y.emplace_back(0.0);
        continue;
      }
      const int at = loop.corners[corner];
      const Loop::Carrier& carrier = loop.carriers[corner];
      FlatVector along(vertices_mm, at, carrier.before), after(vertices_mm, at, carrier.after);
      along.scale_to(Ball(1.0));
      after.scale_to(Ball(1.0));
      along.x = along.x + after.x;
      along.y = along.y + after.y;
      along.scale_to(Ball(1.0));
      const Ball ahead(carrier.place_mm.x()), left(carrier.place_mm.y());
      const auto v = static_cast<std::size_t>(at);
      geometry.x.push_back(geometry.x[v] + quotient(ahead * along.x - left * along.y, width));
      geometry.y.push_back(geometry.y[v] + quotient(ahead * along.y + left * along.x, width));
    }
  }
}

}  // namespace

HalfAngle<Ball> half_angle_ball(double angle_deg) {
  constexpr double kHalfDegree_rad = 0.0087266462599716478846;  // pi / 360, rounded
  const Ball x = Ball(angle_deg) * Ball::number(kHalfDegree_rad, 2 * kUnit * kHalfDegree_rad);
  const Ball xx = x * x;
  // sin x = x (1 - xx / 6 (1 - xx / 20 (...))) and cos x likewise; |x| <= pi. Terms alternate and
  // fall: the remainder is less than its first term, x^38 / 38! < 2e-26.
  constexpr int kTerms = 18;
  Ball c(1.0), s(1.0);
  for (int n = kTerms; n >= 1; --n) {
    c = Ball(1.0) - quotient(xx * c, Ball(2.0 * n * (2 * n - 1)));
    s = Ball(1.0) - quotient(xx * s, Ball(2.0 * n * (2 * n + 1)));
  }
  c.radius += 1e-25;
  s.radius += 1e-25;
  return {c, x * s};
}

SheetGeometry<Ball> place_exactly(const Mechanism& mechanism, const FlatVertices& vertices_mm) {
  assert(vertices_mm.cols() == mechanism.vertices);
  SheetGeometry<Ball> geometry;
  const Ball width(mechanism.panel_width_mm);
  for (int v = 0; v < vertices_mm.cols(); ++v) {
    const FlatVector from_first(vertices_mm, 0, v);
    geometry.x.push_back(quotient(from_first.x, width));
    geometry.y.push_back(quotient(from_first.y, width));
  }
  for (const Edge& edge : mechanism.edges) {
    const FlatVector along(vertices_mm, edge.a, edge.b);
    const Ball length = along.length();
    geometry.axis_x.push_back(quotient(along.x, length));
    geometry.axis_y.push_back(quotient(along.y, length));
  }
  if (!mechanism.springs.at_vertices()) add_spring_ends(mechanism, vertices_mm, geometry);
  return geometry;
}

IntervalChart::IntervalChart(const Mechanism& mechanism, const PathInterval& interval)
    : mechanism_(&mechanism), interval_(interval) {
  assert(interval.from_deg >= 0 && interval.from_deg < interval.to_deg && interval.to_deg <= 180);
  assert(interval.middle.creases.size() == mechanism.creases.size());
  assert(interval.middle.balls.size() == mechanism.balls.size());
  if (interval.graded) {
    const Ball low = squared_tangent_of(interval.from_deg),
               high = squared_tangent_of(interval.to_deg);
    sigma_ = interval.from_deg == 0 ? 0.5 * high.bound() : 0.5 * (low.c[0] + high.c[0]);
    // Intervals from flat have exactly sigma - half_width = 0.
    half_width_ = interval.from_deg == 0
                      ? sigma_
                      : std::max((high - Ball(sigma_)).bound(), (Ball(sigma_) - low).bound());
  } else {
    pilot_ = half_angle_of_deg(0.5 * (interval.from_deg + interval.to_deg));
    half_width_ = std::max(turn_between(pilot_, half_angle_ball(interval.from_deg)).bound(),
                           turn_between(pilot_, half_angle_ball(interval.to_deg)).bound());
  }
  assert(half_width_ > 0);
  place_joints();
}

void IntervalChart::place_joints() {
  const double tau = std::sqrt(sigma_);
  joints_.creases.clear();
  joints_.balls.clear();
  for (const HalfAngle<double>& h : interval_.middle.creases) {
    const bool is_pilot = static_cast<int>(joints_.creases.size()) == mechanism_->pilot;
    if (is_graded()) {
      joints_.creases.push_back(is_pilot ? Chart::Crease{1, 0, 1, 0}
                                         : Chart::Crease{1, 0, h.s / (h.c * tau), 1});
    } else {
      const HalfAngle<double>& at = is_pilot ? pilot_ : h;
      joints_.creases.push_back({at.c, -at.s, at.s, at.c});
    }
  }
  for (const Quaternion<double>& q : interval_.middle.balls) {
    joints_.balls.push_back(
        is_graded() ? Chart::Ball{{1, q.x / (q.w * tau), q.y / (q.w * tau), q.z / (q.w * sigma_)},
                                  {{{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}}
                    : turned_from(q));
  }
}

void IntervalChart::recentre(const double* x) {
  for (std::size_t i = 0; i < joints_.creases.size(); ++i) {
    if (static_cast<int>(i) == mechanism_->pilot) continue;
    Chart::Crease& at = joints_.creases[i];
    const double turn = x[mechanism_->creases[i].column];
    const HalfAngle<double> h{at.c + at.c_rate * turn, at.s + at.s_rate * turn};
    at = is_graded() ? Chart::Crease{1, 0, h.s, 1} : Chart::Crease{h.c, -h.s, h.s, h.c};
  }
  for (std::size_t i = 0; i < joints_.balls.size(); ++i) {
    Chart::Ball& at = joints_.balls[i];
    const GradedQuaternion<double> q = quaternion_at(at, x + mechanism_->balls[i].column);
    at.middle = q;
    if (!is_graded()) at = turned_from({q.w, q.x, q.y, q.z});
  }
}

FoldState<double> IntervalChart::state_at(const double* x, double s) const {
  FoldState<double> state;
  const double sigma = is_graded() ? sigma_ + half_width_ * s : 1, tau = std::sqrt(sigma);
  for (std::size_t i = 0; i < joints_.creases.size(); ++i) {
    const Chart::Crease& at = joints_.creases[i];
    const bool is_pilot = static_cast<int>(i) == mechanism_->pilot;
    const double unknown = x == nullptr ? 0 : x[mechanism_->creases[i].column];
    const double turn = is_pilot ? half_width_ * s : unknown;
    const double c = at.c + at.c_rate * turn, t = tau * (at.s + at.s_rate * turn);
    const double length = std::sqrt(c * c + t * t);
    state.creases.push_back({c / length, t / length});
  }
  for (std::size_t i = 0; i < joints_.balls.size(); ++i) {
    const Chart::Ball& at = joints_.balls[i];
    const GradedQuaternion<double> q =
        x == nullptr ? at.middle : quaternion_at(at, x + mechanism_->balls[i].column);
    state.balls.push_back(Quaternion<double>{q.w, tau * q.x, tau * q.y, sigma * q.z}.normalized());
  }
  return state;
}

Ball IntervalChart::place_of(double pilot_deg) const {
  if (is_graded()) {
    return quotient(squared_tangent_of(pilot_deg) - Ball(sigma_), Ball(half_width_));
  }
  return quotient(turn_between(pilot_, half_angle_ball(pilot_deg)), Ball(half_width_));
}

double IntervalChart::angle_deg_until(double s) const {
  constexpr double kResolution_deg = 5e-8;
  double low_deg = interval_.from_deg, high_deg = interval_.to_deg;
  while (high_deg - low_deg > kResolution_deg) {
    const double middle_deg = 0.5 * (low_deg + high_deg);
    const Ball place = place_of(middle_deg);
    (place.c[0] + place.radius <= s ? low_deg : high_deg) = middle_deg;
  }
  return low_deg;
}

IntervalChart::PlainState IntervalChart::plain(const std::vector<Ball>& x, double pilot_deg) const {
  assert(std::ssize(x) >= mechanism_->equations);
  const Ball tau = is_graded() ? tangent_of(pilot_deg) : Ball(1.0), sigma = tau * tau;
  PlainState state;
  for (std::size_t i = 0; i < joints_.creases.size(); ++i) {
    const Chart::Crease& at = joints_.creases[i];
    const bool is_pilot = static_cast<int>(i) == mechanism_->pilot;
    const Ball turn = is_pilot ? Ball(0.0) : x[mechanism_->creases[i].column];
    state.creases.push_back({Ball(at.c) + at.c_rate * turn, tau * (Ball(at.s) + at.s_rate * turn)});
  }
  for (std::size_t i = 0; i < joints_.balls.size(); ++i) {
    const Chart::Ball& at = joints_.balls[i];
    Quaternion<Ball> q{at.middle.w, at.middle.x, at.middle.y, at.middle.z};
    for (int k = 0; k < 3; ++k) {
      const Ball& turn = x[mechanism_->balls[i].column + k];
      q = {q.w + at.rate[k].w * turn, q.x + at.rate[k].x * turn, q.y + at.rate[k].y * turn,
           q.z + at.rate[k].z * turn};
    }
    state.balls.push_back({q.w, tau * q.x, tau * q.y, sigma * q.z});
  }
  return state;
}

std::vector<Ball> IntervalChart::unknowns(const PlainState& state, double pilot_deg) const {
  assert(state.creases.size() == joints_.creases.size());
  assert(state.balls.size() == joints_.balls.size());
  const Ball tau = is_graded() ? tangent_of(pilot_deg) : Ball(1.0), sigma = tau * tau;
  std::vector<Ball> x(mechanism_->equations);
  for (std::size_t i = 0; i < joints_.creases.size(); ++i) {
    if (static_cast<int>(i) == mechanism_->pilot) continue;
    const Chart::Crease& at = joints_.creases[i];
    x[mechanism_->creases[i].column] =
        is_graded() ? quotient(state.creases[i].s, state.creases[i].c * tau) - Ball(at.s)
                    : turn_between({at.c, at.s}, state.creases[i]);
  }
  for (std::size_t i = 0; i < joints_.balls.size(); ++i) {
    const GradedQuaternion<double>& at = joints_.balls[i].middle;
    const Quaternion<Ball>& q = state.balls[i];
    Ball* unknown = x.data() + mechanism_->balls[i].column;
    if (is_graded()) {
      unknown[0] = quotient(q.x, q.w * tau) - Ball(at.x);
      unknown[1] = quotient(q.y, q.w * tau) - Ball(at.y);
      unknown[2] = quotient(q.z, q.w * sigma) - Ball(at.z);
    } else {
      const Quaternion<Ball> turn = q * Quaternion<Ball>{at.w, -at.x, -at.y, -at.z};
      unknown[0] = quotient(turn.x, turn.w);
      unknown[1] = quotient(turn.y, turn.w);
      unknown[2] = quotient(turn.z, turn.w);
    }
  }
  return x;
}

}  // namespace misalign::solver
