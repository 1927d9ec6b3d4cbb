// Printed plates beside closed forms: each edge belongs to two triangles in opposite directions,
// and volumes are areas times heights, by Simpson's rule where they vary with the square of the
// height.
#include "schema/print/printed_plate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>

#include "schema/files/user_error.hpp"
#include "schema/kit/kit_outline.hpp"
#include "schema/print/knuckles.hpp"
#include "schema/print/printed_kit.hpp"
#include "tests/schema/kit/deploying_kit.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector3d;

KitOptions printed_options(CreaseCut crease, bool has_bores) {
  KitOptions options;
  options.crease = crease;
  options.plates = {.thickness_mm = 4, .trim_mm = 5, .barrel_mm = 4};
  options.from_deg = 60;
  options.plates->clearance_mm = crease == CreaseCut::pin ? 0.2 : 0.1;
  if (crease == CreaseCut::film) options.plates->film_thickness_mm = 0.5;
  if (has_bores) options.joint_bore_mm = options.spring_bore_mm = 1.5;
  return options;
}

double volume_mm3(const Solid& solid) {
  double six = 0;
  for (const auto& t : solid.triangles) {
    const auto at = [&](std::size_t k) -> const Vector3d& {
      return solid.vertices_mm[static_cast<std::size_t>(t[k])];
    };
    six += at(0).dot(at(1).cross(at(2)));
  }
  return six / 6;
}

void expect_closed(const Solid& solid) {
  std::map<std::pair<int, int>, int> sides;
  for (const auto& [a, b, c] : solid.triangles) {
    for (const auto& side : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++sides[side];
  }
  int open = 0;
  for (const auto& [side, count] : sides) {
    const auto other = sides.find({side.second, side.first});
    open += count != 1 || other == sides.end();
  }
  EXPECT_EQ(open, 0) << solid.name << ", sides without just one other triangle";
}

// Area of a regular polygon of the chords that are drawn for a circle.
double circle_mm2(double radius_mm) {
  const double corners = std::ceil(2 * std::numbers::pi / (2 * std::acos(1 - 0.005 / radius_mm)));
  return corners / 2 * radius_mm * radius_mm * std::sin(2 * std::numbers::pi / corners);
}

class Printed : public testing::TestWithParam<std::pair<CreaseCut, bool>> {
 protected:
  double ring_mm2(int facet, const std::array<double, 4>& back_mm) const {
    return signed_area_mm2(plate_ring(kit_.sheet, facet, fittings_, back_mm).value().points);
  }
  // The plate without its bores.
  double whole_mm3(int facet, const Solid& solid) const {
    const PlateOptions& plates = *options_.plates;
    const PlateEdges& edges = fittings_.edges;
    const std::array<double, 4> back_mm = edges.back_mm(facet);
    const double contour_mm2 = ring_mm2(facet, back_mm), t_mm = plates.thickness_mm;
    if (options_.crease == CreaseCut::bevel) {
      double volume = 0;
      for (const bool valley : {false, true}) {
        std::array<double, 4> middle_mm = back_mm, face_mm = back_mm;
        for (std::size_t k = 0; k < 4; ++k) {
          const PlateEdge& edge = edges.edge(facet, k);
          if (edge.valley != valley) continue;
          middle_mm[k] += edge.bevel_mm / 2;
          face_mm[k] += edge.bevel_mm;
        }
        volume += t_mm / 2 / 6 *
                  (contour_mm2 + 4 * ring_mm2(facet, middle_mm) + ring_mm2(facet, face_mm));
      }
      return volume;
    }
    if (options_.crease == CreaseCut::film) {
      // The slot's depth is read from the solid, where films end: between the walls of its slots.
      const double slot_mm = plates.film_thickness_mm + plates.clearance_mm;
      std::array<double, 4> within_mm = back_mm;
      const auto& around = kit_.sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
      for (std::size_t k = 0; k < 4; ++k) {
        if (edges.edge(facet, k).crease < 0) continue;
        const Eigen::Vector2d from = kit_.sheet.point_mm(around[k]),
                              along =
                                  (kit_.sheet.point_mm(around[(k + 1) % 4]) - from).normalized();
        std::map<long, double> lengths;  // of lines parallel to the side, at the slot's height
        for (const auto& t : solid.triangles) {
          for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d& p = solid.vertices_mm[static_cast<std::size_t>(t[i])];
            const Vector3d& q = solid.vertices_mm[static_cast<std::size_t>(t[(i + 1) % 3])];
            if (std::abs(p.z() - slot_mm / 2) > 1e-5 || std::abs(q.z() - p.z()) > 1e-5) continue;
            const double at = cross(along, p.head<2>() - from),
                         to = cross(along, q.head<2>() - from);
            if (std::abs(at - to) > 1e-4 || (q - p).norm() < 5) continue;
            lengths[std::lround(at * 1000)] += 1;
          }
        }
        for (const auto& [at, count] : lengths) {
          const double depth_mm = static_cast<double>(at) / 1000;
          if (depth_mm < 10) within_mm[k] = std::max(within_mm[k], depth_mm);
        }
        EXPECT_GE(within_mm[k], back_mm[k] + 1);
      }
      return contour_mm2 * (t_mm - slot_mm) + ring_mm2(facet, within_mm) * slot_mm;
    }
    double volume = contour_mm2 * t_mm;
    const double half_mm = t_mm / 2;
    const double chords = std::ceil(std::numbers::pi / (2 * std::acos(1 - 0.005 / half_mm)));
    const double round_mm2 = chords / 2 * half_mm * half_mm * std::sin(std::numbers::pi / chords);
    for (std::size_t k = 0; k < 4; ++k) {
      if (edges.edge(facet, k).crease < 0) continue;
      for (const Knuckle& knuckle :
           knuckles_on(kit_.sheet, facet, k, fittings_, plates.clearance_mm)) {
        volume +=
            (knuckle.to_mm - knuckle.from_mm) *
            (back_mm[k] * t_mm + round_mm2 - circle_mm2((plates.pin_mm + plates.clearance_mm) / 2));
      }
    }
    return volume;
  }

  const DeployingKit kit_;
  const KitOptions options_ = printed_options(GetParam().first, GetParam().second);
  const KitFittings fittings_ = kit_fittings(kit_.sheet, options_);
};

