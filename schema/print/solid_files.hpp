// Writes closed solids for printers.
#pragma once

#include <string>
#include <vector>

#include "schema/print/solid.hpp"

namespace misalign::schema {

/// Binary STL, mm: a header of 80 bytes with the name, then 50 bytes for each triangle.
std::string binary_stl(const Solid& solid);

/// A 3MF package (3D Manufacturing Format, core specification 1.3), mm: an object for each solid,
/// side by side on the bed, their lowest points at z = 0. Its parts are stored, not compressed.
std::string three_mf(const std::vector<Solid>& solids, const std::string& title);

}  // namespace misalign::schema
