// Lays the items of a kit out on pages: the beds of a machine, or one page that is as large as they
// need.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "schema/exchange/line_drawing.hpp"
#include "schema/kit/kit_item.hpp"
#include "schema/kit/kit_layout.hpp"
#include "schema/kit/kit_options.hpp"

namespace misalign::schema {

class KitPages {
 public:
  /// Returns the sentences of a page's heading; `page` counts from 0.
  using Heading = std::function<std::vector<std::string>(std::size_t page, std::size_t count)>;

  /// UserError (bad_request) if the bed has no room beside its heading. `options` and what
  /// `heading` refers to must outlive this object.
  KitPages(const KitOptions& options, std::string title, Heading heading);

  /// Returns the room of a page for items, within its margin and above its heading; without a bed
  /// infinite.
  Eigen::Vector2d room_mm() const;
  /// UserError (bad_request) about `what` if a box has no room on a bed.
  void expect_room(const std::string& what, const LayoutBox& box) const;
  /// Returns the pages, without empty layers. Every item must have room.
  std::vector<LineDrawing> laid_out(const std::vector<KitItem>& items) const;

 private:
  [[noreturn]] void refuse_bed(const std::string& why) const;

  const KitOptions& options_;
  const std::string title_;
  const Heading heading_;
};

}  // namespace misalign::schema
