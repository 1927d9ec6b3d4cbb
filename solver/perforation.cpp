#include "solver/perforation.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "solver/newton.hpp"
#include "solver/singular_value.hpp"

namespace misalign::solver {
namespace {

// Singular values below this part of the largest count as zero: the least true one at the angles
// looked at is above 1e-4, rounding below 1e-14.
constexpr double kRankThreshold = 1e-9;

}  // namespace

std::vector<int> inner_facets(const CreasePattern& sheet) {
  const std::vector<int> interior = interior_vertices(sheet);
  std::vector<int> inner;
  for (int f = 0; f < sheet.facet_count(); ++f) {
    const auto& corners = sheet.facets[f];
    if (std::all_of(corners.begin(), corners.end(), [&](int v) {
          return std::binary_search(interior.begin(), interior.end(), v);
        })) {
      inner.push_back(f);
    }
  }
  return inner;
}

std::vector<int> checkerboard(const CreasePattern& sheet, int remainder) {
  std::vector<int> holes = inner_facets(sheet);
  std::erase_if(holes,
                [&](int f) { return (sheet.places[f][0] + sheet.places[f][1]) % 2 != remainder; });
  return holes;
}

int default_pilot(const CreasePattern& sheet, const std::vector<int>& holes) {
  const auto is_hole = [&](int f) { return std::binary_search(holes.begin(), holes.end(), f); };
  const auto first = std::find_if(sheet.edges.begin(), sheet.edges.end(), [&](const Edge& edge) {
    return !edge.on_perimeter() && !is_hole(edge.left) && !is_hole(edge.right);
  });
  return first == sheet.edges.end() ? -1 : static_cast<int>(first - sheet.edges.begin());
}

std::vector<std::string> hole_faults(const CreasePattern& sheet, const std::vector<int>& holes) {
  std::vector<bool> is_hole(sheet.facet_count(), false);
  for (const int f : holes) is_hole[f] = true;
  const auto name = [&](int f) {
    const auto& v = sheet.facets[f];
    return "the hole " + vertex_label(v[0]) + "-" + vertex_label(v[1]) + "-" + vertex_label(v[2]) +
           "-" + vertex_label(v[3]);
  };
  std::vector<std::string> faults;
  for (const Edge& edge : sheet.edges) {
    if (!edge.on_perimeter() && is_hole[edge.left] && is_hole[edge.right]) {
      faults.push_back(name(edge.left) + " shares the edge " + line_label(edge.a, edge.b) +
                       " with another hole");
    }
  }
  const std::vector<int> inner = inner_facets(sheet);
  for (const int f : holes) {
    if (!std::binary_search(inner.begin(), inner.end(), f)) {
      faults.push_back(name(f) + " lies on the perimeter");
    }
  }
  return faults;
}

int counted_mobility(const CreasePattern& sheet, const std::vector<int>& holes) {
  const int joints = sheet.vertex_count();
  const int kept = sheet.facet_count() - static_cast<int>(holes.size());
  const int members = static_cast<int>(sheet.edges.size()) + 2 * kept;
  return 3 * joints - (members + 6);
}

Mobility measured_mobility(const CreasePattern& sheet, const std::vector<int>& holes,
                           const BaseFolding& folding) {
  const Mechanism mechanism = build_mechanism(sheet, holes, folding);
  SheetGeometry<double> geometry;
  place(mechanism, sheet.vertices_mm, geometry);
  ClosureSystem system(mechanism);
  Mobility mobility{mechanism.unknowns, mechanism.equations, 0};
  for (const double of_180 : {40.0, 75.0, 110.0}) {
    const double pilot_deg = of_180 / 180 * folding.end_deg();
    const auto state =
        base_state(mechanism, folding, sheet.vertices_mm, half_angle_of_deg(pilot_deg));
    system.evaluate(geometry, state);
    if (mechanism.unknowns == mechanism.equations + 1) {
      // The usual case, cheaper than the rank itself: the square Jacobian is regular.
      DenseSolve factors(mechanism.equations);
      factors.factorize(system.jacobian().leftCols(mechanism.equations));
      const double smallest = SmallestSingularValue<double>(mechanism.equations).of(factors);
      if (smallest > kRankThreshold * system.jacobian().norm()) {
        mobility.rank = mechanism.equations;
        return mobility;
      }
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(system.jacobian());
    qr.setThreshold(kRankThreshold);
    mobility.rank = std::max(mobility.rank, static_cast<int>(qr.rank()));
  }
  return mobility;
}

}  // namespace misalign::solver
