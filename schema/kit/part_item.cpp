#include "schema/kit/part_item.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "schema/kit/hinge_marks.hpp"
#include "schema/kit/panel_room.hpp"
#include "schema/kit/stroke_font.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kPanelNumber_mm = 5, kPanelLabel_mm = 2.5;  // largest heights
constexpr double kPanelNumberPart = 0.09,
                 kPanelLabelPart = 0.045;  // largest heights, as shares of a panel's size

// Points round a middle, the nearest first.
std::vector<Vector2d> rings_round(const Vector2d& middle, double first_mm, double step_mm,
                                  int rings, int directions) {
  std::vector<Vector2d> points;
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * std::numbers::pi * k / directions;
      points.emplace_back(middle +
                          (first_mm + ring * step_mm) * Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
  return points;
}

class Marks {
 public:
  Marks(const solver::Sheet& sheet, const KitPart& part, const KitFittings& fittings,
        LineLayer& engraved)
      : sheet_(sheet), engraved_(engraved) {
    for (const int f : part.facets) rooms_.emplace(f, PanelRoom(sheet, f, fittings));
  }

  // Numbers each panel in its middle, or as near as bores permit; smaller where there is no room.
  void add_panel_numbers() {
    constexpr double kSmaller = 0.8, kLeast_mm = 0.5;
    for (auto& [facet, room] : rooms_) {
      const std::string words = panel_label(sheet_, facet);
      std::vector<Vector2d> middles = {room.middle_mm()};
      for (const Vector2d& point :
           rings_round(room.middle_mm(), 0.05 * room.size_mm(), 0.05 * room.size_mm(), 8, 16)) {
        middles.push_back(point);
      }
      double height_mm = std::min(kPanelNumber_mm, kPanelNumberPart * room.size_mm());
      auto text = room.place(words, height_mm, middles);
      while (!text && (height_mm *= kSmaller) > kLeast_mm) {
        text = room.place(words, height_mm, middles);
      }
      // The number lies over bores where it has no room.
      engrave(text ? *text : DrawnText{room.middle_mm(), words, height_mm});
    }
  }

  void add_bevel_angles(const KitFittings& fittings) {
    for (auto& [facet, room] : rooms_) {
      for (const DrawnText& text :
           bevel_angles(sheet_, facet, fittings, mark_height_mm(room), room)) {
        engrave(text);
      }
    }
  }

  void add_spring_numbers(const std::vector<SpringEnd>& ends) {
    for (const SpringEnd& end : ends) {
      const auto room = rooms_.find(end.facet);
      if (room == rooms_.end()) continue;
      const double height_mm = mark_height_mm(room->second);
      add(room->second, "s" + std::to_string(end.spring),
          rings_round(end.at_mm, end.taken_mm + height_mm, 0.5 * height_mm, 12, 24));
    }
  }

  // Labels each vertex once, in the panel with room nearest to it.
  void add_vertex_labels() {
    constexpr int kSteps = 40;
    constexpr double kFarthest = 0.4;  // largest distance, as a share of a panel's size
    std::map<int, std::vector<int>> panels_at;
    for (const auto& [facet, room] : rooms_) {
      for (const int v : sheet_.base().sheet.facets[static_cast<std::size_t>(facet)]) {
        panels_at[v].push_back(facet);
      }
    }
    for (const auto& [vertex, panels] : panels_at) {
      bool placed = false;
      for (int step = 1; step <= kSteps && !placed; ++step) {
        for (std::size_t k = 0; k < panels.size() && !placed; ++k) {
          PanelRoom& room = rooms_.at(panels[k]);
          const PanelCorner corner(sheet_, panels[k], vertex);
          placed =
              add(room, solver::vertex_label(vertex),
                  {corner.at_mm + kFarthest * room.size_mm() * step / kSteps * corner.bisector});
        }
      }
    }
  }

 private:
  static double mark_height_mm(const PanelRoom& room) {
    return std::min(kPanelLabel_mm, kPanelLabelPart * room.size_mm());
  }
  bool add(PanelRoom& room, const std::string& words, const std::vector<Vector2d>& middles_mm) {
    const auto text = room.place(words, mark_height_mm(room), middles_mm);
    if (text) engrave(*text);
    return text.has_value();
  }
  void engrave(const DrawnText& text) {
    for (DrawnPath& stroke : strokes_of(text)) engraved_.paths.push_back(std::move(stroke));
  }

  const solver::Sheet& sheet_;
  LineLayer& engraved_;
  std::map<int, PanelRoom> rooms_;
};

// Adds the part's creases, which end at the clearances of tabs.
void add_creases(const solver::Sheet& sheet, const KitPart& part, const KitFittings& fittings,
                 const KitOptions& options, KitItem& item) {
  const auto end_mm = [&](int at, int other) {
    const Vector2d from = sheet.point_mm(at), along = sheet.point_mm(other) - from;
    const SpringTab* tab = fittings.tab_at(at);
    return tab == nullptr ? from : Vector2d(from + tab->clear_mm * along.normalized());
  };
  const bool dashed = options.crease == CreaseCut::dash;
  for (const int c : part.creases) {
    const solver::Crease& crease = sheet.mechanism().creases[static_cast<std::size_t>(c)];
    const Vector2d from = end_mm(crease.a, crease.b), to = end_mm(crease.b, crease.a);
    const bool valley = sheet.mechanism().is_valley(crease);
    if (!dashed) {
      item.on(valley ? KitLayer::score_valley : KitLayer::score_mountain)
          .paths.push_back({{from, to}, false});
      continue;
    }
    auto& paths = item.on(valley ? KitLayer::dash_valley : KitLayer::dash_mountain).paths;
    for (DrawnPath& dash : perforation(from, to, options)) paths.push_back(std::move(dash));
  }
}

}  // namespace

