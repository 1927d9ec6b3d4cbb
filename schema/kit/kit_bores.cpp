#include "schema/kit/kit_bores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;
using solver::OptionFault;

// The distance from the contour of a panel and its bevels.
double distance_to_edges(const solver::Sheet& sheet, const PlateEdges& edges, int facet,
                         const Vector2d& point) {
  const auto& around = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  double least = INFINITY;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector2d from = sheet.point_mm(around[k]),
                   along = (sheet.point_mm(around[(k + 1) % 4]) - from).normalized();
    const Vector2d off = point - from;
    const PlateEdge& edge = edges.edge(facet, k);
    least =
        std::min(least, along.x() * off.y() - along.y() * off.x() - edge.back_mm - edge.bevel_mm);
    const PanelCorner corner(sheet, facet, around[k]);
    if (const double trim_mm = edges.trim_mm(facet, k); trim_mm > 0) {
      least = std::min(least, corner.bisector.dot(off) - trim_mm);
    }
  }
  return least;
}

class FittingsMaker {
 public:
  // `scale` multiplies the diameters.
  FittingsMaker(const solver::Sheet& sheet, const KitOptions& options, const PlateEdges& edges,
                double scale)
      : sheet_(sheet), options_(options), scale_(scale) {
    made_.edges = edges;
  }

  KitFittings make() {
    if (options_.joint_bore_mm) {
      for (const solver::BallJoint& ball : sheet_.mechanism().balls) {
        add_bore(ball.from_facet, ball.vertex, -1, scale_ * *options_.joint_bore_mm);
        add_bore(ball.to_facet, ball.vertex, -1, scale_ * *options_.joint_bore_mm);
      }
    }
    if (!options_.spring_bore_mm) return std::move(made_);
    for (std::size_t d = 0; d < sheet_.mechanism().diagonals.size(); ++d) {
      const solver::Diagonal& diagonal = sheet_.mechanism().diagonals[d];
      for (const int corner : {diagonal.from_corner, diagonal.to_corner}) {
        add_end(sheet_.mechanism().loops[static_cast<std::size_t>(diagonal.loop)],
                static_cast<std::size_t>(corner), static_cast<int>(d));
      }
    }
    return std::move(made_);
  }

 private:
  // Adds a bore on the bisector of a corner, behind earlier ones.
  void add_bore(int facet, int vertex, int spring, double diameter_mm) {
    const PanelCorner corner(sheet_, facet, vertex);
    const double radius_mm = 0.5 * diameter_mm, edge_mm = options_.bore_edge_mm;
    double away_mm = distance_from_corner(facet, vertex, radius_mm + edge_mm, corner);
    for (const Bore& other : made_.bores) {  // which is nearer to the corner
      if (other.facet != facet || other.vertex != vertex) continue;
      away_mm = std::max(away_mm, (other.centre_mm - corner.at_mm).norm() +
                                      0.5 * other.diameter_mm + edge_mm + radius_mm);
    }
    made_.bores.push_back(
        {facet, vertex, spring, corner.at_mm + away_mm * corner.bisector, diameter_mm});
  }

  // The distance of a bore on the bisector of a corner which keeps so far from the contour.
  double distance_from_corner(int facet, int vertex, double apart_mm,
                              const PanelCorner& corner) const {
    const auto& around = sheet_.base().sheet.facets[static_cast<std::size_t>(facet)];
    const auto k = static_cast<std::size_t>(solver::corner_of(around, vertex));
    double back_mm = 0;
    for (const std::size_t side : {k, (k + 3) % 4}) {
      const PlateEdge& edge = made_.edges.edge(facet, side);
      back_mm = std::max(back_mm, edge.back_mm + edge.bevel_mm);
    }
    const double trim_mm = made_.edges.trim_mm(facet, k);
    return std::max((apart_mm + back_mm) / corner.sine, trim_mm > 0 ? trim_mm + apart_mm : 0);
  }

