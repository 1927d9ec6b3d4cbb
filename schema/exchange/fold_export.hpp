// Writes a pattern and its folding as a FOLD 1.2 object, for Origami Simulator, Rabbit Ear and
// others.
#pragma once

#include "schema/exchange/folding_json.hpp"
#include "solver/kinematics/filler.hpp"

namespace misalign::schema {

/// The key frame is the crease pattern: flat 2-D coordinates in mm, holes absent, the edges round
/// them and of the perimeter "B", with the fold angles (degrees, valley positive) of the last
/// of `rows`, the deepest good state, to which importers without frames fold. A frame for each of
/// `rows` follows, which inherits the mesh and restates coordinates and angles. The object carries
/// its pattern (see carried_pattern.hpp), `data` as `misalign:data`, and `fillers` (of
/// joining_fillers, for all of `rows`): see filled_mesh.hpp.
Json folded_fold_json(const FoldingView& view, const std::vector<Eigen::Index>& rows,
                      const std::string& title, const Json& data,
                      const std::vector<solver::Filler>& fillers = {});

}  // namespace misalign::schema
