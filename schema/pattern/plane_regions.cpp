#include "schema/pattern/plane_regions.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::schema {
namespace {

using Side = std::pair<int, int>;

// Returns the neighbours of each vertex, counter-clockwise.
std::vector<std::vector<int>> rings_of(const PlanePoints& points, const PlaneEdges& edges) {
  std::vector<std::vector<int>> around(points.size());
  for (const auto& [ends, assignment] : edges) {
    around[static_cast<std::size_t>(ends.first)].push_back(ends.second);
    around[static_cast<std::size_t>(ends.second)].push_back(ends.first);
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto angle = [&](int to) {
      const Eigen::Vector2d along = points[static_cast<std::size_t>(to)] - points[v];
      return std::atan2(along.y(), along.x());
    };
    std::sort(around[v].begin(), around[v].end(),
              [&](int a, int b) { return angle(a) < angle(b); });
  }
  return around;
}

enum class Kind { unknown, face, hole };

// Returns whether an edge is a border or cut: one of its sides is no face.
bool is_open(const std::string& assignment) { return assignment == "B" || assignment == "C"; }

// Tells faces from holes: first across edges that are no borders, then across one border, and so
// on. A wrong letter then contradicts the rest, and not the rest it.
class Telling {
 public:
  Telling(const std::vector<PlaneRegion>& regions, const PlaneEdges& edges)
      : regions_(regions), edges_(edges), kinds_(regions.size(), Kind::unknown) {
    for (std::size_t r = 0; r < regions.size(); ++r) {
      const std::vector<int>& loop = regions[r].loop;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        left_of_[{loop[k], loop[(k + 1) % loop.size()]}] = r;
      }
    }
    for (std::size_t r = 0; r < regions.size(); ++r) {
      if (regions[r].bounded()) continue;
      each_side(r, [&](const Side&, std::size_t over, bool) { decide(over, Kind::face); });
    }
    while (!near_.empty() || !far_.empty()) {
      const bool border = near_.empty();
      auto& some = border ? far_ : near_;
      const std::size_t r = some.back();
      some.pop_back();
      if (!border) far_.push_back(r);
      const Kind other = kinds_[r] == Kind::face ? Kind::hole : Kind::face;
      each_side(r, [&](const Side&, std::size_t over, bool is_border) {
        if (is_border == border) decide(over, border ? other : kinds_[r]);
      });
    }
  }

  Kind kind(std::size_t r) const { return kinds_[r]; }

  // Returns the edges whose letter contradicts the regions on their sides.
  std::vector<Side> contradictions() const {
    std::vector<Side> found;
    for (const auto& [ends, assignment] : edges_) {
      const std::size_t r = left_of_.at(ends), over = left_of_.at({ends.second, ends.first});
      if (!regions_[r].bounded() || !regions_[over].bounded() || r == over) continue;
      if (is_open(assignment) == (kinds_[r] == kinds_[over])) found.push_back(ends);
    }
    return found;
  }

 private:
  template <class See>
  void each_side(std::size_t r, const See& see) const {
    const std::vector<int>& loop = regions_[r].loop;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int a = loop[k], b = loop[(k + 1) % loop.size()];
      const Side ends = std::minmax(a, b);
      see(ends, left_of_.at({b, a}), is_open(edges_.at(ends)));
    }
  }

  void decide(std::size_t r, Kind kind) {
    if (!regions_[r].bounded() || kinds_[r] != Kind::unknown) return;
    kinds_[r] = kind;
    near_.push_back(r);
  }

  const std::vector<PlaneRegion>& regions_;
  const PlaneEdges& edges_;
  std::map<Side, std::size_t> left_of_;
  std::vector<Kind> kinds_;
  std::vector<std::size_t> near_, far_;
};

}  // namespace

std::vector<PlaneRegion> regions_of(const PlanePoints& points, const PlaneEdges& edges,
                                    const std::function<bool(const Side&)>& starts) {
  const auto around = rings_of(points, edges);
  const auto point = [&](int v) { return points[static_cast<std::size_t>(v)]; };
  std::map<Side, bool> walked;
  std::vector<PlaneRegion> regions;
  for (const auto& [ends, assignment] : edges) {
    for (const Side& start : {Side(ends.first, ends.second), Side(ends.second, ends.first)}) {
      if (walked[start] || !starts(start)) continue;
      PlaneRegion region{{}, 0};
      for (Side at = start; !walked[at];) {
        walked[at] = true;
        region.loop.push_back(at.first);
        region.twice_area +=
            cross(point(at.first) - point(start.first), point(at.second) - point(start.first));
        const auto& ring = around[static_cast<std::size_t>(at.second)];
        const auto back = std::find(ring.begin(), ring.end(), at.first);
        at = {at.second, back == ring.begin() ? ring.back() : *(back - 1)};
      }
      regions.push_back(std::move(region));
    }
  }
  return regions;
}

FacesOfRegions faces_of_edges(const PlanePoints& points, const PlaneEdges& edges) {
  const std::vector<PlaneRegion> regions =
      regions_of(points, edges, [](const Side&) { return true; });
  const Telling telling(regions, edges);
  FacesOfRegions found{{}, {}, telling.contradictions()};
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (telling.kind(r) != Kind::face) continue;
    std::vector<int> loop = regions[r].loop;
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    if (loop.size() == 4) {
      found.faces.push_back({loop[0], loop[1], loop[2], loop[3]});
    } else {
      found.not_four_sided.push_back(std::move(loop));
    }
  }
  std::sort(found.faces.begin(), found.faces.end());
  return found;
}

}  // namespace misalign::schema
