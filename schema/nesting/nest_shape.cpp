#include "schema/nesting/nest_shape.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "schema/nesting/simple_rings.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kSamePlace_mm = 1e-9;

double signed_area(const PlanePoints& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    twice += cross(ring[i], ring[(i + 1) % ring.size()]);
  return 0.5 * twice;
}

bool is_convex_ring(const PlanePoints& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d in = ring[(i + 1) % n] - ring[i], out = ring[(i + 2) % n] - ring[(i + 1) % n];
    if (cross(in, out) < -kSamePlace_mm) return false;
  }
  return true;
}

struct Side {
  Vector2d low, high;
  int winding;  // what crossing it to the right adds: 1 at the material's left
  double x(double y) const {
    return low.x() + (y - low.y()) / (high.y() - low.y()) * (high.x() - low.x());
  }
};

std::vector<Side> sides_of(const std::vector<PlanePoints>& rings) {
  std::vector<Side> sides;
  for (const PlanePoints& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector2d &from = ring[i], &to = ring[(i + 1) % ring.size()];
      if (std::abs(from.y() - to.y()) <= kSamePlace_mm) continue;
      if (from.y() > to.y()) {
        sides.push_back({to, from, 1});
      } else {
        sides.push_back({from, to, -1});
      }
    }
  }
  return sides;
}

PlanePoints trapezoid(const Side& left, const Side& right, double low, double high) {
  PlanePoints corners;
  const auto add = [&](const Vector2d& at) {
    if (corners.empty() || ((at - corners.back()).norm() > kSamePlace_mm &&
                            (at - corners.front()).norm() > kSamePlace_mm)) {
      corners.push_back(at);
    }
  };
  add({left.x(low), low});
  add({right.x(low), low});
  add({right.x(high), high});
  add({left.x(high), high});
  return corners;
}

// Trapezoids between the heights of corners; one goes on while the same two sides bound it.
std::vector<PlanePoints> trapezoids(const std::vector<PlanePoints>& rings) {
  const std::vector<Side> sides = sides_of(rings);
  std::vector<double> heights;
  for (const Side& side : sides) {
    heights.push_back(side.low.y());
    heights.push_back(side.high.y());
  }
  std::ranges::sort(heights);
  using Bounds = std::pair<std::size_t, std::size_t>;
  std::map<Bounds, double> open;  // to where they begin
  std::vector<PlanePoints> pieces;
  const auto close = [&](const std::map<Bounds, double>& still, double high) {
    for (const auto& [bounds, low] : open) {
      if (still.contains(bounds)) continue;
      PlanePoints piece = trapezoid(sides[bounds.first], sides[bounds.second], low, high);
      if (piece.size() > 2) pieces.push_back(std::move(piece));
    }
  };
  double last = 0;
  for (std::size_t h = 0; h + 1 < heights.size(); ++h) {
    const double low = heights[h], high = heights[h + 1], middle = 0.5 * (low + high);
    if (high - low <= kSamePlace_mm) continue;
    std::vector<std::size_t> across;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      if (sides[s].low.y() < middle && middle < sides[s].high.y()) across.push_back(s);
    }
    std::ranges::stable_sort(across, {}, [&](std::size_t s) { return sides[s].x(middle); });
    std::map<Bounds, double> still;
    int winding = 0;
    std::size_t left = 0;
    for (const std::size_t s : across) {
      if (winding == 0) left = s;
      winding += sides[s].winding;
      if (winding != 0) continue;
      const auto before = open.find({left, s});
      still[{left, s}] = before == open.end() ? low : before->second;
    }
    close(still, low);
    open = std::move(still);
    last = high;
  }
  close({}, last);
  return pieces;
}

