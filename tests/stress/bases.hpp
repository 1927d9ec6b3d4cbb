// Base patterns of any size for the stress suite, each through the border that users' files pass.
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "schema/pattern/pattern_file.hpp"

namespace misalign::stress {

using schema::Json;

inline solver::PerforatedSheet read_base(const Json& pattern) {
  schema::InputFaults faults;
  const schema::Pattern read =
      schema::read_pattern(pattern, "pattern", schema::Displacements::refused, {}, faults);
  faults.refuse("a base of the stress suite");
  return read.base;
}

/// A Miura-ori whose zigzags have this sector angle, its panels 80 mm high and `width_mm` wide.
inline solver::PerforatedSheet miura(int rows, int columns, double sector_deg,
                                     double width_mm = 80) {
  return read_base({{"family", "miura"},
                    {"rows", rows},
                    {"columns", columns},
                    {"panel_width_mm", width_mm},
                    {"zigzag_offset_mm", 80 / std::tan(sector_deg * solver::kRadPerDeg)}});
}

inline solver::PerforatedSheet paper(int rows, int columns, const std::string& holes) {
  return read_base({{"family", "miura"}, {"rows", rows}, {"columns", columns}, {"holes", holes}});
}

inline solver::PerforatedSheet graded(int rows, int columns) {
  Json widths, heights, offsets;
  for (int c = 0; c < columns; ++c) widths.push_back(100.0 - 30.0 * c / columns);
  for (int r = 0; r < rows; ++r) {
    heights.push_back(60.0 + 30.0 * r / rows);
    offsets.push_back(0.5 * (60.0 + 30.0 * r / rows));
  }
  return read_base({{"family", "miura"},
                    {"rows", rows},
                    {"columns", columns},
                    {"panel_width_mm", widths},
                    {"panel_height_mm", heights},
                    {"zigzag_offset_mm", offsets}});
}

/// Directions (deg) and signs (valley +1) of the edges that leave vertex (i, j) for the next column
/// and for the next row.
using AtVertex = std::function<double(int, int)>;

/// A mesh from the lengths (mm) of its first row and column and the directions of all edges.
inline solver::PerforatedSheet mesh(int rows, int columns, const AtVertex& across_deg,
                                    const AtVertex& up_deg, const AtVertex& across_sign,
                                    const AtVertex& up_sign, double length_mm) {
  const auto ray = [](double deg) {
    return Eigen::Vector2d(std::cos(deg * solver::kRadPerDeg), std::sin(deg * solver::kRadPerDeg));
  };
  const auto index = [&](int i, int j) { return i * (columns + 1) + j; };
  std::vector<Eigen::Vector2d> p((rows + 1) * (columns + 1), Eigen::Vector2d::Zero());
  Json edges, letters, faces, vertices;
  const auto edge = [&](int from, int to, bool inside, double sign) {
    edges.push_back({from, to});
    letters.push_back(!inside ? "B" : sign > 0 ? "V" : "M");
  };
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      if (i == 0 && j > 0)
        p[index(0, j)] = p[index(0, j - 1)] + length_mm * ray(across_deg(0, j - 1));
      if (j == 0 && i > 0) p[index(i, 0)] = p[index(i - 1, 0)] + length_mm * ray(up_deg(i - 1, 0));
      if (i > 0 && j > 0) {  // where the edge from below and the one from the left meet
        Eigen::Matrix2d directions;
        directions << ray(up_deg(i - 1, j)), -ray(across_deg(i, j - 1));
        const Eigen::Vector2d along =
            directions.inverse() * (p[index(i, j - 1)] - p[index(i - 1, j)]);
        p[index(i, j)] = p[index(i - 1, j)] + along[0] * ray(up_deg(i - 1, j));
      }
      vertices.push_back({p[index(i, j)].x(), p[index(i, j)].y()});
      if (j < columns) edge(index(i, j), index(i, j + 1), i > 0 && i < rows, across_sign(i, j));
      if (i < rows) edge(index(i, j), index(i + 1, j), j > 0 && j < columns, up_sign(i, j));
      if (i < rows && j < columns) {
        faces.push_back({index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j)});
      }
    }
  }
  return read_base({{"family", "fold"},
                    {"mesh",
                     {{"vertices_coords", vertices},
                      {"edges_vertices", edges},
                      {"edges_assignment", letters},
                      {"faces_vertices", faces}}}});
}

/// Both families of creases are zigzags, by 10 and by 25 degrees.
inline solver::PerforatedSheet double_corrugation(int rows, int columns) {
  const auto zigzag = [](int j) { return j % 2 ? 1.0 : -1.0; };
  return mesh(
      rows, columns, [](int, int j) { return j % 2 ? -10.0 : 10.0; },
      [](int i, int) { return i % 2 ? 115.0 : 65.0; },
      [=](int i, int j) { return (j ? zigzag(j) : -1) * (i % 2 ? 1 : -1); },
      [=](int, int j) { return zigzag(j); }, 80);
}

/// Quadrilaterals with these angles, every other one turned by half.
inline solver::PerforatedSheet turned_quads(int rows, int columns, double b_deg, double c_deg,
                                            double a_deg) {
  const auto odd = [](int i, int j) { return (i + j) % 2 == 1; };
  return mesh(
      rows, columns, [=](int i, int j) { return odd(i, j) ? 180 - b_deg - c_deg : 0.0; },
      [=](int i, int j) { return odd(i, j) ? 180 - b_deg : a_deg; },
      [=](int i, int j) { return odd(i, j) ? -1.0 : 1.0; }, [](int, int) { return 1.0; }, 80);
}

}  // namespace misalign::stress
