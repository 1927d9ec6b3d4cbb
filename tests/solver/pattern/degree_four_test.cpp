// A vertex of degree four against rotations multiplied out, and against spherical trigonometry.
#include "solver/pattern/degree_four.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr unsigned kVertexSeed = 1976;

// Sectors a (crease 1 to 2), b, c, d in turn.
using Sectors = std::array<double, 4>;

std::array<Eigen::Vector2d, 4> directions(const Sectors& sector, double turned) {
  std::array<Eigen::Vector2d, 4> u;
  double angle = turned;
  for (int k = 0; k < 4; ++k) {
    u[k] = {std::cos(angle), std::sin(angle)};
    angle += sector[k];
  }
  return u;
}

// Angles of a spherical triangle at the ends of its side z: opposite to x, opposite to y.
std::array<double, 2> angles_at(double x, double y, double z) {
  const double s = (x + y + z) / 2;
  const auto opposite = [&](double of, double next) {
    const double over = std::sin(s - next) * std::sin(s - z);
    const double under = std::sin(s) * std::sin(s - of);
    return 2 * std::atan2(std::sqrt(std::max(over, 0.0)), std::sqrt(std::max(under, 0.0)));
  };
  return {opposite(x, y), opposite(y, x)};
}

// The folded vertex cuts a quadrilateral out of a sphere; its diagonal from crease 2 to crease 4
// makes two triangles of it. None where they cannot be, or where a crease has passed 180 degrees.
std::optional<std::array<double, 3>> by_triangles(const Sectors& sector, int way, double first) {
  const auto [a, b, c, d] = sector;
  // 4 sin^2 halves of the diagonal e from crease 2 to 4, in a form without cancellation near flat
  // or near 180 degrees.
  const double haversine = std::pow(std::sin((a - d) / 2), 2) +
                           std::sin(a) * std::sin(d) * std::pow(std::cos(first / 2), 2);
  const double e = 2 * std::asin(std::min(1.0, std::sqrt(haversine)));
  if (e < std::abs(b - c)) return std::nullopt;
  const auto [at_4, at_2] = angles_at(a, d, e);            // of the triangle with crease 1
  const auto [at_4_of_3, at_2_of_3] = angles_at(b, c, e);  // of the triangle with crease 3
  const double third =                                     // haversines again
      2 * std::asin(std::min(1.0, std::sqrt(std::sin(a) * std::sin(d) / std::sin(b) / std::sin(c)) *
                                      std::sin(first / 2)));
  if (way > 0) return std::array{kHalfTurn - at_2 - at_2_of_3, third, kHalfTurn - at_4 - at_4_of_3};
  const double turn = a + d < kHalfTurn ? -kHalfTurn : kHalfTurn;
  const std::array<double, 3> others = {turn + at_2_of_3 - at_2, -third, turn + at_4_of_3 - at_4};
  for (const double rho : others) {
    if (std::abs(rho) > kHalfTurn) return std::nullopt;
  }
  return others;
}

// One crease is unlike the other three: one whose two sectors make less than a half turn.
std::array<int, 3> expected_signs(const Sectors& sector, int way) {
  if (way < 0) {
    return sector[0] + sector[3] < kHalfTurn ? std::array{-1, -1, -1} : std::array{1, -1, 1};
  }
  return sector[0] + sector[1] < kHalfTurn ? std::array{-1, 1, 1} : std::array{1, 1, -1};
}

