// A drawing for a machine that follows lines, in layers: made once, and written by any pen.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace misalign::schema {

/// For SVG as #rrggbb, for DXF as its number in AutoCAD's list of colours.
struct LineColour {
  std::string rgb;
  int aci;
};
inline const LineColour kBlack{"#000000", 7}, kRed{"#ff0000", 1}, kBlue{"#0000ff", 5},
    kGreen{"#008000", 3}, kMagenta{"#ff00ff", 6}, kCyan{"#00a0a0", 4}, kGrey{"#808080", 8};

struct DrawnPath {
  std::vector<Eigen::Vector2d> points_mm;
  bool closed;  ///< from the last point back to the first, which is not repeated
};

struct DrawnCircle {
  Eigen::Vector2d centre_mm;
  double radius_mm;
};

struct DrawnText {
  Eigen::Vector2d at_mm;  ///< on the base line: its left end, or its middle
  std::string words;
  double height_mm;  ///< of a capital
  bool centred = false;
  double turned_deg = 0;  ///< counter-clockwise, about `at_mm`
};

enum class LayerUse {
  cut,     ///< cut, scored or perforated
  mark,    ///< shown, for a machine that engraves or for people
  hidden,  ///< no machine follows it unless asked
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

/// Seen from +z, y up, true scale. Later layers lie over earlier ones, and are cut after them.
struct LineDrawing {
  std::string title;
  Eigen::Vector2d least_mm, most_mm;  ///< opposite corners of the page
  std::vector<LineLayer> layers;

  /// Without what is not cut: some programs follow hidden layers, too.
  void keep_cuts() {
    std::erase_if(layers, [](const LineLayer& layer) { return layer.use != LayerUse::cut; });
  }
};

}  // namespace misalign::schema
