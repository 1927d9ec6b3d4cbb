#include "schema/kit/joint_words.hpp"

#include <fmt/format.h>

#include "solver/pattern/crease_pattern.hpp"
#include "solver/play/joint_play.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::schema {

using solver::JointKind;

std::string joint_words(const solver::JointParts& parts) {
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

const char* joint_steps(JointKind kind) {
  switch (kind) {
    case JointKind::loop:
      return "Bend the wire through both bores, pull it tight while the sheet is flat, and twist "
             "its ends. Flat, the bores are farthest apart.";
    case JointKind::ball:
      return "The middle of each ball is the vertex: half way between both panels, in the plane of "
             "the hinges' axes.";
    case JointKind::tab:
      break;
  }
  return "Rivet each strip of NAME-kit-strips through its bores to both panels, and clamp it up to "
         "its two lines: its free length lies half on either side of the vertex, in the plane of "
         "the hinges' axes.";
}

std::string joint_section(const solver::Sheet& sheet, const KitOptions& options) {
  const auto& balls = sheet.mechanism().balls;
  if (!options.joints || balls.empty()) return "";
  const solver::JointPlay play =
      solver::joint_play(sheet, *options.joints, solver::rows_of_use(sheet, options.from_deg));
  std::string worst;
  if (play.ball >= 0) {
    worst = " (" + solver::vertex_label(balls[static_cast<std::size_t>(play.ball)].vertex) + ")";
  }
  return fmt::format(
      "<h2>Ball joints</h2>\n<p>{} joints: {}. {}</p>\n<p>Their play is {:.3g} mm{}, the radius of "
      "the ball in which a vertex settles: `misalign card --play {:.3g}` judges it.</p>\n",
      balls.size(), joint_words(*options.joints), joint_steps(options.joints->kind), play.play_mm,
      worst, play.play_mm);
}

}  // namespace misalign::schema
