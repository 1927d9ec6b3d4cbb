#include "search/cli.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sqlite3.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "schema/plain_export.hpp"
#include "schema/result_table.hpp"
#include "search/bench.hpp"
#include "search/build_info.hpp"
#include "search/doctor.hpp"
#include "search/look.hpp"
#include "search/merge.hpp"
#include "search/run_info.hpp"
#include "search/search_run.hpp"
#include "search/status.hpp"
#include "search/tolerance.hpp"
#include "search/verify.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::UserError;

// A number within bounds, which NaN is not.
CLI::Validator within(double least, double most) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return "";
        return text + " is not a number from " + schema::shown_number(least) + " to " +
               schema::shown_number(most);
      },
      "");
}

// What a verb's options set, and what to do once they are read.
using Action = std::function<int()>;

std::string version_text() {
  const BuildInfo& build = build_info();
  return "misalign " + build.version + "\ncommit    " + build.commit + "\ncompiler  " +
         build.compiler + "\nflags     " + build.flags + "\nlibraries Eigen " +
         std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION) + ", SQLite " + sqlite3_libversion() +
         ", nlohmann-json " + std::to_string(NLOHMANN_JSON_VERSION_MAJOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_MINOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_PATCH) + "\ninstruction set " +
         solver::instruction_set_name(solver::available_instruction_sets().back());
}

// What is typed, and what it stands for.
using Names = std::vector<std::pair<std::string, std::string>>;

// One of the names; `where` ends the sentence about any other.
CLI::Validator one_of(const Names& names, const std::string& where = "") {
  return CLI::Validator(
      [=](std::string& text) {
        std::string all;
        for (const auto& [name, value] : names) {
          if (text == name) {
            text = value;
            return std::string();
          }
          all += (all.empty() ? "" : ", ") + name;
        }
        return "'" + text + "' is none of " + all + where;
      },
      "");
}

template <class Enum>
std::string number_of(Enum value) {
  return std::to_string(static_cast<int>(value));
}

CLI::Validator instruction_set_of_this_machine() {
  Names names;
  for (const auto set : solver::available_instruction_sets()) {
    names.emplace_back(solver::instruction_set_name(set), number_of(set));
  }
  return one_of(names, ", which this machine has");
}

void set_up_log(const std::string& level) {
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(
      std::getenv("NO_COLOR") ? spdlog::color_mode::never : spdlog::color_mode::automatic);
  auto logger = std::make_shared<spdlog::logger>("misalign", sink);
  logger->set_pattern("misalign: %^%v%$");
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(logger);
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

Action add_search(CLI::App& app) {
  auto* verb = app.add_subcommand("search", "run or resume a campaign, alone or under mpirun");
  verb->footer(
      "Examples:\n"
      "  misalign search search/campaigns/miura-4x4.json --draws 2000\n"
      "  mpirun -n 8 misalign search search/campaigns/miura-6x6.json --max-time 3600\n"
      "The same command again resumes. Signals, to mpirun or to the program alone: SIGINT or "
      "SIGTERM\n"
      "ends it within half a second, a second one at once; SIGUSR1 ends it once everything under "
      "way\n"
      "is committed; SIGUSR2 prints a status line.");
  auto options = std::make_shared<SearchOptions>();
  auto range = std::make_shared<std::string>();
  auto mixed = std::make_shared<bool>(false);
  const auto draw_count = CLI::Range(std::uint64_t{0}, schema::kEndOfDraws);
  verb->add_option("CAMPAIGN", options->campaign_path, "campaign file (JSON)")->required();
  verb->add_option("--catalogue", options->catalogue_path,
                   "catalogue file [results/NAME-<8 hex digits>.db]");
  verb->add_option("--draws", options->draws, "draws wanted in total")->check(draw_count);
  verb->add_option("--accepted", options->accepted, "accepted draws wanted in total")
      ->check(draw_count);
  verb->add_option("--relative-error", options->relative_error,
                   "end when the acceptance rate is known to this share of itself")
      ->check(within(1e-6, 1));
  verb->add_option("--max-time", options->max_time_s, "end this run after so many seconds")
      ->check(within(0, 1e9));
  verb->add_option("--seed", options->seed, "instead of the campaign's seed")->check(draw_count);
  verb->add_option("--range", *range, "only the draws LO:HI (half-open)");
  verb->add_option("--unit-draws", options->unit_draws,
                   "draws of one unit of work [about 5 s worth]")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000000}));
  verb->add_option("--instruction-set", options->instruction_set,
                   "baseline, avx2 or avx512, changes no answer [the widest of this machine]")
      ->transform(instruction_set_of_this_machine());
  verb->add_option("--storage", options->storage,
                   "local or network: what the catalogue lies on [as the file system says]")
      ->transform(one_of({{"local", number_of(schema::Storage::local)},
                          {"network", number_of(schema::Storage::network)}}));
  verb->add_flag("--retry-undecided", options->retry_undecided,
                 "first judge again what no run could decide");
  verb->add_flag("--allow-mixed-builds", *mixed,
                 "go on although ranks or earlier runs give other golden verdicts");
  verb->add_option("--progress", options->progress, "auto, plain or none [auto]")
      ->transform(one_of({{"auto", number_of(ProgressStyle::plain)},
                          {"plain", number_of(ProgressStyle::plain)},
                          {"none", number_of(ProgressStyle::none)}}));
  return [options, range, mixed] {
    if (!range->empty()) options->range = parse_range(*range);
    if (*mixed) options->builds = schema::Builds::mixed;
    return run_search(*options);
  };
}

