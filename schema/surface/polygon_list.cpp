#include "schema/surface/polygon_list.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "schema/files/text_lines.hpp"

namespace misalign::schema {
namespace {

// A binary STL file: a header, the number of facets, and for each a normal, three points and a
// word. PLY is read with the same numbers, least byte first.
constexpr std::size_t kStlHeader_bytes = 80, kStlBegin_bytes = 84, kFacet_bytes = 50;
static_assert(std::endian::native == std::endian::little);

std::size_t facets_of_header(std::string_view bytes) {
  std::uint32_t count;
  std::memcpy(&count, bytes.data() + kStlHeader_bytes, sizeof(count));
  return count;
}

// Reads three numbers after a line's first word.
bool read_point(const Words& words, std::vector<Eigen::Vector3d>& points_mm) {
  Eigen::Vector3d& point_mm = points_mm.emplace_back(Eigen::Vector3d::Zero());
  if (words.size() < 4) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = number_of<double>(words[k + 1]);
    if (!number || !std::isfinite(*number)) return false;
    point_mm(static_cast<Eigen::Index>(k)) = *number;
  }
  return true;
}

void report_points(const FaultKind& kind, InputFaults& faults) {
  kind.report("needs three finite numbers", "write the file again from the program it comes from",
              faults);
}

bool begins_with_word(std::string_view bytes, std::string_view word) {
  const Words words = words_of(bytes.substr(0, bytes.find('\n')));
  return !words.empty() && words[0] == word;
}

}  // namespace

void FaultKind::report(const std::string& why, const std::string& suggestion,
                       InputFaults& faults) const {
  if (count_ == 0) return;
  const std::string others = count_ == 1   ? ""
                             : count_ == 2 ? " and 1 other"
                                           : fmt::format(" and {} others", count_ - 1);
  faults.add(first_ + others, why, suggestion);
}

PolygonList read_obj_polygons(std::string_view text, InputFaults& faults) {
  PolygonList list;
  FaultKind points, faces;
  each_line(text, [&](const Words& words) {
    if (words[0] == "v" && !read_point(words, list.points_mm)) {
      points.see([&] { return fmt::format("vertex {}", list.points_mm.size()); });
    }
    if (words[0] != "f") return true;
    std::vector<int>& face = list.faces.emplace_back();
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto number = number_of<int>(words[k].substr(0, words[k].find('/')));
      if (!number) faces.see([&] { return fmt::format("face {}", list.faces.size()); });
      const int from_end = static_cast<int>(list.points_mm.size());
      face.push_back(number ? *number > 0 ? *number - 1 : from_end + *number : 0);
    }
    return list.faces.size() <= kMostPolygons;
  });
  report_points(points, faults);
  faces.report("has a corner that is no whole number", "write corners like 7 or 7/1/3", faults);
  return list;
}

PolygonList read_stl_text(std::string_view text, InputFaults& faults) {
  PolygonList list;
  FaultKind points;
  bool is_ended = false;
  each_line(text, [&](const Words& words) {
    if (words[0] == "vertex" && !read_point(words, list.points_mm)) {
      points.see(
          [&] { return fmt::format("a vertex of facet {}", (list.points_mm.size() + 2) / 3); });
    }
    is_ended = is_ended || words[0] == "endsolid";
    return list.points_mm.size() <= 3 * kMostPolygons + 3;
  });
  report_points(points, faults);
  if (!is_ended || list.points_mm.size() % 3 != 0) {
    faults.add("STL", is_ended ? "has a facet without three vertices" : "has no endsolid",
               "write the file again: it is not whole");
  }
  for (int k = 0; k + 2 < static_cast<int>(list.points_mm.size()); k += 3) {
    list.faces.push_back({k, k + 1, k + 2});
  }
  return list;
}

PolygonList read_stl_bytes(std::string_view bytes) {
  PolygonList list;
  const std::size_t count = std::min(facets_of_header(bytes), kMostPolygons + 1);
  for (std::size_t k = 0; k < count; ++k) {
    float numbers[12];
    std::memcpy(numbers, bytes.data() + kStlBegin_bytes + k * kFacet_bytes, sizeof(numbers));
    const int first = static_cast<int>(3 * k);
    list.faces.push_back({first, first + 1, first + 2});
    for (int corner = 1; corner <= 3; ++corner) {
      list.points_mm.push_back(
          Eigen::Map<const Eigen::Vector3f>(numbers + 3 * corner).cast<double>());
    }
  }
  return list;
}

PolygonList read_polygons(std::string_view bytes, const std::string& name, InputFaults& faults) {
  const bool has_count = bytes.size() >= kStlBegin_bytes;
  if (has_count && bytes.size() == kStlBegin_bytes + kFacet_bytes * facets_of_header(bytes)) {
    return read_stl_bytes(bytes);
  }
  if (begins_with_word(bytes, "ply")) return read_ply(bytes, faults);
  if (begins_with_word(bytes, "solid")) return read_stl_text(bytes, faults);
  if (name.ends_with(".stl") || name.ends_with(".STL")) {
    faults.add(
        "binary STL",
        has_count
            ? fmt::format("says {} facets, which are {} bytes, but has {}", facets_of_header(bytes),
                          kStlBegin_bytes + kFacet_bytes * facets_of_header(bytes), bytes.size())
            : fmt::format("is shorter than its header: {} bytes", bytes.size()),
        "write the file again: it is not whole");
    return {};
  }
  PolygonList list = read_obj_polygons(bytes, faults);
  if (list.points_mm.empty() && list.faces.empty()) {
    faults.add("the file", "is no OBJ, STL or PLY", "export the surface as one of these");
  }
  return list;
}

}  // namespace misalign::schema
