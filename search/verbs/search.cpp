// `misalign search`: runs or resumes a campaign.
#include <unistd.h>

#include <charconv>

#include "search/ranks/mpi_session.hpp"
#include "search/ranks/run_info.hpp"
#include "search/ranks/search_run.hpp"
#include "search/terminal/screen.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/help_format.hpp"
#include "search/verbs/rank_options.hpp"
#include "search/verbs/validators.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

struct SearchCall {
  SearchOptions options;
  std::string range, ranks;  // as typed; empty otherwise
  int stopped_exit = 0;
};

CLI::Validator instruction_set_of_this_machine() {
  Names<solver::InstructionSet> names;
  for (const auto set : solver::available_instruction_sets()) {
    names.emplace_back(solver::instruction_set_name(set), set);
  }
  // --help is the same on every machine.
  return one_of(names, ", which this machine has").description("{baseline,avx2,avx512}");
}

schema::DrawRange parse_range(const std::string& text) {
  schema::DrawRange range{0, 0};
  const char* const end = text.data() + text.size();
  const auto lo = std::from_chars(text.data(), end, range.lo);
  if (lo.ec == std::errc{} && lo.ptr != end && *lo.ptr == ':') {
    const auto hi = std::from_chars(lo.ptr + 1, end, range.hi);
    if (hi.ec == std::errc{} && hi.ptr == end && range.lo < range.hi &&
        range.hi <= schema::kEndOfDraws) {
      return range;
    }
  }
  throw UserError(schema::Cause::bad_request,
                  "--range " + text + ": must be LO:HI with LO < HI, half-open; try 0:100000");
}

// Adds the goals of a run.
void add_goals(CLI::App& verb, SearchCall& call) {
  SearchOptions& options = call.options;
  const auto draw_count = a_draw();
  add_value(verb, "--draws", options.draws,
            "end after the first N draws (of --range, if given), earlier runs included", draw_count,
            "N");
  add_value(verb, "--populations", options.populations,
            "of a splitting search: end after the first N populations (of --range, if given)",
            counted(0, schema::kEndOfPopulations), "N");
  add_value(verb, "--accepted", options.accepted,
            "end when K draws are accepted, earlier runs included; of a splitting search: keep K "
            "candidates at most",
            draw_count, "K");
  add_value(verb, "--relative-error", options.relative_error,
            "end when the acceptance rate is known to within this share of itself",
            a_share(1e-6, 1), "SHARE");
  add_value(verb, "--max-time", options.max_time_s,
            "end this run after this time; the next one resumes", within(0, 1e9), "SECONDS");
  add_value(verb, "--stopped-exit", call.stopped_exit,
            "exit code when a signal or --max-time ends it and work remains; some schedulers "
            "restart a job by it [0]",
            counted(0, 255), "N");
  add_value(verb, "--seed", options.seed, "use this seed instead of the campaign's", draw_count,
            "SEED");
}

// The command that would use every core; empty if this one does, or a launcher decides.
std::string command_for_all(const Words& typed) {
  if (launched_by_mpi() || usable_threads() < 2) return "";
  std::string command;
  for (const std::string& word : typed) command += shell_word(word) + " ";
  return command + "--ranks all";
}

int start_search(const SearchCall& call, const Words& typed) {
  SearchOptions options = call.options;
  options.border = kCommandLine;
  options.border.stopped = call.stopped_exit;
  if (!call.range.empty()) options.range = parse_range(call.range);
  if (const int count = ranks_wanted(call.ranks); count > 1) {
    const bool with_bar = options.progress == ProgressStyle::automatic &&
                          is_terminal(STDERR_FILENO) && terminal_is_able();
    return run_on_ranks(count, typed, with_bar, call.stopped_exit);
  }
  options.alone_is_meant = options.range || !call.ranks.empty();
  if (call.ranks.empty()) options.command_for_all = command_for_all(typed);
  return run_search(options);
}

}  // namespace

