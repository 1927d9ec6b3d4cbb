// The science of populations: draws -> those that reach a level -> copies -> moved within it ->
// those that reach the next -> ... -> sheets that meet the criterion.
#pragma once

#include "schema/campaign/splitting.hpp"
#include "search/splitting/population.hpp"

namespace misalign::search {

/// One campaign that splits made ready, and the workspace of this rank.
class Climber {
 public:
  /// `campaign` must outlive this object.
  Climber(const schema::Campaign& campaign, solver::InstructionSet set);
  Climber(const Climber&) = delete;
  Climber& operator=(const Climber&) = delete;

  /// What populations find goes on to its end from now on, as of a DrawEvaluator.
  void ascend_with(BeginAscent begin) { begin_ascent_ = std::move(begin); }

  PieceWork start(PieceOrder order) {
    return {moves_, sweeps_, scorers_, begin_ascent_, std::move(order)};
  }
  const schema::Campaign& campaign() const { return scorers_.campaign(); }
  const solver::Mechanism& mechanism() const { return mechanism_; }
  const Moves& moves() const { return moves_; }
  LevelScorers& scorers() { return scorers_; }

 private:
  const solver::Mechanism mechanism_;
  const Moves moves_;
  const std::uint32_t sweeps_;
  LevelScorers scorers_;
  BeginAscent begin_ascent_;  // of a campaign that optimises
};

/// The ladder of a campaign, without levels where it names none.
Ladder named_ladder(const schema::Campaign& campaign);
/// The same with the levels that its catalogue keeps, if a level finder has found them. UserError
/// (3) if they can be none of this campaign.
Ladder stored_ladder(const schema::Campaign& campaign, const std::vector<int>& stored);
/// The levels of a campaign: those that it names, or what a level finder finds.
Ladder ladder_of(const schema::Campaign& campaign, Climber& climber);

/// One population from its first draws to the last level, by one rank alone.
PopulationRecord climbed(const Ladder& ladder, std::uint32_t number, Climber& climber);

}  // namespace misalign::search
