// Lays out the parts of a kit: in shelves, on as many beds as are needed.
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
  Eigen::Vector2d at_mm;  ///< its upper left corner from the bed's, right and down
  bool turned;            ///< by a quarter
};

/// Whether it has room on an empty bed, turned if need be.
bool fits_bed(const LayoutBox& box, const Eigen::Vector2d& bed_mm);

/// The tallest first, each on the first shelf with room, in columns: next to one another, and below
/// one another where the shelf is taller. Every box must fit a bed, whose height may be infinite.
std::vector<LaidOut> lay_out(const std::vector<LayoutBox>& boxes, const Eigen::Vector2d& bed_mm,
                             double gap_mm);

/// The width of one sheet for all of them: the widest with the next widest beside it, or more where
/// that makes a long strip.
double sheet_width_mm(const std::vector<LayoutBox>& boxes, double gap_mm);

}  // namespace misalign::schema
