// A drawing in layers for a machine that follows lines, for any pen to write.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "schema/exchange/length_unit.hpp"

namespace misalign::schema {

/// A colour: #rrggbb for SVG, a number in AutoCAD's list of colours for DXF. The colours are those
/// of LightBurn's palette, so that it makes a layer of each.
struct LineColour {
  std::string rgb;
  int aci;
};
inline const LineColour kBlack{"#000000", 7}, kRed{"#ff0000", 1}, kBlue{"#0000ff", 5},
    kGreen{"#00e000", 3}, kMagenta{"#ff00ff", 6}, kCyan{"#00e0e0", 4}, kOrange{"#ff8000", 30},
    kGrey{"#b4b4b4", 8};

struct DrawnPath {
  std::vector<Eigen::Vector2d> points_mm;
  bool closed;  ///< true if the last point is joined to the first, which is not repeated
};

struct DrawnCircle {
  Eigen::Vector2d centre_mm;
  double radius_mm;
};

struct DrawnText {
  Eigen::Vector2d at_mm;  ///< left end of the base line; its middle where it is engraved
  std::string words;
  double height_mm;  ///< height of a capital
};

enum class LayerUse {
  cut,     ///< cut, scored or perforated
  mark,    ///< engraved, or shown to people
  hidden,  ///< followed by no machine by default
};

struct LineLayer {
  std::string name;  ///< lower case letters and _
  LineColour colour;
  LayerUse use;
  std::vector<DrawnPath> paths;
  std::vector<DrawnCircle> circles;
  std::vector<DrawnText> texts;

  bool is_empty() const { return paths.empty() && circles.empty() && texts.empty(); }
};

/// A drawing in top view (+z), y up, scale 1:1. Later layers lie over earlier ones, and are cut
/// after them.
struct LineDrawing {
  std::string title;
  Eigen::Vector2d least_mm, most_mm;  ///< opposite corners of the page
  std::vector<LineLayer> layers;
  LengthUnit unit = LengthUnit::millimetre;  ///< unit of files

  /// Removes layers that are not cut: some programs follow hidden layers, too.
  void keep_cuts() {
    std::erase_if(layers, [](const LineLayer& layer) { return layer.use != LayerUse::cut; });
  }
};

}  // namespace misalign::schema
