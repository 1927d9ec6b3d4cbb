// The first contact of panels, against a sweep of solved states that looks for crossing panels by
// signs of volumes: every 0.001 degrees within 1 degree of the claim and wherever panels are closer
// than 1 mm, otherwise every 0.1. Also what the claims rest on: how well lines through the nodes'
// rates follow the rates, and how far the way's shapes are off.
//   contacts SHEETS DEPLOYS_FROM_DEG CAMPAIGN...    the campaign's first draws with such a D
#include <fmt/format.h>

#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/models.hpp"
#include "signed_volumes.hpp"
#include "solver/contact/contact_finder.hpp"
#include "solver/linear/held_correction.hpp"

namespace misalign {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kCoarse_deg = 0.1, kFine_deg = 0.001, kNear_deg = 1, kNear_mm = 1;
constexpr double kClaim_deg = 1e-4, kSlack_deg = 1e-6;  // what is claimed, and to how much

// Solved states of one sheet, next to those of its way.
class SolvedShapes {
 public:
  SolvedShapes(const solver::Model& model, const solver::FoldingWay& way)
      : model_(model),
        way_(way),
        lu_(model.elimination()),
        room_(static_cast<std::size_t>(model.mechanism().unknowns)),
        state_(solver::flat_state<double>(model.mechanism())) {}

  const solver::FoldState<double>& state_at(double pilot_deg) {
    if (pilot_deg == solved_deg_) return state_;
    solved_deg_ = pilot_deg;
    way_.find_state(way_.x_of(pilot_deg), state_);
    state_.creases[static_cast<std::size_t>(model_.mechanism().pilot)] =
        solver::half_angle_of_deg(pilot_deg);
    for (int k = 0; k < 2; ++k) {
      solver::correct_held(model_.mechanism(), way_.geometry(), true, lu_, room_, work_, turn_,
                           state_);
    }
    return state_;
  }
  Eigen::Matrix3Xd corners_mm(double pilot_deg) {
    return model_.shape().corners_mm(way_.geometry(), state_at(pilot_deg));
  }

 private:
  const solver::Model& model_;
  const solver::FoldingWay& way_;
  solver::SparseLu<double> lu_;
  std::vector<double> room_, work_ = room_, turn_ = room_;
  solver::FoldState<double> state_;
  double solved_deg_ = -1;
};

struct Sums {
  int sheets = 0, lost = 0, apart = 0, vertex = 0, crease = 0, free = 0;
  int most_stations = 0, more_stations = 0, unresolved = 0, unresolved_to_d = 0;
  int states = 0, false_free = 0, late = 0;
  double rate_ratio = 0, position_mm = 0;
};

class Sweeper {
 public:
  Sweeper(const schema::Campaign& campaign, std::mt19937& random)
      : campaign_(campaign), random_(random), model_(search::model_of(campaign)), solver_(model_) {}

  void look(std::uint64_t draw, double deploys_from_deg) {
    const Eigen::Matrix2Xd shifts_mm = search::shifts_of_draw(campaign_, draw);
    const solver::Sheet sheet(solver_, shifts_mm);
    const auto followed = solver::resolved_motion(sheet);
    ++sums_.sheets;
    sums_.lost += !followed;
    if (!followed) return;
    const solver::PanelMotion& motion = *followed;
    const solver::FoldingWay* way = &motion.way();
    sums_.most_stations = std::max(sums_.most_stations, motion.nodes());
    sums_.more_stations += motion.nodes() > 120;
    sums_.unresolved += motion.resolved_until() < way->end();
    sums_.unresolved_to_d += way->pilot_deg(motion.resolved_until()) < deploys_from_deg - 1e-9;
    const solver::ContactFinder finder(panels_, motion);
    const auto claim = finder.first(motion.resolved_until());
    sums_.free += !claim;
    if (claim) {
      sums_.apart += claim->pair.kind == solver::ContactKind::apart;
      sums_.vertex += claim->pair.kind == solver::ContactKind::vertex;
      sums_.crease += claim->pair.kind == solver::ContactKind::crease;
    }
    measure_rates(sheet, motion);
    SolvedShapes shapes(model_, *way);
    measure_positions(motion, shapes);
    sweep(draw, motion, finder, claim, shapes);
  }

