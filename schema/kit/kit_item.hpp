// An item of a kit's layout, moved as one: a part on the kit's layers.
#pragma once

#include "schema/exchange/line_drawing.hpp"
#include "schema/nesting/nest.hpp"

namespace misalign::schema {

/// Layers in the order of cutting: contours that hold a part are last.
enum class KitLayer {
  registration,  ///< bores by which a bed is placed again
  hinge,         ///< axes of plates' hinges; not cut
  engrave,
  score_mountain,
  score_valley,
  dash_mountain,
  dash_valley,
  bore,
  slit,     ///< cuts through a ball joint, where two openings touch
  opening,  ///< inner contours
  cut,      ///< outer contours
};

struct KitItem {
  LineDrawing drawing;  ///< has every layer

  LineLayer& on(KitLayer layer) { return drawing.layers[static_cast<std::size_t>(layer)]; }
  const LineLayer& on(KitLayer layer) const {
    return drawing.layers[static_cast<std::size_t>(layer)];
  }
  /// Size of the box round all outer contours.
  Eigen::Vector2d size_mm() const;
  /// The shape of its contours.
  NestShape shape(NestTurns turns) const;
  /// Adds the other's lines at a place.
  void add(const KitItem& other, const Nested& place);
};

/// An item with every layer, all empty, on a page from the origin.
KitItem empty_item(const Eigen::Vector2d& size_mm = Eigen::Vector2d::Zero());

/// The drawing without its empty layers.
LineDrawing without_empty_layers(LineDrawing drawing);

}  // namespace misalign::schema
