#include "schema/kit/kit_item.hpp"

namespace misalign::schema {

KitItem empty_item(const Eigen::Vector2d& least_mm, const Eigen::Vector2d& most_mm) {
  KitItem item{{"", least_mm, most_mm, {}}, false};
  const auto add = [&](const char* name, const LineColour& colour, LayerUse use = LayerUse::cut) {
    item.drawing.layers.push_back({name, colour, use, {}, {}, {}});
  };
  add("hatch", kGrey, LayerUse::mark);
  add("note", kCyan, LayerUse::mark);
  add("hinge", kGrey, LayerUse::hidden);
  add("engrave", kGreen, LayerUse::mark);
  add("score_mountain", kRed);
  add("score_valley", kBlue);
  add("dash_mountain", kRed);
  add("dash_valley", kBlue);
  add("bore", kMagenta);
  add("slit", kMagenta);
  add("cut", kBlack);
  return item;
}

void KitItem::add(const KitItem& other, const Eigen::Vector2d& at_mm, bool turned) {
  const Eigen::Vector2d &least = other.drawing.least_mm, &most = other.drawing.most_mm;
  const auto moved = [&](const Eigen::Vector2d& point) {
    return Eigen::Vector2d(at_mm +
                           (turned ? Eigen::Vector2d(most.y() - point.y(), point.x() - least.x())
                                   : Eigen::Vector2d(point - least)));
  };
  constexpr double kQuarter_deg = 90;
  for (std::size_t l = 0; l < drawing.layers.size(); ++l) {
    LineLayer& to = drawing.layers[l];
    for (DrawnPath path : other.drawing.layers[l].paths) {
      for (Eigen::Vector2d& point : path.points_mm) point = moved(point);
      to.paths.push_back(std::move(path));
    }
    for (const DrawnCircle& circle : other.drawing.layers[l].circles) {
      to.circles.push_back({moved(circle.centre_mm), circle.radius_mm});
    }
    for (DrawnText text : other.drawing.layers[l].texts) {
      text.at_mm = moved(text.at_mm);
      if (turned) text.turned_deg += kQuarter_deg;
      to.texts.push_back(std::move(text));
    }
  }
}

}  // namespace misalign::schema
