#include "solver/certificate/certifier.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/certificate/conditions.hpp"
#include "solver/certificate/energy_slope.hpp"
#include "solver/certificate/panel_proof.hpp"
#include "solver/records/record_sheet.hpp"

namespace misalign::solver {
namespace {

/// Largest radius of a box, on intervals of a degree or more; on shorter ones in proportion.
constexpr double kLargestBox = 2e-5;
constexpr double kShorterInterval = 0.5;
constexpr double kFirstInterval_deg = 12, kLeastFirst_deg = 0.05;
constexpr double kSqrt2 = 1.41421356;
/// Largest angle of graded coordinates.
constexpr double kGradedUntil_deg = 62;
/// Least length of an interval.
constexpr double kShortest_deg = 2e-6;
/// Bound of the number of intervals, which ends marches of hours; no sheet is known to need more
/// than 120.
constexpr std::size_t kMostIntervals = 10000;
/// Tries of an interval; from kManyTries on each is at most half as long as the one before. That
/// takes 27 more from 180 degrees to kShortest_deg, and 6 from the closing interval on.
constexpr int kManyTries = 40, kMostTries = kManyTries + 27 + 6 + 2;
/// Length of a closing interval, below kClosing_deg in spite of rounded angles.
constexpr double kClosingInterval_deg = 0.9 * kClosing_deg;

}  // namespace

struct Certifier::Workspace {
  Workspace(const Model& m, bool proves_contact, const std::optional<Fill>& its_fill)
      : model(m),
        panels(panels_of(m.base(), m.mechanism())),
        proof(m.shape(), panels),
        contact(proves_contact),
        fill(its_fill) {}

  const Model& model;
  const Panels panels;
  const PanelProof proof;
  const bool contact;
  const std::optional<Fill> fill;
};

namespace {

// Makes one sheet's certificate.
class TubeContinuation {
 public:
  /// `panels` proves that none meet; null: not requested. `fill`: its energy rises, or `visit` sees
  /// it; none: every diagonal is monotone.
  TubeContinuation(const Model& model, const PanelProof* panels, const std::optional<Fill>& fill,
                   const FlatVertices& vertices_mm, double asked_deg, const EnergyVisitor& visit)
      : model_(model),
        mechanism_(model.mechanism()),
        panels_(panels),
        visit_(visit),
        vertices_mm_(vertices_mm),
        prover_(mechanism_, vertices_mm) {
    certificate_.asked_deg = asked_deg;
    certificate_.contact = panels != nullptr;
    if (!fill) return;
    certificate_.criterion = CertifiedBy::energy;
    energy_.emplace(mechanism_, *fill, prover_.flat_diagonals());
  }

  Certificate run() {
    if (!begin()) return certificate_;
    while (at_deg() < certificate_.asked_deg && certificate_.intervals.size() < kMostIntervals) {
      if (!go_on()) return certificate_;
    }
    certificate_.end = at_deg() < certificate_.asked_deg ? CertificateEnd::unclear_slope
                                                         : CertificateEnd::to_the_end;
    return certificate_;
  }

 private:
  double at_deg() const { return certificate_.certified_deg(); }
  // Largest end of the next interval.
  double farthest_deg() const {
    const bool graded = at_deg() < kGradedUntil_deg;
    return graded ? std::min(kGradedUntil_deg, certificate_.asked_deg) : certificate_.asked_deg;
  }

  // Proves the first interval, from flat on.
  bool begin() {
    for (double to = std::min(kFirstInterval_deg, certificate_.asked_deg); to >= kLeastFirst_deg;
         to *= kShorterInterval) {
      const HalfAngle<double> end = half_angle_of_deg(to);
      const HalfAngle<double> middle = half_angle_of_ratio(std::sqrt(0.5) * end.s, end.c);
      if (begin_with(to, base_state(mechanism_, model_.base().folding,
                                    model_.base().sheet.vertices_mm, middle))) {
        return true;
      }
    }
    return certificate_.end != CertificateEnd::unclear_slope && begin_elsewhere();
  }

  // Begins with states of a followed path, where the base is too far from this sheet's way.
  bool begin_elsewhere() {
    std::vector<std::pair<double, FoldState<double>>> states;
    const StationVisitor keep = [&](const Station& station, const PathPoint& point) {
      if (station.pilot_deg < kFirstInterval_deg) {
        states.emplace_back(station.pilot_deg, point.state);
      }
    };
    record_history(model_, vertices_mm_, &keep);
    for (std::size_t k = states.size(); k-- > 0;) {
      // The state is in the middle by tau^2, which is nearly proportional to the angle squared.
      const double to = kSqrt2 * states[k].first;
      if (to <= certificate_.asked_deg && begin_with(to, states[k].second)) return true;
    }
    return false;
  }

