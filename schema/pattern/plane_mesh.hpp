// Checks that points, edges and faces in the plane form a sheet: a disk of convex quadrilaterals,
// four at each inner vertex, in rows and columns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "schema/pattern/plane_regions.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

inline constexpr std::size_t kMostFaces = 6400;  ///< faces of an 80 x 80 Miura-ori

/// Faults of a mesh, a few of each kind.
class MeshFaults {
 public:
  static constexpr int kMostOfAKind = 5;  ///< largest number of listed faults

  /// Collects faults; `where` names the mesh, or is empty.
  MeshFaults(std::string where, InputFaults& faults) : where_(std::move(where)), faults_(faults) {}

  /// Begins another kind of faults.
  void next_kind() { told_ = 0; }
  bool any() const { return told_ > 0; }
  void add(const std::string& problem, const std::string& why, const std::string& suggestion);

 private:
  const std::string where_;
  InputFaults& faults_;
  int told_ = 0;
};

/// A mesh as a file lists it.
struct PlaneMesh {
  PlanePoints points_mm;
  PlaneEdges edges;
  bool has_faces = true;  ///< false: faces follow from the edges, see faces_of_edges
  std::vector<std::array<int, 4>> faces;
};

/// Returns the sheet: the mesh's faces in its order (or in that of their least vertices), then the
/// single missing quadrilaterals. Its panel width is the median length of the faces' first sides.
/// Faults name the vertex, edge or face; none after a fault.
std::optional<solver::CreasePattern> fill_sheet(PlaneMesh& mesh, MeshFaults& faults);

}  // namespace misalign::schema
