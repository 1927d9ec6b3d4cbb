// Shapes on beds: their outlines keep the gap by a brute-force distance of all edges, and lie on
// their beds; openings are used; the result is that of closed forms where there is one.
#include "schema/nesting/nest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "schema/nesting/simple_rings.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;
using NestRings = std::vector<PlanePoints>;

double from_edge(const Vector2d& point, const Vector2d& p, const Vector2d& q) {
  const double share = std::clamp((point - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
  return (point - p - share * (q - p)).norm();
}

bool cross_over(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 &&
         cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

bool within(const Vector2d& point, const NestRings& rings) {
  int winding = 0;
  for (const PlanePoints& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vector2d p = ring[k] - point, q = ring[(k + 1) % ring.size()] - point;
      if ((p.y() > 0) == (q.y() > 0)) continue;
      if ((cross(p, q) > 0) == (q.y() > p.y())) winding += q.y() > p.y() ? 1 : -1;
    }
  }
  return winding != 0;
}

// The distance of two outlines; 0 where they overlap.
double apart(const NestRings& some, const NestRings& others) {
  double least = INFINITY;
  for (const PlanePoints& a : some) {
    for (const PlanePoints& b : others) {
      for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
          const Vector2d &p = a[i], &q = a[(i + 1) % a.size()], &r = b[j],
                         &s = b[(j + 1) % b.size()];
          if (cross_over(p, q, r, s)) return 0;
          least = std::min({least, from_edge(p, r, s), from_edge(r, p, q)});
        }
      }
    }
  }
  return within(some[0][0], others) || within(others[0][0], some) ? 0 : least;
}

NestRings placed(const NestRings& rings, const Nested& place) {
  NestRings moved = rings;
  for (PlanePoints& ring : moved) {
    for (Vector2d& point : ring) point = place(point);
  }
  return moved;
}

PlanePoints rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

PlanePoints reversed(PlanePoints ring) {
  std::ranges::reverse(ring);
  return ring;
}

// A star round the origin, convex nowhere or nearly everywhere.
PlanePoints star(std::mt19937& random, double most_mm, int corners) {
  std::uniform_real_distribution<double> radius(0.3 * most_mm, most_mm);
  PlanePoints ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    ring.push_back(radius(random) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

std::vector<NestShape> shapes_of(const std::vector<NestRings>& outlines) {
  std::vector<NestShape> shapes;
  for (const NestRings& rings : outlines) shapes.push_back(nest_shape(rings));
  return shapes;
}

TEST(Nest, OutlinesKeepTheGapAndTheirBeds) {
  const unsigned seed = 7;
  RecordProperty("seed", static_cast<int>(seed));
  std::mt19937 random(seed);
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<NestRings> outlines;
    for (int k = 0; k < 12; ++k) outlines.push_back({star(random, 40, 3 + k)});
    for (int k = 0; k < 4; ++k) {  // frames round openings of stars
      outlines.push_back({rectangle(-50, -45, 100, 90), reversed(star(random, 40, 9))});
    }
    const NestBed bed{{260, trial % 3 == 0 ? INFINITY : 240}, 1.5 * trial, {rectangle(0, 0, 9, 9)}};
    const NestResult result = nest(shapes_of(outlines), bed);
    double closest = INFINITY;
    for (std::size_t k = 0; k < outlines.size(); ++k) {
      const NestRings one = placed(outlines[k], result.places[k]);
      for (const Vector2d& point : one[0]) {
        EXPECT_GE(point.minCoeff(), -1e-6);
        EXPECT_LE((point - bed.size_mm).maxCoeff(), 1e-6);
        EXPECT_LE((point - result.used_mm[result.places[k].bed]).maxCoeff(), 1e-6);
      }
      EXPECT_GE(apart(one, bed.taken), bed.gap_mm - 1e-6);
      for (std::size_t j = 0; j < k; ++j) {
        if (result.places[j].bed != result.places[k].bed) continue;
        const double distance = apart(one, placed(outlines[j], result.places[j]));
        EXPECT_GE(distance, bed.gap_mm - 1e-6) << trial << ": " << j << ", " << k;
        closest = std::min(closest, distance);
      }
    }
    EXPECT_LE(closest, 1.02 * bed.gap_mm + 1e-6) << "nothing is as close as it may be";
  }
}

// Sides that are almost parallel, and almost along the bed's: places on a bound are rounded there.
TEST(Nest, PanelsThatAreNearlyAlikeAreApart) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(-1, 1);
  double least = INFINITY;
  for (int trial = 0; trial < 10; ++trial) {
    const double off_mm = std::pow(10.0, -(trial % 10));
    std::vector<NestRings> outlines(
        8, {{{0, 0}, {80, 0}, {80 + 40.0 * (trial % 2), 70}, {40.0 * (trial % 2), 70}}});
    for (NestRings& rings : outlines) {
      for (Vector2d& point : rings[0]) point += off_mm * Vector2d(part(random), part(random));
    }
    const NestBed bed{{300, INFINITY}, 5};
    const NestResult result = nest(shapes_of(outlines), bed);
    for (std::size_t k = 0; k < outlines.size(); ++k) {
      for (std::size_t j = 0; j < k; ++j) {
        least = std::min(least, apart(placed(outlines[k], result.places[k]),
                                      placed(outlines[j], result.places[j])));
      }
    }
  }
  EXPECT_GE(least, 5 - 1e-6);
}

