#include "solver/contact/spring_walk.hpp"

#include <algorithm>
#include <cassert>

#include "solver/model/panels.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

// The middle part of a line: `left_out` of it is missing at each end.
PolygonCorners middle_of(const Vector3d& from, const Vector3d& to, double left_out) {
  PolygonCorners middle(3, 2);
  middle << from + left_out * (to - from), to - left_out * (to - from);
  return middle;
}

}  // namespace

PolygonCorners SpringAxis::seen_from_panel(const PanelMotion& motion, int panel, double x) const {
  const PanelMotion::Pose frame = motion.pose(x, panel);
  const auto seen = [&](const End& end) {
    return seen_from(frame, motion.pose(x, end.panel), end.place_mm);
  };
  return middle_of(seen(ends[0]), seen(ends[1]), left_out);
}

PolygonCorners SpringAxis::rates_from_panel(const PanelMotion& motion, int panel, int node) const {
  const bool is_mirrored = node < 0;
  const int like = is_mirrored ? -1 - node : node;
  const auto rate = [&](const End& end) {
    Vector3d place_mm = end.place_mm;
    if (is_mirrored) place_mm.z() *= -1;
    return rate_seen_from(motion.at_node(like, panel), motion.at_node(like, end.panel), place_mm);
  };
  PolygonCorners rates = middle_of(rate(ends[0]), rate(ends[1]), left_out);
  if (is_mirrored) rates.topRows<2>() *= -1;  // the mirror image, the other way
  return rates;
}

SpringAxis spring_axis(const Mechanism& mechanism, const Panels& panels,
                       const SheetGeometry<double>& geometry, int diagonal, double end_mm) {
  const Diagonal& line = mechanism.diagonals[static_cast<std::size_t>(diagonal)];
  const Loop& loop = mechanism.loops[static_cast<std::size_t>(line.loop)];
  const auto end = [&](int corner) -> SpringAxis::End {
    const int facet = loop.carriers[static_cast<std::size_t>(corner)].facet;
    const Vec3<double> at = spring_end(mechanism, geometry, loop, corner);
    return {panels.panel_of(facet), mechanism.panel_width_mm * Vector3d(at.x, at.y, at.z)};
  };
  const SpringAxis::End first = end(line.from_corner), second = end(line.to_corner);
  const double left_out = end_mm / (second.place_mm - first.place_mm).norm();
  assert(left_out >= 0 && left_out < 0.5);
  return {diagonal, {first, second}, left_out};
}

double SpringWalk::move_to(double x) {
  x_ = x;
  if (other_) outline_ = other_->seen_from_panel(motion_, frame_, x);
  const PolygonCorners spring = spring_.seen_from_panel(motion_, frame_, x);
  const Separation separation = separation_of(outline_, spring);
  direction_ = separation.direction;
  const auto heights = direction_.transpose() * spring;
  if (other_) {
    gaps_mm_.resize(4);
    gaps_mm_ << heights.array() - direction_.dot(outline_.col(0)),
        heights.array() - direction_.dot(outline_.col(1));
  } else {
    gaps_mm_ = heights.array() - (direction_.transpose() * outline_).maxCoeff();
  }
  return std::max(gaps_mm_.minCoeff(), 0.0);
}

void SpringWalk::find_rates(int node, PolygonCorners& rates) const {
  rates = spring_.rates_from_panel(motion_, frame_, node);
  if (!other_) return;
  const PolygonCorners ends = rates, outline = other_->rates_from_panel(motion_, frame_, node);
  rates.resize(3, 4);
  rates << ends.colwise() - outline.col(0), ends.colwise() - outline.col(1);
}

}  // namespace misalign::solver
