#include "schema/nesting/nest.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "schema/nesting/free_places.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kSameCost_mm = 1e-9;

// Aims of a shape's place, by the upper right corner of its box: the lowest, then farthest left; or
// the nearest to the lower left corner.
enum class Aim { low, near };

double cost(Aim aim, const Vector2d& top_right) {
  constexpr double kLittle = 1e-3;
  return top_right.y() + (aim == Aim::low ? kLittle : 1) * top_right.x();
}

// Turns that a plan uses: all, or one of a shape's turns and the opposite one, so that alike shapes
// lie alike.
struct Turns {
  std::optional<std::size_t> pair;

  std::vector<double> chosen(const std::vector<double>& turns_deg) const {
    constexpr std::size_t kQuarters = 4, kHalves = 2;
    if (!pair || turns_deg.size() < kQuarters) return turns_deg;
    const std::size_t first = *pair / kHalves * kQuarters % turns_deg.size() + *pair % kHalves;
    return {turns_deg[first], turns_deg[first + kHalves]};
  }
};

struct Plan {
  std::vector<std::size_t> order;
  Aim aim;
  Turns turns;
};

struct Bed {
  std::vector<PlanePoints> pieces;
  Vector2d used = Vector2d::Zero();
};

struct Candidate {
  Nested place;
  Vector2d top_right;
};

std::optional<Candidate> placed(const NestShape& shape, const Bed& on, const NestBed& bed, Aim aim,
                                const std::vector<double>& turns_deg) {
  std::optional<Candidate> best;
  for (const double turn_deg : turns_deg) {
    const std::vector<PlanePoints> turned = shape.turned(turn_deg);
    const PlaneBox box = PlaneBox::round(turned);
    const double most_y =
        best ? cost(aim, best->top_right) - box.most.y() : std::numeric_limits<double>::infinity();
    const auto at = FreePlaces(turned, box, on.pieces, bed.size_mm, bed.gap_mm).lowest(most_y);
    if (!at) continue;
    const Candidate candidate{{0, turn_deg, *at}, *at + box.most};
    if (!best || cost(aim, candidate.top_right) < cost(aim, best->top_right) - kSameCost_mm) {
      best = candidate;
    }
  }
  return best;
}

NestResult nest_by(const Plan& plan, const std::vector<NestShape>& shapes, const NestBed& bed) {
  const Bed empty{bed.taken};
  NestResult result{std::vector<Nested>(shapes.size()), 0, {}};
  std::vector<Bed> beds;
  for (const std::size_t s : plan.order) {
    for (std::size_t b = 0;; ++b) {
      const bool is_empty = b == beds.size();
      if (is_empty) beds.push_back(empty);
      const NestShape& shape = shapes[s];
      auto place = placed(shape, beds[b], bed, plan.aim, plan.turns.chosen(shape.turns_deg));
      if (!place && is_empty) place = placed(shape, beds[b], bed, plan.aim, shape.turns_deg);
      assert(place || !is_empty);
      if (!place) continue;
      result.places[s] = place->place;
      result.places[s].bed = b;
      beds[b].used = beds[b].used.cwiseMax(place->top_right);
      for (PlanePoints& piece : shape.turned(place->place.turned_deg)) {
        for (Vector2d& point : piece) point += place->place.moved_mm;
        beds[b].pieces.push_back(std::move(piece));
      }
      break;
    }
  }
  result.beds = beds.size();
  for (const Bed& used : beds) result.used_mm.push_back(used.used);
  return result;
}

std::vector<std::size_t> largest_first(const std::vector<double>& sizes) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t s) { return sizes[s]; });
  return order;
}

