#include "solver/contact/spring_faces.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "solver/contact/contact.hpp"
#include "solver/contact/plate_thickness.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::solver {
namespace {

constexpr int kMostNodes = 200000;
// Steps of a way at which lengths between raised ends are taken.
constexpr int kLengthSteps = 240;

// A face and a layer: even numbers are above, odd ones below, the mid-plane's first.
constexpr int kSlots = 2 * kSpringLayers;
int layer_of(int slot) { return slot / 2; }
SheetFace face_of(int slot) { return slot % 2 == 0 ? SheetFace::above : SheetFace::below; }
double slot_height_mm(const SpringBodies& bodies, int slot) {
  const double height_mm = layer_height_mm(bodies, layer_of(slot));
  return face_of(slot) == SheetFace::above ? height_mm : -height_mm;
}

SpringAxis raised(SpringAxis axis, double height_mm) {
  for (SpringAxis::End& end : axis.ends) end.place_mm.z() += height_mm;
  return axis;
}

class SpringColouring {
 public:
  SpringColouring(const Sheet& sheet, const PanelMotion& motion, const SpringBodies& bodies,
                  double end)
      : mechanism_(sheet.mechanism()),
        motion_(motion),
        bodies_(bodies),
        end_(end),
        axes_(spring_axes(mechanism_, sheet.panels(), motion.way(), bodies)),
        outlines_(trimmed_panels(sheet.panels(), motion.way().from_a1_mm(),
                                 kTrimPart * mechanism_.panel_width_mm)),
        slots_(axes_.size(), -1),
        best_layers_(std::numeric_limits<int>::max()) {}

  // A slot for each spring; none where there are no such slots.
  std::vector<int> run() {
    order_.resize(axes_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(order_, std::greater{}, [&](std::size_t k) { return conflicts(k); });
    assign(0, 0);
    return best_;
  }

  const std::vector<SpringAxis>& axes() const { return axes_; }
  bool is_proven() const { return nodes_ < kMostNodes; }

  // The closest two bodies in these slots.
  std::optional<SpringMeeting> closest(const std::vector<int>& slots) const {
    std::optional<SpringMeeting> closest;
    const auto keep = [&](SpringMeeting meeting, SpringWalk walk, double limit_mm) {
      double apart_mm = closest ? limit_mm + closest->clear_mm : kFar_mm, at_x = 0;
      if (!lower_to_least(walk, {0, kSpringTouch_mm}, end_, apart_mm, at_x)) return;
      meeting.apart_mm = apart_mm;
      meeting.clear_mm = apart_mm - limit_mm;
      meeting.pilot_deg = motion_.way().pilot_deg(at_x);
      closest = meeting;
    };
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const SpringAxis axis = in_slot(k, slots[k]);
      for (std::size_t i = 0; i < k; ++i) {
        keep({.spring = axes_[i].diagonal, .other = axis.diagonal},
             SpringWalk(motion_, in_slot(i, slots[i]), axis), bodies_.diameter_mm);
      }
      for (int panel = 0; panel < motion_.panels(); ++panel) {
        keep({.spring = axis.diagonal, .panel = panel},
             SpringWalk(motion_, axis, panel, outlines_[static_cast<std::size_t>(panel)]),
             panel_limit_mm());
      }
    }
    return closest;
  }

 private:
  static constexpr double kFar_mm = 1e9;

  double panel_limit_mm() const { return (bodies_.diameter_mm + bodies_.panel_mm) / 2; }
  SpringAxis in_slot(std::size_t k, int slot) const {
    return raised(axes_[k], slot_height_mm(bodies_, slot));
  }

  bool stays_clear(SpringWalk walk, double limit_mm) const {
    double apart_mm = limit_mm + kSpringTouch_mm, at_x = 0;
    return !lower_to_least(walk, {0, kSpringTouch_mm}, end_, apart_mm, at_x);
  }

  bool share_vertex(std::size_t a, std::size_t b) const {
    const auto ends = [&](std::size_t k) {
      const Diagonal& line = mechanism_.diagonals[static_cast<std::size_t>(axes_[k].diagonal)];
      return std::array{line.from, line.to};
    };
    const std::array<int, 2> others = ends(b);
    return std::ranges::any_of(ends(a),
                               [&](int vertex) { return std::ranges::count(others, vertex) > 0; });
  }

  // Slots of the mid-plane are one height, and one test.
  static int height_key(int slot) { return layer_of(slot) == 0 ? 0 : slot; }

  bool may_have(std::size_t k, int slot) {
    const auto [at, is_new] = alone_.try_emplace({k, height_key(slot)}, true);
    if (!is_new) return at->second;
    const SpringAxis axis = in_slot(k, slot);
    for (int panel = 0; panel < motion_.panels() && at->second; ++panel) {
      at->second =
          stays_clear(SpringWalk(motion_, axis, panel, outlines_[static_cast<std::size_t>(panel)]),
                      panel_limit_mm());
    }
    return at->second;
  }

  bool are_clear(std::size_t a, int slot_a, std::size_t b, int slot_b) {
    if (a > b) return are_clear(b, slot_b, a, slot_a);
    if (slot_a == slot_b && share_vertex(a, b)) return false;
    const auto [at, is_new] =
        pairs_.try_emplace({a, height_key(slot_a), b, height_key(slot_b)}, true);
    if (is_new) {
      at->second = stays_clear(SpringWalk(motion_, in_slot(a, slot_a), in_slot(b, slot_b)),
                               bodies_.diameter_mm);
    }
    return at->second;
  }

