// Invariance of the studies of a sheet: they must not depend on where it lies in the plane, how it
// is turned, from which side it is seen or in which unit of length it is given: every number of
// theirs, on a draw of each family.
#include <Eigen/Geometry>
#include <map>

#include "solver/contact/plate_thickness.hpp"
#include "solver/motion/actuation.hpp"
#include "solver/motion/deploy.hpp"
#include "solver/play/backlash.hpp"
#include "solver/records/metrics.hpp"
#include "solver/records/path_record.hpp"
#include "tests/solver/viewed_family.hpp"

namespace misalign::solver {
namespace {

/// Lengths in the unit that the family comes in: a "mm" of the view is 1 / unit of those.
using Numbers = std::map<std::string, double>;

std::string joint_name(int a, int b = -1) {
  return b < 0 ? vertex_label(a) : line_label(std::min(a, b), std::max(a, b));
}

/// All studies of one sheet in one view. Forces stay as they are: so stiffness goes with 1 / unit,
/// masses with 1 / unit, and densities with its fourth power.
class Studies {
 public:
  Studies(const CarriedFamily& family, const View& view, const FlatVertices& shifts_mm)
      : view_(view),
        unit_(std::sqrt(std::abs(view.linear.determinant()))),
        held_corners_(sorted(panels_of(family.base, family.mechanism).corners[5])),
        base_(seen_base(family, view)),
        model_(base_),
        solver_(model_),
        panels_(solver_.panels()),
        sheet_(solver_, view.linear * shifts_mm),
        vertices_mm_(sheet_.vertices_mm()) {
    look_at_path();
    look_at_contact();
    if (view.linear.isDiagonal() && view.linear.determinant() > 0) look_at_backlash();
    const FoldingWay* const way = sheet_.way();
    EXPECT_TRUE(way);
    if (!way) return;
    EnergyModel::Options free = sheet_options();
    look_at_deployment("free", *way, free);
    free.held = HeldPanel{held_panel(), seen(Eigen::Vector3d(1500, -4000, -9000))};
    free.joints = {1e-3, 1e-2 * unit_, 1e-5, 1e-3, 10};
    look_at_deployment("held", *way, free);
  }

  const Numbers& numbers() const { return numbers_; }

 private:
  static std::array<int, 4> sorted(std::array<int, 4> corners) {
    std::ranges::sort(corners);
    return corners;
  }
  void put(const std::string& name, double value) { numbers_[name] = value; }
  Eigen::Vector3d seen(const Eigen::Vector3d& vector) const {
    Eigen::Vector3d seen;
    seen << view_.linear * vector.head<2>(), unit_ * vector.z();
    return seen;
  }
  void put_place(const std::string& name, const Eigen::Vector2d& seen_mm) {
    const Eigen::Vector2d place = view_.linear.inverse() * (seen_mm - view_.offset_mm);
    put(name + " x", place.x());
    put(name + " y", place.y());
  }
  int held_panel() const {
    const auto at = std::ranges::find_if(
        panels_.corners, [&](const auto& corners) { return sorted(corners) == held_corners_; });
    return static_cast<int>(at - panels_.corners.begin());
  }
  EnergyModel::Options sheet_options() const {
    EnergyModel::Options options;
    options.springs().stiffness_n_per_mm /= unit_;
    options.plates = {unit_, 2.7 / std::pow(unit_, 4)};
    return options;
  }

  void look_at_path() {
    const Metrics& metrics = *sheet_.metrics();
    deploys_from_deg_ = metrics.deploys_from_deg;
    put("D", metrics.deploys_from_deg);
    put("fold limit", metrics.fold_limit_deg);
    put("least elongation", metrics.elongation_min);
    put("largest elongation", metrics.elongation_max);
    put("stroke", metrics.stroke_max);
    put("slope", metrics.slope_min_mm_per_deg.value_or(0) / unit_);
    put("slope between", metrics.slope_between_min_mm_per_deg.value_or(0) / unit_);
    put("reverses", metrics.reverses_at_deg.value_or(-1));
    put("stretch", metrics.stretch_sq_mm2 / unit_ / unit_);
    put("singular value", metrics.singular_value_min);
    put("Kawasaki", metrics.kawasaki_defect_deg);
    Actuators springs;
    springs.springs().stiffness_n_per_mm /= unit_;
    const Actuation actuation = actuate(sheet_, springs);
    const auto at_d = static_cast<std::size_t>(sheet_.rows_up_to_d());
    for (const std::size_t row : {at_d / 2, at_d}) {
      const std::string at = " at row " + std::to_string(row);
      put("energy" + at, actuation.energy_n_mm[row] / unit_);
      put("moment" + at, actuation.moment_n_mm[row] / unit_);
      put("advantage" + at, actuation.mechanical_advantage[row]);
    }
    if (actuation.weakest) put("weakest", actuation.weakest->moment_n_mm / unit_);
  }

