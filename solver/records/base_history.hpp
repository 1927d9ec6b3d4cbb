// Histories of sheets that fold by their base's own fold angles: station by station in closed form.
#pragma once

#include "solver/records/history.hpp"

namespace misalign::solver {

/// Of a model with spare equations and a sheet of its parallel family; others are undecided, and
/// told by how far their loops are open. The verdict is a BaseJudge's.
FoldingHistory record_on_base(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit = nullptr);

}  // namespace misalign::solver
