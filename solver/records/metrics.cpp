#include "solver/records/metrics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

double corner_angle_deg(const CreasePattern& sheet, const FlatVertices& vertices_mm, int facet,
                        int vertex) {
  const auto& v = sheet.facets[facet];
  const auto at = std::find(v.begin(), v.end(), vertex) - v.begin();
  assert(at < 4);
  const Eigen::Vector2d out = vertices_mm.col(v[(at + 1) % 4]) - vertices_mm.col(vertex);
  const Eigen::Vector2d in = vertices_mm.col(v[(at + 3) % 4]) - vertices_mm.col(vertex);
  return std::atan2(out.x() * in.y() - out.y() * in.x(), out.dot(in)) / kRadPerDeg;
}

// Returns the critical friction from the threshold; none if the energy alone does not drive the
// sheet, or without a threshold.
std::optional<double> critical_friction(const Model& model, const FlatVertices& vertices_mm,
                                        const PathRecord& record) {
  const int from_sample = model.threshold_sample();
  const int in_order =
      std::min(record.verdict.deploys_from_sample, record.energy_deploys_from_sample);
  if (from_sample == 0 || in_order < from_sample) return {};
  // The ratio to a demanded friction of 1 is the friction.
  const Fill fill = model.criterion().without_margins().energy->fill;
  EnergyJudge judge(model.mechanism(), {fill, from_sample, 1});
  SheetGeometry<double> geometry;
  place(model.mechanism(), vertices_mm, geometry);
  judge.begin(record.flat, &geometry);
  std::vector<double> lengths(record.flat.size());
  for (int k = 1; k <= from_sample; ++k) {
    const auto row = static_cast<std::ptrdiff_t>(lengths.size()) * (k - 1);
    std::copy_n(record.lengths.begin() + row, lengths.size(), lengths.begin());
    judge.look(lengths);
    judge.set_turning(record.turning_mm[static_cast<std::size_t>(k - 1)]);
    if (k < from_sample) judge.take();
  }
  const double friction = judge.drive().value;
  return std::isfinite(friction) ? std::optional(friction) : std::nullopt;
}

}  // namespace

double kawasaki_defect_deg(const PerforatedSheet& base, const FlatVertices& vertices_mm) {
  double worst = 0;
  for (const int v : interior_vertices(base.sheet)) {
    const std::vector<int> ring = facets_around(base.sheet, v);
    const bool whole = std::none_of(ring.begin(), ring.end(), [&](int f) {
      return std::binary_search(base.holes.begin(), base.holes.end(), f);
    });
    if (!whole) continue;
    assert(ring.size() == 4);
    const double opposite = corner_angle_deg(base.sheet, vertices_mm, ring[0], v) +
                            corner_angle_deg(base.sheet, vertices_mm, ring[2], v);
    worst = std::max(worst, std::abs(opposite - 180));
  }
  return worst;
}

Metrics measure(const Model& model, const FlatVertices& vertices_mm, const PathRecord& record) {
  const PerforatedSheet& base = model.base();
  const double sample_deg = model.sample_deg();
  const int samples = record.verdict.deploys_from_sample;
  assert(samples > 0);
  const double width_mm = base.sheet.panel_width_mm;
  assert(vertices_mm.cols() == base.sheet.vertex_count() && sample_deg > 0);
  assert(record.lengths.size() >= static_cast<std::size_t>(samples) * record.flat.size());
  const bool needs_monotone = !model.criterion().energy;
  Metrics m{};
  m.deploys_from_sample = samples;
  m.deploys_from_deg = samples * sample_deg;
  m.fold_limit_deg = record.path.fold_limit_deg;
  m.stroke_min = std::numeric_limits<double>::infinity();
  const std::size_t diagonals = record.flat.size();
  for (std::size_t d = 0; d < diagonals; ++d) {
    const double flat = record.flat[d];
    double stroke = 0, previous = flat, elongation = 0;
    for (int k = 1; k <= samples; ++k) {
      const double length = record.lengths[static_cast<std::size_t>(k - 1) * diagonals + d];
      elongation = (length - flat) / flat;
      m.elongation_min = std::min(m.elongation_min, elongation);
      m.elongation_max = std::max(m.elongation_max, elongation);
      stroke = std::max(stroke, std::abs(elongation));
      if (needs_monotone && k * sample_deg >= kSlopeFrom_deg) {
        const double slope = std::abs(length - previous) * width_mm / sample_deg;
        m.slope_min_mm_per_deg = std::min(m.slope_min_mm_per_deg.value_or(slope), slope);
      }
      previous = length;
    }
    m.stroke_min = std::min(m.stroke_min, stroke);
    m.stroke_max = std::max(m.stroke_max, stroke);
    m.stretch_sq_mm2 += (previous - flat) * (previous - flat) * width_mm * width_mm;
    ++(elongation > 0 ? m.increasing : m.decreasing);
    m.elongation.push_back(elongation);
  }
  if (needs_monotone && std::isfinite(record.extremes.least_slope)) {
    m.slope_between_min_mm_per_deg = record.extremes.least_slope * width_mm * kRadPerDeg;
  }
  m.bump_deg = record.extremes.bump_deg;
  m.reverses_at_deg = record.extremes.reverses_deg;
  if (needs_monotone) m.miscut_margin_mm = record.miscut_margin_mm;
  m.singular_value_min = record.singular_value_min;
  m.residual_max = record.residual_max;
  m.isometry_error_mm = record.isometry_error * width_mm;
  m.energy_deploys_from_sample = record.energy_deploys_from_sample;
  m.energy_deploys_from_deg = record.energy_deploys_from_sample * sample_deg;
  m.critical_friction_n_mm_per_mm = critical_friction(model, vertices_mm, record);
  m.kawasaki_defect_deg = kawasaki_defect_deg(base, vertices_mm);
  for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
    if (vertices_mm.col(v) != base.sheet.vertices_mm.col(v)) ++m.shifted_vertices;
  }
  return m;
}

}  // namespace misalign::solver
