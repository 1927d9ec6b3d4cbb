#include "solver/certificate/conditions.hpp"

#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Upper bound of the slope of f's polynomial.
double steepest_of(const PathModel& f) {
  double steepest = 0;
  for (int k = 1; k <= kPathDegree; ++k) steepest += k * std::abs(f.c[k]);
  return kUp * steepest;
}

// Returns whether f > 0 on [from, to], by its value in the middle and its largest fall from there.
bool is_positive(const PathModel& f, double steepest, double from, double to) {
  assert(from <= to && -1 <= from && to <= 1 && "models are known there alone");
  const Ball middle(0.5 * (from + to));
  const Ball value = polynomial_at(f, middle);
  const double half = 0.5 * (to - from) + 4 * kUnit;
  return value.c[0] > kUp * (value.radius + f.radius + half * steepest);
}

}  // namespace

std::vector<Condition> conditions_of(const Mechanism& mechanism, const PathTube& tube,
                                     const std::vector<PathModel>& slopes,
                                     const std::vector<int>& directions) {
  std::vector<Condition> conditions;
  assert(slopes.size() == directions.size());
  for (std::size_t d = 0; d < slopes.size(); ++d) {
    conditions.push_back({CertificateEnd::reversal, static_cast<int>(d),
                          static_cast<double>(directions[d]) * slopes[d]});
  }
  for (int i = 0; i < static_cast<int>(mechanism.creases.size()); ++i) {
    if (i == mechanism.pilot) continue;
    const Crease& crease = mechanism.creases[i];
    const Chart::Crease& at = tube.chart.joints().creases[i];
    const PathModel x = tube.path[crease.column];
    conditions.push_back(
        {CertificateEnd::sign_changed, i,
         static_cast<double>(crease.assignment) * (PathModel(at.s) + at.s_rate * x)});
    if (tube.chart.is_graded()) continue;  // the cosine is 1 there
    conditions.push_back({CertificateEnd::over_folded, i, PathModel(at.c) + at.c_rate * x});
  }
  return conditions;
}

int sign_on(const PathModel& f, double from, double to) {
  const double steepest = steepest_of(f);
  return is_positive(f, steepest, from, to) ? 1 : is_positive(-f, steepest, from, to) ? -1 : 0;
}

double positive_until(const PathModel& f, double resolution) {
  assert(resolution > 0);
  const double steepest = steepest_of(f);
  return holds_until([&](double from, double to) { return is_positive(f, steepest, from, to); }, 1,
                     resolution);
}

bool is_negative_at_end(const PathModel& f) {
  const Ball value = polynomial_at(f, Ball(1.0));
  return value.c[0] < -(kUp * (value.radius + f.radius));
}

}  // namespace misalign::solver
