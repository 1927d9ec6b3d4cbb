// An item of a kit's layout, moved as one: a part, or a block of notes, on the kit's layers.
#pragma once

#include "schema/exchange/line_drawing.hpp"

namespace misalign::schema {

/// Layers in the order of cutting: contours, which hold a part, are last.
enum class KitLayer {
  hatch,  ///< hatching of openings; not cut
  note,   ///< title, gauge and tables
  hinge,  ///< axes of plates' hinges; not cut
  engrave,
  score_mountain,
  score_valley,
  dash_mountain,
  dash_valley,
  bore,
  slit,  ///< cuts through a ball joint, where two openings touch
  cut,
};

struct KitItem {
  LineDrawing drawing;  ///< has every layer
  bool may_turn = false;

  LineLayer& on(KitLayer layer) { return drawing.layers[static_cast<std::size_t>(layer)]; }
  Eigen::Vector2d size_mm() const { return drawing.most_mm - drawing.least_mm; }
  /// Adds the other's lines, with their page's lower left corner at a point; `turned`: by a
  /// quarter, counter-clockwise.
  void add(const KitItem& other, const Eigen::Vector2d& at_mm, bool turned);
};

/// An item with every layer, all empty.
KitItem empty_item(const Eigen::Vector2d& least_mm, const Eigen::Vector2d& most_mm);

}  // namespace misalign::schema