  // Adds a spring's end at a corner of its hole.
  void add_end(const solver::Loop& loop, std::size_t corner, int spring) {
    const solver::Loop::Carrier& carrier = loop.carriers[corner];
    const int vertex = loop.corners[corner], facet = carrier.facet;
    const double diameter_mm = scale_ * *options_.spring_bore_mm;
    if (!sheet_.base().springs.at_vertices()) {
      const PanelCorner panel(sheet_, facet, vertex);
      const Vector2d left(-panel.bisector.y(), panel.bisector.x());
      const Vector2d at_mm =
          panel.at_mm + carrier.place_mm.x() * panel.bisector + carrier.place_mm.y() * left;
      made_.bores.push_back({facet, vertex, spring, at_mm, diameter_mm});
      made_.ends.push_back({facet, vertex, spring, at_mm, 0.5 * diameter_mm, carrier.place_mm.z()});
      return;
    }
    if (options_.spring_at == SpringAt::panel) {
      add_bore(facet, vertex, spring, diameter_mm);
      made_.ends.push_back(
          {facet, vertex, spring, made_.bores.back().centre_mm, 0.5 * diameter_mm});
      return;
    }
    const bool in_joint = loop.passages[static_cast<std::size_t>(loop.arrival[corner])].ball;
    const Vector2d at_mm = sheet_.point_mm(vertex);
    const double radius_mm = made_.edges.tab_radius_mm(sheet_, facet, vertex,
                                                       0.5 * diameter_mm + options_.bore_edge_mm),
                 clear_mm =
                     std::hypot(radius_mm, made_.edges.reach_mm()) + kTabSlot_mm + options_.kerf_mm;
    made_.ends.push_back({facet, vertex, spring, at_mm, in_joint ? 0 : clear_mm});
    if (in_joint) return;
    made_.bores.push_back({facet, vertex, spring, at_mm, diameter_mm});
    made_.tabs.push_back({facet, vertex, radius_mm, clear_mm});
  }

  const solver::Sheet& sheet_;
  const KitOptions& options_;
  const double scale_;
  KitFittings made_;
};

constexpr double kSlack_mm = 1e-9;  // rounding of sizes in metres

bool has_room(const solver::Sheet& sheet, const KitFittings& fittings, const Bore& bore,
              double edge_mm) {
  const double reach_mm = 0.5 * bore.diameter_mm + edge_mm - kSlack_mm;
  if (distance_to_edges(sheet, fittings.edges, bore.facet, bore.centre_mm) < reach_mm) return false;
  return std::none_of(fittings.bores.begin(), fittings.bores.end(), [&](const Bore& other) {
    return &other != &bore && other.facet == bore.facet &&
           (other.centre_mm - bore.centre_mm).norm() < reach_mm + 0.5 * other.diameter_mm;
  });
}