KitItem part_item(const solver::Sheet& sheet, const KitPart& part, const KitFittings& fittings,
                  const KitOptions& options) {
  const PartOutline outline = part_outline(sheet, part, fittings, options.kerf_mm);
  KitItem item = empty_item();
  for (const Ring& ring : outline.rings) {
    const bool is_outer = &ring == outline.rings.data();
    item.on(is_outer ? KitLayer::cut : KitLayer::opening).paths.push_back({ring, true});
  }
  for (const auto& slit : outline.slits) item.on(KitLayer::slit).paths.push_back({slit, false});
  for (const Bore& bore : fittings.bores) {
    if (!std::binary_search(part.facets.begin(), part.facets.end(), bore.facet)) continue;
    item.on(KitLayer::bore)
        .circles.push_back({bore.centre_mm, 0.5 * (bore.diameter_mm - options.kerf_mm)});
  }
  add_creases(sheet, part, fittings, options, item);
  for (const int facet : part.facets) add_hinges(sheet, facet, fittings, item);
  Marks marks(sheet, part, fittings, item.on(KitLayer::engrave));
  marks.add_panel_numbers();
  marks.add_bevel_angles(fittings);
  marks.add_spring_numbers(fittings.ends);
  marks.add_vertex_labels();
  return item;
}

std::vector<DrawnPath> perforation(const Vector2d& from_mm, const Vector2d& to_mm,
                                   const KitOptions& options) {
  constexpr double kRounding = 1e-9;  // of the count, where a whole number fits exactly
  const double length_mm = (to_mm - from_mm).norm();
  const double count = std::floor(
      (length_mm - options.bridge_mm) / (options.dash_mm + options.bridge_mm) + kRounding);
  if (count < 1) return {};
  const double bridge_mm = (length_mm - count * options.dash_mm) / (count + 1);
  const Vector2d along = (to_mm - from_mm) / length_mm;
  std::vector<DrawnPath> dashes;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    const double begin_mm = bridge_mm + k * (options.dash_mm + bridge_mm) + 0.5 * options.kerf_mm;
    const double end_mm = begin_mm + options.dash_mm - options.kerf_mm;
    dashes.push_back({{from_mm + begin_mm * along, from_mm + end_mm * along}, false});
  }
  return dashes;
}

}  // namespace misalign::schema