  // Begins with a state near that in the middle. Sets the diagonals' directions.
  bool begin_with(double to_deg, FoldState<double> middle) {
    assert(to_deg > 0 && to_deg <= certificate_.asked_deg);
    PathTube tube;
    const PathInterval interval{0, to_deg, true, 0, std::move(middle)};
    if (prover_.prove(interval, kLargestBox, tube) != TubeProver::End::proven) return false;
    set_directions(prover_.find_diagonals(tube).slopes);
    const Obstacle first = first_obstacle(tube, 1e-3);
    if (first.until < 1) {
      // The branch is proven: a diagonal stands still, unless a shorter interval shows otherwise.
      if (first.kind == CertificateEnd::reversal) {
        certificate_.end = CertificateEnd::unclear_slope;
        certificate_.where = first.where;
      }
      return false;
    }
    certificate_.where = -1;
    if (!is_visited(tube)) {
      certificate_.end = CertificateEnd::unclear_slope;
      return false;
    }
    accept(std::move(tube));
    begin_next(to_deg * std::min(1.0, prover_.better_length()));
    return true;
  }

  // Returns false where the visitor of the energy needs a shorter interval.
  bool is_visited(const PathTube& tube) {
    is_refused_ = visit_ && !visit_(tube, energy_->along(tube, prover_.find_diagonals(tube)));
    return !is_refused_;
  }

  // Sets the directions in which diagonals start; energies rise, unless they are visited.
  void set_directions(const std::vector<PathModel>& slopes) {
    if (!visit_) directions_ = {1};
    if (energy_) return energy_->begin(slopes);
    directions_.clear();
    for (const PathModel& slope : slopes) {
      directions_.push_back(value_at(slope, Ball(-1.0)).c[0] > 0 ? 1 : -1);
    }
  }

  // The slopes that must keep their signs: each diagonal's, or the energy's, unless it is visited.
  std::vector<PathModel> driving_slopes(const PathTube& tube) const {
    if (visit_) return {};
    DiagonalsAlong diagonals = prover_.find_diagonals(tube);
    if (energy_) return {energy_->along(tube, diagonals).slope};
    return std::move(diagonals.slopes);
  }

  // Begins a new interval at the end of the last one.
  void begin_next(double width_deg) {
    width_deg_ = width_deg;
    tries_ = 0;
    may_widen_ = true;
  }
  // Tries a shorter interval from there, after kManyTries at most half as long. There are at most
  // kMostTries tries, since an interval below kShortest_deg ends the march.
  void shorten(double tried_deg, double width_deg) {
    width_deg_ =
        tries_ < kManyTries ? width_deg : std::min(width_deg, kShorterInterval * tried_deg);
    assert(width_deg_ < tried_deg);
  }

  PathInterval interval_to(double to_deg) const {
    PathInterval interval{at_deg(), to_deg, to_deg <= kGradedUntil_deg, 0, {}};
    const double middle = 0.5 * (at_deg() + to_deg);
    interval.middle = predict(middle);
    return interval;
  }

  // Extrapolates the last interval's path, without its higher powers.
  FoldState<double> predict(double pilot_deg) const {
    const Ball place = last_.chart.place_of(pilot_deg);
    const double s = place.c[0];
    std::vector<double> x(mechanism_.unknowns, 0.0);
    for (int j = 0; j < mechanism_.equations; ++j) {
      x[j] = guess_at(last_.path[j], s, s < 2 ? kPathDegree : 3);
    }
    return last_.chart.state_at(x.data(), s);
  }

  // Tries once: adds an interval, sets a width for the next try, or ends.
  bool go_on() {
    const double to = std::min(at_deg() + width_deg_, farthest_deg());
    if (to - at_deg() < std::min(kShortest_deg, farthest_deg() - at_deg())) {
      certificate_.end = is_refused_ ? CertificateEnd::unclear_slope : CertificateEnd::fold_limit;
      return false;
    }
    ++tries_;
    assert(tries_ <= kMostTries);
    is_refused_ = false;
    PathTube tube;
    const double width = to - at_deg();
    assert(width > 0);
    const TubeProver::End end =
        prover_.prove(interval_to(to), kLargestBox * std::clamp(width, 0.01, 1.0), tube);
    if (end == TubeProver::End::proven && join(last_, tube)) return consider(std::move(tube));
    shorten(width,
            width * (end == TubeProver::End::proven ? kShorterInterval
                                                    : std::min(0.8, prover_.better_length())));
    return true;
  }

