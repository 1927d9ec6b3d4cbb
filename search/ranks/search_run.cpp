#include "search/ranks/search_run.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/files/file_name.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/golden_verdicts.hpp"
#include "search/ranks/campaign_run.hpp"
#include "search/ranks/climb_task.hpp"
#include "search/ranks/departure.hpp"
#include "search/ranks/draw_task.hpp"
#include "search/ranks/piece_messages.hpp"
#include "search/ranks/run_info.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/terminal/count_text.hpp"
#include "search/terminal/ladder_text.hpp"
#include "search/terminal/nothing_found.hpp"
#include "search/terminal/screen.hpp"
#include "search/terminal/status_text.hpp"
#include "search/terminal/terminal.hpp"

namespace misalign::search {
namespace {

// UserError (bad_request) if an option counts draws where the campaign counts populations, or the
// reverse.
void check_counts(const SearchOptions& options, const schema::Campaign& campaign) {
  const auto refuse = [](const char* name, const char* why, const std::string& instead) {
    throw schema::UserError(solver::OptionFault{name, {}, why, instead});
  };
  if (campaign.search.splitting && options.draws) {
    refuse("draws", "this campaign splits, and counts populations",
           "give " + schema::parameter("populations", "N"));
  }
  if (campaign.search.splitting && options.unit_draws) {
    refuse("unit_draws", "this campaign splits, and divides its work by time", "omit it");
  }
  if (!campaign.search.splitting && options.populations) {
    refuse("populations", "this campaign makes plain draws",
           "give " + schema::parameter("draws", "N"));
  }
  if (campaign.search.splitting && options.range && options.range->hi > schema::kEndOfPopulations) {
    refuse("range", "populations are numbered below 922337203", "try 0:100");
  }
}

schema::Campaign resolved_campaign(const SearchOptions& options) {
  if (!random_numbers_as_published()) {
    throw schema::UserError(schema::Cause::failure,
                            "the random-number generator does not reproduce its published numbers "
                            "(this build is broken); build it again and run the tests");
  }
  schema::Campaign campaign = schema::read_campaign_file(options.campaign_path);
  if (options.seed) campaign.seed = *options.seed;
  if (options.accepted) campaign.stop.accepted = options.accepted;
  if (options.relative_error) campaign.stop.relative_error = options.relative_error;
  if (options.max_time_s) campaign.stop.wall_s = options.max_time_s;
  // A given range counts as a whole, unless --draws limits it.
  if (options.range || options.draws) campaign.stop.draws = options.draws;
  if (options.range || options.populations) campaign.stop.populations = options.populations;
  check_counts(options, campaign);
  need_part(!campaign.certify || options.parts.certifier, "certifies nothing");
  need_part(!campaign.search.has_ends() || options.parts.ascend, "does not optimise");
  return campaign;
}

schema::Goal goal_of(const SearchOptions& options, const schema::Campaign& campaign) {
  schema::Goal goal;
  if (options.range) goal.range = *options.range;
  if (campaign.search.splitting) {
    goal.range =
        schema::numbers_of(options.range.value_or(schema::DrawRange{0, schema::kEndOfPopulations}));
    if (campaign.stop.populations)
      goal.draws = *campaign.stop.populations * schema::kNumbersOfPopulation;
    goal.relative_error = campaign.stop.relative_error;
    goal.of_populations = true;
    return goal;
  }
  goal.draws = campaign.stop.draws;
  goal.accepted = campaign.stop.accepted;
  goal.relative_error = campaign.stop.relative_error;
  return goal;
}

std::string place_of(const SearchOptions& options, const schema::Campaign& campaign) {
  if (!options.catalogue_path.empty()) return options.catalogue_path;
  std::error_code ignored;  // opening the catalogue reports the fault
  std::filesystem::create_directories("results", ignored);
  return default_catalogue_path(campaign);
}

// One rank's workspace for plain draws or for populations.
struct SearchWorkspace {
  static RankInfo info(const SearchOptions& options, const schema::Campaign& campaign) {
    return {host_name(), message_layout(),
            fingerprint(campaign, golden_verdicts(options.instruction_set), options.parts)};
  }

