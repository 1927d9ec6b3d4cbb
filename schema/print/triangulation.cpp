#include "schema/print/triangulation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kArea_mm2 = 1e-12;  // twice a triangle's, below which its corners are on a line

// Twice the area of a triangle, positive if counter-clockwise.
double turn_of(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return cross(b - a, c - a);
}

// Returns whether two segments share a point other than a common end.
bool touch(const Vector2d& p, const Vector2d& q, const Vector2d& a, const Vector2d& b) {
  if (p == a || p == b || q == a || q == b) return false;
  const double at_a = turn_of(p, q, a), at_b = turn_of(p, q, b), at_p = turn_of(a, b, p),
               at_q = turn_of(a, b, q);
  return at_a * at_b <= 0 && at_p * at_q <= 0;
}

class EarClipping {
 public:
  explicit EarClipping(const std::vector<PlanePoints>& rings) {
    int next = 0;
    for (const PlanePoints& ring : rings) {
      std::vector<int>& loop = loops_.emplace_back();
      for (const Vector2d& point : ring) {
        points_.push_back(point);
        loop.push_back(next++);
      }
    }
  }

  std::vector<std::array<int, 3>> triangles() {
    while (loops_.size() > 1) bridge();
    std::vector<int>& loop = loops_.front();
    std::vector<std::array<int, 3>> triangles;
    while (loop.size() > 2) {
      const std::size_t k = next_ear();
      triangles.push_back(corner(k));
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(k));
    }
    return triangles;
  }

 private:
  const Vector2d& at(int point) const { return points_[static_cast<std::size_t>(point)]; }

  std::array<int, 3> corner(std::size_t k) const {
    const std::vector<int>& loop = loops_.front();
    const std::size_t n = loop.size();
    return {loop[(k + n - 1) % n], loop[k], loop[(k + 1) % n]};
  }

  // Joins the last hole to the outer loop along the shortest segment that meets nothing.
  void bridge() {
    std::vector<int>& outer = loops_.front();
    const std::vector<int> hole = loops_.back();
    std::vector<std::tuple<double, std::size_t, std::size_t>> ways;
    for (std::size_t i = 0; i < outer.size(); ++i) {
      if (std::ranges::count(outer, outer[i]) > 1) continue;  // an end of another bridge
      for (std::size_t k = 0; k < hole.size(); ++k) {
        ways.emplace_back((at(outer[i]) - at(hole[k])).norm(), i, k);
      }
    }
    std::ranges::sort(ways);
    const auto free = std::ranges::find_if(ways, [&](const auto& way) {
      return sees(at(outer[std::get<1>(way)]), at(hole[std::get<2>(way)]));
    });
    assert(free != ways.end());
    const auto [length, i, k] = *free;
    std::vector<int> way(hole.begin() + static_cast<std::ptrdiff_t>(k), hole.end());
    way.insert(way.end(), hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(k + 1));
    way.push_back(outer[i]);
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(i + 1), way.begin(), way.end());
    loops_.pop_back();
  }

  bool sees(const Vector2d& from, const Vector2d& to) const {
    return std::ranges::none_of(loops_, [&](const std::vector<int>& loop) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        if (touch(from, to, at(loop[k]), at(loop[(k + 1) % loop.size()]))) return true;
      }
      return false;
    });
  }

  // The ear that is farthest from a line; where there is none, a corner on a line.
  std::size_t next_ear() const {
    const std::vector<int>& loop = loops_.front();
    std::size_t best = 0;
    double best_height = -1, least_turn = INFINITY;
    std::size_t flattest = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto [a, b, c] = corner(k);
      const double twice = turn_of(at(a), at(b), at(c));
      if (std::abs(twice) < least_turn) {
        least_turn = std::abs(twice);
        flattest = k;
      }
      if (twice < kArea_mm2) continue;
      const double height = twice / std::max({(at(b) - at(a)).norm(), (at(c) - at(b)).norm(),
                                              (at(a) - at(c)).norm()});
      if (height > best_height && is_empty(a, b, c)) {
        best_height = height;
        best = k;
      }
    }
    return best_height > 0 ? best : flattest;
  }

  bool is_empty(int a, int b, int c) const {
    return std::ranges::none_of(loops_.front(), [&](int other) {
      const Vector2d& p = at(other);
      if (p == at(a) || p == at(b) || p == at(c)) return false;
      return turn_of(at(a), at(b), p) >= 0 && turn_of(at(b), at(c), p) >= 0 &&
             turn_of(at(c), at(a), p) >= 0;
    });
  }

  PlanePoints points_;
  std::vector<std::vector<int>> loops_;  // the outer one first
};

}  // namespace

std::vector<std::array<int, 3>> triangulated(const std::vector<PlanePoints>& rings) {
  return EarClipping(rings).triangles();
}

}  // namespace misalign::schema
