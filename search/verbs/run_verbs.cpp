// Verbs that run something.
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>

#include "schema/campaign/key_list.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "search/checks/merge.hpp"
#include "search/draws/trial.hpp"
#include "search/ranks/mpi_session.hpp"
#include "search/ranks/rank_starter.hpp"
#include "search/ranks/run_info.hpp"
#include "search/ranks/search_run.hpp"
#include "search/terminal/help_format.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/bench.hpp"
#include "search/verbs/completion.hpp"
#include "search/verbs/doctor.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

constexpr std::uint64_t kMostRanks = 4096;  // of one machine

CLI::Validator instruction_set_of_this_machine() {
  Names names;
  for (const auto set : solver::available_instruction_sets()) {
    names.emplace_back(solver::instruction_set_name(set), number_of(set));
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
  throw UserError(schema::kExitUsage,
                  "--range " + text + ": must be LO:HI with LO < HI, half-open; try 0:100000");
}

// What is wanted, and of which draws.
void add_goals(CLI::App& verb, SearchOptions& options) {
  const auto draw_count = a_draw();
  verb.add_option("--draws", options.draws, "draws wanted in total")
      ->check(draw_count)
      ->type_name("N");
  verb.add_option("--accepted", options.accepted, "accepted draws wanted in total")
      ->check(draw_count)
      ->type_name("K");
  verb.add_option("--relative-error", options.relative_error,
                  "end when the acceptance rate is known to this share of itself")
      ->check(a_share(1e-6, 1))
      ->type_name("SHARE");
  verb.add_option("--max-time", options.max_time_s, "end this run after so many seconds")
      ->check(within(0, 1e9))
      ->type_name("SECONDS");
  verb.add_option("--seed", options.seed, "instead of the campaign's seed")
      ->check(draw_count)
      ->type_name("SEED");
}

// --ranks: "all", or how many.
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

// How many ranks are to be started; 1 where nobody asked.
int ranks_wanted(const std::string& ranks) {
  if (ranks.empty()) return 1;
  if (launched_by_mpi()) {
    throw UserError(schema::kExitUsage, "--ranks " + ranks +
                                            " has no meaning under mpirun (which has started the "
                                            "ranks); take it out, and give mpirun -n");
  }
  return ranks == "all" ? usable_threads() : std::stoi(ranks);
}

// What would use every core; empty if this does, or if somebody else decides.
std::string command_for_all(const std::vector<std::string>& words) {
  if (launched_by_mpi() || usable_threads() < 2) return "";
  std::string command;
  for (const std::string& word : words) command += shell_word(word) + " ";
  return command + "--ranks all";
}

}  // namespace

