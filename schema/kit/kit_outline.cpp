#include "schema/kit/kit_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "schema/kit/chords.hpp"
#include "schema/kit/plate_ring.hpp"
#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

// The next vertex of a contour that goes from `from` to `at`: where it branches, by the first edge
// counter-clockwise from the way back, so that the outside stays one region.
int next_vertex(const solver::Sheet& sheet, int from, int at, const std::vector<int>& ways) {
  const Vector2d back = sheet.point_mm(from) - sheet.point_mm(at);
  const auto turned = [&](int to) {
    const Vector2d on = sheet.point_mm(to) - sheet.point_mm(at);
    const double angle = std::atan2(cross(back, on), back.dot(on));
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
  };
  return *std::min_element(ways.begin(), ways.end(),
                           [&](int a, int b) { return turned(a) < turned(b); });
}

bool meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const auto side = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
    return cross(q - p, r - p) > 0;
  };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

bool is_simple(const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbours
      if (meet(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n])) return false;
    }
  }
  return true;
}

// The place of a corner whose edges (unit directions) move to their right: one point, or two where
// the mitre is cut off.
std::vector<Vector2d> moved_corner(const Vector2d& corner, const Vector2d& in, const Vector2d& out,
                                   double distance_mm) {
  const Vector2d right_in(in.y(), -in.x()), right_out(out.y(), -out.x());
  const Vector2d middle = right_in + right_out;  // length 2 cos(half the turn)
  const double square = middle.squaredNorm();
  const bool is_convex = cross(in, out) > 0;
  if (!is_convex || square * kMitreLimit * kMitreLimit >= 4) {
    return {corner + 2 * distance_mm / square * middle};
  }
  const Vector2d away = (in - out).normalized();
  const auto on_line = [&](const Vector2d& right, const Vector2d& along) {
    const double way = (kMitreLimit - right.dot(away)) / along.dot(away);
    return Vector2d(corner + distance_mm * (right + way * along));
  };
  return {on_line(right_in, in), on_line(right_out, out)};
}

std::vector<Vector2d> moved_corner(const Ring& ring, std::size_t i, double distance_mm) {
  const std::size_t n = ring.size();
  const Vector2d &before = ring[(i + n - 1) % n], &at = ring[i], &after = ring[(i + 1) % n];
  return moved_corner(at, (at - before).normalized(), (after - at).normalized(), distance_mm);
}

Ring ring_of(const solver::Sheet& sheet, const std::vector<int>& walk) {
  Ring ring;
  for (const int v : walk) ring.push_back(sheet.point_mm(v));
  return ring;
}

// A part's contour at a vertex with a tab: round the disc at its own panel, and round the clearance
// at other panels. `after` is the contour's next vertex.
Ring round_tab(const solver::Sheet& sheet, const KitPart& part, const SpringTab& tab, int after) {
  const Vector2d at_mm = sheet.point_mm(tab.vertex);
  struct Sector {
    bool has_tab;
    double from_rad, turn_rad;  // counter-clockwise from its first edge to the second
  };
  std::vector<Sector> sectors;  // counter-clockwise
  for (int edge = after; edge >= 0;) {
    int next = -1;
    for (const int f : part.facets) {
      const auto& v = sheet.base().sheet.facets[static_cast<std::size_t>(f)];
      for (std::size_t k = 0; k < 4; ++k) {
        if (v[k] != tab.vertex || v[(k + 1) % 4] != edge) continue;
        const Vector2d first = sheet.point_mm(edge) - at_mm;
        next = v[(k + 3) % 4];
        const Vector2d second = sheet.point_mm(next) - at_mm;
        sectors.push_back({f == tab.facet, std::atan2(first.y(), first.x()),
                           std::atan2(cross(first, second), first.dot(second))});
      }
    }
    edge = next;
  }
  Ring ring;
  for (auto sector = sectors.rbegin(); sector != sectors.rend(); ++sector) {
    const double turn_rad =
                     sector->has_tab ? 2 * std::numbers::pi - sector->turn_rad : -sector->turn_rad,
                 radius_mm = sector->has_tab ? tab.radius_mm : tab.clear_mm;
    const Ring arc = arc_points(at_mm, radius_mm, sector->from_rad + sector->turn_rad, turn_rad);
    ring.insert(ring.end(), arc.begin(), arc.end());
  }
  return ring;
}

Ring ring_with_tabs(const solver::Sheet& sheet, const KitPart& part, const KitFittings& fittings,
                    const std::vector<int>& walk) {
  Ring ring;
  for (std::size_t i = 0; i < walk.size(); ++i) {
    const SpringTab* tab = fittings.tab_at(walk[i]);
    const Ring corner = tab == nullptr ? Ring{sheet.point_mm(walk[i])}
                                       : round_tab(sheet, part, *tab, walk[(i + 1) % walk.size()]);
    ring.insert(ring.end(), corner.begin(), corner.end());
  }
  return ring;
}

