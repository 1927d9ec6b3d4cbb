// Looks into a catalogue as any reader may, and compares it with a plain loop over all draws.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "schema/campaign/campaign.hpp"
#include "schema/files/input.hpp"

namespace misalign::simulation {

/// Returns the program that prints what a catalogue holds, at one moment: {"digest", "goal_end",
/// "done", "accepted", "undecided", "certified", "yields", "wrong": the first finding of a check,
/// if any}, or
/// {"sentence", "cause"} where it cannot be read. `between` is called once the moment is fixed.
std::function<int(int)> looking_at(const std::string& path, const schema::Campaign& campaign,
                                   void (*between)());

/// The contents of a finished campaign.
struct Expected {
  std::set<std::uint64_t> accepted, undecided;
  std::uint64_t end = 0;  ///< draws from here on are unknown
  std::uint64_t goal_end = 0;
  std::string digest;
};

/// Makes every draw of a plain campaign in turn, and computes the digest as its definition says.
Expected plain_loop(const schema::Campaign& campaign, std::uint64_t draws);

/// The known contents of a catalogue: no later look may show less.
class Kept {
 public:
  /// Takes a look; `is_durable` if a power cut must not undo what it shows: not what a killed
  /// program has left, before another has synced it. Returns what is wrong with it, empty if
  /// nothing is.
  std::string take(const schema::Json& look, const Expected& expected, bool is_durable);
  /// Takes what another catalogue holds of certificates and yields, as a merge must.
  void take_studies(const Kept& other);
  void lose_power() { seen_ = durable_; }
  void forget() { *this = {}; }
  bool is_empty() const { return seen_.done.empty(); }

 private:
  struct Holdings {
    std::vector<schema::DrawRange> done;
    std::set<std::uint64_t> certified, yields;  // hashes of the sheets
  };
  Holdings seen_, durable_;
};

}  // namespace misalign::simulation