Action add_search(CLI::App& app, const std::vector<std::string>& words) {
  auto* verb = app.add_subcommand("search", "run or resume a campaign, alone or under mpirun");
  verb->footer(
      "The same command again resumes: --draws is the total wanted.\n\n"
      "Progress goes to standard error: one live line on a terminal (bar), a line\n"
      "every 30 s elsewhere and under mpirun (plain), or an object of JSON every 2 s\n"
      "(json) with the keys elapsed_s, draws, draws_left, draws_per_s,\n"
      "draws_per_s_mean, accepted, rate, best (deploys_from_deg and draw), left_s and\n"
      "last; what is not known is null. Counts are those of the whole catalogue; left_s\n"
      "is to the last draw or to the end of --max-time, whichever comes first.\n\n"
      "Signals, to mpirun or to the program alone: SIGINT and SIGTERM end it within\n"
      "half a second, a second one at once; SIGUSR1 ends it once all that is under\n"
      "way is committed; SIGUSR2 prints a status line.\n\n"
      "--ranks starts so many ranks on this machine, through mpirun (Open MPI); across\n"
      "machines, or with options of its own, call mpirun yourself.\n\n"
      "Examples:\n"
      "  misalign search search/campaigns/miura-4x4.json --draws 2000\n"
      "  misalign search search/campaigns/miura-6x6.json --ranks all --max-time 3600\n"
      "  mpirun -n 8 misalign search search/campaigns/miura-6x6.json --max-time 3600");
  auto options = std::make_shared<SearchOptions>();
  auto range = std::make_shared<std::string>();
  auto ranks = std::make_shared<std::string>();
  auto mixed = std::make_shared<bool>(false);
  verb->add_option("CAMPAIGN", options->campaign_path, "campaign file (JSON)")->required();
  verb->add_option("--catalogue", options->catalogue_path,
                   "catalogue file [results/NAME-<8 hex digits>.db]")
      ->type_name("CATALOGUE");
  add_goals(*verb, *options);
  verb->add_option("--range", *range, "only the draws from LO to HI - 1")->type_name("LO:HI");
  verb->add_option("--ranks", *ranks, "so many ranks, a core each; all: as many as cores [1]")
      ->check(rank_count())
      ->type_name("N|all");
  verb->add_option("--unit-draws", options->unit_draws,
                   "draws of one unit of work [about 5 s worth]")
      ->check(counted(1, 1000000000))
      ->type_name("N");
  verb->add_option("--unit-bytes", options->unit_bytes)  // so that a test need not make gigabytes
      ->check(counted(1, kMostUnit_bytes))
      ->group(kHidden);
  verb->add_option("--instruction-set", options->instruction_set,
                   "changes no answer, only the speed [the widest of this machine]")
      ->transform(instruction_set_of_this_machine());
  verb->add_option("--storage", options->storage,
                   "what the catalogue lies on [as the file system says]")
      ->transform(one_of({{"local", number_of(schema::Storage::local)},
                          {"network", number_of(schema::Storage::network)}}));
  verb->add_flag("--retry-undecided", options->retry_undecided,
                 "first judge again what no run could decide");
  verb->add_flag("--allow-mixed-builds", *mixed,
                 "go on although ranks or earlier runs give other golden verdicts");
  verb->add_option("--progress", options->progress, "how to show it, see above [auto]")
      ->transform(one_of({{"auto", number_of(ProgressStyle::automatic)},
                          {"plain", number_of(ProgressStyle::plain)},
                          {"bar", number_of(ProgressStyle::bar)},
                          {"json", number_of(ProgressStyle::json)},
                          {"none", number_of(ProgressStyle::none)}}));
  return [=] {
    if (!range->empty()) options->range = parse_range(*range);
    if (*mixed) options->builds = schema::Builds::mixed;
    if (const int count = ranks_wanted(*ranks); count > 1) {
      const bool with_bar = options->progress == ProgressStyle::automatic &&
                            is_terminal(STDERR_FILENO) && terminal_is_able();
      return run_under_mpirun(count, words, with_bar);
    }
    if (ranks->empty()) options->command_for_all = command_for_all(words);
    return run_search(*options);
  };
}

Action add_merge(CLI::App& app) {
  auto* verb = app.add_subcommand("merge", "catalogues of one campaign into one");
  verb->footer(
      "Draws that several of them have are compared (displacements and samples\n"
      "exactly, metrics within the tolerances of verify) and counted once; parts of\n"
      "units that overlap others are computed again. Exit code 6, and no file, if\n"
      "anything differs.\n\n"
      "Examples:\n  misalign merge all.db part-1.db part-2.db");
  auto options = std::make_shared<MergeOptions>();
  auto mixed = std::make_shared<bool>(false);
  verb->add_option("OUT", options->output, "catalogue file to write; must not exist")->required();
  verb->add_option("IN", options->inputs, "catalogue files, read only")->required();
  verb->add_flag("--allow-mixed-builds", *mixed,
                 "go on although builds with other golden verdicts wrote them");
  return [=] {
    if (*mixed) options->builds = schema::Builds::mixed;
    options->run = run_info(golden_verdicts(solver::available_instruction_sets().back()), 1);
    const MergeReport report = merge(*options);
    for (std::size_t k = 0; k < std::min(report.findings.size(), schema::kMostListed); ++k) {
      spdlog::error("{}", report.findings[k].sentence);
    }
    if (!report.findings.empty()) {
      spdlog::error("{} findings; {} was not written", report.findings.size(), options->output);
      return schema::kExitCheckFailed;
    }
    const auto merged = schema::open_for_reading(options->output);
    const schema::CatalogueState state = schema::read_state(*merged);
    put_format(
        "%s: %zu catalogues, %zu units taken, %llu draws compared, %llu computed again, %llu "
        "decided; %llu draws, %llu accepted, digest %s\n",
        schema::printable(options->output).c_str(), options->inputs.size(), report.units,
        static_cast<unsigned long long>(report.compared),
        static_cast<unsigned long long>(report.recomputed),
        static_cast<unsigned long long>(report.decided),
        static_cast<unsigned long long>(state.draws_in_ledger),
        static_cast<unsigned long long>(state.accepted), state.digest.c_str());
    return 0;
  };
}

