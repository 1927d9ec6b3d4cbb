#include "search/search_run.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "search/build_info.hpp"
#include "search/draw.hpp"
#include "search/stop_signal.hpp"
#include "search/worker.hpp"

namespace misalign::search {
namespace {

std::string host_name() {
  char name[256] = "unknown";
  gethostname(name, sizeof name - 1);
  return name;
}

schema::Campaign resolved_campaign(const SearchOptions& options) {
  if (!random_numbers_as_published()) {
    throw schema::UserError(schema::kExitFailure,
                            "the random-number generator does not give its published numbers (this "
                            "build is broken); build it again and run the tests");
  }
  schema::Campaign campaign = schema::read_campaign_file(options.campaign_path);
  if (options.seed) campaign.seed = *options.seed;
  if (options.accepted) campaign.stop.accepted = options.accepted;
  if (options.max_time_s) campaign.stop.wall_s = options.max_time_s;
  // A range asked for by hand is meant as a whole, unless --draws says otherwise.
  if (options.range || options.draws) campaign.stop.draws = options.draws;
  return campaign;
}

schema::Goal goal_of(const SearchOptions& options, const schema::Campaign& campaign) {
  schema::Goal goal;
  if (options.range) goal.range = *options.range;
  goal.draws = campaign.stop.draws;
  goal.accepted = campaign.stop.accepted;
  return goal;
}

void print_summary(const std::string& path, RunEnd end) {
  const auto database = schema::open_for_reading(path);
  const schema::CatalogueState state = schema::read_state(*database);
  const double rate = state.draws > 0 ? 100.0 * static_cast<double>(state.accepted) /
                                            static_cast<double>(state.draws)
                                      : 0.0;
  std::printf("%s: %s, %llu draws, %llu accepted (%.4g %%), %llu undecided, digest %s\n",
              path.c_str(), run_end_name(end), static_cast<unsigned long long>(state.draws),
              static_cast<unsigned long long>(state.accepted), rate,
              static_cast<unsigned long long>(state.undecided), state.digest.c_str());
}

// Rank 0 from the campaign's setup to the summary; throws UserError and SQLite::Exception.
void coordinate(const MpiSession& mpi, const SearchOptions& options, Trial& trial,
                const std::string& path, schema::Catalogue& catalogue) {
  const schema::Campaign& campaign = trial.campaign();
  const schema::Goal goal = goal_of(options, campaign);
  const BuildInfo& build = build_info();
  catalogue.begin_run({host_name(), build.version, build.commit, build.compiler, build.flags,
                       golden_verdicts(), mpi.ranks()},
                      goal);
  spdlog::info("campaign {} ({}), {} ranks, catalogue {}", campaign.name,
               schema::identity(campaign).substr(0, 8), mpi.ranks(), path);
  CoordinatorOptions settings;
  settings.unit_draws = options.unit_draws;
  settings.max_time_s = campaign.stop.wall_s;
  settings.progress = options.progress;
  const RunEnd end = run_coordinator(mpi, trial, catalogue, goal, settings);
  catalogue.end_run(run_end_name(end));
  print_summary(path, end);
}

int fail(const std::exception& error, int exit_code) {
  spdlog::error("{}", error.what());
  return exit_code;
}

}  // namespace

std::string default_catalogue_path(const schema::Campaign& campaign) {
  return "results/" + campaign.name + "-" + schema::identity(campaign).substr(0, 8) + ".db";
}

int run_search(const SearchOptions& options) {
  const MpiSession mpi;
  watch_for_stop_signals();
  if (mpi.rank() > 0) {
    // Rank 0 alone reads files: here is its exit code, then the campaign it resolved.
    if (const int exit_code = mpi.broadcast(0)) return exit_code;
    const std::string resolved = mpi.broadcast(std::string());
    try {
      Trial trial(schema::read_campaign(schema::Json::parse(resolved), "the campaign of rank 0"),
                  options.instruction_set);
      run_worker(mpi, trial);
      return 0;
    } catch (const std::exception& error) {
      mpi.abort(fail(error, schema::kExitFailure));  // rank 0 would wait for ever
    }
  }
  std::optional<Trial> trial;
  std::optional<schema::Catalogue> catalogue;
  std::string path;
  int exit_code = 0;
  try {
    trial.emplace(resolved_campaign(options), options.instruction_set);
    path = options.catalogue_path.empty() ? default_catalogue_path(trial->campaign())
                                          : options.catalogue_path;
    if (options.catalogue_path.empty()) {
      std::error_code ignored;  // opening the catalogue says what is wrong
      std::filesystem::create_directories("results", ignored);
    }
    catalogue.emplace(path, trial->campaign(), trial->mechanism());
  } catch (const schema::UserError& error) {
    exit_code = fail(error, error.exit_code());
  } catch (const std::exception& error) {
    exit_code = fail(error, schema::kExitFailure);
  }
  mpi.broadcast(exit_code);
  if (exit_code != 0) return exit_code;
  mpi.broadcast(schema::campaign_json(trial->campaign()).dump());
  try {
    coordinate(mpi, options, *trial, path, *catalogue);
    return 0;
  } catch (const schema::UserError& error) {
    exit_code = fail(error, error.exit_code());
  } catch (const std::exception& error) {
    exit_code = fail(error, schema::kExitFailure);
  }
  if (mpi.ranks() > 1) mpi.abort(exit_code);
  return exit_code;
}

}  // namespace misalign::search
