#include "solver/certificate/proven_interval.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

// Ends of springs beside the vertices, behind these: the corner's unit vectors added up.
void add_ends(const Mechanism& mechanism, SheetGeometry<ArbNumber>& geometry) {
  const ArbNumber width(mechanism.panel_width_mm);
  for (const Loop& loop : mechanism.loops) {
    for (int corner = 0; corner < 4; ++corner) {
      ArbNumber x(0.0), y(0.0);
      if (loop.hole >= 0) {
        const int at = loop.corners[corner];
        const Loop::Carrier& carrier = loop.carriers[corner];
        for (const int beside : {carrier.before, carrier.after}) {
          const ArbNumber dx = geometry.x[beside] - geometry.x[at];
          const ArbNumber dy = geometry.y[beside] - geometry.y[at];
          const ArbNumber length = root_of(dx * dx + dy * dy);
          x += dx / length;
          y += dy / length;
        }
        const ArbNumber length = root_of(x * x + y * y) * width;
        const ArbNumber ahead = ArbNumber(carrier.place_mm.x()) / length;
        const ArbNumber left = ArbNumber(carrier.place_mm.y()) / length;
        const ArbNumber along_x = x, along_y = y;
        x = geometry.x[at] + ahead * along_x - left * along_y;
        y = geometry.y[at] + ahead * along_y + left * along_x;
      }
      geometry.x.push_back(x);
      geometry.y.push_back(y);
    }
  }
}

SheetGeometry<ArbNumber> place_in_balls(const Mechanism& mechanism,
                                        const FlatVertices& vertices_mm) {
  assert(vertices_mm.cols() == mechanism.vertices);
  SheetGeometry<ArbNumber> geometry;
  for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
    const ArbNumber width(mechanism.panel_width_mm);
    geometry.x.push_back(ArbNumber(vertices_mm(0, v)) / width);
    geometry.y.push_back(ArbNumber(vertices_mm(1, v)) / width);
  }
  for (const Edge& edge : mechanism.edges) {
    const ArbNumber dx = geometry.x[edge.b] - geometry.x[edge.a];
    const ArbNumber dy = geometry.y[edge.b] - geometry.y[edge.a];
    const ArbNumber length = root_of(dx * dx + dy * dy);
    geometry.axis_x.push_back(dx / length);
    geometry.axis_y.push_back(dy / length);
  }
  if (!mechanism.springs.at_vertices()) add_ends(mechanism, geometry);
  return geometry;
}

// Products i q, j q and k q, which turn q.
std::array<FourParts, 3> turns_of(const FourParts& q) {
  return {{{-q[1], q[0], -q[3], q[2]}, {-q[2], q[3], q[0], -q[1]}, {-q[3], -q[2], q[1], q[0]}}};
}

}  // namespace

ArbNumber half_tangent(const ArbNumber& angle_deg) {
  ArbNumber x;
  arb_const_pi(x[0], kArbBits);
  x = x * angle_deg / ArbNumber(360.0);
  arb_tan(x[0], x[0], kArbBits);
  return x;
}

IntervalProver::IntervalProver(const Mechanism& mechanism, const FlatVertices& vertices_mm)
    : mechanism_(mechanism),
      arb_geometry_(place_in_balls(mechanism, vertices_mm)),
      weights_(Eigen::VectorXd::Ones(mechanism.equations)) {
  solver::place(mechanism, vertices_mm, geometry_);
}

std::array<ArbNumber, 2> IntervalProver::flat_diagonal(const Diagonal& diagonal) const {
  const int p = spring_vertex(mechanism_, diagonal.loop, diagonal.from_corner),
            q = spring_vertex(mechanism_, diagonal.loop, diagonal.to_corner);
  return {arb_geometry_.x[q] - arb_geometry_.x[p], arb_geometry_.y[q] - arb_geometry_.y[p]};
}

