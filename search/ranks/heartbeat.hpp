// Detects lost ranks in a thread of its own, since a long path or a slow disk must not look like a
// lost host.
#pragma once

#include <atomic>
#include <thread>

#include "search/ranks/mpi_session.hpp"

namespace misalign::search {

/// Every rank sends rank 0 a beat every kBeat_s, and rank 0 every rank. Open MPI notices a cut link
/// only after 480 s.
inline constexpr double kBeat_s = 4, kSilence_s = 20;

class Heartbeat {
 public:
  /// Starts to send beats if there are several ranks.
  explicit Heartbeat(MpiSession& mpi);
  ~Heartbeat();
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// Returns whether a rank has been silent for kSilence_s. Rank 0 must then end within seconds;
  /// the others are ended.
  bool lost() const { return lost_; }

 private:
  void beat();

  MpiSession& mpi_;
  std::atomic<bool> lost_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace misalign::search
