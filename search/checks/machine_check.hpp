// Checks whether a machine can run a campaign well, and be trusted with it.
#pragma once

#include <string>
#include <vector>

#include "schema/files/input.hpp"

namespace misalign::search {

enum class Health {
  good,
  note,  ///< it works, but not as well as it could
  bad    ///< a campaign would fail, or could not be trusted
};

struct Check {
  std::string name;
  Health health;
  std::string sentence;  ///< what was found, and what to do if it is not good
};

/// What a rank says of itself.
struct RankReport {
  std::string host;
  int threads = 0;  ///< that the host has for this process
  std::string golden_verdicts;
};
std::string pack(const RankReport& report);
RankReport unpack_rank(const std::string& text);

/// Random numbers, and verdicts in all of the machine's registers.
std::vector<Check> check_numbers();
/// Which libraries this build has; those that it lacks are a note.
Check check_libraries();
/// A place for catalogues: its file system, whether it can be written and locked, and how many
/// commits a second it takes. Leaves nothing there.
std::vector<Check> check_directory(const std::string& directory);
/// All ranks together: hosts and their threads, and whether every rank gives the same verdicts.
std::vector<Check> check_ranks(const std::vector<RankReport>& ranks, bool has_beats);

std::string checks_text(const std::vector<Check>& checks);
schema::Json checks_json(const std::vector<Check>& checks);
bool any_bad(const std::vector<Check>& checks);

}  // namespace misalign::search