void IntervalProver::begin(ProvenInterval& interval) const {
  assert(interval.interval.from_deg < interval.interval.to_deg);
  // Both ends must lie within [-1, 1] for certain: this exceeds the middle's rounding.
  constexpr double kMore = 1 + 1e-12, kRounding = 4 * std::numeric_limits<double>::epsilon();
  const ArbNumber low(interval.interval.from_deg), high(interval.interval.to_deg);
  const ArbNumber half = ArbNumber(0.5);
  HalfAngle<double> pilot{1, 1};
  if (interval.interval.graded) {
    const ArbNumber a = half_tangent(low) * half_tangent(low);
    const ArbNumber b = half_tangent(high) * half_tangent(high);
    interval.sigma = 0.5 * as_double(a + b);
    interval.width = 0.5 * as_double(b - a) * kMore;
    if (interval.interval.from_deg == 0) {
      interval.sigma = interval.width;  // s = -1 is exactly flat
    } else {
      interval.width += kRounding * interval.sigma;
    }
    const ArbNumber sigma(interval.sigma), width(interval.width);
    interval.from = (a - sigma) / width;
    interval.to = (b - sigma) / width;
    interval.middle = (half * (a + b) - sigma) / width;
    if (interval.interval.from_deg == 0) interval.from = ArbNumber(-1.0);
  } else {
    pilot = half_angle_of_deg(0.5 * (interval.interval.from_deg + interval.interval.to_deg));
    interval.sigma = 1;
    interval.width =
        std::tan(0.25 * (interval.interval.to_deg - interval.interval.from_deg) * kRadPerDeg) *
            kMore +
        kRounding;
    const auto place = [&](const ArbNumber& angle_deg) {
      ArbNumber x, c, s;
      arb_const_pi(x[0], kArbBits);
      x = x * angle_deg / ArbNumber(360.0);
      arb_sin_cos(s[0], c[0], x[0], kArbBits);
      const ArbNumber c0(pilot.c), s0(pilot.s);
      return (s * c0 - c * s0) / ((c * c0 + s * s0) * ArbNumber(interval.width));
    };
    interval.from = place(low);
    interval.to = place(high);
    interval.middle = place(half * (low + high));
  }
  begin_joints(interval, pilot);
}

void IntervalProver::begin_joints(ProvenInterval& interval, const HalfAngle<double>& pilot) const {
  const FoldState<double>& state = interval.interval.middle;
  assert(state.creases.size() == mechanism_.creases.size());
  assert(state.balls.size() == mechanism_.balls.size());
  const double tau = std::sqrt(interval.sigma);
  for (std::size_t i = 0; i < state.creases.size(); ++i) {
    const bool is_pilot = static_cast<int>(i) == mechanism_.pilot;
    const HalfAngle<double>& h = is_pilot ? pilot : state.creases[i];
    if (!interval.interval.graded) {
      interval.lines.creases.push_back({h.c, h.s, -h.s, h.c});
    } else {
      interval.lines.creases.push_back(is_pilot ? JointLines::Crease{1, 1, 0, 0}
                                                : JointLines::Crease{1, h.s / (h.c * tau), 0, 1});
    }
  }
  for (const Quaternion<double>& h : state.balls) {
    const FourParts q{h.w, h.x, h.y, h.z};
    if (!interval.interval.graded) {
      interval.lines.balls.push_back({q, turns_of(q)});
    } else {
      const FourParts middle{1, h.x / (h.w * tau), h.y / (h.w * tau), h.z / (h.w * interval.sigma)};
      interval.lines.balls.push_back({middle, turns_of({1, 0, 0, 0})});
    }
  }
}

IntervalProver::JointPlaces IntervalProver::places(const ProvenInterval& interval,
                                                   const std::vector<ArbNumber>& unknowns,
                                                   const ArbNumber& tau) const {
  const ArbNumber order = interval.interval.graded ? tau : ArbNumber(1.0);
  assert(interval.lines.creases.size() == mechanism_.creases.size());
  assert(std::ssize(unknowns) >= mechanism_.equations);
  JointPlaces places;
  for (std::size_t i = 0; i < mechanism_.creases.size(); ++i) {
    const JointLines::Crease& line = interval.lines.creases[i];
    const ArbNumber& x = unknowns[mechanism_.creases[i].column];
    places.creases.push_back({ArbNumber(line.c) + ArbNumber(line.c_rate) * x,
                              order * (ArbNumber(line.s) + ArbNumber(line.s_rate) * x)});
  }
  for (std::size_t i = 0; i < mechanism_.balls.size(); ++i) {
    const JointLines::Ball& line = interval.lines.balls[i];
    std::array<ArbNumber, 4> q;
    for (int part = 0; part < 4; ++part) {
      q[part] = ArbNumber(line.q[part]);
      for (int k = 0; k < 3; ++k) {
        q[part] += ArbNumber(line.rate[k][part]) * unknowns[mechanism_.balls[i].column + k];
      }
      if (part > 0) q[part] = order * q[part];
    }
    q[3] = order * q[3];
    places.balls.push_back(q);
  }
  return places;
}

