// Places where a turned shape may lie on a bed.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "schema/nesting/forbidden.hpp"

namespace misalign::schema {

struct PlaneBox {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()),
                  most = -least;

  /// The box round all pieces.
  static PlaneBox round(const std::vector<PlanePoints>& pieces);
};

class FreePlaces {
 public:
  /// Translations of a shape, whose box this is, that keep it on a bed from the origin to `size_mm`
  /// and the gap from the pieces there.
  FreePlaces(const std::vector<PlanePoints>& shape, const PlaneBox& box,
             const std::vector<PlanePoints>& on_bed, const Eigen::Vector2d& size_mm, double gap_mm);

  /// The lowest row with room, by steps of two millimetres, at most `most_y_mm`; the farthest left
  /// there; and from there down and to the left as far as the way is free.
  std::optional<Eigen::Vector2d> lowest(double most_y_mm) const;

 private:
  bool has_room() const;
  std::vector<OpenInterval> taken(int axis, double value) const;
  void slide(Eigen::Vector2d& at, int coordinate) const;

  Eigen::Vector2d least_, most_;
  std::vector<Forbidden> forbidden_;
};

}  // namespace misalign::schema
