#include "solver/certificate/proven_piece.hpp"

#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

double as_double(const ArbNumber& x) { return arf_get_d(arb_midref(x[0]), ARF_RND_NEAR); }

SheetGeometry<ArbNumber> place_in_balls(const Mechanism& mechanism,
                                        const FlatVertices& vertices_mm) {
  SheetGeometry<ArbNumber> geometry;
  for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
    const ArbNumber width(mechanism.panel_width_mm);
    geometry.x.push_back(ArbNumber(vertices_mm(0, v)) / width);
    geometry.y.push_back(ArbNumber(vertices_mm(1, v)) / width);
  }
  for (const Edge& edge : mechanism.edges) {
    const ArbNumber dx = geometry.x[edge.b] - geometry.x[edge.a];
    const ArbNumber dy = geometry.y[edge.b] - geometry.y[edge.a];
    ArbNumber length;
    arb_sqrt(length[0], (dx * dx + dy * dy)[0], kArbBits);
    geometry.axis_x.push_back(dx / length);
    geometry.axis_y.push_back(dy / length);
  }
  return geometry;
}

// Left of q the quaternions 1, i, j, k, which turn it.
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

PieceProver::PieceProver(const Mechanism& mechanism, const FlatVertices& vertices_mm)
    : mechanism_(mechanism),
      arb_geometry_(place_in_balls(mechanism, vertices_mm)),
      weights_(Eigen::VectorXd::Ones(mechanism.equations)) {
  solver::place(mechanism, vertices_mm, geometry_);
}

void PieceProver::begin(ProvenPiece& piece) const {
  // So that both ends are within [-1, 1] for certain: more than the middle's rounding takes.
  constexpr double kMore = 1 + 1e-12, kRounding = 4 * std::numeric_limits<double>::epsilon();
  const ArbNumber low(piece.piece.from_deg), high(piece.piece.to_deg);
  const ArbNumber half = ArbNumber(0.5);
  HalfAngle<double> pilot{1, 1};
  if (piece.piece.graded) {
    const ArbNumber a = half_tangent(low) * half_tangent(low);
    const ArbNumber b = half_tangent(high) * half_tangent(high);
    piece.sigma = 0.5 * as_double(a + b);
    piece.width = 0.5 * as_double(b - a) * kMore;
    if (piece.piece.from_deg == 0) {
      piece.sigma = piece.width;  // whose s = -1 is flat exactly
    } else {
      piece.width += kRounding * piece.sigma;
    }
    const ArbNumber sigma(piece.sigma), width(piece.width);
    piece.from = (a - sigma) / width;
    piece.to = (b - sigma) / width;
    piece.middle = (half * (a + b) - sigma) / width;
    if (piece.piece.from_deg == 0) piece.from = ArbNumber(-1.0);
  } else {
    pilot = half_angle_of_deg(0.5 * (piece.piece.from_deg + piece.piece.to_deg));
    piece.sigma = 1;
    piece.width =
        std::tan(0.25 * (piece.piece.to_deg - piece.piece.from_deg) * kRadPerDeg) * kMore +
        kRounding;
    const auto place = [&](const ArbNumber& angle_deg) {
      ArbNumber x, c, s;
      arb_const_pi(x[0], kArbBits);
      x = x * angle_deg / ArbNumber(360.0);
      arb_sin_cos(s[0], c[0], x[0], kArbBits);
      const ArbNumber c0(pilot.c), s0(pilot.s);
      return (s * c0 - c * s0) / ((c * c0 + s * s0) * ArbNumber(piece.width));
    };
    piece.from = place(low);
    piece.to = place(high);
    piece.middle = place(half * (low + high));
  }
  begin_joints(piece, pilot);
}