// Orders: by area; by length; and convex shapes of one kind after another, which lie in rows. The
// kind of a quadrilateral is the way that its second side leans.
std::vector<std::vector<std::size_t>> orders_of(const std::vector<NestShape>& shapes) {
  std::vector<double> areas, lengths, kinds;
  for (const NestShape& shape : shapes) {
    const PlaneBox box = PlaneBox::round(shape.pieces);
    areas.push_back(shape.area_mm2);
    lengths.push_back((box.most - box.least).maxCoeff());
    constexpr std::size_t kSecond = 4;
    constexpr double kApart_deg = 15;
    const bool leans = shape.pieces.size() == 1 && shape.turns_deg.size() > kSecond;
    kinds.push_back(leans ? -std::floor(shape.turns_deg[kSecond] / kApart_deg) : shape.area_mm2);
  }
  return {largest_first(areas), largest_first(lengths), largest_first(kinds)};
}

std::vector<Turns> all_turns(const std::vector<NestShape>& shapes) {
  std::size_t pairs = 0;
  for (const NestShape& shape : shapes) pairs = std::max(pairs, shape.turns_deg.size() / 2);
  std::vector<Turns> turns(1);
  for (std::size_t pair = 0; pair < pairs; ++pair) turns.push_back({pair});
  return turns;
}

// The best of several plans, up to an amount of work: turns times pairs of pieces.
class Search {
 public:
  Search(const std::vector<NestShape>& shapes, const NestBed& bed) : shapes_(shapes), bed_(bed) {
    for (const NestShape& shape : shapes) {
      pieces_ += shape.pieces.size();
      most_turns_ = std::max(most_turns_, shape.turns_deg.size());
    }
  }

  // Takes the plan if it is no worse, while there is work left.
  void attempt(const Plan& plan) {
    if (best_ && !has_time()) return;
    work_ += (plan.turns.pair ? 2 : most_turns_) * pieces_ * pieces_;
    NestResult result = nest_by(plan, shapes_, bed_);
    if (best_ && best_->is_better_than(result)) return;
    best_ = std::move(result);
    plan_ = plan;
  }

  // Shapes of the best plan change places, or move in its order, at random.
  void improve() {
    std::mt19937 random(1);
    const std::size_t count = shapes_.size();
    for (bool swaps = true; count > 2 && has_time(); swaps = !swaps) {
      Plan plan = plan_;
      const std::size_t from = random() % count, to = random() % count;
      if (swaps) {
        std::swap(plan.order[from], plan.order[to]);
      } else {
        const std::size_t moved = plan.order[from];
        plan.order.erase(plan.order.begin() + static_cast<std::ptrdiff_t>(from));
        plan.order.insert(plan.order.begin() + static_cast<std::ptrdiff_t>(to), moved);
      }
      attempt(plan);
    }
  }

  const NestResult& best() const { return *best_; }

 private:
  bool has_time() const {
    constexpr std::size_t kMostWork = 400000;
    return work_ < kMostWork;
  }

  const std::vector<NestShape>& shapes_;
  const NestBed& bed_;
  std::size_t pieces_ = 0, most_turns_ = 0, work_ = 0;
  std::optional<NestResult> best_;
  Plan plan_;
};

}  // namespace

bool NestResult::is_better_than(const NestResult& other) const {
  if (beds != other.beds || beds == 0) return beds < other.beds;
  return used_mm.back().y() < other.used_mm.back().y() - kSameCost_mm;
}

std::optional<Nested> place_alone(const NestShape& shape, const NestBed& bed) {
  const auto place = placed(shape, {bed.taken}, bed, Aim::low, shape.turns_deg);
  return place ? std::optional(place->place) : std::nullopt;
}

NestResult nest(const std::vector<NestShape>& shapes, const NestBed& bed) {
  Search search(shapes, bed);
  const auto orders = orders_of(shapes);
  for (const Turns& turns : all_turns(shapes)) {
    for (const Aim aim : {Aim::low, Aim::near}) {
      for (const std::vector<std::size_t>& order : orders) search.attempt({order, aim, turns});
    }
  }
  search.improve();
  return search.best();
}

}  // namespace misalign::schema
