#include "schema/exchange/mjcf_export.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "schema/exchange/xml_text.hpp"
#include "solver/motion/joint_tree.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector3d;

// Consistent units, so that the file needs no factors: stiffness is in N/mm in each.
struct Units {
  const char* words;
  double finer;  // units per mm and per s; its square: units per t

  double force_times_length() const { return finer * finer; }
  double inertia() const { return std::pow(finer, 4); }
};
constexpr Units kUnits[] = {
    {kSimulatedUnits, 1},
    {"units: um, g, ms; forces in mN, energies in mN um (nJ), as the panels are so small", 1e3},
    {"units: nm, ug, us; forces in uN, energies in uN nm (fJ), as the panels are so small", 1e6}};

// MuJoCo refuses moments of inertia below 1e-15 (mjMINVAL), and is accurate a million times above.
constexpr double kLeastInertia = 1e-9;

// The coarsest units in which the moments of inertia of all panels are large enough.
Units units_of(const std::vector<solver::PanelMass>& masses) {
  double least_t_mm2 = INFINITY;
  for (const solver::PanelMass& mass : masses) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(mass.spread, Eigen::EigenvaluesOnly);
    least_t_mm2 = std::min(least_t_mm2, axes.eigenvalues()[0]);
  }
  const auto* const found = std::find_if(
      std::begin(kUnits), std::end(kUnits) - 1,
      [&](const Units& units) { return least_t_mm2 * units.inertia() >= kLeastInertia; });
  return *found;
}

