// Runs populations: draws -> survivors at a level -> copies -> moves within it -> survivors at the
// next -> ... -> sheets that meet the criterion.
#pragma once

#include "schema/campaign/splitting.hpp"
#include "search/draws/parts.hpp"
#include "search/splitting/population.hpp"

namespace misalign::search {

/// The model of a splitting campaign, and the workspace of this rank.
class Climber {
 public:
  /// `campaign` must outlive this object. If the campaign optimises, ascents start from the
  /// candidates; this needs the part.
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

/// Returns the ladder of a campaign, without levels if it names none.
Ladder named_ladder(const schema::Campaign& campaign);
/// Returns it with the levels of a level finder that the catalogue stores. UserError (3) if the
/// campaign cannot have these levels.
Ladder stored_ladder(const schema::Campaign& campaign, const std::vector<int>& stored);
/// Returns it with the campaign's levels, or those that a level finder finds now.
Ladder ladder_of(const schema::Campaign& campaign, Climber& climber);

/// Computes one population from its first draws to the last level, on one rank.
PopulationRecord climbed(const Ladder& ladder, std::uint32_t number, Climber& climber);

}  // namespace misalign::search
