// The campaigns that stories are about.
#pragma once

#include "schema/campaign/campaign.hpp"
#include "tests/simulation/invented_draws.hpp"
#include "tests/simulation/look.hpp"
#include "tests/simulation/story.hpp"

namespace misalign::simulation {

/// A campaign with its file, its goal, and how its draws turn out.
struct Told {
  std::string kind;
  Work work;
  schema::Json file;
  schema::Campaign campaign;
  std::uint64_t goal;     ///< draws, or populations
  bool is_split = false;  ///< counts populations
  int older_version = 0;  ///< version of the catalogue that it begins with; 0: none
  std::string older_path = {};
  Tempo tempo = {};
  double expected_s = 1;  ///< virtual time of one rank

  /// The words of a search from `lo` to before `hi`.
  std::vector<std::string> search_words(const std::string& catalogue, std::uint64_t lo,
                                        std::uint64_t hi) const;
};

/// Chooses the campaign of a seed.
Told told_by(std::uint64_t seed, Random& random);

/// Returns a plain campaign of 40 draws.
Told plain_story();

/// Returns the bytes of a file.
std::string bytes_of_file(const std::string& path);

/// Runs the program with these words on a machine; see run_command_line.
std::function<int(int)> program(const std::vector<std::string>& words);

/// Returns the answer of a reader that has ended (looking_at).
schema::Json answer_of(const LifeEnd& end);

/// Makes what a process makes once, so that processes that are forked need not.
void warm_up(Disk& disk);

/// Returns what a campaign must hold at its end: a plain loop's results, or those of an undisturbed
/// run where a draw's result depends on more than its number. Known ones are not made again.
const Expected& expected_of(const Told& told, Disk& disk);

}  // namespace misalign::simulation
