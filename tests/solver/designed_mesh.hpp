// Meshes that are designed for a folded state, flat and folded, without the solver: a Miura-ori in
// closed form, and developable meshes on a curved surface that do not fold rigidly as a whole.
#pragma once

#include <Eigen/Dense>
#include <complex>
#include <random>

#include "solver/pattern/isometric_pair.hpp"

namespace misalign::solver {

struct DesignedMesh {
  CreasePattern flat;
  FoldedVertices folded_mm;
};

/// Rows and columns of quadrilaterals, vertices row by row, facets counter-clockwise.
inline CreasePattern grid_of(int rows, int columns) {
  CreasePattern sheet;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int v = r * (columns + 1) + c;
      sheet.facets.push_back({v, v + 1, v + columns + 2, v + columns + 1});
      sheet.places.push_back({r, c});
    }
  }
  sheet.edges = edges_of(sheet.facets);
  sheet.vertices_mm.setZero(2, (rows + 1) * (columns + 1));
  sheet.panel_width_mm = 80;
  return sheet;
}

/// A Miura-ori of graded rows and columns (Schenk & Guest, PNAS 110, 2013): edges along rows lie in
/// (S, +-V, 0), edges along columns in (0, L, +-H). The tilt of the latter is 0 on the flat sheet.
inline DesignedMesh graded_miura(int rows, int columns, double tilt_rad) {
  DesignedMesh mesh{grid_of(rows, columns), {}};
  const double cosine = 0.45;  // of the sector angle
  const auto folded = [&](double tilt) {
    FoldedVertices at(3, mesh.flat.vertices_mm.cols());
    double y = 0, z = 0;
    for (int r = 0; r <= rows; ++r) {
      double x = 0, zigzag = 0;
      for (int c = 0; c <= columns; ++c) {
        at.col(r * (columns + 1) + c) << x, y + zigzag, z;
        const double b = 70 + 4 * c, v = b * cosine / std::cos(tilt);
        x += std::sqrt(b * b - v * v);
        zigzag += c % 2 == 0 ? v : -v;
      }
      const double a = 85 - 3 * r;
      y += a * std::cos(tilt);
      z += (r % 2 == 0 ? a : -a) * std::sin(tilt);
    }
    return at;
  };
  mesh.flat.vertices_mm = folded(0).topRows<2>();
  mesh.folded_mm = folded(tilt_rad);
  return mesh;
}

/// Makes panels plane and angles round each inner vertex add to 360 degrees (Dudte, Vouga, Tachi &
/// Mahadevan, Nature Materials 15, 2016), by the least moves; derivatives are differences.
inline void make_developable(const CreasePattern& sheet, FoldedVertices& at_mm) {
  const auto angle = [](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
    return std::atan2(u.cross(v).norm(), u.dot(v));
  };
  const std::vector<int> inner = interior_vertices(sheet);
  const auto misfits = [&](const FoldedVertices& at) {
    Eigen::VectorXd sums = Eigen::VectorXd::Constant(at.cols(), -2 * std::acos(-1.0));
    Eigen::VectorXd misfit(sheet.facet_count() + std::ssize(inner));
    for (int f = 0; f < sheet.facet_count(); ++f) {
      const auto& v = sheet.facets[f];
      const Eigen::Vector3d a = at.col(v[1]) - at.col(v[0]), b = at.col(v[2]) - at.col(v[0]),
                            c = at.col(v[3]) - at.col(v[0]);
      misfit(f) = a.cross(b).dot(c) / std::pow(sheet.panel_width_mm, 3);
      for (int k = 0; k < 4; ++k) {
        sums(v[k]) +=
            angle(at.col(v[(k + 1) % 4]) - at.col(v[k]), at.col(v[(k + 3) % 4]) - at.col(v[k]));
      }
    }
    for (std::size_t k = 0; k < inner.size(); ++k)
      misfit(sheet.facet_count() + std::ssize(inner) - 1 - static_cast<int>(k)) = sums(inner[k]);
    return misfit;
  };
  for (int step = 0; step < 30; ++step) {
    const Eigen::VectorXd misfit = misfits(at_mm);
    if (misfit.cwiseAbs().maxCoeff() < 1e-14) return;
    Eigen::MatrixXd slopes(misfit.size(), at_mm.size());
    for (Eigen::Index k = 0; k < at_mm.size(); ++k) {
      FoldedVertices before = at_mm, after = at_mm;
      before.data()[k] -= 1e-3;
      after.data()[k] += 1e-3;
      slopes.col(k) = (misfits(after) - misfits(before)) / 2e-3;
    }
    at_mm.reshaped() -= slopes.completeOrthogonalDecomposition().solve(misfit);
  }
}

/// Lays developable panels flat, each beside one that lies already.
inline FlatVertices unrolled(const CreasePattern& sheet, const FoldedVertices& folded_mm) {
  using Point = std::complex<double>;
  std::vector<Point> at(static_cast<std::size_t>(folded_mm.cols()));
  std::vector<bool> lies(at.size(), false);
  for (const auto& corners : sheet.facets) {
    Eigen::Matrix<double, 3, 4> p;
    for (int k = 0; k < 4; ++k) p.col(k) = folded_mm.col(corners[k]);
    const Eigen::Vector3d x = (p.col(1) - p.col(0)).normalized(),
                          y = x.cross(Eigen::Vector3d(p.col(3) - p.col(0))).cross(x).normalized();
    std::array<Point, 4> in_panel;
    for (int k = 0; k < 4; ++k) {
      in_panel[k] = {x.dot(p.col(k) - p.col(0)), y.dot(p.col(k) - p.col(0))};
    }
    Point turn = 1, origin = 0;
    for (int k = 0; k < 4; ++k) {
      const int a = corners[k], b = corners[(k + 1) % 4];
      if (!lies[a] || !lies[b]) continue;
      turn = (at[b] - at[a]) / (in_panel[(k + 1) % 4] - in_panel[k]);
      turn /= std::abs(turn);
      origin = at[a] - turn * in_panel[k];
      break;
    }
    for (int k = 0; k < 4; ++k) {
      if (!lies[corners[k]]) at[corners[k]] = origin + turn * in_panel[k];
      lies[corners[k]] = true;
    }
  }
  FlatVertices flat(2, folded_mm.cols());
  for (Eigen::Index v = 0; v < flat.cols(); ++v) flat.col(v) << at[v].real(), at[v].imag();
  return flat;
}

/// A folded Miura-ori bent by curvatures (1/mm) along and across, moved by up to `random_mm`, and
/// made developable.
inline DesignedMesh curved_mesh(int rows, int columns, const Eigen::Vector2d& curvatures,
                                double random_mm, unsigned seed) {
  DesignedMesh mesh = graded_miura(rows, columns, 0.6);
  std::mt19937 words(seed);
  std::uniform_real_distribution<double> move_mm(-random_mm, random_mm);
  const Eigen::Vector3d middle = mesh.folded_mm.rowwise().mean();
  for (auto place : mesh.folded_mm.colwise()) {
    const Eigen::Vector2d from = place.head<2>() - middle.head<2>();
    place.z() -= curvatures.dot(from.cwiseAbs2()) / 2;
    for (double& x : place) x += move_mm(words);
  }
  make_developable(mesh.flat, mesh.folded_mm);
  mesh.flat.vertices_mm = unrolled(mesh.flat, mesh.folded_mm);
  return mesh;
}

}  // namespace misalign::solver