// The widest kerf with which all of these contours can be cut.
double widest_kerf_mm(const std::vector<Ring>& rings, double too_wide_mm) {
  double fits = 0, fails = too_wide_mm;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (fits + fails);
    const bool fit = std::all_of(rings.begin(), rings.end(), [&](const Ring& ring) {
      return offset_ring(ring, 0.5 * middle).has_value();
    });
    (fit ? fits : fails) = middle;
  }
  return fits;
}

}  // namespace

std::vector<std::vector<int>> part_walks(const solver::Sheet& sheet, const KitPart& part) {
  const auto& pattern = sheet.base().sheet;
  std::vector<bool> inside(static_cast<std::size_t>(pattern.facet_count()), false);
  for (const int f : part.facets) inside[static_cast<std::size_t>(f)] = true;
  const auto is_inside = [&](int f) { return f >= 0 && inside[static_cast<std::size_t>(f)]; };
  std::map<int, std::vector<int>> ways;  // along the contours, from each vertex on them
  for (const solver::Edge& edge : pattern.edges) {
    if (is_inside(edge.left) == is_inside(edge.right)) continue;
    const bool on_left = is_inside(edge.left);
    ways[on_left ? edge.a : edge.b].push_back(on_left ? edge.b : edge.a);
  }
  std::vector<std::vector<int>> walks;
  while (!ways.empty()) {
    const int first = ways.begin()->first, second = ways.begin()->second.front();
    std::vector<int> walk;
    int from = first, to = second;
    do {
      walk.push_back(from);
      std::vector<int>& left = ways[from];
      left.erase(std::find(left.begin(), left.end(), to));
      if (left.empty()) ways.erase(from);
      // The way back to the first edge is taken already.
      std::vector<int> open = ways.contains(to) ? ways[to] : std::vector<int>();
      if (to == first) open.push_back(second);
      const int next = next_vertex(sheet, from, to, open);
      from = to;
      to = next;
    } while (from != first || to != second);
    walks.push_back(std::move(walk));
  }
  std::stable_partition(walks.begin(), walks.end(), [&](const std::vector<int>& walk) {
    return signed_area_mm2(ring_of(sheet, walk)) > 0;
  });
  return walks;
}

std::optional<Ring> offset_ring(const Ring& ring, double distance_mm) {
  if (distance_mm == 0) return ring;
  const std::size_t n = ring.size();
  std::vector<std::vector<Vector2d>> corners(n);
  for (std::size_t i = 0; i < n; ++i) corners[i] = moved_corner(ring, i, distance_mm);
  Ring moved;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d along = ring[(i + 1) % n] - ring[i];
    if ((corners[(i + 1) % n].front() - corners[i].back()).dot(along) <= 0) return std::nullopt;
    moved.insert(moved.end(), corners[i].begin(), corners[i].end());
  }
  if (!is_simple(moved)) return std::nullopt;
  return moved;
}

PartOutline part_outline(const solver::Sheet& sheet, const KitPart& part,
                         const KitFittings& fittings, double kerf_mm) {
  const std::vector<std::vector<int>> walks = part_walks(sheet, part);
  std::vector<Ring> drawn;
  if (fittings.edges.are_plates()) {
    drawn.push_back(plate_contour(sheet, part.facets[0], fittings));
  } else {
    for (const auto& walk : walks) drawn.push_back(ring_with_tabs(sheet, part, fittings, walk));
  }
  PartOutline outline;
  std::map<int, std::vector<Vector2d>> ends_at;  // slits' ends by vertex
  for (std::size_t r = 0; r < drawn.size(); ++r) {
    const std::optional<Ring> moved = offset_ring(drawn[r], 0.5 * kerf_mm);
    if (!moved) {
      throw UserError(solver::OptionFault{
          "kerf_mm", fmt::format("{:g}", kerf_mm),
          fmt::format("too wide for the contours of the part with panel {} (one of their edges "
                      "would vanish)",
                      panel_label(sheet, part.facets[0])),
          fmt::format("at most {:.4g} mm fit", 0.999 * widest_kerf_mm(drawn, kerf_mm))});
    }
    outline.rings.push_back(*moved);
    if (kerf_mm == 0 || fittings.edges.are_plates()) continue;
    const Ring corners = ring_of(sheet, walks[r]);
    for (std::size_t i = 0; i < walks[r].size(); ++i) {
      if (fittings.tab_at(walks[r][i]) != nullptr) continue;  // nothing is left there
      ends_at[walks[r][i]].push_back(moved_corner(corners, i, 0.5 * kerf_mm).front());
    }
  }
  for (const auto& [vertex, ends] : ends_at) {
    if (ends.size() == 2) outline.slits.push_back({ends[0], sheet.point_mm(vertex), ends[1]});
  }
  return outline;
}

double signed_area_mm2(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    twice += cross(ring[i], ring[(i + 1) % ring.size()]);
  }
  return 0.5 * twice;
}

}  // namespace misalign::schema