double distance_to_segment(const Vector2d& at, const Vector2d& p, const Vector2d& q) {
  const double along = std::clamp((at - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
  return (at - p - along * (q - p)).norm();
}

// Returns whether the clearance of a tab keeps off the other edges, tabs and bores.
bool has_room(const solver::Sheet& sheet, const KitFittings& fittings, const SpringTab& tab,
              double edge_mm) {
  const Vector2d at_mm = sheet.point_mm(tab.vertex);
  const double reach_mm = tab.clear_mm + edge_mm - kSlack_mm;
  for (const int f : solver::facets_around(sheet.base().sheet, tab.vertex)) {
    const auto& around = sheet.base().sheet.facets[static_cast<std::size_t>(f)];
    for (std::size_t k = 0; k < 4; ++k) {
      const int a = around[k], b = around[(k + 1) % 4];
      if (a == tab.vertex || b == tab.vertex) continue;
      if (distance_to_segment(at_mm, sheet.point_mm(a), sheet.point_mm(b)) < reach_mm) return false;
    }
  }
  const auto keeps_off = [&](const Vector2d& other_mm, double taken_mm) {
    return (other_mm - at_mm).norm() >= reach_mm + taken_mm;
  };
  return std::all_of(fittings.tabs.begin(), fittings.tabs.end(),
                     [&](const SpringTab& other) {
                       return &other == &tab ||
                              keeps_off(sheet.point_mm(other.vertex), other.clear_mm);
                     }) &&
         std::all_of(fittings.bores.begin(), fittings.bores.end(), [&](const Bore& bore) {
           return fittings.tab_at(bore.vertex) != nullptr ||
                  keeps_off(bore.centre_mm, 0.5 * bore.diameter_mm);
         });
}

// Describes the first bore that leaves its panel, or bore or tab without room; empty if none does.
std::string misplaced(const solver::Sheet& sheet, const KitFittings& fittings, double edge_mm) {
  for (const Bore& bore : fittings.bores) {
    if (fittings.tab_at(bore.vertex) != nullptr || has_room(sheet, fittings, bore, edge_mm)) {
      continue;
    }
    return fmt::format("no room in panel {} at {} (bores must be {:g} mm from bores and edges, {})",
                       panel_label(sheet, bore.facet), solver::vertex_label(bore.vertex), edge_mm,
                       parameter("bore_edge_mm"));
  }
  for (const SpringTab& tab : fittings.tabs) {
    if (has_room(sheet, fittings, tab, edge_mm)) continue;
    return fmt::format(
        "no room for a tab at {} (the panels beside it would be cut away within {:.4g} mm, "
        "including {} of {:g} mm)",
        solver::vertex_label(tab.vertex), tab.clear_mm, parameter("bore_edge_mm"), edge_mm);
  }
  return "";
}

// The largest scale of the diameters that fits.
double fitting_scale(const solver::Sheet& sheet, const KitOptions& options,
                     const PlateEdges& edges) {
  double fits = 0, fails = 1;
  for (int k = 0; k < 30; ++k) {
    const double middle = 0.5 * (fits + fails);
    const KitFittings fittings = FittingsMaker(sheet, options, edges, middle).make();
    (misplaced(sheet, fittings, options.bore_edge_mm).empty() ? fits : fails) = middle;
  }
  return fits;
}

void refuse_within_kerf(const char* name, const std::optional<double>& bore_mm, double kerf_mm) {
  if (!bore_mm || *bore_mm > kerf_mm) return;
  throw UserError(OptionFault{
      name, fmt::format("{:g}", *bore_mm),
      fmt::format("no larger than the kerf of {:g} mm (nothing would be left to draw)", kerf_mm),
      "take a larger bore"});
}

// "joint_bore_mm=1.2 spring_bore_mm=0.8", rounded down.
std::string requested(const KitOptions& options, double scale) {
  constexpr double kStep = 100;
  std::string words;
  const auto add = [&](const char* name, const std::optional<double>& bore_mm) {
    if (!bore_mm) return;
    const double shown = scale == 1 ? *bore_mm : std::floor(*bore_mm * scale * kStep) / kStep;
    words += (words.empty() ? "" : " ") + parameter(name, fmt::format("{:g}", shown));
  };
  add("joint_bore_mm", options.joint_bore_mm);
  add("spring_bore_mm", options.spring_bore_mm);
  return words;
}

}  // namespace

const SpringTab* KitFittings::tab_at(int vertex) const {
  const auto at = std::find_if(tabs.begin(), tabs.end(),
                               [&](const SpringTab& tab) { return tab.vertex == vertex; });
  return at == tabs.end() ? nullptr : &*at;
}

KitFittings kit_fittings(const solver::Sheet& sheet, const KitOptions& options) {
  refuse_within_kerf("joint_bore_mm", options.joint_bore_mm, options.kerf_mm);
  refuse_within_kerf("spring_bore_mm", options.spring_bore_mm, options.kerf_mm);
  const bool at_vertices = sheet.base().springs.at_vertices();
  if (options.spring_at && !at_vertices) {
    throw UserError(
        OptionFault{"spring_at", *options.spring_at == SpringAt::panel ? "panel" : "vertex",
                    "the pattern says where its springs end (\"springs.attach\")", "leave it out"});
  }
  if (options.spring_bore_mm && at_vertices && options.spring_at != SpringAt::panel &&
      options.bore_edge_mm == 0) {
    throw UserError(
        OptionFault{"bore_edge_mm", "0",
                    "nothing would be left of a tab round its bore (springs end on vertices)",
                    "take more, or " + parameter("spring_at", "panel")});
  }
  const bool has_loops = !options.joints || options.joints->kind == solver::JointKind::loop;
  if (options.spring_bore_mm && at_vertices && options.spring_at != SpringAt::panel && !has_loops &&
      !sheet.mechanism().balls.empty()) {
    throw UserError(OptionFault{"spring_bore_mm", fmt::format("{:g}", *options.spring_bore_mm),
                                "springs that end at ball joints hang in loops of wire, and these "
                                "joints have none",
                                "take " + parameter("spring_at", "panel")});
  }
  const PlateEdges edges(sheet, options);
  KitFittings fittings = FittingsMaker(sheet, options, edges, 1).make();
  const std::string bad = misplaced(sheet, fittings, options.bore_edge_mm);
  if (bad.empty()) return fittings;
  constexpr double kLeastBore_mm = 0.1;
  const double scale = fitting_scale(sheet, options, edges);
  const double largest_mm =
      scale * std::max(options.joint_bore_mm.value_or(0), options.spring_bore_mm.value_or(0));
  throw UserError(
      Cause::bad_request,
      fmt::format("{}: {}; {}", requested(options, 1), bad,
                  largest_mm < kLeastBore_mm ? "take a smaller " + parameter("bore_edge_mm")
                                             : requested(options, scale) + " would fit"));
}

}  // namespace misalign::schema
