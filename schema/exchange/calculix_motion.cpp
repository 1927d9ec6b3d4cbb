#include "schema/exchange/calculix_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "schema/exchange/calculix_result.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::schema {

using Eigen::Vector3d;

MotionReader::MotionReader(const SimulatedSheet& sheet, const PanelMesh& mesh)
    : sheet_(sheet),
      mesh_(mesh),
      corners_mm_(3, 4 * static_cast<Eigen::Index>(sheet.panels.corners.size())) {
  Eigen::Index corner = 0;
  for (const auto& corners : sheet.panels.corners) {
    for (const int v : corners) corners_mm_.col(corner++) = sheet.start_mm.col(v);
  }
  add_row();
}

void MotionReader::feed(const std::string& text) {
  rest_ += text;
  std::size_t begin = 0;
  for (std::size_t end; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    see_line(rest_.substr(begin, end - begin));
  }
  rest_.erase(0, begin);
}

void MotionReader::see_line(const std::string& line) {
  const std::size_t time = line.find("and time");
  if (time != std::string::npos) {
    const double time_s = fortran_number(line.substr(time + 8));
    const bool has_corners = line.find("displacements") != std::string::npos;
    if (has_corners) row_ = {time_s, 0, 0, 0, 0, 0};
    block_ = has_corners                                         ? Block::corners
             : line.find("internal energy") != std::string::npos ? Block::strain
             : line.find("kinetic energy") != std::string::npos  ? Block::kinetic
                                                                 : Block::none;
  } else if (line.find_first_not_of(' ') == std::string::npos) {
    return;
  } else if (block_ == Block::corners) {
    see_corner(line);
  } else if (block_ == Block::strain) {
    row_.strain_n_mm = fortran_number(line);
  } else if (block_ == Block::kinetic) {
    row_.kinetic_n_mm = fortran_number(line);
    add_row();
    block_ = Block::none;
  }
}

void MotionReader::see_corner(const std::string& line) {
  const int node = fortran_whole(line, 0, 10), panel = mesh_.panel_of_node(node);
  if (panel < 0 || panel >= static_cast<int>(sheet_.panels.corners.size())) return;
  for (int i = 0; i < 4; ++i) {
    if (mesh_.corner_node(panel, i) != node) continue;
    const Vector3d moved(fortran_column(line, 10, 14), fortran_column(line, 24, 14),
                         fortran_column(line, 38, 14));
    corners_mm_.col(4 * panel + i) =
        sheet_.start_mm.col(sheet_.panels.corners[static_cast<std::size_t>(panel)][i]) + moved;
  }
}

Vector3d MotionReader::normal(int panel) const {
  const Eigen::Index first = 4 * panel;
  const Vector3d diagonal = corners_mm_.col(first + 2) - corners_mm_.col(first),
                 other = corners_mm_.col(first + 3) - corners_mm_.col(first + 1);
  return diagonal.cross(other).normalized();
}

// The right panel is rotated by -rho about the crease from a to b.
double MotionReader::fold_angle_deg(const solver::FoldLine& fold) const {
  const auto& corners = sheet_.panels.corners[static_cast<std::size_t>(fold.left)];
  const auto place = [&](int vertex) -> Vector3d {
    const auto at = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
    return corners_mm_.col(4 * fold.left + at);
  };
  const Vector3d left = normal(fold.left), right = normal(fold.right);
  const Vector3d way = (place(fold.b) - place(fold.a)).normalized();
  return std::atan2(-left.cross(right).dot(way), left.dot(right)) / solver::kRadPerDeg;
}

void MotionReader::add_row() {
  const auto& folds = sheet_.panels.folds;
  const auto pilot = static_cast<std::size_t>(sheet_.mechanism.pilot);
  // The pilot angle is positive at the start, as everywhere.
  row_.pilot_deg = fold_angle_deg(folds[pilot]) * folds[pilot].sign;
  for (const solver::FoldLine& fold : folds) {
    row_.widest_deg = std::max(row_.widest_deg, std::abs(fold_angle_deg(fold)));
  }
  const auto place = [&](int vertex) -> Vector3d {
    const int panel = sheet_.panel_at(vertex);
    const auto& corners = sheet_.panels.corners[static_cast<std::size_t>(panel)];
    return corners_mm_.col(4 * panel +
                           (std::find(corners.begin(), corners.end(), vertex) - corners.begin()));
  };
  for (const solver::Diagonal& diagonal : sheet_.mechanism.diagonals) {
    const double pulled_mm =
        (place(diagonal.from) - place(diagonal.to)).norm() - sheet_.relaxed_mm(diagonal);
    row_.springs_n_mm += sheet_.stiffness_n_per_mm / 2 * pulled_mm * pulled_mm;
  }
  const bool is_later = rows_.empty() || row_.time_s >= rows_.back().time_s;
  const bool is_good = is_later && is_result(corners_mm_.cwiseAbs().sum()) &&
                       is_result(row_.time_s) && is_result(row_.pilot_deg) &&
                       is_result(row_.springs_n_mm) && is_result(row_.strain_n_mm) &&
                       is_result(row_.kinetic_n_mm);
  is_sound_ = is_sound_ && is_good;
  if (is_sound_) rows_.push_back(row_);
}

}  // namespace misalign::schema