void PieceProver::begin_joints(ProvenPiece& piece, const HalfAngle<double>& pilot) const {
  const FoldState<double>& state = piece.piece.middle;
  const double tau = std::sqrt(piece.sigma);
  for (std::size_t i = 0; i < state.creases.size(); ++i) {
    const bool is_pilot = static_cast<int>(i) == mechanism_.pilot;
    const HalfAngle<double>& h = is_pilot ? pilot : state.creases[i];
    if (!piece.piece.graded) {
      piece.lines.creases.push_back({h.c, h.s, -h.s, h.c});
    } else {
      piece.lines.creases.push_back(is_pilot ? CreaseLine{1, 1, 0, 0}
                                             : CreaseLine{1, h.s / (h.c * tau), 0, 1});
    }
  }
  for (const Quaternion<double>& h : state.balls) {
    const FourParts q{h.w, h.x, h.y, h.z};
    if (!piece.piece.graded) {
      piece.lines.balls.push_back({q, turns_of(q)});
    } else {
      const FourParts middle{1, h.x / (h.w * tau), h.y / (h.w * tau), h.z / (h.w * piece.sigma)};
      piece.lines.balls.push_back({middle, turns_of({1, 0, 0, 0})});
    }
  }
}

JointPlaces PieceProver::places(const ProvenPiece& piece, const std::vector<ArbNumber>& unknowns,
                                const ArbNumber& tau) const {
  const ArbNumber order = piece.piece.graded ? tau : ArbNumber(1.0);
  JointPlaces places;
  for (std::size_t i = 0; i < mechanism_.creases.size(); ++i) {
    const CreaseLine& line = piece.lines.creases[i];
    const ArbNumber& x = unknowns[mechanism_.creases[i].column];
    places.creases.push_back({ArbNumber(line.c) + ArbNumber(line.c_rate) * x,
                              order * (ArbNumber(line.s) + ArbNumber(line.s_rate) * x)});
  }
  for (std::size_t i = 0; i < mechanism_.balls.size(); ++i) {
    const BallLine& line = piece.lines.balls[i];
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

std::vector<ArbNumber> PieceProver::unknowns(const ProvenPiece& piece, const JointPlaces& places,
                                             const ArbNumber& tau) const {
  std::vector<ArbNumber> x(mechanism_.unknowns);
  for (std::size_t i = 0; i < mechanism_.creases.size(); ++i) {
    const CreaseLine& line = piece.lines.creases[i];
    const auto& [c, s] = places.creases[i];
    const ArbNumber c0(line.c), s0(line.s);
    x[mechanism_.creases[i].column] =
        piece.piece.graded ? s / (c * tau) - s0 : (s * c0 - c * s0) / (c * c0 + s * s0);
  }
  for (std::size_t i = 0; i < mechanism_.balls.size(); ++i) {
    const FourParts& q = piece.lines.balls[i].q;
    const std::array<ArbNumber, 4>& p = places.balls[i];
    ArbNumber* at = &x[mechanism_.balls[i].column];
    if (piece.piece.graded) {
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

Proof PieceProver::prove(const PathPiece& piece, const Question& question, ProvenPiece& proven) {
  proven = {};
  proven.piece = piece;
  begin(proven);
  for (const ArbNumber* end : {&proven.from, &proven.to}) {
    if (!arb_le(size_of(*end)[0], ArbNumber(1.0)[0])) return Proof::unclear;
  }
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(mechanism_.equations);
  return cover(proven, -1, 1, start, 0, question);
}

Proof PieceProver::cover(ProvenPiece& piece, double low, double high, const Eigen::VectorXd& start,
                         int depth, const Question& question) {
  constexpr int kMostCuts = 10;
  // Uneven, so that neither a piece's middle nor any place that is asked for is between two.
  constexpr double kCut = 0.4375;
  ProvenStretch stretch{0.5 * (low + high), 0.5 * (high - low), {}, {}, {}, {}, {}, {}};
  Proof proof = Proof::unclear;
  if (prove_stretch(piece, start, stretch)) proof = question(piece, stretch);
  if (proof == Proof::holds) {
    piece.stretches.push_back(std::move(stretch));
    return proof;
  }
  if (proof == Proof::fails || depth == kMostCuts || stretch.guess.empty()) return proof;
  const double cut = low + kCut * (high - low);
  const auto middle_of = [&](double a, double b) {
    const double s = (0.5 * (a + b) - stretch.middle) / stretch.half;
    Eigen::VectorXd x = start;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      x[j] = stretch.guess[static_cast<std::size_t>(j)].c[0] +
             s * stretch.guess[static_cast<std::size_t>(j)].c[1];
    }
    return x;
  };
  proof = cover(piece, low, cut, middle_of(low, cut), depth + 1, question);
  return proof == Proof::holds ? cover(piece, cut, high, middle_of(cut, high), depth + 1, question)
                               : proof;
}

}  // namespace misalign::solver
