// Reads the motion of the panels' corners and the energies from CalculiX's results
// (calculix_deck.hpp).
#pragma once

#include <string>
#include <vector>

#include "schema/exchange/panel_mesh.hpp"
#include "schema/exchange/simulated_sheet.hpp"
#include "solver/motion/stress.hpp"

namespace misalign::schema {

/// Reads the .dat file as it grows.
class MotionReader {
 public:
  MotionReader(const SimulatedSheet& sheet, const PanelMesh& mesh);

  /// Reads the text since the last call, whose last line may be incomplete.
  void feed(const std::string& text);
  /// Rows from the start to the last before an increment that is no result.
  const std::vector<solver::StressStudy::Row>& rows() const { return rows_; }
  bool is_sound() const { return is_sound_; }

 private:
  enum class Block { none, corners, strain, kinetic };

  void see_line(const std::string& line);
  void see_corner(const std::string& line);
  void add_row();
  double fold_angle_deg(const solver::FoldLine& fold) const;
  Eigen::Vector3d normal(int panel) const;

  const SimulatedSheet& sheet_;
  const PanelMesh mesh_;
  std::string rest_;  // an incomplete line
  Block block_ = Block::none;
  solver::StressStudy::Row row_;
  Eigen::Matrix3Xd corners_mm_;  // four for each panel
  std::vector<solver::StressStudy::Row> rows_;
  bool is_sound_ = true;  // false after an increment that is no result
};

}  // namespace misalign::schema
