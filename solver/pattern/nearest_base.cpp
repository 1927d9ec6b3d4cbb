#include "solver/pattern/nearest_base.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

namespace misalign::solver {
namespace {

// Sheets with shifts of a quarter of a panel close in seven steps, 40 x 40 panels in eleven. The
// equations of sheets that are not flat-foldable depend on one another, and the last steps are
// slow.
constexpr int kMostShortestSteps = 16, kMostFromMesh = 10;
// Residual that damping leaves of steps from the mesh; steps from the sheet's place remove the
// rest.
constexpr double kNearlyClosed = 1e-6;
constexpr double kClosed = 1e-12;
// Damping as a share of the largest diagonal entry; independent equations have squared singular
// values above 1e-3 of it.
constexpr double kDamping = 1e-8;
// Step of central differences in panel widths; their error is 1e-10.
constexpr double kDifference = 1e-5;

// Shares of the mesh's fold range at which loops must close. One is enough for flat-foldable
// vertices, whose ratios of tangents are constant.
constexpr double kNextToFlat[] = {0.005};
constexpr double kAllTheWay[] = {0.1, 0.3, 0.5, 0.7, 0.85, 0.95};

constexpr double kPlacesPerMm = 1e9;

enum class Vertices { fold_flat, fold };
enum class From { mesh, current };  // the place to which the step keeps nearest

// Equations of a rigidly folding sheet in its flat vertices: opposite sectors add up to 180 degrees
// at every vertex that must be flat-foldable, and fold angles close round every facet of inner
// corners.
class BaseEquations {
 public:
  BaseEquations(const CreasePattern& sheet, const BaseFolding& unclosed, Vertices vertices)
      : sheet_(sheet), steps_(unclosed.steps()), step_of_(sheet.vertex_count(), -1) {
    for (int s = 0; s < std::ssize(steps_); ++s) {
      step_of_[steps_[s].vertex] = s;
      if (vertices == Vertices::fold_flat) parts_.push_back({s, -1});
    }
    for (int f = 0; f < sheet.facet_count(); ++f) {
      const auto& corners = sheet.facets[f];
      if (std::ranges::all_of(corners, [&](int v) { return step_of_[v] >= 0; })) {
        parts_.push_back({-1, f});
      }
    }
    const std::span<const double> shares =
        vertices == Vertices::fold_flat ? std::span<const double>(kNextToFlat) : kAllTheWay;
    for (const double share : shares) {
      angles_.push_back(unclosed.fold_angles(half_angle_of_deg(share * unclosed.end_deg())));
    }
    for (const Part& part : parts_) rows_ += rows_of(part);
  }

  // Moves the vertices (panel widths) to the nearest place, to the mesh or to where they are, that
  // satisfies the equations to first order. Returns the error before; not a number if the mesh does
  // not fold that far.
  double step(FlatVertices& at, From from) const {
    Eigen::VectorXd residual(rows_);
    std::vector<Eigen::Triplet<double>> entries;
    int row = 0;
    for (const Part& part : parts_) {
      evaluate(part, at, residual.data() + row);
      differentiate(part, at, row, entries);
      row += rows_of(part);
    }
    const double off = residual.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!(off > kClosed)) return off;
    Eigen::SparseMatrix<double> jacobian(rows_, at.size());
    jacobian.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseMatrix<double> normal = jacobian * jacobian.transpose();
    const double damping = kDamping * Eigen::VectorXd(normal.diagonal()).maxCoeff();
    for (int k = 0; k < rows_; ++k) normal.coeffRef(k, k) += damping;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(normal);
    if (factor.info() != Eigen::Success) return kNoNumber;
    if (from == From::mesh) {
      const FlatVertices back = sheet_.vertices_mm / sheet_.panel_width_mm - at;
      residual += jacobian * back.reshaped();
      at += back;
    }
    at.reshaped() -= jacobian.transpose() * factor.solve(residual);
    return off;
  }

 private:
  static constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

  // A vertex (given by its step) or a facet.
  struct Part {
    int step, facet;
  };
  int rows_of(const Part& part) const {
    return part.facet < 0 ? 1 : static_cast<int>(angles_.size());
  }

  // Unit directions of a vertex' creases, starting with number `first`.
  std::array<Eigen::Vector2d, 4> directions(const BaseFolding::Step& step, int first,
                                            const FlatVertices& at) const {
    std::array<Eigen::Vector2d, 4> directions;
    for (int k = 0; k < 4; ++k) {
      const Edge& edge = sheet_.edges[step.edges[(first + k) % 4]];
      const int other = edge.a == step.vertex ? edge.b : edge.a;
      directions[k] = (at.col(other) - at.col(step.vertex)).normalized();
    }
    return directions;
  }

  // The sine of the first and the third sector's sum.
  double flatness(const BaseFolding::Step& step, const FlatVertices& at) const {
    const auto u = directions(step, 0, at);
    const auto sine = [&](int k) { return u[k].x() * u[k + 1].y() - u[k].y() * u[k + 1].x(); };
    return sine(0) * u[2].dot(u[3]) + u[0].dot(u[1]) * sine(2);
  }