  bool print() const {
    fmt::print(
        "{:<22} {} sheets ({} lost): first contact apart {}, at a vertex {}, at a crease {}, none "
        "{}; with more than 120 stations {} (up to {}), not resolved to the end {}, to D {}; {} "
        "states; false \"free\" {}, later than {} deg {}; rates off by {:.2f} of the second "
        "differences' eighth, positions by {:.1e} mm at most\n",
        campaign_.name, sums_.sheets, sums_.lost, sums_.apart, sums_.vertex, sums_.crease,
        sums_.free, sums_.more_stations, sums_.most_stations, sums_.unresolved,
        sums_.unresolved_to_d, sums_.states, sums_.false_free, kClaim_deg, sums_.late,
        sums_.rate_ratio, sums_.position_mm);
    std::fflush(stdout);
    return sums_.false_free == 0 && sums_.late == 0;
  }

 private:
  // Rates on the way with twice as many stations against lines through the nodes.
  void measure_rates(const solver::Sheet& sheet, const solver::PanelMotion& motion) {
    const solver::FoldingWay* const fine_way = sheet.way(2 * motion.nodes());
    if (!fine_way || std::abs(fine_way->end() - motion.way().end()) > 1e-9) return;
    const solver::PanelMotion fine(model_, *fine_way, panels_);
    const double width_mm = model_.mechanism().panel_width_mm;
    for (int k = 0; k < 300; ++k) {
      const int a = number(motion.panels()), b = number(motion.panels());
      const Vector3d corner = motion.corners_mm(b).col(number(4));
      const auto rate = [&](const solver::PanelMotion& of, int node) {
        const int like = node < 0 ? -1 - node : node;
        const Vector3d r = solver::rate_seen_from(of.at_node(like, a), of.at_node(like, b), corner);
        return node < 0 ? Vector3d(-r.x(), -r.y(), r.z()) : r;
      };
      const int node = number(motion.nodes());  // of the segment before it
      if (motion.way().x_of_station(static_cast<std::size_t>(node)) > motion.resolved_until())
        continue;
      const Vector3d from = rate(motion, node - 1), to = rate(motion, node);
      double curved = (to - 2 * from + rate(motion, node - 2)).norm();
      if (node + 1 < motion.nodes()) {
        curved = std::max(curved, (rate(motion, node + 1) - 2 * to + from).norm());
      }
      // A quarter of the way the error is three quarters of what it is in the middle.
      const Vector3d truth = rate(fine, 2 * node);
      const double error =
          (truth - (0.75 * to + 0.25 * from)).norm() * 4 / 3 - solver::kRateError * width_mm;
      if (error > 0) sums_.rate_ratio = std::max(sums_.rate_ratio, error / (curved / 8));
    }
  }

  void measure_positions(const solver::PanelMotion& motion, SolvedShapes& shapes) {
    for (int k = 0; k < 20; ++k) {
      const double pilot_deg = (0.5 + number(1000)) / 1000 * motion.way().end_deg();
      if (motion.way().end_deg() - pilot_deg < 1e-3) continue;
      if (motion.way().x_of(pilot_deg) > motion.resolved_until()) continue;
      const Eigen::Matrix3Xd corners_mm = shapes.corners_mm(pilot_deg);
      for (int panel = 0; panel < motion.panels(); ++panel) {
        const solver::PanelMotion::Pose pose = motion.pose(motion.way().x_of(pilot_deg), panel);
        Eigen::Matrix3Xd ours_mm =
            (pose.rotation * motion.corners_mm(panel)).colwise() + pose.shift_mm;
        ours_mm.row(2) *= model_.mechanism().side;
        sums_.position_mm =
            std::max(sums_.position_mm,
                     (ours_mm - corners_mm.middleCols(4 * panel, 4)).cwiseAbs().maxCoeff());
      }
    }
  }

  int number(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }

  bool any_cross(SolvedShapes& shapes, double pilot_deg) {
    ++sums_.states;
    const Eigen::Matrix3Xd corners_mm = shapes.corners_mm(pilot_deg);
    for (const solver::HalfAngle<double>& rho : shapes.state_at(pilot_deg).creases) {
      if (rho.c < -1e-12) return true;
    }
    centres_mm_.clear();
    radii_mm_.clear();
    for (Index panel = 0; panel < corners_mm.cols() / 4; ++panel) {
      const auto corners = corners_mm.middleCols<4>(4 * panel);
      centres_mm_.push_back(corners.rowwise().mean());
      radii_mm_.push_back((corners.colwise() - centres_mm_.back()).colwise().norm().maxCoeff());
    }
    for (const solver::PanelPair& pair : pairs_) {
      const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
      if ((centres_mm_[a] - centres_mm_[b]).norm() > radii_mm_[a] + radii_mm_[b]) continue;
      if (cross(pair, corners_mm.middleCols<4>(4 * pair.a), corners_mm.middleCols<4>(4 * pair.b))) {
        return true;
      }
    }
    return false;
  }

