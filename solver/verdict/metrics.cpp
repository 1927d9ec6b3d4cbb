#include "solver/verdict/metrics.hpp"

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
  const Eigen::Vector2d out = vertices_mm.col(v[(at + 1) % 4]) - vertices_mm.col(vertex);
  const Eigen::Vector2d in = vertices_mm.col(v[(at + 3) % 4]) - vertices_mm.col(vertex);
  return std::atan2(out.x() * in.y() - out.y() * in.x(), out.dot(in)) / kRadPerDeg;
}

// Rows of the history that are samples up to D, in order.
std::vector<Eigen::Index> rows_up_to(const FoldingHistory& history) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < history.stations.size(); ++i) {
    const int sample = history.stations[i].sample;
    if (sample > 0 && sample <= history.verdict.deploys_from_sample) {
      rows.push_back(static_cast<Eigen::Index>(i));
    }
  }
  return rows;
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
    const double opposite = corner_angle_deg(base.sheet, vertices_mm, ring[0], v) +
                            corner_angle_deg(base.sheet, vertices_mm, ring[2], v);
    worst = std::max(worst, std::abs(opposite - 180));
  }
  return worst;
}

Metrics measure(const PerforatedSheet& base, const FlatVertices& vertices_mm,
                const FoldingHistory& history, double sample_deg) {
  const std::vector<Eigen::Index> rows = rows_up_to(history);
  assert(!rows.empty());
  Metrics m{};
  m.deploys_from_sample = history.verdict.deploys_from_sample;
  m.deploys_from_deg = m.deploys_from_sample * sample_deg;
  m.fold_limit_deg = history.path.fold_limit_deg;
  m.stroke_min = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < history.flat_mm.size(); ++d) {
    const double flat = history.flat_mm[d];
    double stroke = 0, previous = flat, elongation = 0;
    for (const Eigen::Index row : rows) {
      const double length = history.length_mm(row, static_cast<Eigen::Index>(d));
      elongation = (length - flat) / flat;
      m.elongation_min = std::min(m.elongation_min, elongation);
      m.elongation_max = std::max(m.elongation_max, elongation);
      stroke = std::max(stroke, std::abs(elongation));
      if (history.stations[row].pilot_deg >= kSlopeFrom_deg) {
        const double slope = std::abs(length - previous) / sample_deg;
        m.slope_min_mm_per_deg = std::min(m.slope_min_mm_per_deg.value_or(slope), slope);
      }
      previous = length;
    }
    m.stroke_min = std::min(m.stroke_min, stroke);
    m.stroke_max = std::max(m.stroke_max, stroke);
    m.stretch_sq_mm2 += (previous - flat) * (previous - flat);
    ++(elongation > 0 ? m.increasing : m.decreasing);
    m.elongation.push_back(elongation);
  }
  if (std::isfinite(history.between.least_slope)) {
    m.slope_between_min_mm_per_deg =
        history.between.least_slope * base.sheet.panel_width_mm * kRadPerDeg;
  }
  if (history.between.bump_where >= 0) m.bump_deg = history.between.bump_deg;
  m.miscut_margin_mm = history.miscut_margin_mm;
  m.singular_value_min = std::numeric_limits<double>::infinity();
  for (const Eigen::Index row : rows) {
    m.singular_value_min = std::min(m.singular_value_min, history.singular_value_min[row]);
    m.residual_max = std::max(m.residual_max, history.open_by[row]);
    m.isometry_error_mm = std::max(m.isometry_error_mm, history.isometry_error_mm[row]);
  }
  m.kawasaki_defect_deg = kawasaki_defect_deg(base, vertices_mm);
  for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
    if (vertices_mm.col(v) != base.sheet.vertices_mm.col(v)) ++m.shifted_vertices;
  }
  return m;
}

}  // namespace misalign::solver
