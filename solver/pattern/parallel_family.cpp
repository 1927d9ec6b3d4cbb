#include "solver/pattern/parallel_family.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Shares of the base's fold range at which its path is tested.
constexpr std::array kSharesOfPath = {0.02, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 0.99};
// Conditions have entries of about 1; elimination leaves far smaller zeros.
constexpr double kLeastPivot = 1e-9;
// Mixed ratios are read where T is 1.
constexpr double kUnitPilot_deg = 90;

// Fold angles of a hole's four edges, each seen with the hole on its left.
std::array<HalfAngle<double>, 4> edge_angles(const CreasePattern& sheet, int hole,
                                             const BaseFolding& folding,
                                             const std::vector<HalfAngle<double>>& angles) {
  std::array<HalfAngle<double>, 4> around{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& corners = sheet.facets[static_cast<std::size_t>(hole)];
    const auto e = static_cast<std::size_t>(find_edge(sheet, corners[k], corners[(k + 1) % 4]));
    around[k] = angles[e];
    const bool negative = folding.assignment()[e] < 0;
    if (negative != (around[k].s < 0)) around[k].s = -around[k].s;
  }
  return around;
}

// The negative of an angle, for edges that are traversed backwards.
HalfAngle<double> opposite(const HalfAngle<double>& angle) { return {angle.c, -angle.s}; }

double apart_rad(const HalfAngle<double>& angle, const HalfAngle<double>& other) {
  return 2 * std::abs(half_sine_between(angle, other));
}

BaseHole shape_of(const CreasePattern& sheet, int facet) {
  BaseHole hole{};
  hole.facet = facet;
  hole.corners = sheet.facets[static_cast<std::size_t>(facet)];
  const auto corner = [&](std::size_t k) {
    return Eigen::Vector2d(sheet.vertices_mm.col(hole.corners[k]));
  };
  hole.a = corner(1) - corner(0);
  hole.b = corner(2) - corner(1);
  hole.a_mm = std::sqrt(hole.a.x() * hole.a.x() + hole.a.y() * hole.a.y());
  hole.b_mm = std::sqrt(hole.b.x() * hole.b.x() + hole.b.y() * hole.b.y());
  hole.a /= hole.a_mm;
  hole.b /= hole.b_mm;
  hole.cosine = hole.a.x() * hole.b.x() + hole.a.y() * hole.b.y();
  hole.sine = spanned_area(hole.a, hole.b);
  return hole;
}

// Tests the conditions on a hole along the path and fills in its ratios.
std::optional<NoParallelFamily> fold_hole(const PerforatedSheet& base, BaseHole& hole,
                                          double& misfit_rad) {
  using Cause = NoParallelFamily::Cause;
  const CreasePattern& sheet = base.sheet;
  const auto corner = [&](std::size_t k) {
    return Eigen::Vector2d(sheet.vertices_mm.col(hole.corners[k]));
  };
  const Eigen::Vector2d open = corner(1) - corner(0) + corner(3) - corner(2);
  const double off_mm = std::max(std::abs(open.x()), std::abs(open.y()));
  if (off_mm > kParallelogram_widths * sheet.panel_width_mm) {
    return NoParallelFamily{Cause::no_parallelogram, hole.facet, off_mm, 0};
  }
  const auto at = [&](double pilot_deg) {
    return edge_angles(sheet, hole.facet, base.folding,
                       base.folding.fold_angles(half_angle_of_deg(pilot_deg)));
  };
  const double end_deg = base.folding.end_deg();
  if (end_deg <= kUnitPilot_deg) {
    return NoParallelFamily{Cause::no_fixed_ratio, hole.facet, 180 - end_deg, end_deg};
  }
  const auto unit = at(kUnitPilot_deg);
  const double tan_a = unit[0].s / unit[0].c, tan_b = unit[1].s / unit[1].c;
  hole.a_ratio = tan_a * tan_a;
  hole.b_ratio = tan_b * tan_b;
  hole.mixed_ratio = tan_a * tan_b;
  for (const double share : kSharesOfPath) {
    const double pilot_deg = share * end_deg;
    const auto angles = at(pilot_deg);
    const HalfAngle<double> pilot = half_angle_of_deg(pilot_deg);
    for (std::size_t k = 0; k < 2; ++k) {
      const double turn = apart_rad(opposite(angles[k]), angles[k + 2]);
      const double ratio =
          apart_rad(angles[k], half_angle_of_ratio((k == 0 ? tan_a : tan_b) * pilot.s, pilot.c));
      misfit_rad = std::max({misfit_rad, turn, ratio});
      if (turn > kTurnsAlike_rad) {
        return NoParallelFamily{Cause::turns_apart, hole.facet, turn / kRadPerDeg, pilot_deg};
      }
      if (ratio > kTurnsAlike_rad) {
        return NoParallelFamily{Cause::no_fixed_ratio, hole.facet, ratio / kRadPerDeg, pilot_deg};
      }
    }
  }
  return std::nullopt;
}