Action add_status(CLI::App& app) {
  auto* verb = app.add_subcommand("status", "how far a campaign is, and what it found");
  verb->footer("Example:\n  misalign status results/miura-6x6-1a2b3c4d.db --at 160");
  auto path = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false), check = std::make_shared<bool>(false);
  auto at_deg = std::make_shared<std::optional<double>>();
  verb->add_option("CATALOGUE", *path, "catalogue file")->required();
  verb->add_flag("--json", *json, "as JSON");
  verb->add_flag("--check", *check, "exit with 75 while work remains, 0 when complete");
  verb->add_option("--at", *at_deg, "also count what deploys from this many degrees");
  return [=] {
    const auto database = schema::open_for_reading(*path);
    const schema::CatalogueState state = schema::read_state(*database);
    std::optional<DeployingFrom> deploying;
    if (*at_deg) {
      deploying = deploying_from(*database, schema::read_campaign_of(*database, *path), **at_deg);
    }
    if (*json) {
      Json answer = status_json(state);
      if (deploying) answer["at"] = deploying_json(*deploying, state);
      std::puts(answer.dump(1).c_str());
    } else {
      std::fputs(status_text(state).c_str(), stdout);
      if (deploying) std::fputs(deploying_text(*deploying, state).c_str(), stdout);
    }
    return *check && !state.gaps.empty() ? schema::kExitWorkRemains : 0;
  };
}

Action add_fold(CLI::App& app) {
  auto* verb = app.add_subcommand("fold", "the folding path of one pattern");
  verb->footer(
      "Example:\n  misalign fold search/patterns/table1.json --json > table1-folding.json");
  auto options = std::make_shared<FoldOptions>();
  verb->add_option("PATTERN", options->pattern_path, "pattern file (JSON)")->required();
  verb->add_option("--to", options->to_deg, "last pilot angle, degrees [180]")
      ->check(within(1, 180));
  verb->add_option("--step", options->step_deg, "look at multiples of this too, degrees")
      ->check(within(0.01, 180));
  verb->add_flag("--json", options->json, "as JSON");
  return [options] {
    fold(*options);
    return 0;
  };
}

Action add_perforations(CLI::App& app) {
  auto* verb = app.add_subcommand("perforations", "which holes leave one degree of freedom");
  verb->footer(
      "Lists every set of inner panels, no two sharing an edge, that counts to one degree of\n"
      "freedom and has one by the rank of the Jacobian. The pattern's own holes do not matter.\n"
      "Example:\n  misalign perforations search/patterns/turned-quads-6x6.json");
  auto options = std::make_shared<PerforationsOptions>();
  verb->add_option("PATTERN", options->pattern_path, "pattern file (JSON)")->required();
  verb->add_flag("--json", options->json, "as JSON");
  return [options] {
    list_perforations(*options);
    return 0;
  };
}

