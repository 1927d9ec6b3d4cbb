// Finds the paths of a model's sheets.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solver/records/path_record.hpp"
#include "solver/sheet/way_solver.hpp"

namespace misalign::solver {

/// A source belongs to one thread.
class PathSource {
 public:
  virtual ~PathSource() = default;

  /// The record of a path in long steps; none where record_of(history) is as good.
  virtual std::optional<PathRecord> record(const FlatVertices& vertices_mm) = 0;
  /// A path in close steps; `states` becomes one at each station, its rates by radian of pilot.
  virtual FoldingHistory history(const FlatVertices& vertices_mm,
                                 std::vector<WayStation>& states) = 0;
  /// The path solved at this many stations; none where it is lost. `outline` is kept for the next
  /// such call with the same vertices.
  virtual std::optional<FoldingWay> way(const FlatVertices& vertices_mm,
                                        std::shared_ptr<const PathOutline>& outline,
                                        int stations) = 0;
  /// Closes a state of a way once more, its pilot held; returns whether it is closed.
  virtual bool close(const SheetGeometry<double>& geometry, FoldState<double>& state) = 0;

  /// Numbers of paths followed so far, in long steps and in close ones.
  struct Followed {
    int as_functions = 0, closely = 0;
  };
  const Followed& followed() const { return followed_; }

 protected:
  Followed followed_;
};

/// Paths are followed; those of an overconstrained model, which is its base, have closed forms.
/// `model` must outlive the source.
std::unique_ptr<PathSource> path_source_of(const Model& model);

}  // namespace misalign::solver
