// Records the path of one sheet.
#pragma once

#include "solver/records/history.hpp"

namespace misalign::solver {

/// Follows the path of the sheet with these vertices to the model's end or the fold limit, past
/// faults. Where dense matrices follow it again (see dense_fallback) `visit` sees it from the first
/// station once more.
FoldingHistory record_history(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit = nullptr);

/// The same by dense matrices with pivoting alone.
FoldingHistory record_densely(const Model& model, const FlatVertices& vertices_mm);

/// The same station by station in closed form, of an overconstrained model and a sheet of its
/// parallel family, which folds by its base's own fold angles; others are undecided, and told by
/// how far their loops are open. The verdict is a BaseJudge's.
FoldingHistory record_on_base(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit = nullptr);

}  // namespace misalign::solver
