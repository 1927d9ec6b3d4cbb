// Detects lost ranks, in a thread of its own: neither a long path nor a slow disk may look like a
// lost host.
#pragma once

#include <atomic>
#include <thread>

#include "search/ranks/mpi_session.hpp"

namespace misalign::search {

/// Every rank sends rank 0 a beat every kBeat_s, and rank 0 every rank. Open MPI itself notices a
/// link that was cut after 480 s.
inline constexpr double kBeat_s = 4, kSilence_s = 20;

class Heartbeat {
 public:
  /// Beats from now on, if there is more than one rank.
  explicit Heartbeat(MpiSession& mpi);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// Whether some rank has been silent for kSilence_s. Rank 0 is to end then, within seconds, the
  /// others are ended.
  bool lost() const { return lost_; }

 private:
  void beat();

  MpiSession& mpi_;
  std::atomic<bool> lost_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace misalign::search