std::string numbers(const Vector3d& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

// Escapes double dashes, which would end a comment.
std::string in_comment(const std::string& text) {
  std::string comment;
  for (const char c : printable(text)) comment += c == '-' && comment.ends_with('-') ? '_' : c;
  return comment;
}

class MjcfWriter {
 public:
  MjcfWriter(const SimulatedSheet& sheet, const MjcfOptions& options)
      : sheet_(sheet),
        options_(options),
        tree_(solver::joint_tree(sheet.mechanism, sheet.panels)),
        masses_(solver::panel_masses(sheet.plates, sheet.panels.corners, sheet.flat_mm)),
        units_(units_of(masses_)),
        children_(sheet.panels.corners.size()) {
    for (const auto& branch : tree_.branches) children_[branch.parent].push_back(&branch);
    for (const solver::Diagonal& diagonal : sheet.mechanism.diagonals) {
      ends_.insert({diagonal.from, diagonal.to});
    }
  }

  std::string text() const {
    return "<mujoco model=\"" + xml_text(sheet_.title) + "\">\n" + head() + settings() + assets() +
           "  <worldbody>\n    <light pos=\"0 0 1000\" dir=\"0 0 -1\" directional=\"true\"/>\n" +
           body(tree_.root, nullptr, "    ") + "  </worldbody>\n" + closures() + springs() +
           sensors() + "</mujoco>\n";
  }

 private:
  std::string head() const;
  std::string settings() const;
  std::string assets() const;
  std::string body(int panel, const solver::JointTree::Branch* branch,
                   const std::string& indent) const;
  std::string joint(const solver::JointTree::Branch& branch) const;
  std::string inertial(int panel) const;
  std::string closures() const;
  std::string springs() const;
  std::string sensors() const;

  std::string panel_name(int panel) const {
    return "panel" + std::to_string(sheet_.panels.facets[panel]);
  }
  std::string crease_name(int crease) const {
    const solver::Crease& fold = sheet_.mechanism.creases[crease];
    return solver::line_label(fold.a, fold.b);
  }
  Vector3d corner(int panel, int i) const {
    return sheet_.start_mm.col(sheet_.panels.corners[panel][i]);
  }
  // A place of the sheet, in the file's units.
  std::string place(const Vector3d& at_mm) const { return numbers(units_.finer * at_mm); }
  double time_step_s() const;
  // Right-handed axes: two of them in the panel.
  Eigen::Matrix3d normal_frame(int panel) const;

  const SimulatedSheet& sheet_;
  const MjcfOptions& options_;
  const solver::JointTree tree_;
  const std::vector<solver::PanelMass> masses_;
  const Units units_;
  std::vector<std::vector<const solver::JointTree::Branch*>> children_;
  std::set<int> ends_;  // vertices at which springs end
};

// The step is at most half of sqrt(m/k) for all panels' mass m and all springs' stiffness k: loops,
// which close in two steps, are then faster than motions by springs.
double MjcfWriter::time_step_s() const {
  double mass_t = 0;
  for (const solver::PanelMass& mass : masses_) mass_t += mass.mass_t;
  const double springs_n_per_mm =
      sheet_.stiffness_n_per_mm * static_cast<double>(sheet_.mechanism.diagonals.size());
  return std::min(options_.time_step_s, 0.5 * std::sqrt(mass_t / springs_n_per_mm));
}

// Maps flat coordinates x and y to the folded sheet.
Eigen::Matrix3d MjcfWriter::normal_frame(int panel) const {
  const auto& corners = sheet_.panels.corners[panel];
  const Eigen::Vector2d flat =
      (sheet_.flat_mm.col(corners[2]) - sheet_.flat_mm.col(corners[0])).normalized();
  const Vector3d along = (corner(panel, 2) - corner(panel, 0)).normalized();
  const Vector3d normal = along.cross(corner(panel, 3) - corner(panel, 1)).normalized();
  const Vector3d across = normal.cross(along);
  Eigen::Matrix3d frame;
  frame << flat.x() * along - flat.y() * across, flat.y() * along + flat.x() * across, normal;
  return frame;
}

std::string MjcfWriter::head() const {
  std::string text = "  <!--\n";
  for (const std::string& line : sheet_.head()) text += "    " + in_comment(line) + "\n";
  text += std::string("    ") + units_.words + "\n";
  text += fmt::format(
      "    A tree of {} hinges and {} ball joints joins the panels; {} `connect` close the loops, "
      "at "
      "points that two panels share.\n"
      "    A hinge that closes a loop has two, one at each end. One of their six equations is "
      "redundant: both panels keep\n"
      "    its length. An end at a vertex that hinges of the tree hold together is left out.\n"
      "    Joint values of hinges are fold angles in rad, valleys positive. Friction acts on "
      "hinges "
      "of the tree: {:.10g} N mm/mm.\n  -->\n",
      std::count(tree_.crease_is_branch.begin(), tree_.crease_is_branch.end(), true),
      tree_.branches.size() -
          static_cast<std::size_t>(
              std::count(tree_.crease_is_branch.begin(), tree_.crease_is_branch.end(), true)),
      tree_.closures.size(), options_.friction_n_mm_per_mm);
  return text;
}

std::string MjcfWriter::settings() const {
  const double time_step = units_.finer * time_step_s();
  const std::string stiff =
      fmt::format("{:.10g} 1", 2 * time_step);  // the least that MuJoCo allows
  return fmt::format(
      "  <compiler angle=\"radian\"/>\n"
      "  <option gravity=\"0 0 0\" timestep=\"{:.10g}\" integrator=\"RK4\" solver=\"Newton\" "
      "tolerance=\"1e-12\">\n    <flag energy=\"enable\" contact=\"disable\"/>\n  </option>\n"
      "  <default>\n    <equality solref=\"{}\" solimp=\"0.9999 0.9999 0.001\"/>\n"
      "    <joint solreffriction=\"{}\" solimpfriction=\"0.9999 0.9999 0.001\"/>\n"
      "    <geom contype=\"0\" conaffinity=\"0\" rgba=\"0.8 0.8 0.85 1\"/>\n  </default>\n",
      time_step, stiff, stiff);
}

// Panels as visible prisms.
std::string MjcfWriter::assets() const {
  std::string text = "  <asset>\n";
  for (int panel = 0; panel < static_cast<int>(masses_.size()); ++panel) {
    const Vector3d up = normal_frame(panel).col(2) * sheet_.plates.thickness_mm / 2;
    text += "    <mesh name=\"" + panel_name(panel) + "\" vertex=\"";
    for (int i = 0; i < 4; ++i) {
      text +=
          (i > 0 ? "  " : "") + place(corner(panel, i) - up) + "  " + place(corner(panel, i) + up);
    }
    text += "\"/>\n";
  }
  return text + "  </asset>\n";
}

// Inertia about principal axes. The third moment of a plate is the sum of the other two, no less.
std::string MjcfWriter::inertial(int panel) const {
  const solver::PanelMass& mass = masses_[panel];
  const Eigen::Matrix3d frame = normal_frame(panel);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(mass.spread);
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  turned.topLeftCorner<2, 2>() = axes.eigenvectors();
  if (turned.determinant() < 0) turned.col(0) *= -1;
  const Eigen::Quaterniond pose(frame * turned);
  const double along = units_.inertia() * axes.eigenvalues()[1],
               across = units_.inertia() * axes.eigenvalues()[0];
  const auto& corners = sheet_.panels.corners[panel];
  Vector3d arm_mm = Vector3d::Zero();
  arm_mm.head<2>() = mass.centre_mm - sheet_.flat_mm.col(corners[0]);
  return fmt::format(
      "<inertial mass=\"{:.17g}\" pos=\"{}\" quat=\"{:.17g} {:.17g} {:.17g} {:.17g}\" "
      "diaginertia=\"{}\"/>\n",
      units_.finer * units_.finer * mass.mass_t, place(corner(panel, 0) + frame * arm_mm), pose.w(),
      pose.x(), pose.y(), pose.z(), numbers({along, across, along + across}));
}

std::string MjcfWriter::joint(const solver::JointTree::Branch& branch) const {
  if (branch.ball) {
    const int vertex = sheet_.mechanism.balls[branch.joint].vertex;
    return fmt::format("<joint name=\"{}\" type=\"ball\" pos=\"{}\"/>\n",
                       solver::vertex_label(vertex), place(sheet_.start_mm.col(vertex)));
  }
  // The right panel is rotated by -rho about the crease from a to b.
  const solver::FoldLine& fold = sheet_.panels.folds[branch.joint];
  const Vector3d way = sheet_.start_mm.col(fold.b) - sheet_.start_mm.col(fold.a);
  const double sense = branch.child == fold.right ? -1 : 1;
  std::string text = fmt::format(
      "<joint name=\"{}\" type=\"hinge\" pos=\"{}\" axis=\"{}\" ref=\"{:.17g}\"",
      crease_name(branch.joint), place(sheet_.start_mm.col(fold.a)),
      numbers(sense * way.normalized()),
      sheet_.fold_angle_deg[static_cast<std::size_t>(branch.joint)] * solver::kRadPerDeg);
  if (options_.friction_n_mm_per_mm > 0) {
    text += fmt::format(" frictionloss=\"{:.17g}\"",
                        units_.force_times_length() * options_.friction_n_mm_per_mm * way.norm());
  }
  return text + "/>\n";
}

std::string MjcfWriter::body(int panel, const solver::JointTree::Branch* branch,
                             const std::string& indent) const {
  const std::string inner = indent + "  ";
  std::string text = indent + "<body name=\"" + panel_name(panel) + "\">\n";
  text += inner + (branch ? joint(*branch) : "<freejoint/>\n");
  text += inner + inertial(panel);
  text += inner + "<geom type=\"mesh\" mesh=\"" + panel_name(panel) + "\"/>\n";
  for (const int v : ends_) {
    if (sheet_.panel_at(v) != panel) continue;
    text += fmt::format("{}<site name=\"{}\" pos=\"{}\" size=\"1\"/>\n", inner,
                        solver::vertex_label(v), place(sheet_.start_mm.col(v)));
  }
  for (const auto* child : children_[panel]) text += body(child->child, child, inner);
  return text + indent + "</body>\n";
}

std::string MjcfWriter::closures() const {
  std::string text = "  <equality>\n";
  for (const auto& point : tree_.closures) {
    text += fmt::format("    <connect body1=\"{}\" body2=\"{}\" anchor=\"{}\"/>\n",
                        panel_name(point.one), panel_name(point.other),
                        place(sheet_.start_mm.col(point.vertex)));
  }
  return text + "  </equality>\n";
}

std::string MjcfWriter::springs() const {
  std::string text = "  <tendon>\n";
  for (const solver::Diagonal& diagonal : sheet_.mechanism.diagonals) {
    const std::string from = solver::vertex_label(diagonal.from),
                      to = solver::vertex_label(diagonal.to);
    text += fmt::format(
        "    <spatial name=\"{}-{}\" stiffness=\"{:.17g}\" springlength=\"{:.17g}\">"
        "<site site=\"{}\"/><site site=\"{}\"/></spatial>\n",
        from, to, sheet_.stiffness_n_per_mm, units_.finer * sheet_.relaxed_mm(diagonal), from, to);
  }
  return text + "  </tendon>\n";
}

std::string MjcfWriter::sensors() const {
  const std::string pilot = crease_name(sheet_.mechanism.pilot);
  return "  <sensor>\n    <jointpos name=\"pilot\" joint=\"" + pilot +
         "\"/>\n    <jointvel name=\"pilot_rate\" joint=\"" + pilot + "\"/>\n  </sensor>\n";
}

}  // namespace

std::string mjcf_model(const SimulatedSheet& sheet, const MjcfOptions& options) {
  return MjcfWriter(sheet, options).text();
}

}  // namespace misalign::schema
