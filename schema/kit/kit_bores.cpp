#include "schema/kit/kit_bores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

double distance_to_edges(const KitSheet& sheet, int facet, const Vector2d& point) {
  const auto& around = sheet.base.sheet.facets[static_cast<std::size_t>(facet)];
  double least = INFINITY;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector2d from = sheet.point(around[k]),
                   along = (sheet.point(around[(k + 1) % 4]) - from).normalized();
    const Vector2d off = point - from;
    least = std::min(least, along.x() * off.y() - along.y() * off.x());
  }
  return least;
}

// The panel in which a diagonal's spring hangs at a vertex.
int panel_of_spring(const KitSheet& sheet, int hole, int vertex) {
  const std::vector<int> around = solver::facets_around(sheet.base.sheet, vertex);
  const auto here = std::find(around.begin(), around.end(), hole) - around.begin();
  const int across = around[static_cast<std::size_t>(here + 2) % 4];
  const auto& holes = sheet.base.holes;
  return std::binary_search(holes.begin(), holes.end(), across)
             ? around[static_cast<std::size_t>(here + 1) % 4]
             : across;
}

// Of the diameters times `scale`.
std::vector<Bore> bores_of(const KitSheet& sheet, const KitOptions& options, double scale) {
  const double edge_mm = options.bore_edge_mm;
  std::vector<Bore> bores;
  const auto add = [&](int facet, int vertex, int spring, double diameter_mm) {
    const PanelCorner corner(sheet, facet, vertex);
    const double radius_mm = 0.5 * diameter_mm;
    double away_mm = (radius_mm + edge_mm) / corner.sine;
    for (const Bore& other : bores) {  // which is nearer to the corner
      if (other.facet != facet || other.vertex != vertex) continue;
      away_mm = std::max(away_mm, (other.centre_mm - corner.at_mm).norm() +
                                      0.5 * other.diameter_mm + edge_mm + radius_mm);
    }
    bores.push_back({facet, vertex, spring, corner.at_mm + away_mm * corner.bisector, diameter_mm});
  };
  if (options.joint_bore_mm) {
    for (const solver::BallJoint& ball : sheet.mechanism.balls) {
      add(ball.from_facet, ball.vertex, -1, scale * *options.joint_bore_mm);
      add(ball.to_facet, ball.vertex, -1, scale * *options.joint_bore_mm);
    }
  }
  if (!options.spring_bore_mm) return bores;
  for (std::size_t d = 0; d < sheet.mechanism.diagonals.size(); ++d) {
    const solver::Diagonal& diagonal = sheet.mechanism.diagonals[d];
    const int hole = sheet.mechanism.loops[static_cast<std::size_t>(diagonal.loop)].hole;
    for (const int vertex : {diagonal.from, diagonal.to}) {
      add(panel_of_spring(sheet, hole, vertex), vertex, static_cast<int>(d),
          scale * *options.spring_bore_mm);
    }
  }
  return bores;
}

// The first bore that leaves its panel or comes too close to another; null if none does.
const Bore* misplaced(const KitSheet& sheet, const std::vector<Bore>& bores, double edge_mm) {
  constexpr double kRounding_mm = 1e-9;  // of sizes of metres
  for (const Bore& bore : bores) {
    const double reach_mm = 0.5 * bore.diameter_mm + edge_mm - kRounding_mm;
    if (distance_to_edges(sheet, bore.facet, bore.centre_mm) < reach_mm) return &bore;
    for (const Bore& other : bores) {
      if (&other == &bore || other.facet != bore.facet) continue;
      if ((other.centre_mm - bore.centre_mm).norm() < reach_mm + 0.5 * other.diameter_mm) {
        return &bore;
      }
    }
  }
  return nullptr;
}

// The largest part of the diameters that fits.
double fitting_scale(const KitSheet& sheet, const KitOptions& options) {
  double fits = 0, fails = 1;
  for (int k = 0; k < 30; ++k) {
    const double middle = 0.5 * (fits + fails);
    const bool fit =
        misplaced(sheet, bores_of(sheet, options, middle), options.bore_edge_mm) == nullptr;
    (fit ? fits : fails) = middle;
  }
  return fits;
}

void refuse_within_kerf(const char* option, const std::optional<double>& bore_mm, double kerf_mm) {
  if (!bore_mm || *bore_mm > kerf_mm) return;
  throw UserError(kExitUsage, fmt::format("{} {:g}: no larger than the kerf of {:g} mm (nothing "
                                          "would be left to draw); take a larger bore",
                                          option, *bore_mm, kerf_mm));
}

// "--joint-bore 1.2 --spring-bore 0.8", rounded down.
std::string asked_for(const KitOptions& options, double scale) {
  constexpr double kStep = 100;
  std::string words;
  const auto add = [&](const char* option, const std::optional<double>& bore_mm) {
    if (!bore_mm) return;
    words += fmt::format("{}{} {:g}", words.empty() ? "" : " ", option,
                         scale == 1 ? *bore_mm : std::floor(*bore_mm * scale * kStep) / kStep);
  };
  add("--joint-bore", options.joint_bore_mm);
  add("--spring-bore", options.spring_bore_mm);
  return words;
}

}  // namespace

std::vector<Bore> kit_bores(const KitSheet& sheet, const KitOptions& options) {
  refuse_within_kerf("--joint-bore", options.joint_bore_mm, options.kerf_mm);
  refuse_within_kerf("--spring-bore", options.spring_bore_mm, options.kerf_mm);
  std::vector<Bore> bores = bores_of(sheet, options, 1);
  const Bore* bad = misplaced(sheet, bores, options.bore_edge_mm);
  if (bad == nullptr) return bores;
  constexpr double kLeastBore_mm = 0.1;
  const double scale = fitting_scale(sheet, options);
  const double largest_mm =
      scale * std::max(options.joint_bore_mm.value_or(0), options.spring_bore_mm.value_or(0));
  throw UserError(
      kExitUsage,
      fmt::format("{}: no room in panel {} at {} (between bores and edges {:g} mm are to be left, "
                  "--bore-edge); {}",
                  asked_for(options, 1), sheet.panel_label(bad->facet),
                  solver::vertex_label(bad->vertex), options.bore_edge_mm,
                  largest_mm < kLeastBore_mm ? "take a smaller --bore-edge"
                                             : asked_for(options, scale) + " would fit"));
}

}  // namespace misalign::schema