  void look_at_contact() {
    const auto motion = resolved_motion(sheet_);
    ASSERT_TRUE(motion);
    const ContactFinder finder(panels_, *motion, kTouch_mm * unit_);
    const auto first = finder.first(motion->resolved_until());
    put("contact", first ? first->pilot_deg : -1);
    if (first && first->pair.kind == ContactKind::apart) {
      // Either panel may be the one of smaller number.
      const Eigen::Vector2d both_mm = (first->on_a_mm + first->on_b_mm) / 2;
      put_place("contact", both_mm);
    }
    const double reach_deg =
        first ? std::min(deploys_from_deg_, first->pilot_deg - 1) : deploys_from_deg_;
    const double x = std::min(motion->way().x_of(reach_deg), motion->resolved_until());
    const ContactFinder::Clearance clearance = finder.clearance(x / 2);
    put("apart", clearance.apart_mm / unit_);
    put("vertex", clearance.vertex_deg);
    put("crease", clearance.crease_deg);
    const PlateThickness plates = largest_thickness(panels_, *motion, x, 2 * unit_);
    put("clear", plates.clear_mm / unit_);
    put("taper", plates.taper_mm / unit_);
  }

  // Places where joints have settled are in their panels' frames.
  void look_at_backlash() {
    constexpr BacklashOptions kOptions;
    const BacklashStart sheet = prepare_backlash(model_, vertices_mm_, kOptions);
    if (sheet.own_deg <= kOptions.from_deg) return;
    const Mechanism& mechanism = model_.mechanism();
    std::mt19937 words(kSeed);
    const auto some = [&] {
      const auto entry = [&] { return static_cast<double>(words()) / words.max() - 0.5; };
      return Vec3<double>{entry(), entry(), entry()};
    };
    JointOffsets offsets;
    for (std::size_t k = 0; k < mechanism.creases.size(); ++k) {
      offsets.creases_a.push_back(some());
      offsets.creases_b.push_back(some());
    }
    for (std::size_t k = 0; k < mechanism.balls.size(); ++k) offsets.balls.push_back(some());
    const BacklashTrial trial =
        BacklashFollower(model_, sheet, kOptions).trial(offsets, 2e-4, false);
    put("one way from", trial.one_way_from_deg);
    put("one way to", trial.one_way_to_deg);
    put("one way", trial.moves_one_way());
    put("lost", trial.lost_deg);
  }

  void look_at_deployment(const std::string& name, const FoldingWay& way,
                          const EnergyModel::Options& options) {
    Deployment::Options run;
    run.from_deg = std::min(36.0, deploys_from_deg_);
    const DeploymentStudy study = study_deployment(sheet_, options, run, JointForces::Options{});
    put(name + " mass", study.mass_t * unit_);
    put(name + " outcome", static_cast<double>(study.run.outcome));
    put(name + " time", study.deploy_time_s().value_or(-1));
    put(name + " friction", study.friction.critical_n_mm_per_mm.value_or(-1));
    put(name + " holds from", study.friction.static_stall_deg);
    const EnergyModel sheet(way, model_.shape(), base_, options);
    for (const double share : {0.1, 0.5, 1.0}) {
      const EnergyAt here = sheet.at(way.x_of(share * run.from_deg)), flat = sheet.at(0);
      const std::string at = name + " at " + std::to_string(share);
      put(at + " mass", here.mass / unit_);
      put(at + " potential", (here.potential - flat.potential) / unit_);
      put(at + " friction", here.friction / unit_);
      put(at + " damping", here.damping / unit_);
    }
    for (const double pilot_deg : {run.from_deg, std::floor(run.from_deg / 2), 5.0}) {
      const auto row = std::ranges::min_element(
          study.forces->pilot_deg, {}, [&](double at) { return std::abs(at - pilot_deg); });
      put_forces(name + " " + std::to_string(pilot_deg) + " ", *study.forces,
                 row - study.forces->pilot_deg.begin());
    }
  }

