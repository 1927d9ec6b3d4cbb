// Writes a folded sheet as a MAT-file, for MATLAB and Octave: histories, coordinates, springs.
#pragma once

#include <string>

#include "schema/exchange/folding_json.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::schema {

/// The bytes of a MAT-file (see mat_file). With S rows, flat first; V vertices, C creases, D
/// diagonals; vertices, panels and diagonals counted from 1. Every number is the one that
/// folding_json, folded_pattern_json and actuation_history_json write. `origin` as in origin_json,
/// empty for a pattern file; `path` is the file's name in sentences. UserError (failure).
std::string folded_mat(const std::string& path, const FoldingView& view,
                       const solver::Actuation& actuation, const Sampling& sampling,
                       const std::string& title, const Json& origin);

}  // namespace misalign::schema