Action add_replay(CLI::App& app) {
  auto* verb = app.add_subcommand("replay", "any draw of a campaign again, from its number");
  verb->footer("Example:\n  misalign replay results/miura-6x6-1a2b3c4d.db 1234");
  auto options = std::make_shared<ReplayOptions>();
  verb->add_option("CATALOGUE", options->catalogue_path, "catalogue file")->required();
  verb->add_option("DRAW", options->draw, "number of the draw")
      ->required()
      ->check(CLI::Range(std::uint64_t{0}, schema::kEndOfDraws));
  verb->add_flag("--json", options->json, "as JSON");
  return [options] {
    replay(*options);
    return 0;
  };
}

Action add_query(CLI::App& app) {
  auto* verb = app.add_subcommand("query", "a named query, or any read-only SQL");
  verb->footer("Named queries: " + schema::named_query_list() +
               "\nExamples:\n  misalign query results/miura-6x6-1a2b3c4d.db best\n"
               "  misalign query results/miura-6x6-1a2b3c4d.db "
               "\"SELECT draw FROM candidates WHERE stroke_max < 0.08\" --csv");
  auto path = std::make_shared<std::string>(), sql = std::make_shared<std::string>("best");
  auto json = std::make_shared<bool>(false), csv = std::make_shared<bool>(false);
  verb->add_option("CATALOGUE", *path, "catalogue file")->required();
  verb->add_option("QUERY", *sql, "name or SQL [best]");
  auto* json_flag = verb->add_flag("--json", *json, "as JSON");
  verb->add_flag("--csv", *csv, "as CSV")->excludes(json_flag);
  return [=] {
    const auto database = schema::open_for_reading(*path);
    const std::string named = schema::named_query(*sql);
    const auto style = *json  ? schema::TableStyle::json
                       : *csv ? schema::TableStyle::csv
                              : schema::TableStyle::aligned;
    std::fputs(schema::query_table(*database, named.empty() ? *sql : named, style).c_str(), stdout);
    return 0;
  };
}

Action add_export(CLI::App& app) {
  auto* verb = app.add_subcommand("export", "chosen candidates as files");
  verb->footer(
      "Examples:\n  misalign export results/miura-6x6-1a2b3c4d.db --best 3 --output out\n"
      "  misalign export results/miura-6x6-1a2b3c4d.db --sqlite-compat --output plain.db");
  auto options = std::make_shared<ExportOptions>();
  verb->add_option("CATALOGUE", options->catalogue_path, "catalogue file")->required();
  auto* choice = verb->add_option_group("choice", "which candidates");
  const auto count = CLI::Range(std::uint64_t{0}, schema::kEndOfDraws);
  choice->add_option("--draw", options->draw, "this one")->check(count);
  choice->add_option("--best", options->best, "so many, the best first")->check(count);
  choice->add_option("--where", options->where, "those for which this SQL condition holds");
  auto compat = std::make_shared<bool>(false);
  choice->add_flag("--sqlite-compat", *compat,
                   "the whole catalogue, as one file that SQLite from 3.7 on can read");
  choice->require_option(1);
  verb->add_option("--by", options->by, "column that --best sorts by [deploys_from_deg]");
  verb->add_option("--format", options->format, "json or csv [json]")
      ->check(CLI::IsMember({"json", "csv"}));
  verb->add_option("--output", options->output,
                   "directory, made if it is not there; with --sqlite-compat a new file")
      ->required();
  return [options, compat] {
    if (*compat) {
      schema::export_plain(*schema::open_for_reading(options->catalogue_path), options->output);
      std::puts(options->output.c_str());
    } else {
      export_candidates(*options);
    }
    return 0;
  };
}

