#include "schema/nesting/simple_rings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

// A triangle of new material, and the contour's corner instead of those that it takes away.
struct Filling {
  std::array<Vector2d, 3> triangle;
  double area_mm2;
  std::size_t first, count;         // corners that go
  std::optional<Vector2d> instead;  // none: the neighbours are joined
};

double area(const std::array<Vector2d, 3>& t) {
  return 0.5 * std::abs(cross(t[1] - t[0], t[2] - t[0]));
}

bool holds(const std::array<Vector2d, 3>& t, const Vector2d& point) {
  std::array<double, 3> side{};
  for (std::size_t k = 0; k < 3; ++k) side[k] = cross(t[(k + 1) % 3] - t[k], point - t[k]);
  return std::ranges::all_of(side, [](double s) { return s >= 0; }) ||
         std::ranges::all_of(side, [](double s) { return s <= 0; });
}

// A reflex corner is filled; two convex ones in a row become the point where their outer edges
// meet.
std::optional<Filling> filling_at(const PlanePoints& ring, std::size_t i) {
  const std::size_t n = ring.size();
  if (n < 4) return std::nullopt;
  const Vector2d &before = ring[(i + n - 1) % n], &at = ring[i], &after = ring[(i + 1) % n],
                 &last = ring[(i + 2) % n];
  const Vector2d in = at - before, along = after - at, out = last - after;
  if (cross(in, along) <= 0) {
    const std::array<Vector2d, 3> triangle{before, at, after};
    return Filling{triangle, area(triangle), i, 1, std::nullopt};
  }
  if (n < 5 || cross(along, out) <= 0 || cross(in, out) <= 0) return std::nullopt;
  const Vector2d meeting = at + cross(along, out) / cross(in, out) * in;
  const std::array<Vector2d, 3> triangle{at, meeting, after};
  return Filling{triangle, area(triangle), i, 2, meeting};
}

bool is_free(const Filling& filling, const std::vector<PlanePoints>& rings, std::size_t index) {
  const auto is_own = [&](std::size_t r, std::size_t k) {
    if (r != index) return false;
    const std::size_t n = rings[r].size(), from = (k + n + 1 - filling.first) % n;
    return from < filling.count + 2;  // those that go, and their neighbours
  };
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t k = 0; k < rings[r].size(); ++k) {
      if (!is_own(r, k) && holds(filling.triangle, rings[r][k])) return false;
    }
  }
  return true;
}

void fill(PlanePoints& ring, const Filling& filling) {
  if (filling.instead) ring[filling.first] = *filling.instead;
  const std::size_t gone = filling.instead ? (filling.first + 1) % ring.size() : filling.first;
  ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(gone));
}

}  // namespace

std::vector<PlanePoints> simple_rings(std::vector<PlanePoints> rings, double most_mm2) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (;;) {
      std::vector<Filling> fillings;
      for (std::size_t i = 0; i < rings[r].size(); ++i) {
        const auto filling = filling_at(rings[r], i);
        if (filling && filling->area_mm2 <= most_mm2) fillings.push_back(*filling);
      }
      std::ranges::stable_sort(fillings, {}, &Filling::area_mm2);
      const auto best = std::ranges::find_if(
          fillings, [&](const Filling& filling) { return is_free(filling, rings, r); });
      if (best == fillings.end()) break;
      fill(rings[r], *best);
    }
  }
  return rings;
}

}  // namespace misalign::schema
