// Reads CalculiX's results of a deck (calculix_deck.hpp): the motion of the panels' corners,
// energies, and stresses.
#pragma once

#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "schema/exchange/panel_mesh.hpp"
#include "schema/exchange/simulated_sheet.hpp"

namespace misalign::schema {

/// What is larger, or no number at all, is no result: ccx has lost its way there.
inline constexpr double kLargestResult = 1e30;

/// The start, or one increment. A crease's fold angle is the one between its panels' normals, each
/// the cross product of the panel's diagonals: panels bend.
struct ElasticRow {
  double time_s = 0;
  double pilot_deg = 0;
  double widest_deg = 0;  ///< of all creases, the farthest from flat
  double springs_n_mm = 0, strain_n_mm = 0, kinetic_n_mm = 0;
};

/// Reads the .dat file as it grows.
class MotionReader {
 public:
  MotionReader(const SimulatedSheet& sheet, const PanelMesh& mesh);

  /// What came since; the last line may be a part of one.
  void feed(const std::string& text);
  /// The first is the start; the last is before the first one that is no result.
  const std::vector<ElasticRow>& rows() const { return rows_; }
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
  ElasticRow row_;
  Eigen::Matrix3Xd corners_mm_;  // of each panel its four
  std::vector<ElasticRow> rows_;
  bool is_sound_ = true;  // no increment was none
};

/// Von Mises stress at a node, and where that is on the flat sheet.
struct StressAt {
  double stress_mpa = 0, time_s = 0;
  int panel = -1;
  Eigen::Vector2d flat_mm = Eigen::Vector2d::Zero();
};

struct StressHistory {
  bool is_sound = true;  ///< if not, it ends before the first frame that is no result
  /// Of each time that was written: the largest outside the discs, and anywhere.
  std::vector<double> time_s, outside_mpa, anywhere_mpa;
  std::optional<StressAt> outside, anywhere;  ///< the largest of all times
  std::vector<double> panel_outside_mpa;      ///< the same of each panel; 0 where nothing is
};

struct StressOptions {
  /// Radius of the discs round the corners of each panel: forces that act at a point have no limit
  /// there as meshes get finer. A tenth of the paper's panels.
  double disc_mm = 8;
  double until_s = std::numeric_limits<double>::infinity();  ///< later frames do not count
};

/// Reads a .frd file; its last frame may be cut off, and then does not count. UserError (1) if the
/// file is not what ccx writes of such a deck.
StressHistory read_stresses(std::istream& file, const std::string& name,
                            const SimulatedSheet& sheet, const PanelMesh& mesh,
                            const StressOptions& options);

}  // namespace misalign::schema