TEST_P(Printed, PlatesAreClosedAndHaveTheVolumeOfTheirParts) {
  const std::vector<Solid> solids = printed_kit(kit_.sheet, options_);
  ASSERT_EQ(solids.size(), kit_.sheet.panels().facets.size());
  for (std::size_t p = 0; p < solids.size(); ++p) {
    const int facet = kit_.sheet.panels().facets[p];
    expect_closed(solids[p]);
    double wanted_mm3 = whole_mm3(facet, solids[p]);
    for (const Bore& bore : fittings_.bores) {
      if (bore.facet == facet) {
        wanted_mm3 -= circle_mm2(bore.diameter_mm / 2) * options_.plates->thickness_mm;
      }
    }
    // Vertices are rounded to 1e-6 mm, depths of slots are read to 1e-3 mm.
    EXPECT_NEAR(volume_mm3(solids[p]), wanted_mm3, GetParam().first == CreaseCut::film ? 0.5 : 1e-2)
        << solids[p].name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Hinges, Printed,
    testing::Values(std::pair(CreaseCut::film, false), std::pair(CreaseCut::film, true),
                    std::pair(CreaseCut::bevel, false), std::pair(CreaseCut::bevel, true),
                    std::pair(CreaseCut::pin, false), std::pair(CreaseCut::pin, true)));

TEST(PrintedKit, RefusesWhatHasNoRoom) {
  const DeployingKit kit;
  KitOptions options = printed_options(CreaseCut::pin, false);
  options.plates->pin_mm = 3;
  EXPECT_THROW(printed_kit(kit.sheet, options), UserError);
  options = printed_options(CreaseCut::film, false);
  options.plates->film_thickness_mm = 2.5;
  EXPECT_THROW(printed_kit(kit.sheet, options), UserError);
  options = printed_options(CreaseCut::film, false);
  options.crease = CreaseCut::score;
  EXPECT_THROW(printed_kit(kit.sheet, options), UserError);
}

// Knuckles of both plates fill the axis in turn, and nowhere both.
TEST(PrintedKit, KnucklesOfBothPlatesAreApart) {
  const DeployingKit kit;
  const KitOptions options = printed_options(CreaseCut::pin, true);
  const KitFittings fittings = kit_fittings(kit.sheet, options);
  const auto& creases = kit.sheet.mechanism().creases;
  for (std::size_t c = 0; c < creases.size(); ++c) {
    std::vector<std::pair<double, double>> taken;
    for (const int facet : {creases[c].left, creases[c].right}) {
      const auto& around = kit.sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
      for (std::size_t k = 0; k < 4; ++k) {
        if (fittings.edges.edge(facet, k).crease != static_cast<int>(c)) continue;
        const double length_mm =
            (kit.sheet.point_mm(creases[c].b) - kit.sheet.point_mm(creases[c].a)).norm();
        for (const Knuckle& knuckle : knuckles_on(kit.sheet, facet, k, fittings, 0.2)) {
          const bool is_along = around[k] == creases[c].a;
          taken.emplace_back(is_along ? knuckle.from_mm : length_mm - knuckle.to_mm,
                             is_along ? knuckle.to_mm : length_mm - knuckle.from_mm);
        }
      }
    }
    std::sort(taken.begin(), taken.end());
    ASSERT_GE(taken.size(), 3u);
    for (std::size_t k = 1; k < taken.size(); ++k) {
      EXPECT_NEAR(taken[k].first - taken[k - 1].second, 0.2, 1e-9);
    }
  }
}

}  // namespace
}  // namespace misalign::schema
