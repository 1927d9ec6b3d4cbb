// Loop closure as in loop_closure.hpp, by the product of poses round a loop, for the checker: it
// shares nothing with graded_closure.hpp, by which certificates are made.
//
// Motions are graded (graded_motion.hpp). A loop is closed where R = I and t = 0: the antisymmetric
// part of R is zero, in these orders, and so is t. (It is zero for a half turn too, whose trace is
// -1 instead of 3.) Each loop is seen from one of its points, which keeps t small.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "solver/certificate/graded_motion.hpp"
#include "solver/certificate/polynomial.hpp"
#include "solver/certificate/spring_vertex.hpp"
#include "solver/kinematics/folded_shape.hpp"

namespace misalign::solver {

using FourParts = std::array<double, 4>;
/// An interval's joints in its unknowns x: graded, half a crease's angle has cos : sin = c : tau s
/// and a ball's quaternion is (w, tau x, tau y, sigma z); otherwise tau = 1.
struct JointLines {
  struct Crease {
    double c, s, c_rate, s_rate;
  };
  struct Ball {
    FourParts q;
    std::array<FourParts, 3> rate;
  };
  std::vector<Crease> creases;
  std::vector<Ball> balls;
};

inline double scaled(double k, double x) { return k * x; }
template <int Degree>
Polynomial<Degree> scaled(double k, const Polynomial<Degree>& f) {
  return k * f;
}

/// Models in T of a sheet whose coordinates are known in Number, with `scaled` for products of
/// both.
template <class T, class Number = double>
class PoseClosure {
 public:
  struct Entry {
    int row, column;
    T value;
  };

  /// All must outlive this object. `x` has all unknowns, the pilot's last.
  PoseClosure(const Mechanism& mechanism, const SheetGeometry<Number>& geometry,
              const JointLines& lines, const Grading<T>& sigma, const std::vector<T>& x)
      : mechanism_(mechanism), geometry_(geometry), lines_(lines), sigma_(sigma) {
    for (std::size_t i = 0; i < lines.creases.size(); ++i) {
      const JointLines::Crease& line = lines.creases[i];
      const T& turn = x[mechanism.creases[i].column];
      const T c = T(line.c) + scaled(line.c_rate, turn), s = T(line.s) + scaled(line.s_rate, turn);
      creases_.push_back({c, s, reciprocal(c * c + sigma(s * s))});
    }
    for (std::size_t i = 0; i < lines.balls.size(); ++i) {
      std::array<T, 4> q;
      for (int part = 0; part < 4; ++part) {
        q[part] = T(lines.balls[i].q[part]);
        for (int k = 0; k < 3; ++k) {
          q[part] =
              q[part] + scaled(lines.balls[i].rate[k][part], x[mechanism.balls[i].column + k]);
        }
      }
      const T inverse =
          reciprocal(q[0] * q[0] + sigma(q[1] * q[1] + q[2] * q[2]) + sigma(sigma(q[3] * q[3])));
      balls_.push_back({q, inverse});
    }
  }

  const T& cosine(std::size_t crease) const { return creases_[crease].c; }
  const T& sine(std::size_t crease) const { return creases_[crease].s; }

  /// Finds the residual, one for each equation, and R's trace less 3, over sigma, for each loop.
  void open_by(std::vector<T>& residual, std::vector<T>* traces) const {
    residual.assign(mechanism_.equations, T());
    if (traces != nullptr) traces->clear();
    for (const Loop& loop : mechanism_.loops) {
      Motion<T> whole = motion(loop, loop.passages[0]);
      for (std::size_t j = 1; j < loop.passages.size(); ++j) {
        whole = composed(sigma_, whole, motion(loop, loop.passages[j]));
      }
      const std::array<T, 6> rows = equations(whole);
      for (int row = 0; row < loop.rows; ++row) residual[loop.first_row + row] = rows[row];
      if (traces != nullptr) traces->push_back(whole.a[0][0] + whole.a[1][1] + whole.d);
    }
  }

  /// The Jacobian's structural nonzeros, without those of the pilot.
  std::vector<Entry> jacobian() const {
    std::vector<Entry> entries;
    for (const Loop& loop : mechanism_.loops) add_entries(loop, entries);
    return entries;
  }