  // Number of the springs that one cannot be with on the same face in the mid-plane.
  int conflicts(std::size_t k) {
    int count = 0;
    for (std::size_t i = 0; i < axes_.size(); ++i) count += i != k && !are_clear(i, 0, k, 0);
    return count;
  }

  // Gives the spring at this place of the order each slot in turn.
  void assign(std::size_t place, int layers) {
    if (layers >= best_layers_ || ++nodes_ > kMostNodes) return;
    if (place == order_.size()) {
      best_ = slots_;
      best_layers_ = layers;
      return;
    }
    const std::size_t k = order_[place];
    for (int slot = 0; slot < kSlots; ++slot) {
      if (!may_have(k, slot)) continue;
      bool is_free = true;
      for (std::size_t before = 0; before < place && is_free; ++before) {
        const std::size_t i = order_[before];
        is_free = are_clear(i, slots_[i], k, slot);
      }
      if (!is_free) continue;
      slots_[k] = slot;
      assign(place + 1, layers + layer_of(slot));
    }
  }

  const Mechanism& mechanism_;
  const PanelMotion& motion_;
  const SpringBodies& bodies_;
  const double end_;
  const std::vector<SpringAxis> axes_;
  const std::vector<PolygonCorners> outlines_;
  std::vector<std::size_t> order_;
  std::vector<int> slots_, best_;
  int best_layers_, nodes_ = 0;
  std::map<std::pair<std::size_t, int>, bool> alone_;
  std::map<std::tuple<std::size_t, int, std::size_t, int>, bool> pairs_;
};

// The length between the ends of a spring at x, hooks included.
double length_mm(const PanelMotion& motion, SpringAxis axis, double height_mm, double x) {
  axis.left_out = 0;
  const PolygonCorners ends = raised(axis, height_mm).seen_from_panel(motion, 0, x);
  return (ends.col(0) - ends.col(1)).norm();
}

// Judges the lengths that heights give: their changes, and whether the energy rises from flat.
void judge_lengths(const PanelMotion& motion, const std::vector<SpringAxis>& axes, double end,
                   SpringFaces& faces) {
  const Filling filling = filling_on(motion.way(), faces.bodies.fill);
  Eigen::VectorXd lengths_mm = motion.way().flat_mm();
  double before_n_mm = 0;
  for (int step = 0; step <= kLengthSteps; ++step) {
    const double x = end * step / kLengthSteps;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const double height_mm = faces.springs[k].height_mm;
      const double raised_mm = length_mm(motion, axes[k], height_mm, x);
      const double change_mm = raised_mm - length_mm(motion, axes[k], 0, x);
      faces.length_change_mm = std::max(faces.length_change_mm, std::abs(change_mm));
      lengths_mm(axes[k].diagonal) = raised_mm;
    }
    const double n_mm = filling.energy_n_mm(lengths_mm);
    if (step > 0 && !(n_mm > before_n_mm)) faces.drives = false;
    before_n_mm = n_mm;
  }
}

void find_turns(std::vector<HungSpring>& springs) {
  std::vector<HungSpring*> order;
  for (HungSpring& spring : springs) order.push_back(&spring);
  std::ranges::stable_sort(order, [](const HungSpring* a, const HungSpring* b) {
    const auto key = [](const HungSpring& spring) {
      return std::pair(spring.face == SheetFace::above, spring.layer);
    };
    return key(*a) < key(*b);
  });
  for (std::size_t k = 0; k < order.size(); ++k) order[k]->turn = static_cast<int>(k);
}

}  // namespace

double layer_height_mm(const SpringBodies& bodies, int layer) {
  assert(layer >= 0);
  if (layer == 0) return 0;
  const double on_face_mm = (bodies.panel_mm + bodies.diameter_mm) / 2 + kLayerGap_mm;
  return on_face_mm + (layer - 1) * (bodies.diameter_mm + kLayerGap_mm);
}

StudyResult<SpringFaces> spring_faces(const Sheet& sheet, const SpringBodies& bodies,
                                      double to_deg) {
  if (auto fault = beyond_d(sheet, to_deg)) return *fault;
  const std::optional<PanelMotion> motion = resolved_motion(sheet);
  if (!motion) return NoResult::path_lost;
  const FoldingWay& way = motion->way();
  if (auto fault = nothing_left_of_springs(sheet, bodies, way)) return *fault;
  const double end = std::min(way.x_of(to_deg), motion->resolved_until());
  SpringColouring colouring(sheet, *motion, bodies, end);
  const std::vector<int> slots = colouring.run();
  SpringFaces faces{bodies, way.pilot_deg(end), {}, {}};
  faces.is_proven = colouring.is_proven();
  for (std::size_t k = 0; k < slots.size(); ++k) {
    faces.springs.push_back({colouring.axes()[k].diagonal, face_of(slots[k]), layer_of(slots[k]),
                             slot_height_mm(bodies, slots[k]), 0});
  }
  if (faces.springs.empty()) return faces;
  find_turns(faces.springs);
  faces.closest = colouring.closest(slots);
  judge_lengths(*motion, colouring.axes(), end, faces);
  return faces;
}

}  // namespace misalign::solver
