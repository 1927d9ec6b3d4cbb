// The checker's proof that no two panels meet on a subinterval of a path; like panel_proof.hpp, by
// arb.
#pragma once

#include "solver/certificate/panel_directions.hpp"
#include "solver/certificate/proven_interval.hpp"

namespace misalign::solver {

class PanelCheck {
 public:
  /// Both must outlive this object.
  PanelCheck(const FoldedShape& shape, const Panels& panels);

  /// `holds` or `unclear`: a subinterval on which panels meet is never proven.
  Proof are_apart(const IntervalProver& prover, const ProvenInterval& interval,
                  const ProvenInterval::Subinterval& subinterval) const;
  /// Number of pairs of panels, including those with a common crease.
  int pairs() const { return pairs_; }

 private:
  const FoldedShape& shape_;
  const Panels& panels_;
  const std::vector<ComparedPanels> compared_;
  const int pairs_;
};

}  // namespace misalign::solver
