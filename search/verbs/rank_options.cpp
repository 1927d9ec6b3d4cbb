#include "search/verbs/rank_options.hpp"

#include "search/ranks/mpi_session.hpp"
#include "search/ranks/rank_starter.hpp"
#include "search/ranks/run_info.hpp"
#include "search/verbs/validators.hpp"

namespace misalign::search {
namespace {

constexpr std::uint64_t kMostRanks = 4096;  // of one machine

// "all", or a number.
CLI::Validator rank_count() {
  const CLI::Validator count = counted(1, kMostRanks);
  return CLI::Validator(
      [=](std::string& text) {
        const bool is_count = text == "all" || count(text).empty();
        return is_count ? std::string()
                        : "'" + text + "' is neither all nor a whole number from 1 to " +
                              std::to_string(kMostRanks);
      },
      "");
}

// The words without the program's name, --ranks and its value.
Words words_of_a_rank(const Words& words, bool with_bar) {
  Words kept;
  bool only_arguments = false;
  for (std::size_t k = 1; k < words.size(); ++k) {
    only_arguments = only_arguments || words[k] == "--";
    const bool alone = words[k] == "--ranks";
    if (only_arguments || (!alone && words[k].rfind("--ranks=", 0) != 0)) {
      kept.push_back(words[k]);
      continue;
    }
    if (alone) ++k;
    if (with_bar) kept.insert(kept.end(), {"--progress", "bar"});
  }
  return kept;
}

}  // namespace

void add_ranks(CLI::App& verb, std::string& ranks) {
  add_value(verb, "--ranks", ranks,
            "number of ranks to start, one core each; all: one for every core [1]", rank_count(),
            "N|all");
}

void add_jobs(CLI::App& verb) {
  add_value(verb, "--jobs", typed_jobs, "threads; the answer does not depend on them [all cores]",
            counted("", "jobs"), "N");
}

int ranks_wanted(const std::string& ranks) {
  if (ranks.empty()) return 1;
  // A task among several that MPI may not join, see expect_joined, may run alone on purpose.
  const auto tasks = launched_tasks();
  const bool is_alone = ranks == "1" && tasks && tasks->launcher != "mpirun";
  if (launched_by_mpi() && !is_alone) {
    throw schema::UserError(schema::Cause::bad_request,
                            "--ranks " + ranks +
                                " has no meaning under mpirun (which has started the ranks); take "
                                "it out, and give mpirun -n");
  }
  return ranks == "all" ? usable_threads() : std::stoi(ranks);
}

int run_on_ranks(int ranks, const Words& typed, bool with_bar, int stopped_exit) {
  return run_under_mpirun(ranks, words_of_a_rank(typed, with_bar), stopped_exit);
}

}  // namespace misalign::search
