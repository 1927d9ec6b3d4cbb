// Points, edges and faces in the plane, and whether they are a sheet: a disk of convex
// quadrilaterals whose inner vertices join four of them, in rows and columns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "schema/pattern/plane_regions.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

inline constexpr std::size_t kMostFaces = 1600;  ///< as many as a 40 x 40 Miura-ori has

/// Faults of a mesh, a few of each kind.
class MeshFaults {
 public:
  static constexpr int kMostOfAKind = 5;  ///< no more are told

  /// `where` names the mesh; may be empty.
  MeshFaults(std::string where, InputFaults& faults) : where_(std::move(where)), faults_(faults) {}

  /// What is added from now on is of another kind.
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
  bool has_faces = true;  ///< false: they follow from the edges, see faces_of_edges
  std::vector<std::array<int, 4>> faces;
};

/// The sheet: the mesh's faces in its order (or in that of their least vertices), then the single
/// quadrilaterals that are missing among them. The median length of the faces' first sides is its
/// panel width. Faults name the vertex, edge or face; nothing after a fault.
std::optional<solver::CreasePattern> fill_sheet(PlaneMesh& mesh, MeshFaults& faults);

}  // namespace misalign::schema