  SearchWorkspace(schema::Campaign its_campaign, const SearchOptions& options)
      : most_bytes(options.unit_bytes), campaign(std::move(its_campaign)) {
    if (campaign.search.splitting) {
      climber.emplace(campaign, options.instruction_set, options.parts);
    } else {
      evaluator.emplace(campaign, options.instruction_set, options.parts);
    }
  }

  const solver::Mechanism& mechanism() const {
    return climber ? climber->mechanism() : evaluator->mechanism();
  }

  void work(const MpiSession& mpi) {
    const auto send = [](auto& work, bool was_stopped) { return pack({work.take(), was_stopped}); };
    if (climber) {
      run_worker(
          mpi, [&](const Bytes& job) { return climber->start(unpack_order(job)); }, send);
      return;
    }
    const auto start = [&](const Bytes& job) {
      return UnitWork(*evaluator, unpack_range(job), schema::FaultSampleRule(), most_bytes);
    };
    run_worker(mpi, start, send);
  }

  const std::size_t most_bytes;
  const schema::Campaign campaign;
  std::optional<DrawEvaluator> evaluator;
  std::optional<Climber> climber;
};

// Judges undecided draws again.
void retry_undecided(DrawEvaluator& evaluator, schema::Catalogue& catalogue) {
  const std::vector<std::uint64_t> draws = catalogue.undecided();
  std::size_t decided = 0;
  for (const std::uint64_t draw : draws) {
    if (stop_request() != StopRequest::none) break;
    const schema::UnitRecord unit = [&] {
      const MayBeLeft computing;
      return judge_again(evaluator, draw);
    }();
    if (!unit.undecided.empty()) continue;
    catalogue.settle(unit);
    ++decided;
  }
  spdlog::info("{} of {} undecided draws are decided now", decided, draws.size());
}

SearchWorkspace made_ready(const SearchOptions& options) {
  const MayBeLeft computing;
  return {resolved_campaign(options), options};
}

void warn_of_network(const std::string& path) {
  spdlog::warn(
      "{}: is on a shared file system ({}), where a write-ahead log is not safe: a rollback "
      "journal and an exclusive lock are used, and status and query must wait until this run ends",
      path, schema::file_system_of(path).name);
}

// Private to rank 0 of a search: the catalogue, the coordinator and the progress.
class SearchZero {
 public:
  using Workspace = SearchWorkspace;

  explicit SearchZero(const SearchOptions& options)
      : options_(options),
        ready_(made_ready(options)),
        path_(schema::end_of_links(place_of(options, campaign()))),
        goal_(goal_of(options, campaign())) {
    if (!options.retry_undecided && schema::holds_all(path_, campaign(), goal_)) return;
    catalogue_.emplace(path_, campaign(), ready_.mechanism(), options.storage);
    if (catalogue_->storage() == schema::Storage::network) warn_of_network(path_);
  }

  const schema::Campaign& campaign() const { return ready_.campaign; }

  void begin(const std::vector<RankInfo>& ranks) {
    const std::string verdicts = common_verdicts(ranks, options_.builds);
    if (catalogue_) {
      catalogue_->begin_run(run_info(verdicts, static_cast<int>(ranks.size())), goal_,
                            options_.builds);
      has_begun_ = true;
    }
    spdlog::info("campaign {} ({}), {}, catalogue {}{}", campaign().name,
                 schema::identity(campaign()).substr(0, 8), count_text(ranks.size(), "rank"), path_,
                 catalogue_ ? "" : ": already complete, nothing is written");
    for (const std::string& sentence : campaign().pattern.reading) {
      spdlog::info("{}: {}", options_.campaign_path, sentence);
    }
    // Whoever wrote a complete file may have been killed before it synced the directory.
    if (!catalogue_) return schema::sync_directory_of(path_);
    if (is_talkative() && !options_.command_for_all.empty()) {
      spdlog::info("using one core of {}; to use all: {}", usable_threads(),
                   options_.command_for_all);
    }
    if (options_.retry_undecided && ready_.evaluator)
      retry_undecided(*ready_.evaluator, *catalogue_);
  }