  void put_forces(const std::string& name, const JointForces& forces, Eigen::Index row) {
    put(name + "angle", forces.pilot_deg[static_cast<std::size_t>(row)]);
    const Mechanism& mechanism = model_.mechanism();
    for (std::size_t k = 0; k < mechanism.creases.size(); ++k) {
      const auto column = 3 * static_cast<Eigen::Index>(k);
      const std::string joint = name + joint_name(mechanism.creases[k].a, mechanism.creases[k].b);
      put(joint + " N", forces.crease_force_n.block<1, 3>(row, column).norm());
      put(joint + " N mm", forces.crease_moment_n_mm.block<1, 3>(row, column).norm() / unit_);
    }
    for (std::size_t k = 0; k < mechanism.balls.size(); ++k) {
      const auto column = 3 * static_cast<Eigen::Index>(k);
      put(name + joint_name(mechanism.balls[k].vertex) + " N",
          forces.ball_force_n.block<1, 3>(row, column).norm());
    }
  }

  const View view_;
  const double unit_;
  const std::array<int, 4> held_corners_;
  const PerforatedSheet base_;
  const Model model_;
  SheetSolver solver_;
  const Panels& panels_;
  const Sheet sheet_;
  const FlatVertices& vertices_mm_;
  double deploys_from_deg_ = 0;
  Numbers numbers_;
};

class StudiesInvariance : public testing::TestWithParam<std::string> {
 protected:
  // Of a few draws the one that folds farthest in order.
  static FlatVertices shifts_of(const CarriedFamily& family) {
    const ShiftBlock block = family.draws(30, kSeed);
    const Model sheets(family.base, family.shifted_vertices, {}, 1);
    const auto verdicts = make_batch(available_instruction_sets().back(), sheets)->judge(block);
    const auto best = std::ranges::max_element(verdicts, {}, &Verdict::deploys_from_sample);
    const int draw = static_cast<int>(best - verdicts.begin());
    return family.vertices(block, draw) - family.base.sheet.vertices_mm;
  }

  void expect_unchanged(const View& view) const {
    const Numbers numbers = Studies(family_, view, shifts_mm_).numbers();
    double worst = 0;
    for (const auto& [name, value] : numbers) {
      ASSERT_TRUE(expected_.contains(name)) << name;
      const double expected = expected_.at(name);
      EXPECT_NEAR(value, expected, kSame * std::abs(expected) + kNothing) << name;
      worst = std::max(worst, std::abs(value - expected) / (std::abs(expected) + 1));
    }
    EXPECT_GT(numbers.size(), 200u);
    RecordProperty("worst", std::to_string(worst));
  }

  // Rounding of coordinates a few metres away, through the tables of a way and its integration; of
  // forces in N and moments in N mm what is left where none act.
  static constexpr double kSame = 1e-5, kNothing = 1e-6;

  const CarriedFamily family_{GetParam()};
  const FlatVertices shifts_mm_ = shifts_of(family_);
  const Numbers expected_ = Studies(family_, View(family_), shifts_mm_).numbers();
};

TEST_P(StudiesInvariance, OfPlaceDirectionSideAndUnit) {
  const Eigen::Vector2d away_mm(-3000, 2000);
  View view(family_);
  view.offset_mm = away_mm;
  {
    SCOPED_TRACE("turned");
    view.linear = Eigen::Rotation2Dd(0.5).toRotationMatrix();
    expect_unchanged(view);
  }
  if (kFewer > 1) return;
  {
    SCOPED_TRACE("mirrored");
    view.linear = Eigen::Vector2d(-1, 1).asDiagonal();
    expect_unchanged(view);
  }
  {
    SCOPED_TRACE("moved, in another unit");
    view.linear = 0.1 * Eigen::Matrix2d::Identity();
    expect_unchanged(view);
  }
}

INSTANTIATE_TEST_SUITE_P(Carried, StudiesInvariance, testing::ValuesIn(carried_families()),
                         family_word);

}  // namespace
}  // namespace misalign::solver