Action add_verify(CLI::App& app) {
  auto* verb = app.add_subcommand("verify", "a catalogue's ledger, and its candidates once more");
  verb->footer(
      "Checks the file, every unit's candidates and the digest; follows the chosen candidates' "
      "paths\n"
      "again from their stored displacements and compares every column; checks each folded shape "
      "by\n"
      "its coordinates. Panels that cross are reported (they are assumed not to), and no fault.\n"
      "Exit code 6 if anything differs.\n"
      "Examples:\n  misalign verify results/miura-6x6-1a2b3c4d.db\n"
      "  misalign verify results/miura-6x6-1a2b3c4d.db --all --json");
  auto path = std::make_shared<std::string>();
  auto sample = std::make_shared<std::uint64_t>(100);
  auto all = std::make_shared<bool>(false), json = std::make_shared<bool>(false);
  verb->add_option("CATALOGUE", *path, "catalogue file")->required();
  auto* sample_option = verb->add_option("--sample", *sample,
                                         "so many candidates, spread evenly over them in the order "
                                         "of their draws [100]");
  sample_option->check(CLI::Range(std::uint64_t{0}, schema::kEndOfDraws));
  verb->add_flag("--all", *all, "every candidate")->excludes(sample_option);
  verb->add_flag("--json", *json, "as JSON");
  return [=] {
    const auto database = schema::open_for_reading(*path);
    const Verification verification =
        verify(*database, *path, *all ? std::nullopt : std::optional(*sample));
    std::fputs(*json ? (verification_json(verification).dump(1) + "\n").c_str()
                     : verification_text(verification).c_str(),
               stdout);
    return verification.good() ? 0 : schema::kExitCheckFailed;
  };
}

Action add_merge(CLI::App& app) {
  auto* verb = app.add_subcommand("merge", "catalogues of one campaign into one");
  verb->footer(
      "Draws that several of them have are compared (displacements and samples exactly, metrics\n"
      "within the tolerances of verify) and counted once; parts of units that overlap others are\n"
      "computed again. Exit code 6, and no file, if anything differs.\n"
      "Example:\n  misalign merge all.db part-1.db part-2.db");
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
    constexpr std::size_t kShown = 20;
    for (std::size_t k = 0; k < std::min(report.findings.size(), kShown); ++k) {
      spdlog::error("{}", report.findings[k].sentence);
    }
    if (!report.findings.empty()) {
      spdlog::error("{} findings; {} was not written", report.findings.size(), options->output);
      return schema::kExitCheckFailed;
    }
    const auto merged = schema::open_for_reading(options->output);
    const schema::CatalogueState state = schema::read_state(*merged);
    std::printf(
        "%s: %zu catalogues, %zu units taken, %llu draws compared, %llu computed again, %llu "
        "decided; %llu draws, %llu accepted, digest %s\n",
        options->output.c_str(), options->inputs.size(), report.units,
        static_cast<unsigned long long>(report.compared),
        static_cast<unsigned long long>(report.recomputed),
        static_cast<unsigned long long>(report.decided),
        static_cast<unsigned long long>(state.draws_in_ledger),
        static_cast<unsigned long long>(state.accepted), state.digest.c_str());
    return 0;
  };
}

Action add_tolerance(CLI::App& app) {
  auto* verb =
      app.add_subcommand("tolerance", "how many miscut copies of a candidate still deploy");
  verb->footer(
      "Every vertex, of the perimeter too, is moved by a random error, uniform on [-MM, MM] in x "
      "and\n"
      "in y; then each vertex alone. Trial t makes the same errors for every candidate of a "
      "campaign:\n"
      "they are numbers of the campaign's seed and of t. The intervals are exact ones of 95 %.\n"
      "Example:\n"
      "  misalign tolerance results/miura-6x6-1a2b3c4d.db 1234 --amplitude 0.05 --trials 1000");
  auto path = std::make_shared<std::string>();
  auto draw = std::make_shared<std::uint64_t>(), trials = std::make_shared<std::uint64_t>(1000);
  auto amplitude_mm = std::make_shared<double>();
  auto json = std::make_shared<bool>(false);
  verb->add_option("CATALOGUE", *path, "catalogue file")->required();
  verb->add_option("DRAW", *draw, "number of the candidate's draw")
      ->required()
      ->check(CLI::Range(std::uint64_t{0}, schema::kEndOfDraws));
  verb->add_option("--amplitude", *amplitude_mm, "largest error, mm")
      ->required()
      ->check(within(0, 1e6));
  verb->add_option("--trials", *trials, "copies with every vertex off its place [1000]")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100000000}));
  verb->add_flag("--json", *json, "as JSON");
  return [=] {
    const auto database = schema::open_for_reading(*path);
    const schema::Campaign campaign = schema::read_campaign_of(*database, *path);
    if (schema::read_candidate(*database, *draw).is_null()) {
      const std::string number = std::to_string(*draw);
      throw UserError(schema::kExitUsage, *path + ": draw " + number +
                                              " is no candidate; `misalign replay " + *path + " " +
                                              number + "` shows what became of it");
    }
    const Tolerance tolerance = study_tolerance(campaign, *draw, *amplitude_mm, *trials,
                                                solver::available_instruction_sets().back());
    std::fputs(*json ? (tolerance_json(tolerance).dump(1) + "\n").c_str()
                     : tolerance_text(tolerance).c_str(),
               stdout);
    return 0;
  };
}