// One condition or function of the shifts: a weight (x, y) for each vertex.
struct Term {
  int vertex;
  Eigen::Vector2d weight;
};
using Condition = std::vector<Term>;

std::vector<Condition> conditions_of(const PerforatedSheet& base) {
  const CreasePattern& sheet = base.sheet;
  const auto is_hole = [&](int f) {
    return std::binary_search(base.holes.begin(), base.holes.end(), f);
  };
  std::vector<Condition> conditions;
  for (const Edge& edge : sheet.edges) {
    if (edge.on_perimeter() || is_hole(edge.left) || is_hole(edge.right)) continue;
    Eigen::Vector2d along = sheet.vertices_mm.col(edge.b) - sheet.vertices_mm.col(edge.a);
    along /= std::sqrt(along.x() * along.x() + along.y() * along.y());
    const Eigen::Vector2d beside(-along.y(), along.x());
    conditions.push_back({{edge.a, -beside}, {edge.b, beside}});
  }
  for (const int f : base.holes) {
    const auto& v = sheet.facets[static_cast<std::size_t>(f)];
    for (const Eigen::Vector2d& axis : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}) {
      conditions.push_back({{v[0], -axis}, {v[1], axis}, {v[2], -axis}, {v[3], axis}});
    }
  }
  return conditions;
}

// delta and epsilon of a hole as functions of the shifts.
std::array<Condition, 2> hole_functions(const BaseHole& hole) {
  const auto& v = hole.corners;
  const Eigen::Vector2d by_b = Eigen::Vector2d(hole.b.y(), -hole.b.x()) / hole.sine;
  const Eigen::Vector2d by_a = Eigen::Vector2d(-hole.a.y(), hole.a.x()) / hole.sine;
  return {Condition{{v[1], -by_b}, {v[2], by_b}}, Condition{{v[0], -by_a}, {v[1], by_a}}};
}

}  // namespace

std::string NoParallelFamily::why(const CreasePattern& sheet) const {
  const auto& v = sheet.facets[static_cast<std::size_t>(hole)];
  std::string name = "the hole " + vertex_label(v[0]);
  for (std::size_t k = 1; k < 4; ++k) name += "-" + vertex_label(v[k]);
  const auto number = [](double value) {
    std::string text = std::to_string(value);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
  };
  switch (cause) {
    case Cause::no_parallelogram:
      return name + " is no parallelogram: its opposite edges differ by " + number(off) + " mm";
    case Cause::turns_apart:
      return "panels on opposite sides of " + name + " turn apart, by " + number(off) +
             " deg where the base is folded to " + number(pilot_deg) + " deg";
    case Cause::no_fixed_ratio:
      break;
  }
  return "the base does not fold flat at " + name +
         ": tangents of half fold angles keep no fixed ratio (" + number(off) + " deg off at " +
         number(pilot_deg) + " deg)";
}

std::variant<std::vector<BaseHole>, NoParallelFamily> base_holes(const PerforatedSheet& base,
                                                                 double& misfit_rad) {
  std::vector<BaseHole> holes;
  for (const int f : base.holes) {
    BaseHole hole = shape_of(base.sheet, f);
    if (const auto fault = fold_hole(base, hole, misfit_rad)) return *fault;
    holes.push_back(hole);
  }
  return holes;
}

