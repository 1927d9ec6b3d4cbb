// Starts of the paths that go on in close steps from a station that their functions have passed.
#pragma once

#include <deque>
#include <vector>

#include "solver/continuation/path_function.hpp"
#include "solver/judging/sheet_queue.hpp"

namespace misalign::solver {

class LaterStarts {
 public:
  /// `model` must outlive this object, whose memory is used again.
  explicit LaterStarts(const Model& model);
  ~LaterStarts();

  void clear() { starts_.clear(); }
  /// Returns whether a station lies between the last nodes, so that its state is not extrapolated.
  static bool reaches_back_to(const Station& station, const PathFunction& function);
  /// Adds a sheet's path from this station of the model's path on. Returns its state, to be filled.
  FoldState<double>& add(int sheet, std::size_t station, int forward_sign);
  const std::vector<QueuedStart>& starts() const { return starts_; }

 private:
  const Model& model_;
  const FoldState<double> near_;  // a state of the right size
  std::vector<QueuedStart> starts_;
  std::deque<FoldState<double>> states_;  // at stable addresses
};

}  // namespace misalign::solver
