// A target surface through the vertices of a triangle mesh.
#pragma once

#include "solver/target/target_surface.hpp"

namespace misalign::solver {

/// The smooth surface of a mesh: each vertex has a quadric through it, fitted by least squares to
/// its neighbours and theirs, and between vertices these are blended (a partition of unity; Shepard
/// 1968, Franke and Nielson 1980). Its height is right to O(h^3) at edges of length h and exact for
/// quadrics. It is a height above z = 0: where a sheet lies on it, the mesh must have one height
/// over each place, and be finer than what it shows. Beyond its rim the surface goes straight on.
/// Triangles are indices of vertices; each vertex belongs to one.
std::unique_ptr<TargetSurface> mesh_surface(const Eigen::Matrix3Xd& vertices_mm,
                                            const Eigen::Matrix3Xi& triangles);

}  // namespace misalign::solver
