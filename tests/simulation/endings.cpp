#include "tests/simulation/endings.hpp"

#include <algorithm>
#include <array>
#include <csignal>

#include "tests/simulation/told_file.hpp"

namespace misalign::simulation {
namespace {

// A signal of the story, or of mpirun after one of a rank's.
bool is_killed_by_story(const LifeEnd& end, const Planned& planned) {
  const bool is_under_mpirun = planned.life.ranks > 1;
  const bool by_launcher = is_under_mpirun && (planned.has_silence || planned.has_signal);
  if (end.was_killed()) return planned.has_kill || by_launcher || end.was_cut;
  // Once a search has begun it catches these.
  constexpr std::array kSignals = {SIGTERM, SIGINT, SIGHUP, SIGUSR1};
  return planned.has_signal && std::ranges::count(kSignals, end.code) > 0 &&
         !contains(end.err, "misalign: campaign ");
}

}  // namespace

bool says_complete(const LifeEnd& end, const std::string& file) {
  return !end.by_signal && contains(end.out, file + ": complete, ");
}

bool ended_early(const LifeEnd& end, const Planned& planned, const std::string& file) {
  const bool says_so = contains(end.out, file + ": stopped, ") ||
                       contains(end.out, file + ": max_time, ") ||
                       contains(end.err, "stopped before any work was done");
  const bool was_asked = planned.has_signal || planned.has_max_time;
  const int stopped_exit = planned.has_stopped_exit ? kStoppedExit : 0;
  return !end.by_signal && says_so && was_asked &&
         (end.code == stopped_exit || planned.life.ranks > 1);
}

std::string unexplained(const LifeEnd& end, const Planned& planned,
                        const Circumstances& circumstances, const std::string& file) {
  const bool is_under_mpirun = planned.life.ranks > 1;
  if (end.by_signal) {
    return is_killed_by_story(end, planned) ? "" : "ended by a signal of nobody";
  }
  constexpr double kLongestStop_s = 5;
  const bool must_stop = planned.has_signal && !planned.is_drain && planned.life.ranks == 1;
  if (must_stop && end.stop_s > kLongestStop_s) return "a stop that takes too long";
  if (says_complete(end, file)) {
    const bool may_fail = end.errors > 0 || planned.has_signal || planned.has_silence;
    return end.code == 0 || may_fail ? "" : "complete, with an error";
  }
  if (ended_early(end, planned, file)) return "";
  if (!contains(end.err, "misalign: ")) return "no sentence";
  const bool is_left = planned.is_asked_twice || is_under_mpirun;
  if (planned.has_signal && is_left && end.code > 128) return "";
  const bool has_cause = end.errors > 0 || circumstances.was_taken_away || planned.has_silence ||
                         circumstances.lost_index || (is_under_mpirun && planned.has_signal);
  if (end.code == 1 && has_cause) return "";
  if (end.code == 4 && circumstances.was_locked) return "";
  const bool is_gone = circumstances.was_taken_away && contains(end.err, "there is no such file");
  return end.code == 3 && is_gone ? "" : "unexplained";
}

}  // namespace misalign::simulation