  bool cross(const solver::PanelPair& pair, const stress::PanelCorners& a,
             const stress::PanelCorners& b) const {
    if (pair.kind == solver::ContactKind::crease) return false;
    if (pair.kind == solver::ContactKind::apart) return stress::panels_cross(a, b);
    const auto at = [&](int panel) {
      const auto& corners = panels_.corners[static_cast<std::size_t>(panel)];
      return static_cast<int>(std::find(corners.begin(), corners.end(), pair.joint) -
                              corners.begin());
    };
    const int i = at(pair.a), k = at(pair.b);
    return stress::sectors_cross(a.col((i + 1) % 4) - a.col(i), a.col((i + 3) % 4) - a.col(i),
                                 b.col((k + 1) % 4) - b.col(k), b.col((k + 3) % 4) - b.col(k));
  }

  void sweep(std::uint64_t draw, const solver::PanelMotion& motion,
             const solver::ContactFinder& finder, const std::optional<solver::Contact>& claim,
             SolvedShapes& shapes) {
    const solver::FoldingWay& way = motion.way();
    const double end_deg =
        std::min(way.end_deg() - 1e-3,
                 way.pilot_deg(motion.resolved_until()));  // at a fold limit no state is solved
    const double claim_deg = claim ? claim->pilot_deg : end_deg;
    const double free_deg = std::min(claim_deg - kSlack_deg, end_deg);
    for (double from_deg = 0; from_deg < free_deg; from_deg += kCoarse_deg) {
      const double to_deg = std::min(from_deg + kCoarse_deg, free_deg);
      const bool is_near = claim_deg - to_deg < kNear_deg || is_close(finder, way, from_deg) ||
                           is_close(finder, way, to_deg);
      const int steps = is_near ? static_cast<int>(std::round(kCoarse_deg / kFine_deg)) : 1;
      for (int k = 1; k <= steps; ++k) {
        const double pilot_deg = from_deg + (to_deg - from_deg) * k / steps;
        if (!any_cross(shapes, pilot_deg)) continue;
        ++sums_.false_free;
        fmt::print("  draw {}: panels cross at {:.6f} deg; said to be free up to {:.6f}\n", draw,
                   pilot_deg, claim_deg);
        return;
      }
    }
    if (!claim || claim_deg + kClaim_deg > end_deg) return;
    if (any_cross(shapes, claim_deg + kClaim_deg)) return;
    ++sums_.late;
    fmt::print(
        "  draw {}: said to meet at {:.6f} deg (panels {} and {}), but does not cross {} "
        "deg later\n",
        draw, claim_deg, claim->pair.a, claim->pair.b, kClaim_deg);
  }

  static bool is_close(const solver::ContactFinder& finder, const solver::FoldingWay& way,
                       double pilot_deg) {
    const solver::ContactFinder::Clearance clearance = finder.clearance(way.x_of(pilot_deg));
    return clearance.apart_mm < kNear_mm || clearance.vertex_deg < kNear_deg;
  }

  const schema::Campaign& campaign_;
  std::mt19937& random_;
  const solver::Model model_;
  solver::SheetSolver solver_;
  const solver::Panels& panels_ = solver_.panels();
  const std::vector<solver::PanelPair> pairs_ = solver::pairs_of(panels_);
  std::vector<Vector3d> centres_mm_;
  std::vector<double> radii_mm_;
  Sums sums_;
};

bool look_at(schema::Campaign campaign, int sheets, double threshold_deg) {
  search::DrawEvaluator evaluator(campaign);
  std::mt19937 random(1);
  Sweeper sweeper(campaign, random);
  int found = 0;
  for (std::uint64_t lo = 0; found < sheets; lo += evaluator.largest_block()) {
    std::uint64_t draw = lo;
    for (const solver::Verdict& verdict : evaluator.judge({lo, lo + evaluator.largest_block()})) {
      const double deploys_from_deg = verdict.deploys_from_sample * campaign.sample_deg;
      if (found < sheets && deploys_from_deg >= threshold_deg) {
        sweeper.look(draw, deploys_from_deg);
        ++found;
      }
      ++draw;
    }
  }
  return sweeper.print();
}

}  // namespace
}  // namespace misalign

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "contacts SHEETS DEPLOYS_FROM_DEG CAMPAIGN...\n");
    return 2;
  }
  bool good = true;
  for (int k = 3; k < argc; ++k) {
    good = misalign::look_at(misalign::schema::read_campaign_file(argv[k]), std::stoi(argv[1]),
                             std::stod(argv[2])) &&
           good;
  }
  return good ? 0 : 1;
}