  /// Change of a diagonal's squared length from the flat sheet, over sigma: with sides e, f at the
  /// corner that it spans, and R that of the corner, |e + R f|^2 - |e + f|^2 = 2 e . (R - I) f.
  T squared_elongation(const Diagonal& diagonal) const {
    if (!mechanism_.springs.at_vertices()) return stretch_of_spring(diagonal);
    const Loop& loop = mechanism_.loops[diagonal.loop];
    const int corner = (diagonal.from_corner + 1) % 4;
    const int end = corner == 3 ? static_cast<int>(loop.passages.size()) : loop.arrival[corner + 1];
    Motion<T> turn = motion(loop, loop.passages[loop.arrival[corner]]);
    for (int j = loop.arrival[corner] + 1; j < end; ++j) {
      turn = composed(sigma_, turn, motion(loop, loop.passages[j]));
    }
    const int at = loop.corners[corner];
    const auto e = step(diagonal.from, at), f = step(at, diagonal.to);
    T sum(0.0);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) sum = sum + scaled(e[i] * f[j], turn.a[i][j]);
    }
    return sum + sum;
  }

  /// The corners of every facet that a tree of joints reaches, its first one lying flat: (x, y, z /
  /// tau), panel widths; seen from the sheet's first vertex. `corners` has those of each of
  /// `facets`.
  std::vector<std::array<std::array<T, 3>, 4>> place_panels(
      const std::vector<FoldedShape::Branch>& tree, const std::vector<int>& facets,
      const std::vector<std::array<int, 4>>& corners) const {
    std::map<int, Motion<T>> motions;
    motions[tree.empty() ? facets.front() : tree.front().parent] = {};
    for (const FoldedShape::Branch& branch : tree) {
      motions[branch.facet] = composed(sigma_, motions.at(branch.parent), motion(0, branch.joint));
    }
    std::vector<std::array<std::array<T, 3>, 4>> placed(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const Motion<T>& m = motions.at(facets[f]);
      for (int k = 0; k < 4; ++k) {
        const auto p = step(0, corners[f][k]);
        for (int i = 0; i < 2; ++i) {
          const T shift = scaled(p[0], m.a[i][0]) + scaled(p[1], m.a[i][1]) + m.t[i];
          placed[f][k][i] = T(p[i]) + sigma_(shift);
        }
        placed[f][k][2] = scaled(p[0], m.c[0]) + scaled(p[1], m.c[1]) + m.t[2];
      }
    }
    return placed;
  }

 private:
  // The joints between the panels of ends p and q take q to q + u: 2 (q - p) . u + u^2.
  T stretch_of_spring(const Diagonal& diagonal) const {
    const Loop& loop = mechanism_.loops[diagonal.loop];
    const int p = spring_vertex(mechanism_, diagonal.loop, diagonal.from_corner),
              q = spring_vertex(mechanism_, diagonal.loop, diagonal.to_corner);
    Motion<T> turn{};
    bool is_first = true;
    each_passage_between_ends(mechanism_, diagonal, [&](const Passage& passage) {
      turn = is_first ? motion(loop, passage) : composed(sigma_, turn, motion(loop, passage));
      is_first = false;
    });
    const auto at = step(loop.passages[0].vertex, q), apart = step(p, q);
    T inner{}, square{};
    for (int i = 0; i < 2; ++i) {
      const T shift = scaled(at[0], turn.a[i][0]) + scaled(at[1], turn.a[i][1]) + turn.t[i];
      inner = inner + scaled(apart[i], shift);
      square = square + shift * shift;
    }
    const T up = scaled(at[0], turn.c[0]) + scaled(at[1], turn.c[1]) + turn.t[2];
    return inner + inner + sigma_(square) + up * up;
  }

  struct CreaseValue {
    T c, s, inverse;
  };
  struct BallValue {
    std::array<T, 4> q;
    T inverse;
  };

  std::array<Number, 2> step(int from, int to) const {
    return {geometry_.x[to] - geometry_.x[from], geometry_.y[to] - geometry_.y[from]};
  }

  static std::array<T, 6> equations(const Motion<T>& m) {
    return {m.c[1] - m.b[1], m.b[0] - m.c[0], m.a[1][0] - m.a[0][1], m.t[0], m.t[1], m.t[2]};
  }

  // R = I + sin [u]x + (1 - cos) [u]x^2, with `sine` and `rest` in their orders, u in the sheet.
  Motion<T> about_axis(const Passage& passage, const T& sine, const T& rest) const {
    const int edge = mechanism_.creases[passage.joint].edge;
    const Number &ux = geometry_.axis_x[edge], &uy = geometry_.axis_y[edge];
    const T turn = passage.sense > 0 ? -sine : sine;  // crossing to the right is by minus the angle
    Motion<T> m;
    m.a[0][0] = -scaled(uy * uy, rest);
    m.a[0][1] = m.a[1][0] = scaled(ux * uy, rest);
    m.a[1][1] = -scaled(ux * ux, rest);
    m.b = {scaled(uy, turn), -scaled(ux, turn)};
    m.c = {-m.b[0], -m.b[1]};
    m.d = -rest;
    return m;
  }

  // The quadratic form behind R - I, R that of a quaternion of length one, with its two arguments.
  Motion<T> quaternion_form(const std::array<T, 4>& p, const std::array<T, 4>& q) const {
    const auto pair = [&](int i, int j) { return p[i] * q[j] + p[j] * q[i]; };
    const T zz = sigma_(pair(3, 3));
    const T xy = pair(1, 2), wz = pair(0, 3), wy = pair(0, 2), wx = pair(0, 1);
    const T xz = sigma_(pair(1, 3)), yz = sigma_(pair(2, 3));
    Motion<T> m;
    m.a = {{{-(pair(2, 2) + zz), xy - wz}, {xy + wz, -(pair(1, 1) + zz)}}};
    m.b = {xz + wy, yz - wx};
    m.c = {xz - wy, yz + wx};
    m.d = -(pair(1, 1) + pair(2, 2));
    return m;
  }

  // t = p - R p for the point p that a joint keeps in place, seen from a vertex.
  void place(int origin, const Passage& passage, Motion<T>& m) const {
    const auto p = step(origin, passage.vertex);
    for (int i = 0; i < 2; ++i) m.t[i] = -(scaled(p[0], m.a[i][0]) + scaled(p[1], m.a[i][1]));
    m.t[2] = -(scaled(p[0], m.c[0]) + scaled(p[1], m.c[1]));
  }

  static void scale(const T& k, Motion<T>& m) {
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) m.a[i][j] = k * m.a[i][j];
      m.b[i] = k * m.b[i];
      m.c[i] = k * m.c[i];
    }
    m.d = k * m.d;
  }

  Motion<T> motion(const Loop& loop, const Passage& passage) const {
    return motion(loop.passages[0].vertex, passage);
  }
  Motion<T> motion(int origin, const Passage& passage) const {
    Motion<T> m;
    if (passage.ball) {
      const BallValue& ball = balls_[passage.joint];
      m = quaternion_form(ball.q, ball.q);
      scale(ball.inverse, m);
      if (passage.sense < 0) m = m.transposed();
    } else {
      const CreaseValue& at = creases_[passage.joint];
      const T twice = at.inverse + at.inverse;
      m = about_axis(passage, twice * (at.c * at.s), twice * (at.s * at.s));
    }
    place(origin, passage, m);
    return m;
  }

  // Derivative of a joint's motion by one of its unknowns: that of M = N / |q|^2 is (N' - M |q|^2')
  // / |q|^2.
  Motion<T> rate(const Loop& loop, const Passage& passage, int unknown) const {
    Motion<T> m;
    if (passage.ball) {
      const BallValue& ball = balls_[passage.joint];
      std::array<T, 4> r;
      for (int k = 0; k < 4; ++k) r[k] = T(lines_.balls[passage.joint].rate[unknown][k]);
      const auto& q = ball.q;
      const T growth = q[0] * r[0] + sigma_(q[1] * r[1] + q[2] * r[2] + sigma_(q[3] * r[3]));
      const T half = -(growth * ball.inverse);
      Motion<T> shrink = quaternion_form(q, q);
      scale(half, shrink);
      m = quaternion_form(q, r) + shrink;
      scale(ball.inverse + ball.inverse, m);
      if (passage.sense < 0) m = m.transposed();
    } else {
      // Half the angle turns at (c s' - s c') / (c^2 + sigma s^2); sin and 1 - cos by the chain
      // rule.
      const CreaseValue& at = creases_[passage.joint];
      const JointLines::Crease& line = lines_.creases[passage.joint];
      const T turn = (scaled(line.s_rate, at.c) - scaled(line.c_rate, at.s)) * at.inverse;
      const T twice = (turn + turn) * at.inverse;
      m = about_axis(passage, twice * (at.c * at.c - sigma_(at.s * at.s)),
                     (twice + twice) * (at.c * at.s));
    }
    place(loop.passages[0].vertex, passage, m);
    return m;
  }

  void add_entries(const Loop& loop, std::vector<Entry>& entries) const {
    const std::size_t count = loop.passages.size();
    std::vector<Motion<T>> before(count + 1), after(count + 1);  // the first and the last are I
    for (std::size_t j = 0; j < count; ++j) {
      const Motion<T> joint_motion = motion(loop, loop.passages[j]);
      before[j + 1] = j == 0 ? joint_motion : composed(sigma_, before[j], joint_motion);
      after[j] = joint_motion;
    }
    for (std::size_t j = count - 1; j-- > 0;) after[j] = composed(sigma_, after[j], after[j + 1]);
    for (std::size_t j = 0; j < count; ++j) {
      const Passage& passage = loop.passages[j];
      if (!passage.ball && passage.joint == mechanism_.pilot) continue;
      for (int unknown = 0; unknown < (passage.ball ? 3 : 1); ++unknown) {
        Motion<T> m = rate(loop, passage, unknown);
        if (j > 0) m = m + beyond_sum(sigma_, before[j], m);
        if (j + 1 < count) m = m + beyond_sum(sigma_, m, after[j + 1]);
        const std::array<T, 6> rows = equations(m);
        for (int row = 0; row < loop.rows; ++row) {
          entries.push_back(
              {loop.first_row + row, mechanism_.first_column(passage) + unknown, rows[row]});
        }
      }
    }
  }

  const Mechanism& mechanism_;
  const SheetGeometry<Number>& geometry_;
  const JointLines& lines_;
  const Grading<T>& sigma_;
  std::vector<CreaseValue> creases_;
  std::vector<BallValue> balls_;
};

}  // namespace misalign::solver