std::variant<ParallelFamily, NoParallelFamily> ParallelFamily::of(const PerforatedSheet& base,
                                                                  std::vector<int> vertices) {
  assert(std::is_sorted(vertices.begin(), vertices.end()));
  ParallelFamily family;
  family.base_mm_ = base.sheet.vertices_mm;
  auto holes_of_base = base_holes(base, family.misfit_rad_);
  if (const auto* none = std::get_if<NoParallelFamily>(&holes_of_base)) return *none;
  family.holes_ = std::get<std::vector<BaseHole>>(std::move(holes_of_base));
  if (static_cast<int>(vertices.size()) == base.sheet.vertex_count()) {
    vertices.erase(vertices.begin());
  }
  family.vertices_ = std::move(vertices);
  const auto shifts = static_cast<int>(2 * family.vertices_.size());
  const auto holes = static_cast<int>(2 * family.holes_.size());
  std::vector<int> at(static_cast<std::size_t>(base.sheet.vertex_count()), -1);
  for (std::size_t k = 0; k < family.vertices_.size(); ++k) {
    at[static_cast<std::size_t>(family.vertices_[k])] = static_cast<int>(k);
  }
  const std::vector<Condition> conditions = conditions_of(base);
  const auto rows = static_cast<Eigen::Index>(conditions.size());
  RowMatrix equations = RowMatrix::Zero(rows + holes, shifts + holes);
  const auto enter = [&](Eigen::Index row, const Condition& condition) {
    for (const Term& term : condition) {
      const int k = at[static_cast<std::size_t>(term.vertex)];
      if (k < 0) continue;
      equations(row, 2 * k) += term.weight.x();
      equations(row, 2 * k + 1) += term.weight.y();
    }
  };
  for (Eigen::Index row = 0; row < rows; ++row) {
    enter(row, conditions[static_cast<std::size_t>(row)]);
  }
  for (int h = 0; h < holes; ++h) {
    enter(rows + h,
          hole_functions(
              family.holes_[static_cast<std::size_t>(h / 2)])[static_cast<std::size_t>(h % 2)]);
    equations(rows + h, shifts + h) = -1;
  }
  // Shifts are eliminated first, so that delta and epsilon stay free where possible; the last holes
  // come before the first.
  std::vector<int> order;
  for (int c = 0; c < shifts; ++c) order.push_back(c);
  for (int h = holes - 1; h >= 0; --h) order.push_back(shifts + h);
  const NullSpace space = null_space(std::move(equations), order, kLeastPivot);
  std::vector<Eigen::Index> columns;
  for (const bool of_holes : {true, false}) {
    for (std::size_t k = 0; k < space.free.size(); ++k) {
      const int c = space.free[k];
      if ((c >= shifts) != of_holes) continue;
      columns.push_back(static_cast<Eigen::Index>(k));
      using Kind = ParallelCoordinate::Kind;
      if (of_holes) {
        const int h = c - shifts;
        family.coordinates_.push_back({h % 2 == 0 ? Kind::delta : Kind::epsilon, h / 2, -1, 0});
      } else {
        family.coordinates_.push_back(
            {Kind::shape, -1, family.vertices_[static_cast<std::size_t>(c / 2)], c % 2});
      }
    }
  }
  family.basis_ = space.basis(Eigen::seqN(0, shifts), columns);
  family.hole_basis_ = space.basis(Eigen::seqN(shifts, holes), columns);
  return family;
}

Eigen::Matrix2Xd ParallelFamily::shifts_mm(const Eigen::VectorXd& coordinates_mm) const {
  const Eigen::VectorXd moved = product_in_order(basis_, coordinates_mm);
  Eigen::Matrix2Xd shifts = Eigen::Matrix2Xd::Zero(2, base_mm_.cols());
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    shifts.col(vertices_[k]) = moved.segment<2>(static_cast<Eigen::Index>(2 * k));
  }
  return shifts;
}

Eigen::VectorXd ParallelFamily::hole_changes_mm(const Eigen::VectorXd& coordinates_mm) const {
  return product_in_order(hole_basis_, coordinates_mm);
}

std::optional<Eigen::VectorXd> ParallelFamily::whole_steps_mm() const {
  constexpr int kMostParts = 12;
  constexpr double kWhole = 1e-9;  // far above elimination's rounding, far below a fraction
  Eigen::VectorXd steps_mm(dimension());
  for (Eigen::Index k = 0; k < steps_mm.size(); ++k) {
    const Eigen::VectorXd parts = basis_.col(k);
    double least = parts.cwiseAbs().maxCoeff();
    for (const double part : parts) {
      if (std::abs(part) > kWhole) least = std::min(least, std::abs(part));
    }
    const auto is_whole = [&](double step) {
      return ((parts * step).array() - (parts * step).array().round()).abs().maxCoeff() < kWhole;
    };
    int count = 1;
    while (count <= kMostParts && !is_whole(count / least)) ++count;
    if (count > kMostParts) return {};
    steps_mm(k) = count / least;
  }
  return steps_mm;
}

std::vector<HoleMotion> ParallelFamily::motions(const Eigen::Matrix2Xd& shifts_mm) const {
  const Eigen::Matrix2Xd vertices_mm = base_mm_ + shifts_mm;
  std::vector<HoleMotion> motions;
  for (const BaseHole& hole : holes_) motions.emplace_back(hole, hole_edges(hole, vertices_mm));
  return motions;
}

ParallelMisfit parallel_misfit(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm) {
  ParallelMisfit most;
  for (const Condition& condition : conditions_of(base)) {
    double sum = 0;
    for (const Term& term : condition) {
      sum +=
          term.weight.x() * shifts_mm(0, term.vertex) + term.weight.y() * shifts_mm(1, term.vertex);
    }
    if (std::abs(sum) <= most.mm) continue;
    most = {std::abs(sum)};
    for (const Term& term : condition) most.vertices.push_back(term.vertex);
  }
  return most;
}

}  // namespace misalign::solver