  void evaluate(const Part& part, const FlatVertices& at, double* residual) const {
    if (part.facet < 0) {
      *residual = flatness(steps_[part.step], at);
      return;
    }
    const auto& corners = sheet_.facets[part.facet];
    const auto side = [&](int k) {  // the edge that ends in this corner
      return find_edge(sheet_, corners[(k + 3) % 4], corners[k % 4]);
    };
    for (const std::vector<HalfAngle<double>>& angles : angles_) {
      const HalfAngle<double>& start = angles[side(0)];
      std::optional<HalfAngle<double>> angle = start;
      for (int k = 0; k < 4 && angle; ++k) {
        const BaseFolding::Step& step = steps_[step_of_[corners[k]]];
        const auto place = [&](int edge) {
          return static_cast<int>(std::ranges::find(step.edges, edge) - step.edges.begin());
        };
        const int in = place(side(k)), out = place(side(k + 1));
        const int way = step.folds.opposite_sign();
        const DegreeFourVertex folds(directions(step, in, at), in % 2 == 0 ? way : -way);
        const auto others = folds.others(*angle);
        angle.reset();
        if (others) angle = (*others)[(out - in + 3) % 4];
      }
      *residual++ = angle ? half_sine_between(*angle, start) / start.s : kNoNumber;
    }
  }

  void differentiate(const Part& part, const FlatVertices& at, int row,
                     std::vector<Eigen::Triplet<double>>& entries) const {
    std::vector<int> moved;  // the equation's vertices and their neighbours
    const auto add = [&](const BaseFolding::Step& step) {
      for (const int e : step.edges) {
        moved.push_back(sheet_.edges[e].a);
        moved.push_back(sheet_.edges[e].b);
      }
    };
    if (part.facet < 0) {
      add(steps_[part.step]);
    } else {
      for (const int v : sheet_.facets[part.facet]) add(steps_[step_of_[v]]);
    }
    std::ranges::sort(moved);
    moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
    const auto rows = static_cast<std::size_t>(rows_of(part));
    std::vector<double> before(rows), after(rows);
    FlatVertices near = at;
    for (const int v : moved) {
      for (int k = 0; k < 2; ++k) {
        near(k, v) = at(k, v) - kDifference;
        evaluate(part, near, before.data());
        near(k, v) = at(k, v) + kDifference;
        evaluate(part, near, after.data());
        near(k, v) = at(k, v);
        for (std::size_t r = 0; r < rows; ++r) {
          entries.emplace_back(row + static_cast<int>(r), 2 * v + k,
                               (after[r] - before[r]) / (2 * kDifference));
        }
      }
    }
  }

  const CreasePattern& sheet_;
  const std::vector<BaseFolding::Step>& steps_;
  std::vector<int> step_of_;  // per vertex; -1 on the perimeter
  std::vector<Part> parts_;
  std::vector<std::vector<HalfAngle<double>>>
      angles_;  // fold angles at which loops close, per edge
  int rows_ = 0;
};

std::optional<NearestBase> base_near(const CreasePattern& sheet, const BaseFolding& unclosed,
                                     Vertices vertices, double farthest_mm) {
  const BaseEquations equations(sheet, unclosed, vertices);
  FlatVertices at = sheet.vertices_mm / sheet.panel_width_mm;
  const auto off_mm = [&](const FlatVertices& vertices_mm) {
    return std::sqrt((vertices_mm - sheet.vertices_mm).colwise().squaredNorm().maxCoeff());
  };
  double open_by = 1;
  for (int k = 0; k < kMostShortestSteps && open_by > kClosed; ++k) {
    const bool is_far = open_by > kNearlyClosed && k < kMostFromMesh;
    open_by = equations.step(at, is_far ? From::mesh : From::current);
    if (std::isnan(open_by) || !(off_mm(at * sheet.panel_width_mm) <= farthest_mm) ||
        !nonconvex_facets(sheet, at).empty()) {
      return std::nullopt;
    }
  }
  NearestBase base{sheet, {}, 0};
  base.sheet.vertices_mm =
      (at * (sheet.panel_width_mm * kPlacesPerMm)).array().round() / kPlacesPerMm;
  base.off_mm = off_mm(base.sheet.vertices_mm);
  std::vector<int> assignment = unclosed.assignment();
  for (int& sign : assignment) sign *= unclosed.side();
  auto folded = fold_sequentially(base.sheet, assignment, unclosed.pilot_edge());
  auto* folding = std::get_if<BaseFolding>(&folded);
  if (!folding) return std::nullopt;
  base.folding = std::move(*folding);
  return base;
}

}  // namespace

std::optional<NearestBase> nearest_base(const CreasePattern& sheet, const BaseFolding& unclosed) {
  assert(sheet.panel_width_mm > 0);
  if (!(unclosed.end_deg() > 0)) return std::nullopt;
  const double near_mm = kStandsFor_widths * sheet.panel_width_mm;
  auto flat =
      base_near(sheet, unclosed, Vertices::fold_flat, std::numeric_limits<double>::infinity());
  if (flat && flat->off_mm <= near_mm) return flat;
  auto rigid = base_near(sheet, unclosed, Vertices::fold, near_mm);
  return rigid ? std::move(rigid) : std::move(flat);
}

}  // namespace misalign::solver
