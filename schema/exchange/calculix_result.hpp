// Reads CalculiX's results of a deck (calculix_deck.hpp): the motion of the panels' corners,
// energies, and stresses.
#pragma once

#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

#include "schema/exchange/panel_mesh.hpp"
#include "schema/exchange/simulated_sheet.hpp"
#include "solver/motion/stress.hpp"

namespace misalign::schema {

/// What is larger, or no number at all, is no result: ccx has lost its way there.
inline constexpr double kLargestResult = 1e30;

/// Reads the .dat file as it grows.
class MotionReader {
 public:
  MotionReader(const SimulatedSheet& sheet, const PanelMesh& mesh);

  /// What came since; the last line may be a part of one.
  void feed(const std::string& text);
  /// The first is the start; the last is before the first one that is no result.
  const std::vector<solver::ElasticRow>& rows() const { return rows_; }
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
  std::string rest_;  // of a line that is not whole yet
  Block block_ = Block::none;
  solver::ElasticRow row_;
  Eigen::Matrix3Xd corners_mm_;  // of each panel its four
  std::vector<solver::ElasticRow> rows_;
  bool is_sound_ = true;  // no increment was none
};

struct StressOptions {
  /// Radius of the discs round the corners of each panel: forces that act at a point have no limit
  /// there as meshes get finer. A tenth of the paper's panels.
  double disc_mm = 8;
  double until_s = std::numeric_limits<double>::infinity();  ///< later frames do not count
};

/// Reads a .frd file; its last frame may be cut off, and then does not count. UserError (failure)
/// if the file is not what ccx writes of such a deck.
solver::StressHistory read_stresses(std::istream& file, const std::string& name,
                                    const SimulatedSheet& sheet, const PanelMesh& mesh,
                                    const StressOptions& options);

}  // namespace misalign::schema
