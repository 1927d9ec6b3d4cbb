// The problem given to every method: misaligned sheets of one campaign, the angles at which lengths
// are wanted, the closure tolerance; and what it gives back.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "tests/bench/work_precision/linear.hpp"

namespace misalign::bench {

/// Samples lie at whole multiples of the spacing up to here; every sheet's path reaches it.
inline constexpr int kEnd_deg = 150;

struct Sheet {
  std::uint64_t draw;
  solver::FlatVertices vertices_mm;
  solver::SheetGeometry<double> geometry;
};

class Problem {
 public:
  /// The first `sheets` draws of the campaign whose paths reach kEnd_deg. The mechanism points into
  /// this object: it stays where it is.
  Problem(const schema::Campaign& campaign, int sheets);
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  const solver::Mechanism& mechanism() const { return mechanism_; }
  Topology topology() const { return {mechanism_, base_.folding, base_.sheet.vertices_mm}; }
  const solver::PerforatedSheet& base() const { return base_; }
  const std::vector<Sheet>& sheets() const { return sheets_; }
  int diagonals() const { return mechanism_.diagonal_count(); }

  /// The base folding: what a method may start from.
  solver::FoldState<double> base_state(double pilot_deg) const;

 private:
  solver::PerforatedSheet base_;
  solver::Mechanism mechanism_;
  std::vector<Sheet> sheets_;
};

/// What is asked of a method.
struct Demand {
  double tolerance;  ///< of `open_by`: radians and panel widths
  int spacing_deg;   ///< lengths are wanted at its multiples up to kEnd_deg
};

struct Effort {
  long corrections = 0;  ///< Newton steps
  long evaluations = 0;  ///< of the residual, with or without Jacobian
};

/// One sheet's answer.
struct Track {
  bool converged;
  Effort effort;
  std::vector<double> lengths;  ///< panel widths, sample by sample, as many as were reached
};

/// Follows every sheet of the problem: tracks[k] is that of sheets()[k]. Owns its workspace. Lanes
/// may take several sheets at a time.
using Run = std::function<void(std::vector<Track>& tracks)>;

}  // namespace misalign::bench
