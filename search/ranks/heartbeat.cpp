#include "search/ranks/heartbeat.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>

#include "schema/files/input.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

Heartbeat::Heartbeat(MpiSession& mpi) : mpi_(mpi) {
  if (mpi.ranks() > 1 && mpi.has_beats()) thread_ = std::thread([this] { beat(); });
}

Heartbeat::~Heartbeat() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void Heartbeat::beat() {
  constexpr auto kLook = std::chrono::milliseconds(50);
  constexpr double kGrace_s = 3;
  const Stopwatch watch;
  const int peers =
      mpi_.rank() == 0 ? mpi_.ranks() : 1;  // ranks below this number, except this rank
  std::vector<double> heard_s(peers, 0);
  double next_beat_s = 0, lost_s = 0;
  while (!stop_) {
    const double now_s = watch.seconds();
    while (const auto from = mpi_.receive_beat()) heard_s[*from] = now_s;
    if (now_s >= next_beat_s) {
      for (int peer = 0; peer < peers; ++peer) {
        if (peer != mpi_.rank()) mpi_.send_beat(peer);
      }
      next_beat_s = now_s + kBeat_s;
    }
    for (int peer = 0; peer < peers && !lost_; ++peer) {
      if (peer == mpi_.rank() || now_s - heard_s[peer] < kSilence_s) continue;
      spdlog::error(
          "rank {}: no message from rank {} for {} s (its host or the link to it is down); this "
          "rank ends, committed results are kept, and the same command resumes",
          mpi_.rank(), peer, kSilence_s);
      lost_s = now_s;
      lost_ = true;
    }
    // Rank 0 commits its results, but may hang in MPI.
    if (lost_ && (mpi_.rank() > 0 || now_s - lost_s > kGrace_s)) _exit(EXIT_FAILURE);
    std::this_thread::sleep_for(kLook);
  }
}

}  // namespace misalign::search
