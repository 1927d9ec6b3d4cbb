#include "schema/kit/joint_words.hpp"

#include <fmt/format.h>

#include "solver/pattern/crease_pattern.hpp"
#include "solver/play/joint_play.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::schema {
namespace {

using solver::JointKind;

std::string parts_words(const solver::JointParts& parts) {
  switch (parts.kind) {
    case JointKind::loop:
      return fmt::format("loops of wire of {:g} mm in bores of {:g} mm", parts.wire_mm,
                         parts.bore_mm);
    case JointKind::ball:
      return fmt::format("balls in sockets, with a clearance of {:g} mm", parts.clearance_mm);
    case JointKind::tab:
      break;
  }
  return fmt::format("flexible tabs with a free length of {:g} mm, on bores of {:g} mm",
                     parts.strip_mm, parts.bore_mm);
}

const char* steps(JointKind kind) {
  switch (kind) {
    case JointKind::loop:
      return "Bend the wire through both bores, pull it tight while the sheet is flat, and twist "
             "its "
             "ends. Flat, the bores are farthest apart.";
    case JointKind::ball:
      return "The middle of each ball is the vertex: half way between both panels, at half their "
             "thickness.";
    case JointKind::tab:
      break;
  }
  return "Clamp each tab in both bores so that its free length lies half on either side of the "
         "vertex, at half the thickness of the panels.";
}

solver::JointPlay play_of(const solver::Sheet& sheet, const KitJoints& joints) {
  return solver::joint_play(sheet, joints.parts, solver::rows_of_use(sheet, joints.from_deg));
}

std::string worst_words(const solver::Sheet& sheet, const solver::JointPlay& play) {
  if (play.ball < 0) return "";
  const auto& balls = sheet.mechanism().balls;
  return " (" + solver::vertex_label(balls[static_cast<std::size_t>(play.ball)].vertex) + ")";
}

}  // namespace

std::string joint_words(const solver::Sheet& sheet, const KitOptions& options) {
  if (!options.joints || sheet.mechanism().balls.empty()) return "";
  const solver::JointPlay play = play_of(sheet, *options.joints);
  return fmt::format("ball joints: {}; play {:.3g} mm{}", parts_words(options.joints->parts),
                     play.play_mm, worst_words(sheet, play));
}

std::string joint_section(const solver::Sheet& sheet, const KitOptions& options) {
  if (!options.joints || sheet.mechanism().balls.empty()) return "";
  const solver::JointPlay play = play_of(sheet, *options.joints);
  return fmt::format(
      "<h2>Ball joints</h2>\n<p>{} joints: {}. {}</p>\n<p>Their play is {:.3g} mm{}, the radius of "
      "the ball in which a vertex settles: `misalign card --play {:.3g}` judges it.</p>\n",
      sheet.mechanism().balls.size(), parts_words(options.joints->parts),
      steps(options.joints->parts.kind), play.play_mm, worst_words(sheet, play), play.play_mm);
}

}  // namespace misalign::schema
