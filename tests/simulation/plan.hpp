// Plans the lives of a story: a search's words and ranks, faults of its disk, signals, and visits.
#pragma once

#include "tests/simulation/campaigns.hpp"
#include "tests/simulation/process.hpp"

namespace misalign::simulation {

/// An act of others while a search stands still; two of them last until another one.
enum class Visit {
  look,
  long_look,
  end_long_look,
  lock,
  unlock,
  copy,
  take_away,
  cut_index,
  status,
  query,
  verify,
  watch,
  second_search
};

inline constexpr int kStoppedExit = 85;

inline bool is_error(FaultKind kind) {
  return kind != FaultKind::kill && kind != FaultKind::power_cut;
}

/// One catalogue of a story and its part of the goal.
struct Share {
  std::string file;
  std::uint64_t lo, hi;  ///< draws, or populations
  bool on_network = false;
};

struct Planned {
  Life life;
  bool has_signal = false, is_drain = false, is_asked_twice = false, has_kill = false,
       has_silence = false, has_max_time = false, has_stopped_exit = false;
};

class Planner {
 public:
  /// Counts faults and happenings in `planned`, and leaves out those that the cast leaves out.
  Planner(const Told& told, const Cast& cast, int& planned)
      : told_(told), cast_(cast), planned_(planned) {}

  /// Plans a search; `calls`: file calls of a life like it.
  Planned search(const Share& share, bool is_faulty, std::uint64_t calls, Random& random);
  void add_faults(Life& life, std::uint64_t calls, Random& random);
  int ranks(Random& random) const;
  /// Returns whether the next fault or happening is played.
  bool is_in();

 private:
  void add_signals(Planned& planned, double run_s, Random& random);
  void add_visits(Planned& planned, double run_s, bool on_network, Random& random);

  const Told& told_;
  const Cast& cast_;
  int& planned_;
};

}  // namespace misalign::simulation
