// Checks whether a machine can run a campaign well and reliably.
#pragma once

#include <string>
#include <vector>

#include "schema/files/input.hpp"

namespace misalign::search {

enum class Health {
  good,
  note,  ///< works, but not as well as possible
  bad    ///< a campaign would fail, or give wrong results
};

struct Check {
  std::string name;
  Health health;
  std::string sentence;  ///< the result, and a remedy if it is not good
};

/// A rank's report to rank 0.
struct RankReport {
  std::string host;
  int threads = 0;  ///< threads that the host allows this process
  std::string golden_verdicts;
};
std::string pack(const RankReport& report);
RankReport unpack_rank(const std::string& text);

/// Checks random numbers, and verdicts with all instruction sets of the machine.
std::vector<Check> check_numbers();
/// Lists the libraries of this build; missing ones are a note.
Check check_libraries();
/// Checks a directory for catalogues: its file system, whether it can be written and locked, and
/// its commits per second. Leaves no file there.
std::vector<Check> check_directory(const std::string& directory);
/// Checks all ranks together: hosts and their threads, and whether every rank gives the same
/// verdicts.
std::vector<Check> check_ranks(const std::vector<RankReport>& ranks, bool has_beats);

std::string checks_text(const std::vector<Check>& checks);
schema::Json checks_json(const std::vector<Check>& checks);
bool any_bad(const std::vector<Check>& checks);

}  // namespace misalign::search