  // The first obstacle, and the s up to which there is none.
  struct Obstacle {
    double until = 1;
    CertificateEnd kind = CertificateEnd::to_the_end;
    int where = -1;
    bool happens = false;  // true: it certainly happens by the end of the interval
  };
  Obstacle first_obstacle(const PathTube& tube, double resolution) const {
    Obstacle first;
    for (const Condition& condition :
         conditions_of(mechanism_, tube, driving_slopes(tube), directions_)) {
      const double s = positive_until(condition.value, resolution);
      if (s >= first.until) continue;
      first = {s, condition.broken, condition.where, is_negative_at_end(condition.value)};
    }
    if (energy_ && first.kind == CertificateEnd::reversal) first.where = -1;
    if (panels_ == nullptr) return first;
    const PanelProof::Apart apart = panels_->prove(prover_, tube, resolution);
    if (apart.until < first.until) {
      first = {apart.until, CertificateEnd::contact, apart.pair, false};
    }
    return first;
  }

  // Accepts a proven interval, or has a shorter one tried, or ends the certificate.
  bool consider(PathTube tube) {
    const double from = at_deg(), width = tube.chart.interval().to_deg - from;
    assert(width > 0 && tube.chart.interval().to_deg <= certificate_.asked_deg);
    const double resolution = std::min(0.01, 0.02 * kClosing_deg / width);
    const Obstacle first = first_obstacle(tube, resolution);
    if (first.until == 1) {
      if (!is_visited(tube)) return shorten(width, kShorterInterval * width), true;
      accept(std::move(tube));
      begin_next(width * prover_.better_length());
      return true;
    }
    if (width <= kClosing_deg && first.happens) {
      certificate_.end = first.kind;
      certificate_.where = first.where;
      certificate_.closing = kept(tube);
      return false;
    }
    const double good_deg = first.until > -1 ? tube.chart.angle_deg_until(first.until) : from;
    if (good_deg - from > 0.1 * kClosing_deg) {
      shorten(width, good_deg - from - 0.02 * kClosing_deg);
      return true;
    }
    // Rates of change are better known on a shorter interval.
    if (width > kClosing_deg) {
      shorten(width, std::max(kShorterInterval * width, kClosingInterval_deg));
      return true;
    }
    // The obstacle may need all of the closing interval to happen. It is tried once, since next to
    // a fold limit there may be no such interval.
    if (may_widen_ && width < 0.8 * kClosing_deg && from + width < farthest_deg()) {
      may_widen_ = false;
      width_deg_ = kClosingInterval_deg;
      return true;
    }
    const bool is_contact = first.kind == CertificateEnd::contact;
    certificate_.end = is_contact ? first.kind : CertificateEnd::unclear_slope;
    const bool is_crease = !is_contact && first.kind != CertificateEnd::reversal;
    certificate_.where = is_crease ? -1 : first.where;
    return false;
  }

  PathInterval kept(const PathTube& tube) const {
    PathInterval interval = tube.chart.interval();
    interval.middle = tube.chart.middle();
    interval.box = tube.isolation();
    return interval;
  }

  void accept(PathTube tube) {
    assert(tube.chart.interval().from_deg == at_deg() && tube.chart.interval().to_deg > at_deg());
    certificate_.intervals.push_back(kept(tube));
    last_ = std::move(tube);
  }

  const Model& model_;
  const Mechanism& mechanism_;
  const PanelProof* panels_;
  const EnergyVisitor& visit_;
  const FlatVertices& vertices_mm_;
  TubeProver prover_;
  std::optional<EnergySlope> energy_;  // none: each diagonal
  Certificate certificate_;
  PathTube last_;
  std::vector<int> directions_;
  double width_deg_ = 0;  // width of the next try
  // Tries since the last interval; true while one may still be longer than the one before.
  int tries_ = 0;
  bool may_widen_ = true;
  bool is_refused_ = false;  // true where the visitor has refused the last try
};

}  // namespace

Certifier::Certifier(const Model& model, bool contact, const std::optional<Fill>& fill)
    : workspace_(new Workspace(model, contact, fill)) {}
Certifier::~Certifier() = default;

Certificate Certifier::certify(const FlatVertices& vertices_mm, double asked_deg,
                               const EnergyVisitor& visit) {
  assert(!visit || workspace_->fill);
  assert(vertices_mm.cols() == workspace_->model.mechanism().vertices);
  assert(asked_deg >= 0 && asked_deg <= 180);
  if (!rounds_as_proven()) {
    Certificate nothing;
    nothing.asked_deg = asked_deg;
    nothing.criterion = workspace_->fill ? CertifiedBy::energy : CertifiedBy::diagonals;
    return nothing;
  }
  return TubeContinuation(workspace_->model, workspace_->contact ? &workspace_->proof : nullptr,
                          workspace_->fill, vertices_mm, asked_deg, visit)
      .run();
}

}  // namespace misalign::solver
