#include "schema/kit/kit_item.hpp"

namespace misalign::schema {

KitItem empty_item(const Eigen::Vector2d& size_mm) {
  KitItem item{{"", Eigen::Vector2d::Zero(), size_mm, {}}};
  const auto add = [&](const char* name, const LineColour& colour, LayerUse use = LayerUse::cut) {
    item.drawing.layers.push_back({name, colour, use, {}, {}, {}});
  };
  add("registration", kCyan);
  add("hinge", kGrey, LayerUse::hidden);
  add("engrave", kGreen, LayerUse::mark);
  add("score_mountain", kRed);
  add("score_valley", kBlue);
  add("dash_mountain", kRed);
  add("dash_valley", kBlue);
  add("bore", kMagenta);
  add("slit", kMagenta);
  add("opening", kOrange);
  add("cut", kBlack);
  return item;
}

Eigen::Vector2d KitItem::size_mm() const {
  const std::vector<DrawnPath>& contours = on(KitLayer::cut).paths;
  Eigen::Vector2d least = contours.at(0).points_mm.at(0), most = least;
  for (const DrawnPath& contour : contours) {
    for (const Eigen::Vector2d& point : contour.points_mm) {
      least = least.cwiseMin(point);
      most = most.cwiseMax(point);
    }
  }
  return most - least;
}

NestShape KitItem::shape(NestTurns turns) const {
  std::vector<PlanePoints> rings;
  for (const KitLayer layer : {KitLayer::cut, KitLayer::opening}) {
    for (const DrawnPath& contour : on(layer).paths) rings.push_back(contour.points_mm);
  }
  return nest_shape(rings, turns);
}

void KitItem::add(const KitItem& other, const Nested& place) {
  for (std::size_t l = 0; l < drawing.layers.size(); ++l) {
    LineLayer& to = drawing.layers[l];
    for (DrawnPath path : other.drawing.layers[l].paths) {
      for (Eigen::Vector2d& point : path.points_mm) point = place(point);
      to.paths.push_back(std::move(path));
    }
    for (const DrawnCircle& circle : other.drawing.layers[l].circles) {
      to.circles.push_back({place(circle.centre_mm), circle.radius_mm});
    }
  }
}

LineDrawing without_empty_layers(LineDrawing drawing) {
  std::erase_if(drawing.layers, [](const LineLayer& layer) { return layer.is_empty(); });
  return drawing;
}

}  // namespace misalign::schema
