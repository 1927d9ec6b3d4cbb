// Lays the items of a kit out on the beds of a machine, or on one sheet that is as large as they
// need.
#pragma once

#include <string>
#include <vector>

#include "schema/kit/kit_item.hpp"
#include "schema/kit/kit_options.hpp"

namespace misalign::schema {

struct KitSheets {
  std::vector<LineDrawing> beds;  ///< one if no bed is given; without empty layers
  std::vector<Nested> places;     ///< place of each item on its bed's page
  Eigen::Vector2d size_mm;        ///< size of each page
  double room_mm2;                ///< area of a page within its margin
  double used_mm;                 ///< height used on the last page, without margin
  double area_mm2;                ///< area of all items
  /// Centres of the registration marks, the same on each page: lower left, lower right, upper left.
  std::vector<Eigen::Vector2d> marks_mm;

  /// Lower bound of the number of pages, by area.
  std::size_t least_beds() const;
};

inline constexpr double kMark_mm = 3;  ///< diameter of a registration mark, a bore

class KitLayout {
 public:
  /// `options` must outlive this object.
  explicit KitLayout(const KitOptions& options);

  /// Returns whether a shape has room on an empty bed; true if there is none.
  bool has_room(const NestShape& shape) const;
  /// UserError (bad_request) about `what` if an item has no room on a bed.
  void expect_room(const std::string& what, const KitItem& item) const;
  /// Nests the items, which all must have room, with registration marks in three corners.
  KitSheets laid_out(const std::vector<KitItem>& items, const std::string& title) const;

 private:
  NestBed bed() const;
  KitSheets on_beds(const std::vector<NestShape>& shapes) const;
  KitSheets on_one_sheet(const std::vector<NestShape>& shapes) const;

  const KitOptions& options_;
};

}  // namespace misalign::schema
