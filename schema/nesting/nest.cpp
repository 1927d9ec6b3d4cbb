#include "schema/nesting/nest.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "schema/nesting/forbidden.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kRounding_mm = 1e-9, kInfinite = std::numeric_limits<double>::infinity();

struct Box {
  Vector2d least = Vector2d::Constant(kInfinite), most = -least;
};

Box box_of(const std::vector<PlanePoints>& pieces) {
  Box box;
  for (const PlanePoints& piece : pieces) {
    for (const Vector2d& point : piece) {
      box.least = box.least.cwiseMin(point);
      box.most = box.most.cwiseMax(point);
    }
  }
  return box;
}

struct Found {
  Nested place;
  Vector2d top_right;
};

// Aims of a shape's place, by the upper right corner of its box: the lowest, then farthest left; or
// the nearest to the lower left corner.
enum class Aim { low, near };

double cost(Aim aim, const Vector2d& top_right) {
  constexpr double kLittle = 1e-3;
  return top_right.y() + (aim == Aim::low ? kLittle : 1) * top_right.x();
}

// Places where a turned shape may lie on a bed.
class Places {
 public:
  Places(const std::vector<PlanePoints>& shape, const std::vector<PlanePoints>& on_bed,
         const NestBed& bed) {
    const Box box = box_of(shape);
    const double top_mm = on_bed.empty() ? 0 : box_of(on_bed).most.y() + bed.gap_mm;
    least_ = -box.least;
    most_ = bed.size_mm - box.most;
    most_.y() = std::min(most_.y(), std::max(top_mm, 0.0) - box.least.y());  // free from there on
    if (!has_room()) return;
    for (const PlanePoints& fixed : on_bed) {
      for (const PlanePoints& moving : shape) {
        Forbidden forbidden(fixed, moving, bed.gap_mm);
        const bool in_reach = (forbidden.most_mm() - least_).minCoeff() > 0 &&
                              (most_ - forbidden.least_mm()).minCoeff() > 0;
        if (in_reach) forbidden_.push_back(std::move(forbidden));
      }
    }
  }

  bool has_room() const { return (most_ - least_).minCoeff() >= -kRounding_mm; }

  // The lowest row with room, by steps; from there down and to the left as far as the way is free.
  std::optional<Vector2d> lowest(double most_y_mm) const {
    constexpr double kStep_mm = 1;
    std::vector<double> rows;
    const double end = std::min(most_.y(), most_y_mm);
    for (double y = least_.y(); y < end; y += kStep_mm) rows.push_back(y);
    rows.push_back(std::min(std::max(most_.y(), least_.y()), end));
    for (const double y : rows) {
      if (y < least_.y() - kRounding_mm) continue;
      const auto x = first_free(taken(1, y), least_.x(), most_.x());
      if (!x) continue;
      Vector2d at(*x, y);
      constexpr int kSlides = 4;
      for (int k = 0; k < kSlides; ++k) slide(at, 1 - k % 2);
      return at;
    }
    return std::nullopt;
  }

 private:
  std::vector<OpenInterval> taken(int axis, double value) const {
    std::vector<OpenInterval> intervals;
    for (const Forbidden& forbidden : forbidden_) {
      if (const auto interval = forbidden.at(axis, value)) intervals.push_back(*interval);
    }
    return intervals;
  }

  // Lowers one coordinate up to the first interval in its way.
  void slide(Vector2d& at, int coordinate) const {
    double stop = least_(coordinate);
    for (const OpenInterval& interval : taken(1 - coordinate, at(1 - coordinate))) {
      if (interval.high <= at(coordinate) + kRounding_mm) stop = std::max(stop, interval.high);
    }
    at(coordinate) = std::min(at(coordinate), stop);
  }

  Vector2d least_, most_;
  std::vector<Forbidden> forbidden_;
};

struct Bed {
  std::vector<PlanePoints> pieces;
  Vector2d used = Vector2d::Zero();
};

std::optional<Found> place(const NestShape& shape, const Bed& on, const NestBed& bed, Aim aim) {
  std::optional<Found> best;
  for (const double turn_deg : shape.turns_deg) {
    const std::vector<PlanePoints> turned = shape.turned(turn_deg);
    const Box box = box_of(turned);
    const Places places(turned, on.pieces, bed);
    if (!places.has_room()) continue;
    const double most_y = best ? cost(aim, best->top_right) - box.most.y() : kInfinite;
    const auto at = places.lowest(most_y);
    if (!at) continue;
    const Found found{{0, turn_deg, *at}, *at + box.most};
    if (!best || cost(aim, found.top_right) < cost(aim, best->top_right) - kRounding_mm) {
      best = found;
    }
  }
  return best;
}

NestResult nest_in_order(const std::vector<NestShape>& shapes, const NestBed& bed,
                         const std::vector<std::size_t>& order, Aim aim) {
  const Bed empty{bed.taken};
  NestResult result{std::vector<Nested>(shapes.size()), 0, {}};
  std::vector<Bed> beds;
  for (const std::size_t s : order) {
    for (std::size_t b = 0;; ++b) {
      if (b == beds.size()) beds.push_back(empty);
      const auto found = place(shapes[s], beds[b], bed, aim);
      assert(found || beds[b].used.y() > 0);
      if (!found) continue;
      result.places[s] = found->place;
      result.places[s].bed = b;
      beds[b].used = beds[b].used.cwiseMax(found->top_right);
      for (PlanePoints& piece : shapes[s].turned(found->place.turned_deg)) {
        for (Vector2d& point : piece) point += found->place.moved_mm;
        beds[b].pieces.push_back(std::move(piece));
      }
      break;
    }
  }
  result.beds = beds.size();
  for (const Bed& used : beds) result.used_mm.push_back(used.used);
  return result;
}

}  // namespace

bool NestResult::is_better_than(const NestResult& other) const {
  if (beds != other.beds || beds == 0) return beds < other.beds;
  return used_mm.back().y() < other.used_mm.back().y() - kRounding_mm;
}

std::optional<Nested> place_alone(const NestShape& shape, const NestBed& bed) {
  const auto found = place(shape, {bed.taken}, bed, Aim::low);
  return found ? std::optional(found->place) : std::nullopt;
}

NestResult nest(const std::vector<NestShape>& shapes, const NestBed& bed) {
  std::vector<double> areas, lengths;
  for (const NestShape& shape : shapes) {
    const Box box = box_of(shape.pieces);
    areas.push_back(shape.area_mm2);
    lengths.push_back((box.most - box.least).maxCoeff());
  }
  NestResult best;
  for (const std::vector<double>& sizes : {areas, lengths}) {
    std::vector<std::size_t> order(shapes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::size_t s) { return sizes[s]; });
    for (const Aim aim : {Aim::low, Aim::near}) {
      NestResult result = nest_in_order(shapes, bed, order, aim);
      if (best.beds == 0 || result.is_better_than(best)) best = std::move(result);
    }
  }
  return best;
}

}  // namespace misalign::schema