Action add_config(CLI::App& app) {
  auto* verb = app.add_subcommand("config", "the default campaign, or every fault of a file");
  verb->footer(
      "Examples:\n  misalign config --default > mine.json\n"
      "  misalign config --check mine.json");
  auto checked = std::make_shared<std::string>();
  auto show = std::make_shared<bool>(false);
  auto* choice = verb->add_option_group("choice", "");
  choice->add_flag("--default", *show, "print the default campaign with every key");
  choice->add_option("--check", *checked, "say what is wrong with a campaign file");
  choice->require_option(1);
  return [=] {
    if (*show) {
      std::puts(schema::campaign_json(schema::default_campaign()).dump(2).c_str());
      return 0;
    }
    const schema::Campaign campaign = schema::read_campaign_file(*checked);
    std::printf("%s: good; catalogue %s\n", checked->c_str(),
                default_catalogue_path(campaign).c_str());
    return 0;
  };
}

Action add_doctor(CLI::App& app) {
  auto* verb = app.add_subcommand("doctor", "whether this machine can run a campaign well");
  verb->footer(
      "Looks at random numbers, verdicts in all registers, MPI and its slots, and the directory "
      "for\n"
      "catalogues. Exit code 1 if a campaign would fail, or could not be trusted.\n"
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
      ->check(CLI::Range(0.01, 1e6));
  verb->add_option(
          "--agree", options->agree_draws,
          "instead of speed: the verdicts of so many draws, each against the reference's at "
          "thresholds of every tenth degree, at its own D and one sample above")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100000000}));
  verb->add_flag("--json", options->json, "as JSON");
  return [options] { return bench(*options) ? 0 : schema::kExitCheckFailed; };
}

// CLI11's sentence with the contract's exit code.
int usage_error(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
  if (launched_rank() == 0) {
    std::fprintf(stderr, "misalign: %s; see misalign --help, or a verb's own\n", error.what());
  }
  return schema::kExitUsage;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app("Searches for misaligned origami that simple springs deploy.", "misalign");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.fallthrough();
  std::string level = "info";
  app.add_option("--log-level", level, "debug, info, warning, error or off [info]")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
  std::map<std::string, Action> verbs = {
      {"search", add_search(app)},       {"status", add_status(app)},
      {"fold", add_fold(app)},           {"perforations", add_perforations(app)},
      {"replay", add_replay(app)},       {"query", add_query(app)},
      {"export", add_export(app)},       {"verify", add_verify(app)},
      {"merge", add_merge(app)},         {"config", add_config(app)},
      {"tolerance", add_tolerance(app)}, {"doctor", add_doctor(app)},
      {"bench", add_bench(app)}};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error);
  }
  set_up_log(level);
  const auto fail = [](const std::exception& error, int exit_code) {
    if (launched_rank() == 0) spdlog::error("{}", error.what());
    return exit_code;
  };
  try {
    const int exit_code = verbs.at(app.get_subcommands().front()->get_name())();
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
      throw UserError(schema::kExitFailure,
                      "the results could not be written to standard output (is the disk full?)");
    }
    return exit_code;
  } catch (const UserError& error) {
    return fail(error, error.exit_code());
  } catch (const std::exception& error) {
    return fail(error, schema::kExitFailure);
  }
}

}  // namespace misalign::search
