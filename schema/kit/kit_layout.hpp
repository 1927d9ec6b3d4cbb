// Lays out the parts of a kit in shelves, on as many beds as they need.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace misalign::schema {

struct LayoutBox {
  Eigen::Vector2d size_mm;
  bool may_turn;
};

struct LaidOut {
  int bed;
  Eigen::Vector2d at_mm;  ///< upper left corner, right and down from the bed's
  bool turned;            ///< true if turned by a quarter
};

/// Returns whether a box has room on an empty bed, turned if need be.
bool fits_bed(const LayoutBox& box, const Eigen::Vector2d& bed_mm);

/// Places the boxes, the tallest first, each on the first shelf with room, in columns that fill the
/// shelf's height. Every box must fit a bed, whose height may be infinite.
std::vector<LaidOut> lay_out(const std::vector<LayoutBox>& boxes, const Eigen::Vector2d& bed_mm,
                             double gap_mm);

/// The width of one sheet for all boxes: the two widest side by side, or more where that makes a
/// long strip.
double sheet_width_mm(const std::vector<LayoutBox>& boxes, double gap_mm);

}  // namespace misalign::schema
