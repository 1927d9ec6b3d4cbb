// Invents verdicts, metrics, optima and certificates: pure functions of a sheet's shifts, within
// microseconds, of realistic sizes and shares.
#pragma once

#include <span>

#include "search/draws/parts.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::simulation {

/// The draws' results, and the time of a full path.
struct Tempo {
  bool is_real = false;      ///< true: draws are judged as they are
  double mean_samples = 12;  ///< P(D > d) = exp(-d / mean_samples)
  int samples = 36;          ///< number on a path
  double undecided = 0.01;   ///< share of draws
  double path_s = 0.01;      ///< virtual time of one path
};

/// Sets it in this process, and in those that it forks from now on.
void set_tempo(const Tempo& tempo);

/// The verdict on a sheet with these shifts (mm, x and y of each shifted vertex in turn) and so
/// many diagonals.
solver::Verdict invented_verdict(std::span<const double> shifts_mm, int diagonals);

/// The parts of the program, of which one invents certificates.
search::Parts invented_parts();

}  // namespace misalign::simulation