  // Returns the exit code.
  int run(const MpiSession& mpi, const Heartbeat& heartbeat) {
    if (!catalogue_) {
      for (int rank = 1; rank < mpi.ranks(); ++rank) mpi.send_job(rank, {});
      print_summary(end_);
      return 0;
    }
    CoordinatorOptions settings;
    settings.max_time_s = campaign().stop.wall_s;
    settings.progress = options_.progress;
    settings.tidy_up = [&] { catalogue_->fold_in(); };
    task_ = make_task(mpi.ranks());
    end_ = run_coordinator(mpi, heartbeat, *task_, settings);
    end_run();
    return end_ == RunEnd::lost ? options_.border.exit_code(schema::Cause::failure) : 0;
  }

  int conclude() const {
    const bool is_early = end_ == RunEnd::stopped || end_ == RunEnd::max_time;
    return is_early ? options_.border.stopped : 0;
  }

  int leave() {
    if (!has_begun_) {
      if (catalogue_) catalogue_->close();
      say_nothing_began();
      return options_.border.stopped;
    }
    spdlog::warn(
        "stopped without the draws under way, for lack of time; the same command makes them again");
    if (task_) task_->commit_all();
    end_ = task_ && task_->complete() ? RunEnd::complete : RunEnd::stopped;
    end_run();
    return conclude();
  }

 private:
  std::unique_ptr<RankTask> make_task(int ranks) {
    if (ready_.climber) {
      return std::make_unique<ClimbTask>(*ready_.climber, *catalogue_, goal_, ranks);
    }
    const DrawTaskOptions units{{options_.unit_draws}, options_.unit_bytes};
    return std::make_unique<DrawTask>(*ready_.evaluator, *catalogue_, goal_, ranks, units);
  }

  void end_run() {
    catalogue_->end_run(run_end_name(end_));
    const schema::CommitCost& cost = catalogue_->cost();
    spdlog::debug("{} commits in {:.3f} s, the longest {:.3f} s", cost.commits, cost.seconds,
                  cost.longest_s);
    print_summary(end_);
  }

  void print_summary(RunEnd end) const {
    const auto database = schema::open_for_reading(path_);
    const schema::CatalogueState state = schema::read_state(*database);
    const double rate = state.draws > 0 ? 100.0 * static_cast<double>(state.accepted) /
                                              static_cast<double>(state.draws)
                                        : 0.0;
    const std::string path = schema::printable(path_);
    if (state.ladder) {
      put("{}: {}, {}, digest {}\n", path, run_end_name(end), ladder_summary(state), state.digest);
    } else {
      put("{}: {}, {} draws, {} accepted ({:.4g} %), {} undecided, digest {}\n", path,
          run_end_name(end), state.draws, state.accepted, rate, state.undecided, state.digest);
    }
    std::fflush(stdout);
    if (is_talkative()) say_what_next(*database, state);
  }

  void say_what_next(SQLite::Database& database, const schema::CatalogueState& state) const {
    for (const std::string& sentence : nothing_found(database, state)) {
      spdlog::info("{}", sentence);
    }
    spdlog::info("next: {}", next_step(state, path_, options_.campaign_path));
  }

  bool is_talkative() const {
    return options_.progress != ProgressStyle::none && options_.progress != ProgressStyle::json;
  }

  const SearchOptions& options_;
  SearchWorkspace ready_;
  const std::string path_;
  const schema::Goal goal_;
  std::optional<schema::Catalogue> catalogue_;  // null if the file is complete already
  bool has_begun_ = false;                      // the run has a row
  std::unique_ptr<RankTask> task_;
  RunEnd end_ = RunEnd::complete;
};

}  // namespace

std::string default_catalogue_path(const schema::Campaign& campaign) {
  return "results/" + campaign.name + "-" + schema::identity(campaign).substr(0, 8) + ".db";
}

int run_search(const SearchOptions& given) {
  SearchOptions options = given;
  options.progress =
      resolved(given.progress, is_terminal(STDERR_FILENO) && terminal_is_able(), launched_by_mpi());
  return run_campaign<SearchZero>(options);
}

}  // namespace misalign::search