// The union of two convex pieces along a common edge; none if they have none, or it is not convex.
std::optional<PlanePoints> joined(const PlanePoints& first, const PlanePoints& second) {
  const std::size_t n = first.size(), m = second.size();
  const auto is_same = [](const Vector2d& p, const Vector2d& q) {
    return (p - q).cwiseAbs().maxCoeff() <= kSamePlace_mm;
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < m; ++j) {
      if (!is_same(first[i], second[(j + 1) % m]) || !is_same(first[(i + 1) % n], second[j]))
        continue;
      PlanePoints ring;
      for (std::size_t k = 1; k < n; ++k) ring.push_back(first[(i + k) % n]);
      for (std::size_t k = 1; k < m; ++k) ring.push_back(second[(j + k) % m]);
      if (is_convex_ring(ring)) return ring;
    }
  }
  return std::nullopt;
}

std::vector<PlanePoints> joined(std::vector<PlanePoints> pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      auto both = joined(pieces[i], pieces[j]);
      if (!both) continue;
      pieces[i] = std::move(*both);
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
      j = i;  // it may join others now
    }
  }
  return pieces;
}

// Turns that lay long edges along the bed's sides: those of the most length first.
std::vector<double> turns_of(const std::vector<PlanePoints>& rings, std::size_t most) {
  constexpr double kQuarter_deg = 90, kSame_deg = 1;
  struct Edges {
    double deg, length_mm;
  };
  std::vector<Edges> directions = {{0, INFINITY}};
  for (std::size_t i = 0; i < rings[0].size(); ++i) {
    const Vector2d along = rings[0][(i + 1) % rings[0].size()] - rings[0][i];
    double deg =
        std::fmod(-std::atan2(along.y(), along.x()) * 180 / std::numbers::pi + 4 * kQuarter_deg,
                  kQuarter_deg);
    if (deg > kQuarter_deg - kSame_deg) deg -= kQuarter_deg;
    const auto same = std::ranges::find_if(directions, [&](const Edges& direction) {
      return std::abs(direction.deg - deg) < kSame_deg;
    });
    if (same == directions.end()) {
      directions.push_back({deg, along.norm()});
    } else {
      same->length_mm += along.norm();
    }
  }
  std::ranges::stable_sort(directions, std::ranges::greater{}, &Edges::length_mm);
  directions.resize(std::min(directions.size(), most));
  std::vector<double> turns_deg;
  for (const Edges& direction : directions) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      turns_deg.push_back(direction.deg + quarter * kQuarter_deg);
    }
  }
  return turns_deg;
}

}  // namespace

Vector2d turned(const Vector2d& point, double turn_deg) {
  if (turn_deg == 0) return point;
  if (turn_deg == 90) return {-point.y(), point.x()};
  if (turn_deg == 180) return -point;
  if (turn_deg == 270) return {point.y(), -point.x()};
  const double rad = turn_deg * std::numbers::pi / 180, c = std::cos(rad), s = std::sin(rad);
  return {c * point.x() - s * point.y(), s * point.x() + c * point.y()};
}

std::vector<PlanePoints> NestShape::turned(double turn_deg) const {
  std::vector<PlanePoints> moved = pieces;
  for (PlanePoints& piece : moved) {
    for (Vector2d& point : piece) point = schema::turned(point, turn_deg);
  }
  return moved;
}

NestShape nest_shape(const std::vector<PlanePoints>& rings, NestTurns turns) {
  constexpr double kMostAdded_mm2 = 4, kMostAddedPart = 5e-4;
  constexpr std::size_t kFewPieces = 12, kDirections = 4, kDirectionsOfMany = 2;
  NestShape shape{{}, 0, {0, 180}};
  for (const PlanePoints& ring : rings) shape.area_mm2 += signed_area(ring);
  const auto simple =
      simple_rings(rings, std::min(kMostAdded_mm2, kMostAddedPart * shape.area_mm2));
  shape.pieces =
      simple.size() == 1 && is_convex_ring(simple[0]) ? simple : joined(trapezoids(simple));
  if (turns == NestTurns::any) {
    shape.turns_deg =
        turns_of(simple, shape.pieces.size() <= kFewPieces ? kDirections : kDirectionsOfMany);
  }
  return shape;
}

}  // namespace misalign::schema
