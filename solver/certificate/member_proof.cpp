#include "solver/certificate/member_proof.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {
namespace {

// Subtracted from the angle of a root in doubles, so that the claim lies below it.
constexpr double kBelowRoot_deg = 1e-6;

class Prover {
 public:
  explicit Prover(const PerforatedSheet& base)
      : base_(base), sheet_(base.sheet), exact_(rational_base(base)) {}

  MemberProof prove(const Eigen::Matrix2Xd& shifts_mm, double to_deg) {
    proof_.base_off_mm = exact_.off_mm;
    proof_.gap = exact_.gap;
    if (!proof_.holds()) return proof_;
    find_member(shifts_mm);
    proof_.certified_deg = to_deg;
    for (const int hole : base_.holes) {
      const auto slope = slope_of(hole);
      if (!slope) {
        proof_.gap = {ProofGap::Kind::unlike_turns, hole};
        return proof_;
      }
      const double one_way_deg = one_way_up_to(*slope, to_deg);
      if (one_way_deg >= proof_.certified_deg) continue;
      proof_.certified_deg = one_way_deg;
      proof_.reversing_hole = hole;
    }
    return proof_;
  }

 private:
  using Quadratic = std::array<Rational, 3>;

  // Finds nearby shifts that satisfy all conditions, by exact elimination; free unknowns stay as
  // they are.
  void find_member(const Eigen::Matrix2Xd& shifts_mm) {
    using Row = std::map<int, Rational>;
    std::map<int, Row> solved;  // by pivot
    const auto reduce = [&](Row& row, int pivot, const Row& pivot_row) {
      const auto at = row.find(pivot);
      if (at == row.end()) return;
      const Rational share = at->second;
      for (const auto& [column, value] : pivot_row) {
        Rational& entry = row[column];
        entry -= share * value;
        if (entry == 0) row.erase(column);
      }
    };
    const auto add = [&](Row row) {
      for (const auto& [pivot, solved_row] : solved) reduce(row, pivot, solved_row);
      if (row.empty()) return;
      const auto largest = std::ranges::max_element(row, {}, [](const auto& entry) {
        return abs(entry.second).template convert_to<double>();
      });
      const int pivot = largest->first;
      const Rational scale = largest->second;
      for (auto& [column, value] : row) value /= scale;
      for (auto& [other, solved_row] : solved) reduce(solved_row, pivot, row);
      solved.emplace(pivot, std::move(row));
    };
    const auto is_hole = [&](int f) { return std::ranges::binary_search(base_.holes, f); };
    for (std::size_t e = 0; e < sheet_.edges.size(); ++e) {
      const Edge& edge = sheet_.edges[e];
      if (edge.on_perimeter() || is_hole(edge.left) || is_hole(edge.right)) continue;
      const RationalVector u = exact_.vertices_mm[static_cast<std::size_t>(edge.b)] -
                               exact_.vertices_mm[static_cast<std::size_t>(edge.a)];
      Row row;
      const auto enter = [&](int column, const Rational& value) {
        if (value != 0) row[column] += value;
      };
      enter(2 * edge.b + 1, u.x);
      enter(2 * edge.b, -u.y);
      enter(2 * edge.a + 1, -u.x);
      enter(2 * edge.a, u.y);
      add(std::move(row));
    }
    for (const int f : base_.holes) {
      const auto& v = sheet_.facets[static_cast<std::size_t>(f)];
      for (int axis = 0; axis < 2; ++axis) {
        add({{2 * v[0] + axis, 1},
             {2 * v[1] + axis, -1},
             {2 * v[2] + axis, 1},
             {2 * v[3] + axis, -1}});
      }
    }
    std::vector<Rational> shifts;
    for (const double shift_mm : shifts_mm.reshaped()) shifts.emplace_back(shift_mm);
    std::vector<Rational> member = shifts;
    for (const auto& [pivot, row] : solved) {
      Rational value = 0;
      for (const auto& [column, weight] : row) {
        if (column != pivot) value -= weight * shifts[static_cast<std::size_t>(column)];
      }
      const auto at = static_cast<std::size_t>(pivot);
      member[at] = value;
      proof_.member_off_mm =
          std::max(proof_.member_off_mm, Rational(abs(value - shifts[at])).convert_to<double>());
    }
    for (std::size_t v = 0; 2 * v < member.size(); ++v) {
      moved_.push_back(exact_.vertices_mm[v] + RationalVector{member[2 * v], member[2 * v + 1]});
    }
  }

