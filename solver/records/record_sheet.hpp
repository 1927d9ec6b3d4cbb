// Records the path of a single sheet.
#pragma once

#include "solver/records/history.hpp"

namespace misalign::solver {

/// Follows the path of the sheet with these vertices to the model's end or the fold limit, beyond
/// faults. If PivotedFallback follows it again, `visit` sees it again from the first station.
FoldingHistory record_history(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit = nullptr);

/// Records by factors with pivoting alone.
FoldingHistory record_with_pivoting(const Model& model, const FlatVertices& vertices_mm);

/// Records in closed form the stations of an overconstrained model's sheet of its parallel family,
/// which folds by its base's fold angles; the verdict is a BaseJudge's. Other sheets are undecided,
/// with their loops' openings.
FoldingHistory record_on_base(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit = nullptr);

}  // namespace misalign::solver
