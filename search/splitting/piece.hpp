// A piece of a population: some of its particles at one level, the job of a rank. Its result is a
// function of the campaign and of the order; who works it off, and how a level is cut into pieces,
// changes nothing.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <unordered_map>

#include "schema/records/unit_record.hpp"
#include "search/draws/ascents.hpp"
#include "search/splitting/level_scorer.hpp"
#include "search/splitting/moves.hpp"

namespace misalign::search {

/// Above every score.
inline constexpr int kBeyondAll = std::numeric_limits<int>::max();

/// Particles lo to hi - 1 of a population at a level.
struct PieceOrder {
  std::uint32_t population, level;
  std::uint32_t lo, hi;
  int within;            ///< the least score at this level
  int next;              ///< that of the next: who has it is wanted; kBeyondAll: nobody
  bool is_first;         ///< its first draws, whose sheets are still to be made
  bool is_catalogued;    ///< whether sheets that meet the campaign's criterion are kept
  ScoredParticles here;  ///< none of the first draws, and of starts
  std::vector<schema::Candidate> starts = {};  ///< of ascents, instead of moves
};

/// A sheet that meets the criterion, and where it was met first; of starts where each of them ends.
struct MetCandidate {
  std::uint32_t step, particle;  ///< of those that met it the least
  schema::Candidate candidate;
};

struct PieceResult {
  std::uint32_t population = 0, level = 0;
  std::uint32_t lo = 0, hi = 0;  ///< what was done of the order
  std::uint64_t tried = 0;       ///< moves, or draws
  std::uint64_t taken = 0;       ///< moves that stayed within the level
  std::uint64_t undecided = 0;   ///< of those tried
  double seconds = 0;
  std::vector<std::uint32_t> survivors;  ///< particles that have reached the next level, ascending
  ScoredParticles there;                 ///< theirs
  std::vector<MetCandidate> met;         ///< each sheet of a piece once, where it was met first

  /// Those that come next.
  void append(PieceResult next);
  /// Whether all survivors have this score, or a higher one.
  bool are_all_from(int score) const;
  /// Whether each of its particles has met one, as starts their ends.
  bool has_one_each() const;
};

/// Orders being worked off, a block of particles and a step at a time.
class PieceWork {
 public:
  /// All must outlive this object. `ascend` is for starts alone.
  PieceWork(const Moves& moves, std::uint32_t sweeps, LevelScorers& scorers, BeginAscent ascend,
            PieceOrder order);

  bool finished() const { return next_ == order_.hi; }
  bool is_full() const { return false; }  // orders are small enough
  /// One step of a block of particles, or some of an ascent: about a tenth of a second.
  void run_next_block();
  const PieceOrder& order() const { return order_; }
  const PieceResult& so_far() const { return result_; }
  /// What has been done: whole blocks of particles, or whole ascents.
  PieceResult take();

 private:
  void advance_ascents();
  void begin_block();
  void make_proposals();
  void take_good_ones();
  void end_block();
  void collect_met();

  const Moves& moves_;
  const std::uint32_t sweeps_;
  LevelScorers& scorers_;
  const PieceOrder order_;
  const std::size_t bytes_;
  std::uint32_t next_;       // the first particle that is not done
  std::uint32_t block_ = 0;  // particles of the block under way; 0: none is
  std::uint32_t step_ = 0;
  Particles now_, tried_;  // of the block
  std::vector<int> now_scores_;
  solver::ShiftBlock shifts_;
  PieceResult result_, of_block_;   // blocks that are done, and the one under way
  std::optional<Ascents> ascents_;  // of starts
  struct Met {
    std::uint32_t step, particle;
    std::vector<std::uint8_t> sheet;
  };
  std::vector<Met> met_;                                // in the block
  std::unordered_map<std::string, std::size_t> place_;  // of a sheet in the result's met ones
};

}  // namespace misalign::search
