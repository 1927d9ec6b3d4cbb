// Computes a piece of a population: some of its particles at one level, the job of a rank. Its
// result is a function of the campaign and the order, whatever rank computes it and however a level
// is cut.
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

/// A bound above every score.
inline constexpr int kBeyondAll = std::numeric_limits<int>::max();

/// An order for particles lo to hi - 1 of a population at a level.
struct PieceOrder {
  std::uint32_t population, level;
  std::uint32_t lo, hi;
  int within;            ///< least score at this level
  int next;              ///< score of the next level, which survivors reach; kBeyondAll without one
  bool is_first;         ///< true for first draws, whose sheets are not made yet
  bool is_catalogued;    ///< true if sheets that meet the campaign's criterion are kept
  ScoredParticles here;  ///< particles; none for first draws and starts
  std::vector<schema::Candidate> starts = {};  ///< starts of ascents, instead of moves
};

/// A sheet that meets the criterion and where it was first met; for a start its optimum.
struct MetCandidate {
  std::uint32_t step, particle;  ///< smallest (step, particle) that met it
  schema::Candidate candidate;
};

struct PieceResult {
  std::uint32_t population = 0, level = 0;
  std::uint32_t lo = 0, hi = 0;  ///< particles done
  std::uint64_t tried = 0;       ///< moves, or draws
  std::uint64_t taken = 0;       ///< moves that stayed within the level
  std::uint64_t undecided = 0;   ///< tries that could not be decided
  double seconds = 0;
  std::vector<std::uint32_t> survivors;  ///< particles that have reached the next level, ascending
  ScoredParticles there;                 ///< the survivors
  std::vector<MetCandidate> met;         ///< each sheet of a piece once, where it was met first

  /// Appends the next particles' result.
  void append(PieceResult next);
  /// Returns whether all survivors have this score, or a higher one.
  bool are_all_from(int score) const;
  /// Returns whether each particle has one candidate, as starts have their optima.
  bool has_one_each() const;
};

/// Work on an order, a block of particles and a step at a time.
class PieceWork {
 public:
  /// All must outlive this object. `ascend` is needed for starts alone.
  PieceWork(const Moves& moves, std::uint32_t sweeps, LevelScorers& scorers, BeginAscent ascend,
            PieceOrder order);

  bool finished() const { return next_ == order_.hi; }
  bool is_full() const { return false; }  // orders are small enough
  /// Computes a step of a block of particles, or a part of an ascent: about a tenth of a second.
  void run_next_block();
  const PieceOrder& order() const { return order_; }
  const PieceResult& so_far() const { return result_; }
  /// Returns the result of whole blocks of particles, or whole ascents.
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
  std::uint32_t next_;       // first particle that is not done
  std::uint32_t block_ = 0;  // particles of the block under way; 0 without one
  std::uint32_t step_ = 0;
  Particles now_, tried_;  // particles of the block
  std::vector<int> now_scores_;
  solver::ShiftBlock shifts_;
  PieceResult result_, of_block_;   // finished blocks, and the block under way
  std::optional<Ascents> ascents_;  // ascents from starts
  struct Met {
    std::uint32_t step, particle;
    std::vector<std::uint8_t> sheet;
  };
  std::vector<Met> met_;                                // sheets met in the block
  std::unordered_map<std::string, std::size_t> place_;  // index of a sheet in result_.met
};

}  // namespace misalign::search