// How far the rotations about the creases, one after the other, are from none at all.
double opening(const std::array<Eigen::Vector2d, 4>& u, const HalfAngle<double>& first,
               const std::array<HalfAngle<double>, 3>& others) {
  Eigen::Quaterniond around = Eigen::Quaterniond::Identity();
  for (int k = 0; k < 4; ++k) {
    const HalfAngle<double>& rho = k == 0 ? first : others[k - 1];
    around = around * Eigen::Quaterniond(rho.c, rho.s * u[k].x(), rho.s * u[k].y(), 0);
  }
  return (around.toRotationMatrix() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

HalfAngle<double> half(double rad) { return {std::cos(rad / 2), std::sin(rad / 2)}; }

class Vertices {
 public:
  double log_uniform(double least, double most) {
    return std::exp(
        std::uniform_real_distribution<double>(std::log(least), std::log(most))(words_));
  }
  double uniform(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(words_);
  }

  // Any sectors, sectors near 0 or 180 degrees, and vertices close to folding flat; no two opposite
  // creases within `apart` of one line.
  Sectors next(double apart = 1e-3) {
    for (;;) {
      Sectors s;
      switch (words_() % 3) {
        case 0:
          for (double& sector : s) sector = -std::log(uniform(1e-9, 1));
          break;
        case 1:
          for (double& sector : s) sector = log_uniform(1e-3, 1);
          break;
        default: {
          const double off = (words_() % 2 ? 1 : -1) * log_uniform(3e-5, 0.3);
          s = {uniform(0.01, 3.1), uniform(0.01, 3.1), 0, 0};
          s[2] = kHalfTurn - s[0] + off;
          s[3] = kHalfTurn - s[1] - off;
        }
      }
      const double sum = s[0] + s[1] + s[2] + s[3];
      for (double& sector : s) sector *= 2 * kHalfTurn / sum;
      if (is_vertex(s, apart)) return s;
    }
  }

 private:
  static bool is_vertex(const Sectors& s, double apart) {
    for (const double sector : s) {
      if (!(sector > 1e-3 && sector < kHalfTurn - 1e-3)) return false;
    }
    return std::abs(s[0] + s[1] - kHalfTurn) > apart && std::abs(s[0] + s[3] - kHalfTurn) > apart &&
           std::abs(s[0] + s[2] - kHalfTurn) > 2 * kFlatFoldable_rad;
  }

  std::mt19937_64 words_{kVertexSeed};
};

// Where the vertex stops, by the triangles alone; pi if it does not.
double end_of(const Sectors& sector, int way) {
  if (by_triangles(sector, way, kHalfTurn)) return kHalfTurn;
  double good = 0, bad = kHalfTurn;
  while (bad - good > 1e-13) {
    const double middle = 0.5 * (good + bad);
    (by_triangles(sector, way, middle) ? good : bad) = middle;
  }
  return good;
}

TEST(DegreeFour, FoldsAsRotationsAndTrianglesDoSlow) {
  constexpr int kVertices = 20000;
  Vertices vertices;
  double worst_opening = 0, worst_angle = 0;
  int folded = 0;
  for (int i = 0; i < kVertices; ++i) {
    const Sectors sector = vertices.next();
    const auto u = directions(sector, vertices.uniform(0, 6));
    for (const int way : {1, -1}) {
      const DegreeFourVertex vertex(u, way);
      ASSERT_TRUE(vertex.signs());
      ASSERT_EQ(*vertex.signs(), expected_signs(sector, way))
          << "seed " << kVertexSeed << ", " << i;
      EXPECT_FALSE(vertex.flat_foldable());
      const double end = end_of(sector, way);
      for (const double first : {vertices.log_uniform(1e-8, 1) * end, vertices.uniform(0, 1) * end,
                                 end * (1 - vertices.log_uniform(1e-4, 1))}) {
        const auto expected = by_triangles(sector, way, first);
        const auto others = vertex.others(half(first));
        ASSERT_TRUE(expected && others)
            << "seed " << kVertexSeed << ", vertex " << i << " at " << first << " of " << end;
        ++folded;
        worst_opening = std::max(worst_opening, opening(u, half(first), *others));
        for (int k = 0; k < 3; ++k) {
          const double rho = angle_deg((*others)[k]) * kRadPerDeg;
          worst_angle = std::max(worst_angle, std::abs(rho - (*expected)[k]));
          ASSERT_EQ(rho > 0 ? 1 : -1, (*vertex.signs())[k]) << i << " at " << first;
        }
        // Folded the other way round every angle changes its sign.
        const auto mirrored = vertex.others(half(-first));
        ASSERT_TRUE(mirrored);
        for (int k = 0; k < 3; ++k) {
          EXPECT_EQ((*mirrored)[k].s, -(*others)[k].s);
          EXPECT_EQ((*mirrored)[k].c, (*others)[k].c);
        }
      }
    }
  }
  RecordProperty("worst_opening", scientific(worst_opening));
  RecordProperty("worst_angle_rad", scientific(worst_angle));
  std::printf("%d foldings: opening %.1e, angle %.1e rad, seed %u\n", folded, worst_opening,
              worst_angle, kVertexSeed);
  EXPECT_LE(worst_opening, 3e-12);  // worst 2.9e-13: rounding, larger at sectors of 0.06 degrees
  EXPECT_LE(worst_angle, 1e-4);     // worst 1.2e-5: flat triangles lose half of their digits
}

TEST(DegreeFour, FoldsToItsEndAndNoFarther) {
  constexpr int kVertices = 5000;
  Vertices vertices;
  int ended = 0;
  for (int i = 0; i < kVertices; ++i) {
    const Sectors sector = vertices.next();
    const auto u = directions(sector, 1);
    for (const int way : {1, -1}) {
      const DegreeFourVertex vertex(u, way);
      const double end = end_of(sector, way);
      EXPECT_TRUE(vertex.others(half(end * (1 - 1e-6)))) << i << " way " << way << " end " << end;
      if (end == kHalfTurn) continue;
      ++ended;
      EXPECT_FALSE(vertex.others(half(end * (1 + 1e-6)), 0))
          << i << " way " << way << " end " << end;
    }
  }
  EXPECT_GT(ended, kVertices / 10);
}

// The crease that closes first, from both sides of the tolerance; `first_at` gives the first one's
// half angle where the cosine of that crease's is less than 0 by as much.
void expect_closing(const DegreeFourVertex& vertex, int crease,
                    const std::function<HalfAngle<double>(double)>& first_at) {
  const auto k = static_cast<std::size_t>(crease - 2);
  ASSERT_TRUE(vertex.others(first_at(-1e-4), 0));
  EXPECT_GT((*vertex.others(first_at(-1e-4), 0))[k].c, 0);
  EXPECT_FALSE(vertex.others(first_at(0.5 * kClosed_rad), 0));
  const auto closed = vertex.others(first_at(0.5 * kClosed_rad));
  ASSERT_TRUE(closed);
  EXPECT_EQ((*closed)[k].c, 0);
  EXPECT_EQ(std::abs((*closed)[k].s), 1);
  EXPECT_FALSE(vertex.others(first_at(2 * kClosed_rad)));
}

TEST(DegreeFour, ClosesWithinATolerance) {
  const double deg = kRadPerDeg;
  // sin^2(rho_3 / 2) is k times that of the first: cos^2 is 1 - k sin^2.
  const Sectors uneven = {85 * deg, 70 * deg, 105 * deg, 100 * deg};
  const double k =
      std::sin(85 * deg) * std::sin(100 * deg) / std::sin(70 * deg) / std::sin(105 * deg);
  expect_closing(DegreeFourVertex(directions(uneven, 0), 1), 3, [&](double beyond) {
    const double sine_square = (1 + beyond * std::abs(beyond)) / k;
    return HalfAngle<double>{std::sqrt(1 - sine_square), std::sqrt(sine_square)};
  });
  // Creases 1 and 3 in line, folded unlike: tan(rho_4 / 2) = 2 sin a sin c t / (p - q t^2) with
  // p = -sin(a + d) sin c, q = sin d sin(a + c) and t the first one's.
  const Sectors in_line = {70 * deg, 110 * deg, 60 * deg, 120 * deg};
  const double p = -std::sin(190 * deg) * std::sin(60 * deg),
               q = std::sin(120 * deg) * std::sin(130 * deg),
               top = 2 * std::sin(70 * deg) * std::sin(60 * deg);
  expect_closing(DegreeFourVertex(directions(in_line, 0), -1), 4, [&](double beyond) {
    const double t = std::sqrt(p / q) * (1 + beyond * top / (2 * std::sqrt(p * q)));
    return half(2 * std::atan(t));
  });
}

// Opposite sectors of 180 degrees together: tan(rho / 2) in constant ratios, up to 180 degrees.
TEST(DegreeFour, FlatFoldableVerticesKeepTheirTangentRatios) {
  Vertices vertices;
  double worst_opening = 0;
  for (int i = 0; i < 5000; ++i) {
    const double a = vertices.uniform(0.01, 3.13), b = vertices.uniform(0.01, 3.13);
    if (std::abs(a + b - kHalfTurn) < 1e-3 || std::abs(a - b) < 1e-3) continue;
    const auto u = directions({a, b, kHalfTurn - a, kHalfTurn - b}, vertices.uniform(0, 6));
    for (const int way : {1, -1}) {
      const DegreeFourVertex vertex(u, way);
      EXPECT_TRUE(vertex.flat_foldable());
      ASSERT_TRUE(vertex.signs());
      // Evans, Lang, Magleby & Howell 2015: cos or sin of half the sum over that of half the
      // difference.
      const double of_second = way > 0 ? std::cos((a + b) / 2) / std::cos((a - b) / 2)
                                       : std::sin((a + b) / 2) / std::sin((a - b) / 2);
      for (const double first :
           {vertices.log_uniform(1e-9, 1), vertices.uniform(0, kHalfTurn), kHalfTurn - 1e-9}) {
        const auto others = vertex.others(half(first));
        ASSERT_TRUE(others);
        worst_opening = std::max(worst_opening, opening(u, half(first), *others));
        const double tangent = std::tan(first / 2);
        EXPECT_NEAR(std::abs((*others)[0].s / (*others)[0].c / tangent), std::abs(of_second),
                    1e-9 * std::abs(of_second));
        EXPECT_NEAR((*others)[1].s / (*others)[1].c / tangent, way, 1e-12);
        EXPECT_NEAR((*others)[2].s / (*others)[2].c / tangent,
                    -way * (*others)[0].s / (*others)[0].c / tangent, 1e-9 * std::abs(of_second));
      }
      const auto closed = vertex.others({0, 1});
      ASSERT_TRUE(closed);
      for (const HalfAngle<double>& rho : *closed) EXPECT_LE(std::abs(rho.c), 1e-12);
    }
  }
  EXPECT_LE(worst_opening, 1e-11) << "seed " << kVertexSeed;
}

// Within kFlatFoldable_rad of Kawasaki's condition a vertex is taken to fold flat: open by no more
// than it is off; beyond, it is not.
TEST(DegreeFour, BandOfFlatFoldability) {
  for (const double off : {-0.9, 0.9, -1.1, 1.1}) {
    const double defect = off * kFlatFoldable_rad;
    const auto u = directions({1.1, 0.7, kHalfTurn - 1.1 + defect, kHalfTurn - 0.7 - defect}, 0.3);
    for (const int way : {1, -1}) {
      const DegreeFourVertex vertex(u, way);
      EXPECT_EQ(vertex.flat_foldable(), std::abs(off) < 1);
      for (const double first : {0.01, 1.0, 3.0}) {
        const auto others = vertex.others(half(first));
        ASSERT_TRUE(others);
        EXPECT_LE(opening(u, half(first), *others),
                  std::abs(off) < 1 ? 4 * std::abs(defect) : 1e-13);
      }
    }
  }
}

// Where two creases are one line, folding them alike would leave the other two flat.
TEST(DegreeFour, StraightLinesFoldOneWayOnly) {
  for (const double alpha : {0.2, 1.1, 1.5, 2.4}) {
    const auto u = directions({alpha, kHalfTurn - alpha, kHalfTurn - alpha, alpha}, 0.9);
    EXPECT_FALSE(DegreeFourVertex(u, 1).signs());
    const DegreeFourVertex miura(u, -1);  // its straight line first: mountain on one side
    ASSERT_TRUE(miura.signs());
    const auto others = miura.others(half(1.3));
    ASSERT_TRUE(others);
    EXPECT_NEAR((*others)[1].s, -half(1.3).s, 1e-15);
    // model.md: tan(straight / 2) = cos alpha tan(zigzag / 2).
    EXPECT_NEAR(std::abs((*others)[0].s / (*others)[0].c * std::cos(alpha)), std::tan(1.3 / 2),
                1e-13);
    EXPECT_LE(opening(u, half(1.3), *others), 1e-14);
    // The other pair is one line now.
    const std::array turned = {u[1], u[2], u[3], u[0]};
    EXPECT_FALSE(DegreeFourVertex(turned, -1).signs());
    EXPECT_TRUE(DegreeFourVertex(turned, 1).signs());
  }
}

// Whether creases 1 and 3 are one line does not depend on the crease that is asked, and what
// written coordinates leave of it is none.
TEST(DegreeFour, NearlyStraightLinesAreOneFromEveryCrease) {
  for (const double off : {0.0, 1e-12, -1e-9, 1e-8, -1e-6, 0.9e-5, 1.1e-5, -1e-4}) {
    const auto u = directions({1.1, kHalfTurn - 1.1 + off, 1.9, kHalfTurn - 1.9 - off}, 0.4);
    for (int first = 0; first < 4; ++first) {
      const std::array turned = {u[first], u[(first + 1) % 4], u[(first + 2) % 4],
                                 u[(first + 3) % 4]};
      const int alike = first % 2 == 0 ? 1 : -1;  // creases 1 and 3, whoever is first
      EXPECT_EQ(DegreeFourVertex(turned, alike).signs().has_value(), std::abs(off) > 1e-5) << off;
      EXPECT_TRUE(DegreeFourVertex(turned, -alike).signs()) << off;
    }
  }
}

}  // namespace
}  // namespace misalign::solver