  // The quadratic in T = tan^2(pilot / 2) that has the sign of a diagonal's slope, with vectors u,
  // v of the hole's edges on the base instead of unit vectors: all is rational.
  std::optional<Quadratic> slope_of(int hole) const {
    const auto& v = sheet_.facets[static_cast<std::size_t>(hole)];
    std::array<Rational, 4> tan_sq;
    std::array<int, 4> sign{};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto e = static_cast<std::size_t>(find_edge(sheet_, v[k], v[(k + 1) % 4]));
      tan_sq[k] = exact_.tangents_sq[e];
      sign[k] = base_.folding.assignment()[e];
    }
    const auto edge = [&](const std::vector<RationalVector>& at, std::size_t k) {
      return at[static_cast<std::size_t>(v[(k + 1) % 4])] - at[static_cast<std::size_t>(v[k])];
    };
    const RationalVector a = edge(exact_.vertices_mm, 0), b = edge(exact_.vertices_mm, 1),
                         over = edge(exact_.vertices_mm, 2), back = edge(exact_.vertices_mm, 3);
    const bool is_parallelogram = a == RationalVector{} - over && b == RationalVector{} - back;
    if (!is_parallelogram || tan_sq[0] != tan_sq[2] || tan_sq[1] != tan_sq[3] ||
        sign[0] != -sign[2] || sign[1] != -sign[3]) {
      return {};
    }
    const Rational p = tan_sq[1], q = tan_sq[0], pq = p * q;
    const Rational uu = dot(a, a), vv = dot(b, b), uv = dot(a, b), area = cross(a, b);
    // The root of p q u.u v.v: of the two angles one's tangent is the other's times the cosine.
    Rational root = p * abs(uv);
    if (root * root != pq * uu * vv) root = q * abs(uv);
    if (root * root != pq * uu * vv) return {};
    const RationalVector first = edge(moved_, 0), second = edge(moved_, 1);
    const Rational of_a = cross(first, b) / area, epsilon = cross(a, first) / area,
                   of_b = cross(a, second) / area, delta = cross(second, b) / area;
    const Rational a_delta = of_a * delta * uu, b_epsilon = of_b * epsilon * vv;
    const Rational both = delta * epsilon, mixed = sign[0] * sign[1] * root;
    return Quadratic{a_delta * p + b_epsilon * q + 2 * both * mixed,
                     2 * pq * (a_delta + b_epsilon + 2 * both * uv),
                     pq * (a_delta * q + b_epsilon * p + 2 * both * (uv * (p + q) - mixed))};
  }

  // Returns whether c0 + c1 t + c2 t^2 keeps its sign for 0 < t < T (all t > 0 without a T), by its
  // Bernstein coefficients, which then have one sign.
  static bool keeps_sign(const Quadratic& c, const std::optional<Rational>& end) {
    const Quadratic bernstein =
        end ? Quadratic{c[0], 2 * c[0] + c[1] * *end, c[0] + c[1] * *end + c[2] * *end * *end} : c;
    const bool any = bernstein[0] != 0 || bernstein[1] != 0 || bernstein[2] != 0;
    return any && (std::ranges::all_of(bernstein, [](const auto& k) { return k >= 0; }) ||
                   std::ranges::all_of(bernstein, [](const auto& k) { return k <= 0; }));
  }

  // Returns tan^2 of half the angle, rounded up.
  static std::optional<Rational> tan_sq_of_half(double pilot_deg) {
    if (pilot_deg >= 180) return {};
    const double tangent = std::tan(pilot_deg * kRadPerDeg / 2);
    return Rational(tangent * tangent * (1 + 1e-12));
  }

  static double one_way_up_to(const Quadratic& slope, double to_deg) {
    if (keeps_sign(slope, tan_sq_of_half(to_deg))) return to_deg;
    const double c0 = slope[0].convert_to<double>(), c1 = slope[1].convert_to<double>(),
                 c2 = slope[2].convert_to<double>();
    const double square = c1 * c1 - 4 * c0 * c2;
    if (!(square >= 0)) return 0;
    // Vieta's formula loses no digits.
    const double sum = -0.5 * (c1 + std::copysign(std::sqrt(square), c1));
    double one_way_deg = 0;
    for (const double root : {sum / c2, c0 / sum}) {
      if (!(root > 0)) continue;
      const double deg = 2 * std::atan(std::sqrt(root)) / kRadPerDeg - kBelowRoot_deg;
      if (deg > 0 && deg < to_deg && keeps_sign(slope, tan_sq_of_half(deg))) {
        one_way_deg = std::max(one_way_deg, deg);
      }
    }
    return one_way_deg;
  }

  const PerforatedSheet& base_;
  const CreasePattern& sheet_;
  const RationalBase exact_;
  MemberProof proof_;
  std::vector<RationalVector> moved_;  // vertices of the member
};

}  // namespace

MemberProof prove_member(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm,
                         double to_deg) {
  return Prover(base).prove(shifts_mm, to_deg);
}

}  // namespace misalign::solver