TEST(Nest, IsTheSameTwice) {
  std::mt19937 random(3);
  std::vector<NestRings> outlines;
  for (int k = 0; k < 20; ++k) outlines.push_back({star(random, 30, 5)});
  const NestBed bed{{150, 150}, 2};
  const NestResult one = nest(shapes_of(outlines), bed), other = nest(shapes_of(outlines), bed);
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    EXPECT_EQ(one.places[k].moved_mm, other.places[k].moved_mm);
    EXPECT_EQ(one.places[k].turned_deg, other.places[k].turned_deg);
  }
}

// Two right triangles of 60 x 60, one turned by 180 degrees and moved sideways by g sqrt(2), keep a
// gap g between their long sides.
TEST(Nest, TrianglesMeetAlongTheirLongSides) {
  const double gap = 3, width = 60 + gap * std::numbers::sqrt2;
  const std::vector<NestRings> outlines(2, {{{0, 0}, {60, 0}, {0, 60}}});
  const auto height_mm = [&](double bed_mm) {
    return nest(shapes_of(outlines), {{bed_mm, INFINITY}, gap}).used_mm[0].y();
  };
  EXPECT_NEAR(height_mm(width + 1e-6), 60, 1e-5);
  EXPECT_GT(height_mm(width - 1), 60.5);
}

TEST(Nest, ParallelogramsLieInRows) {
  const double gap = 4;
  const NestRings panel = {{{0, 0}, {80, 0}, {110, 70}, {30, 70}}};
  const NestResult result =
      nest(shapes_of(std::vector<NestRings>(6, panel)), {{300, INFINITY}, gap});
  EXPECT_LE(result.used_mm[0].y(), 2 * 70 + gap + 1e-6);
}

TEST(Nest, ASmallShapeLiesInAnOpening) {
  const std::vector<NestRings> outlines = {
      {rectangle(0, 0, 100, 100), reversed(rectangle(20, 20, 60, 60))}, {rectangle(5, 5, 54, 50)}};
  const NestBed bed{{100, 100}, 3};
  const NestResult result = nest(shapes_of(outlines), bed);
  EXPECT_EQ(result.beds, 1u);
  EXPECT_GE(apart(placed(outlines[0], result.places[0]), placed(outlines[1], result.places[1])),
            3 - 1e-9);
  const NestResult wider = nest(shapes_of(outlines), {{100, 100}, 3.1});
  EXPECT_EQ(wider.beds, 2u);  // 54 + 2 * 3.1 > 60
}

TEST(Nest, AGrainTurnsByHalfTurnsAlone) {
  std::mt19937 random(5);
  std::vector<NestShape> shapes;
  for (int k = 0; k < 20; ++k) shapes.push_back(nest_shape({star(random, 30, 6)}, NestTurns::half));
  for (const Nested& place : nest(shapes, {{150, 150}, 2}).places) {
    EXPECT_TRUE(place.turned_deg == 0 || place.turned_deg == 180);
  }
  const NestShape wide = nest_shape({rectangle(0, 0, 120, 40)}, NestTurns::half);
  EXPECT_FALSE(place_alone(wide, {{100, 200}, 0}));
  EXPECT_TRUE(place_alone(nest_shape({rectangle(0, 0, 120, 40)}), {{100, 200}, 0}));
}

// Pieces of touching openings, arcs and slots: every point of the material is in a piece, and the
// pieces' area exceeds the material's by little.
TEST(NestShape, PiecesCoverTheMaterial) {
  NestRings rings = {{}, {{0, 0}, {-30, 10}, {-20, 30}}, {{0, 0}, {30, -10}, {20, -30}}};
  for (int k = 0; k < 90; ++k) {
    const double angle = 2 * std::numbers::pi * k / 90;
    rings[0].push_back(60 * Vector2d(std::cos(angle), std::sin(angle)));
  }
  const NestShape shape = nest_shape(rings);
  double circle = 0.5 * 90 * 3600 * std::sin(2 * std::numbers::pi / 90), pieces = 0;
  circle -= 2 * 0.5 * std::abs(-30.0 * 30 + 20 * 10);
  EXPECT_NEAR(shape.area_mm2, circle, 1e-6);
  for (const PlanePoints& piece : shape.pieces) {
    for (std::size_t k = 0; k < piece.size(); ++k) {
      pieces += 0.5 * cross(piece[k], piece[(k + 1) % piece.size()]);
    }
  }
  EXPECT_GT(pieces, circle);
  EXPECT_LT(pieces, 1.02 * circle);
  EXPECT_LT(shape.pieces.size(), 60u);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-61, 61);
  for (int k = 0; k < 4000; ++k) {
    const Vector2d point(place(random), place(random));
    if (!within(point, rings)) continue;
    EXPECT_TRUE(std::ranges::any_of(shape.pieces, [&](const PlanePoints& piece) {
      return within(point, {piece});
    })) << point.transpose();
  }
}

}  // namespace
}  // namespace misalign::schema
