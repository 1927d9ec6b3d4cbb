// The science of populations: draws -> those that reach a level -> copies -> moved within it ->
// those that reach the next -> ... -> sheets that meet the criterion.
#pragma once

#include "schema/campaign/splitting.hpp"
#include "search/draws/parts.hpp"
#include "search/splitting/population.hpp"

namespace misalign::search {

/// One campaign that splits made ready, and the workspace of this rank.
class Climber {
 public:
  /// `campaign` must outlive this object. What populations find goes on to its end if the campaign
  /// optimises, for which the part is needed.
  Climber(const schema::Campaign& campaign, solver::InstructionSet set, const Parts& parts = {});
  Climber(const Climber&) = delete;
  Climber& operator=(const Climber&) = delete;

  PieceWork start(PieceOrder order) {
    return {moves_, sweeps_, scorers_, ascend_, std::move(order)};
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
  const BeginAscent ascend_;
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