std::vector<ArbNumber> IntervalProver::unknowns(const ProvenInterval& interval,
                                                const JointPlaces& places,
                                                const ArbNumber& tau) const {
  std::vector<ArbNumber> x(mechanism_.unknowns);
  assert(places.creases.size() == mechanism_.creases.size());
  assert(places.balls.size() == mechanism_.balls.size());
  for (std::size_t i = 0; i < mechanism_.creases.size(); ++i) {
    const JointLines::Crease& line = interval.lines.creases[i];
    const auto& [c, s] = places.creases[i];
    const ArbNumber c0(line.c), s0(line.s);
    x[mechanism_.creases[i].column] =
        interval.interval.graded ? s / (c * tau) - s0 : (s * c0 - c * s0) / (c * c0 + s * s0);
  }
  for (std::size_t i = 0; i < mechanism_.balls.size(); ++i) {
    const FourParts& q = interval.lines.balls[i].q;
    const std::array<ArbNumber, 4>& p = places.balls[i];
    ArbNumber* at = &x[mechanism_.balls[i].column];
    if (interval.interval.graded) {
      for (int k = 0; k < 3; ++k) at[k] = p[k + 1] / (p[0] * tau) - ArbNumber(q[k + 1]);
      at[2] = p[3] / (p[0] * tau * tau) - ArbNumber(q[3]);
      continue;
    }
    // p times the conjugate of q, as a vector over its scalar part.
    const ArbNumber w(q[0]), i1(-q[1]), i2(-q[2]), i3(-q[3]);
    const ArbNumber scalar = p[0] * w - p[1] * i1 - p[2] * i2 - p[3] * i3;
    at[0] = (p[0] * i1 + p[1] * w + p[2] * i3 - p[3] * i2) / scalar;
    at[1] = (p[0] * i2 + p[2] * w + p[3] * i1 - p[1] * i3) / scalar;
    at[2] = (p[0] * i3 + p[3] * w + p[1] * i2 - p[2] * i1) / scalar;
  }
  return x;
}

Proof IntervalProver::prove(const PathInterval& interval, const Question& question,
                            ProvenInterval& proven) {
  proven = {};
  proven.interval = interval;
  begin(proven);
  for (const ArbNumber* end : {&proven.from, &proven.to}) {
    if (!(size_of(*end) <= ArbNumber(1.0))) return Proof::unclear;
  }
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(mechanism_.equations);
  return cover(proven, -1, 1, start, 0, question);
}

Proof IntervalProver::cover(ProvenInterval& interval, double low, double high,
                            const Eigen::VectorXd& start, int depth, const Question& question) {
  constexpr int kMostCuts = 10;
  assert(-1 <= low && low < high && high <= 1);
  assert(depth <= kMostCuts);
  // Cuts are uneven, so that neither an interval's middle nor a place of interest lies on one.
  constexpr double kCut = 0.4375;
  Subinterval subinterval{0.5 * (low + high), 0.5 * (high - low), {}, {}, {}, {}, {}, {}, {}};
  Proof proof = Proof::unclear;
  if (prove_subinterval(interval, start, subinterval)) proof = question(interval, subinterval);
  if (proof == Proof::holds) {
    interval.subintervals.push_back(std::move(subinterval));
    return proof;
  }
  if (proof == Proof::fails || depth == kMostCuts || subinterval.guess.empty()) return proof;
  const double cut = low + kCut * (high - low);
  const auto middle_of = [&](double a, double b) {
    const double s = (0.5 * (a + b) - subinterval.middle) / subinterval.half;
    Eigen::VectorXd x = start;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      x[j] = subinterval.guess[j].c[0] + s * subinterval.guess[j].c[1];
    }
    return x;
  };
  proof = cover(interval, low, cut, middle_of(low, cut), depth + 1, question);
  return proof == Proof::holds
             ? cover(interval, cut, high, middle_of(cut, high), depth + 1, question)
             : proof;
}

}  // namespace misalign::solver
