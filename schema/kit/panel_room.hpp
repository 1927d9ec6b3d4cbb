// Finds room to engrave in a panel.
#pragma once

#include <optional>
#include <vector>

#include "schema/exchange/line_drawing.hpp"
#include "schema/kit/kit_bores.hpp"

namespace misalign::schema {

class PanelRoom {
 public:
  /// The room of a panel outside its bores and tabs.
  PanelRoom(const solver::Sheet& sheet, int facet, const KitFittings& fittings);

  /// Places words with their middle at the first of the points where they fit, and takes the room.
  std::optional<DrawnText> place(const std::string& words, double height_mm,
                                 const std::vector<Eigen::Vector2d>& middles_mm);

  const Eigen::Vector2d& middle_mm() const { return middle_mm_; }
  double size_mm() const { return size_mm_; }

 private:
  struct Box {
    Eigen::Vector2d middle, half;
  };
  bool has_room_for(const Box& box) const;

  struct Side {
    Eigen::Vector2d at_mm, inwards;
  };
  std::vector<Side> sides_;  // with those of trimmed corners
  Eigen::Vector2d middle_mm_;
  double size_mm_;  // root of the area
  std::vector<DrawnCircle> fittings_;
  std::vector<Box> taken_;
};

}  // namespace misalign::schema
