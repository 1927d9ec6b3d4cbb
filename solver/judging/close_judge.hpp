// The verdict on one path in close steps, whose samples are solved: a Judge, and where bumps are
// looked for exactly the states between the samples that this takes.
#pragma once

#include <vector>

#include "solver/judging/solved_bumps.hpp"
#include "solver/model/model.hpp"

namespace misalign::solver {

class CloseJudge {
 public:
  /// Both must outlive this object; judges may share `bumps`.
  CloseJudge(const Model& model, SolvedBumps& bumps);
  ~CloseJudge();
  CloseJudge(CloseJudge&&);

  void begin(const SheetGeometry<double>& geometry, const std::vector<double>& flat_lengths);
  /// The next sample, with its slopes if those are to be looked at; false once a fault is known.
  /// `geometry`: of the sheet, if looks_between().
  bool see(const Station& station, const PathPoint& point, bool with_slopes,
           const SheetGeometry<double>* geometry);
  /// Whether it solves states between the samples.
  bool looks_between() const { return model_.bumps() == BumpRule::exact; }
  Verdict conclude(const PathResult& path) const { return judge_.conclude(path); }
  const Judge& judge() const { return judge_; }

 private:
  const Model& model_;
  Judge judge_;
  bool is_over_ = false;
  double last_deg_ = 0;
  PathPoint last_;  // the last sample, where bumps are looked for exactly
  SolvedBumps& bumps_;
};

}  // namespace misalign::solver
