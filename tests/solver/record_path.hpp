// The record of one path, by a recorder of its own.
#pragma once

#include "solver/records/function_recorder.hpp"

namespace misalign::solver {

/// The record that metrics need, as a campaign's draws are measured.
inline PathRecord record_path(const Model& model, const FlatVertices& vertices_mm) {
  PathFollower<double, LongSteps> long_follower(model.mechanism(), model.elimination());
  PathFollower<double> follower(model.mechanism(), model.elimination());
  Recorder<double> recorder(model, follower);
  FunctionRecorder<double> functions(model, long_follower, follower, recorder);
  return functions.record(SheetBlock(vertices_mm)).front();
}

}  // namespace misalign::solver
