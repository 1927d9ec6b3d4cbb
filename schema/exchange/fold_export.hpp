// A pattern and its folding as a FOLD 1.2 object, for Origami Simulator, Rabbit Ear and the like.
#pragma once

#include "schema/exchange/folding_json.hpp"
#include "solver/kinematics/filler.hpp"

namespace misalign::schema {

/// The key frame is the crease pattern: flat 2-D coordinates in mm, holes absent, the edges round
/// them and of the perimeter "B", with the fold angles (degrees, valley positive) of the last
/// of `rows`, the deepest state that is good: what importers that know no frames fold to. A frame
/// for each of `rows` follows, which inherits the mesh and restates coordinates and angles. It
/// carries its pattern (see carried_pattern.hpp), and `data` as `misalign:data`. With fillers (of
/// joining_fillers, for all of `rows`) these are in it too: see filled_mesh.hpp.
Json folded_fold_json(const FoldingView& view, const std::vector<Eigen::Index>& rows,
                      const std::string& title, const Json& data,
                      const std::vector<solver::Filler>& fillers = {});

}  // namespace misalign::schema
