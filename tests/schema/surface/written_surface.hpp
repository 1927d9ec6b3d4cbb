// Meshes of surfaces as other programs write them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace misalign::schema {

struct WrittenSurface {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<int>> faces;

  /// Quadrilaterals over a square of `cells` squared cells, 200 mm wide, whose middle is zero.
  static WrittenSurface square(int cells, const std::function<double(double, double)>& height_mm) {
    WrittenSurface surface;
    const double side_mm = 200.0 / cells;
    for (int i = 0; i <= cells; ++i) {
      for (int k = 0; k <= cells; ++k) {
        const double x = k * side_mm - 100, y = i * side_mm - 100;
        // Single precision holds these heights.
        surface.points.emplace_back(x, y, std::round(64 * height_mm(x, y)) / 64);
        if (i == cells || k == cells) continue;
        const int a = i * (cells + 1) + k;
        surface.faces.push_back({a, a + 1, a + cells + 2, a + cells + 1});
      }
    }
    return surface;
  }
  static WrittenSurface bowl(int cells = 8) {
    return square(cells, [](double x, double y) { return (x * x + y * y) / 1024; });
  }

  std::string obj() const {
    std::string text = "# made elsewhere\no hull\n";
    for (const auto& p : points) text += "v " + numbers(p) + " 1.0\r\n";
    text += "vt 0 0\nvn 0 0 1\ns off\n";
    for (std::size_t f = 0; f < faces.size(); ++f) {
      text += "f";
      for (const int v : faces[f]) {
        text += f % 2 ? " " + std::to_string(v - static_cast<int>(points.size()))
                      : " " + std::to_string(v + 1) + "/1/1";
      }
      text += "\n";
    }
    return text;
  }

  std::string stl_text() const {
    std::string text = "solid hull made elsewhere\n";
    each_triangle([&](const std::array<Eigen::Vector3d, 3>& corners) {
      text += "  facet normal 0 0 1\n    outer loop\n";
      for (const auto& p : corners) text += "      vertex " + numbers(p) + "\n";
      text += "    endloop\n  endfacet\n";
    });
    return text + "endsolid hull\n";
  }
  std::string stl_bytes() const {
    std::string facets;
    std::uint32_t count = 0;
    each_triangle([&](const std::array<Eigen::Vector3d, 3>& corners) {
      facets.append(12, '\0');
      for (const auto& p : corners) {
        for (const double x : p) append(facets, static_cast<float>(x), false);
      }
      facets.append(2, '\7');
      ++count;
    });
    std::string bytes = "solid as some programs begin their binary files";
    bytes.resize(80);
    append(bytes, count, false);
    return bytes + facets;
  }

  enum class Form { text, little, big };
  std::string ply(Form form) const {
    const bool is_text = form == Form::text, is_big = form == Form::big;
    std::string bytes = "ply\nformat ";
    bytes += is_text ? "ascii" : is_big ? "binary_big_endian" : "binary_little_endian";
    bytes += " 1.0\ncomment made elsewhere\nelement vertex " + std::to_string(points.size()) +
             "\nproperty double x\nproperty float32 y\nproperty uchar red\nproperty double z\n"
             "element face " +
             std::to_string(faces.size()) +
             "\nproperty list uchar int vertex_indices\nproperty short part\nend_header\n";
    for (const auto& p : points) {
      if (is_text) {
        bytes += std::to_string(p.x()) + " " + std::to_string(p.y()) + " 200 " +
                 std::to_string(p.z()) + "\n";
      } else {
        append(bytes, p.x(), is_big);
        append(bytes, static_cast<float>(p.y()), is_big);
        bytes += '\7';
        append(bytes, p.z(), is_big);
      }
    }
    for (const auto& face : faces) {
      bytes +=
          is_text ? std::to_string(face.size()) : std::string(1, static_cast<char>(face.size()));
      for (const int v : face) {
        if (is_text)
          bytes += " " + std::to_string(v);
        else
          append(bytes, v, is_big);
      }
      if (is_text)
        bytes += " -3\n";
      else
        append(bytes, std::int16_t{-3}, is_big);
    }
    return bytes;
  }

 private:
  static std::string numbers(const Eigen::Vector3d& p) {
    return std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z());
  }
  template <class Number>
  static void append(std::string& bytes, Number number, bool is_big) {
    char raw[sizeof(number)];
    std::memcpy(raw, &number, sizeof(number));
    if (is_big) std::reverse(std::begin(raw), std::end(raw));
    bytes.append(raw, sizeof(number));
  }
  void each_triangle(const std::function<void(const std::array<Eigen::Vector3d, 3>&)>& see) const {
    const auto at = [&](int v) { return points[static_cast<std::size_t>(v)]; };
    for (const auto& face : faces) {
      for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        see({at(face[0]), at(face[k]), at(face[k + 1])});
      }
    }
  }
};

}  // namespace misalign::schema