Action search_verb(CLI::App& verb, const Words& typed, const Parts& parts) {
  verb.description("run or resume a campaign, alone or under mpirun");
  verb.footer(
      "The same command resumes: --draws and --accepted are totals, earlier runs included.\n\n"
      "Progress goes to standard error: one live line on a terminal (bar), a line\n"
      "every 30 s elsewhere and under mpirun (plain), or an object of JSON every 2 s\n"
      "(json) with the keys elapsed_s, draws, draws_left, draws_per_s,\n"
      "draws_per_s_mean, accepted, rate, best (deploys_from_deg and draw), left_s and\n"
      "last; unknown values are null. Counts are those of the whole catalogue; left_s\n"
      "is to the last draw or to the end of --max-time, whichever comes first. Of a\n"
      "splitting search they count populations, not draws, and under_way has the level;\n"
      "there is no rate.\n\n"
      "A splitting search (search.method in the campaign) counts populations instead of\n"
      "draws, with --populations and in --range. Its levels are found once, at the first\n"
      "start; a kill costs some seconds, not the population that was under way.\n\n"
      "Signals, to mpirun or to the program alone: SIGINT, SIGTERM, SIGHUP, SIGXCPU and\n"
      "SIGALRM end it within a second (alone: two), a second SIGINT or SIGTERM at once;\n"
      "SIGUSR1 ends it once all work under way is committed; SIGUSR2 prints a status\n"
      "line. All committed work is kept, and one sentence reports the progress.\n\n"
      "--ranks starts the ranks on this machine, through mpirun (Open MPI). To use several\n"
      "machines, or options of mpirun, call mpirun yourself.\n\n"
      "Examples:\n"
      "  misalign search search/campaigns/miura-4x4.json --draws 2000\n"
      "  misalign search search/campaigns/miura-6x6.json --ranks all --max-time 3600\n"
      "  misalign search search/campaigns/miura-6x6-flat.json --ranks all --populations 5\n"
      "  mpirun -n 8 misalign search search/campaigns/miura-6x6.json --max-time 3600");
  auto call = std::make_shared<SearchCall>();
  SearchOptions& options = call->options;
  options.parts = parts;
  verb.add_option("CAMPAIGN", options.campaign_path, "campaign file (JSON)")->required();
  verb.add_option("--catalogue", options.catalogue_path,
                  "catalogue file [results/NAME-<8 hex digits>.db]")
      ->type_name("CATALOGUE");
  add_goals(verb, *call);
  verb.add_option("--range", call->range, "only the draws, or populations, from LO to HI - 1")
      ->type_name("LO:HI");
  add_ranks(verb, call->ranks);
  add_value(verb, "--unit-draws", options.unit_draws,
            "draws in one unit of work [about 5 s of work]", counted(1, 1000000000), "N");
  verb.add_option("--unit-bytes", options.unit_bytes)  // so that a test need not make gigabytes
      ->check(counted(1, kMostUnit_bytes))
      ->group(kHidden);
  verb.add_option(
          "--instruction-set", options.instruction_set,
          "vector registers to use; changes the speed, never a result [the widest of this machine]")
      ->transform(instruction_set_of_this_machine());
  verb.add_option("--storage", options.storage,
                  "kind of disk of the catalogue [by its file system]")
      ->transform(one_of<schema::Storage>(
          {{"local", schema::Storage::local}, {"network", schema::Storage::network}}));
  verb.add_flag("--retry-undecided", options.retry_undecided,
                "first judge the undecided draws again");
  verb.add_flag_callback(
      "--allow-mixed-builds", [call] { call->options.builds = schema::Builds::mixed; },
      "continue although ranks or earlier runs judge a set of known sheets differently");
  verb.add_option("--progress", options.progress, "how to show progress, see above [auto]")
      ->transform(one_of<ProgressStyle>({{"auto", ProgressStyle::automatic},
                                         {"plain", ProgressStyle::plain},
                                         {"bar", ProgressStyle::bar},
                                         {"json", ProgressStyle::json},
                                         {"none", ProgressStyle::none}}));
  return [call, typed] { return start_search(*call, typed); };
}

}  // namespace misalign::search
