// Runs one campaign on all ranks: rank 0 opens its catalogue, all prepare the campaign and report
// their builds, work until rank 0 has enough, and meet.
#pragma once

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue.hpp"
#include "search/ranks/departure.hpp"
#include "search/ranks/heartbeat.hpp"
#include "search/ranks/mpi_session.hpp"
#include "search/ranks/rank_starter.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/terminal/failure.hpp"

namespace misalign::search {

/// Host and build of a rank, which rank 0 compares.
struct RankInfo {
  std::string host;
  std::string layout;                ///< layout of its messages
  std::string golden_verdicts = {};  ///< empty if they are not compared
};

/// UserError (foreign) if a rank sends its results in another layout.
void expect_one_layout(const std::vector<RankInfo>& ranks);
/// Returns on rank 0 the information of all ranks, in their order and of one layout; elsewhere
/// nothing.
std::vector<RankInfo> gather_ranks(const MpiSession& mpi, const RankInfo& info);

/// Returns the golden verdicts of all ranks; UserError (foreign) if they differ and must not.
std::string common_verdicts(const std::vector<RankInfo>& ranks, schema::Builds builds);

/// Time that rank 0 waits for the others, see MpiSession::meet.
inline constexpr double kMeet_s = 0.8;

/// Warns that a signal came before a catalogue was opened.
void say_nothing_began();

/// UserError (bad_request) if this process is one of several tasks that MPI does not join: each
/// would make the same draws.
void expect_joined(const MpiSession& mpi);

/// Returns the exit code of `work`, 0 if it throws nothing; an exception is logged.
template <class Work>
int exit_code_of(const Border& border, const Work& work) {
  try {
    work();
    return 0;
  } catch (const std::exception& error) {
    const schema::UserError failure = failure_of(error);
    spdlog::error("{}", failure.sentence(border.name_parameter));
    return border.exit_code(failure.cause());
  }
}

// Rank 0 alone reads files. The others get its exit code and the resolved campaign, and its exit
// code again once every rank has sent its RankInfo.
template <class Zero, class Options>
int run_rank_zero(const Options& options, MpiSession& mpi) {
  std::optional<Zero> zero;
  const auto code_of = [&](auto work) { return exit_code_of(options.border, work); };
  // mpirun counts a rank that exits with 0 as done, and the others would wait for it.
  const int leave_code = has_starter() ? kLeftWithStarter : EXIT_FAILURE;
  Departure departure(
      launched_by_mpi() ? kPatience_s : kPatienceAlone_s, LeftFrom::safe_places, [&] {
        int exit_code = options.border.stopped;
        const int failure =
            code_of([&] { zero ? void(exit_code = zero->leave()) : say_nothing_began(); });
        if (failure) return failure;
        return mpi.ranks() > 1 ? leave_code : exit_code;
      });
  Heartbeat heartbeat(mpi);
  if (const int code = mpi.broadcast(code_of([&] { zero.emplace(options); }))) return code;
  mpi.broadcast(schema::campaign_json(zero->campaign()).dump());
  const auto wait_for_ranks = [&] {
    const MayBeLeft waiting;
    return gather_ranks(mpi, Zero::Workspace::info(options, zero->campaign()));
  };
  if (const int code = mpi.broadcast(code_of([&] { zero->begin(wait_for_ranks()); }))) return code;
  int exit_code = 0;
  const int failure = code_of([&] { exit_code = zero->run(mpi, heartbeat); });
  departure.told();
  if (failure) exit_code = failure;
  if (mpi.ranks() > 1 && exit_code) mpi.abort(exit_code);
  if (!mpi.meet(kMeet_s)) _exit(leave_code);
  return exit_code ? exit_code : zero->conclude();
}

template <class Workspace, class Options>
int run_other_rank(const Options& options, MpiSession& mpi) {
  Heartbeat heartbeat(mpi);
  if (const int code = mpi.broadcast(0)) return code;
  const std::string resolved = mpi.broadcast(std::string());
  int refused = 0;
  const int failure = exit_code_of(options.border, [&] {
    Workspace workspace(
        schema::read_campaign(schema::Json::parse(resolved), "the campaign of rank 0"), options);
    gather_ranks(mpi, Workspace::info(options, workspace.campaign));
    refused = mpi.broadcast(0);
    if (!refused) workspace.work(mpi);
  });
  if (failure) mpi.abort(failure);  // otherwise rank 0 would wait for ever
  if (!refused) mpi.meet();
  return refused;
}

/// Does jobs on a rank above 0 until an empty one comes. A job is cut short, and sent as far as it
/// is done, if a signal requests a stop, rank 0 has already sent the next job, or the results are
/// full. `begin` makes a job's work from its bytes (UnitWork, PieceWork); `end` makes a result's
/// bytes from the work and a flag: true if a signal stopped it.
template <class Begin, class End>
void run_worker(const MpiSession& mpi, const Begin& begin, const End& end) {
  for (;;) {
    const Bytes job = mpi.receive_job();
    if (job.empty()) return;
    auto work = begin(job);
    while (!work.finished() && !work.is_full() && stop_request() == StopRequest::none &&
           !mpi.job_waiting()) {
      work.run_next_block();
    }
    mpi.send_result(end(work, !work.finished() && !work.is_full()));
  }
}

/// Returns this rank's exit code. Rank 0 is a `Zero`(options), which opens the files: `campaign()`;
/// `begin(ranks)` once all are ready; `run(mpi, heartbeat)`, whose exit code ends every rank at
/// once if it is not 0; `conclude()` once all have met, with the exit code. Each other rank makes a
/// `Zero::Workspace`(campaign, options) and does jobs in `work(mpi)`; `info(options, campaign)`
/// describes it. If rank 0 MayBeLeft and was asked to leave, `leave()` commits what waits, says so
/// and returns the exit code, in another thread.
template <class Zero, class Options>
int run_campaign(const Options& options) {
  hold_signals();
  MpiSession mpi;
  watch_for_signals();
  if (!options.alone_is_meant) {
    if (const int code = exit_code_of(options.border, [&] { expect_joined(mpi); })) return code;
  }
  if (mpi.rank() > 0) {
    const Departure departure(kRelease_s, LeftFrom::anywhere, [] { return EXIT_FAILURE; });
    return run_other_rank<typename Zero::Workspace>(options, mpi);
  }
  tell_starter();
  return run_rank_zero<Zero>(options, mpi);
}

}  // namespace misalign::search