Action add_config(CLI::App& app) {
  auto* verb = app.add_subcommand("config", "the default campaign, or every fault of a file");
  verb->footer(
      "Examples:\n  misalign config --default > mine.json\n"
      "  misalign config --check mine.json");
  auto checked = std::make_shared<std::string>();
  auto show = std::make_shared<bool>(false), keys = std::make_shared<bool>(false);
  auto* choice = verb->add_option_group("choice", "what to do");
  choice->add_flag("--default", *show, "print the default campaign with every key");
  choice->add_flag("--keys", *keys, "print what each key means, as a Markdown table");
  choice->add_option("--check", *checked, "say what is wrong with a campaign file")
      ->type_name("CAMPAIGN");
  choice->require_option(1);
  return [=] {
    if (*show) {
      put_json(schema::campaign_json(schema::default_campaign()), 2);
      return 0;
    }
    if (*keys) {
      put(schema::campaign_keys_markdown());
      return 0;
    }
    const schema::Campaign campaign = schema::read_campaign_file(*checked);
    put_format("%s: good; catalogue %s\n", schema::printable(*checked).c_str(),
               default_catalogue_path(campaign).c_str());
    return 0;
  };
}

Action add_doctor(CLI::App& app) {
  auto* verb = app.add_subcommand("doctor", "whether this machine can run a campaign well");
  verb->footer(
      "Looks at random numbers, verdicts in all registers, MPI and its slots, and the\n"
      "directory for catalogues. Exit code 1 if a campaign would fail, or could not be\n"
      "trusted.\n\n"
      "Examples:\n  misalign doctor results\n  mpirun -n 8 --hostfile hosts misalign doctor");
  auto directory = std::make_shared<std::string>(".");
  auto json = std::make_shared<bool>(false);
  verb->add_option("DIRECTORY", *directory, "where catalogues are to be [.]");
  verb->add_flag("--json", *json, "as JSON");
  return [=] { return run_doctor(*directory, *json); };
}

Action add_bench(CLI::App& app) {
  auto* verb = app.add_subcommand("bench", "speed, and agreement with the reference solver");
  verb->footer(
      "Examples:\n  misalign bench\n"
      "  misalign bench search/campaigns/ring-6x6.json --agree 2000 --json");
  auto options = std::make_shared<BenchOptions>();
  verb->add_option("CAMPAIGN", options->campaign_path, "campaign file [the default campaign]");
  verb->add_option("--seconds", options->seconds, "for each solver [3]")
      ->check(within(0.01, 1e6))
      ->type_name("SECONDS");
  verb->add_option(
          "--agree", options->agree_draws,
          "instead of speed: the verdicts of so many draws, each against the reference's at "
          "thresholds of every tenth degree, at its own D and one sample above")
      ->check(counted(1, 100000000))
      ->type_name("N");
  verb->add_flag("--json", options->json, "as JSON");
  return [options] { return bench(*options) ? 0 : schema::kExitCheckFailed; };
}

Action add_completion(CLI::App& app) {
  auto* verb = app.add_subcommand("completion", "completion script for a shell");
  verb->footer(
      "Where the program was installed into a place that the shell looks at, it is there "
      "already.\n\n"
      "Examples:\n"
      "  source <(misalign completion bash)\n"
      "  misalign completion zsh > ~/.zfunc/_misalign");
  auto shell = std::make_shared<std::string>();
  verb->add_option("SHELL", *shell, "bash or zsh")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  return [&app, shell] {
    put(*shell == "bash" ? bash_completion(app) : zsh_completion(app));
    return 0;
  };
}

Action add_help(CLI::App& app) {
  auto* verb = app.add_subcommand("help", "what a verb does, with its options and examples");
  verb->footer("The same as misalign VERB --help.\n\nExamples:\n  misalign help search");
  std::vector<std::string> known;
  for (const CLI::App* each : verbs_of(app)) known.push_back(each->get_name());
  auto name = std::make_shared<std::string>();
  verb->add_option("VERB", *name, "the verb [all of them, a line each]")
      ->check(known_word("verb", known));
  return [&app, name] {
    const CLI::App& asked = name->empty() ? app : *app.get_subcommand(*name);
    // Not app.help(): that is this verb's, which was chosen.
    const std::string text =
        asked.get_formatter()->make_help(&asked, "", CLI::AppFormatMode::Normal);
    put(text);
    return 0;
  };
}

}  // namespace misalign::search
