#include "schema/print/solid_files.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>

#include "schema/exchange/xml_text.hpp"
#include "schema/print/stored_zip.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector3d;

static_assert(std::endian::native == std::endian::little, "STL is little-endian");

template <class Number>
void put_bytes(std::string& out, Number value) {
  std::array<char, sizeof value> bytes;
  std::memcpy(bytes.data(), &value, sizeof value);
  out.append(bytes.data(), bytes.size());
}

void put_vector(std::string& out, const Vector3d& vector) {
  for (int k = 0; k < 3; ++k) put_bytes(out, static_cast<float>(vector[k]));
}

std::string object_of(const Solid& solid, std::size_t id) {
  std::string text = fmt::format("<object id=\"{}\" type=\"model\" name=\"{}\"><mesh><vertices>\n",
                                 id, solid.name);
  const auto out = std::back_inserter(text);
  for (const Vector3d& v : solid.vertices_mm) {
    fmt::format_to(out, "<vertex x=\"{:.6f}\" y=\"{:.6f}\" z=\"{:.6f}\"/>\n", v.x(), v.y(), v.z());
  }
  text += "</vertices><triangles>\n";
  for (const auto& [a, b, c] : solid.triangles) {
    fmt::format_to(out, "<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", a, b, c);
  }
  return text + "</triangles></mesh></object>\n";
}

// Items of the build: rows of solids, about as wide as they are long.
std::string build_of(const std::vector<Solid>& solids) {
  constexpr double kGap_mm = 5;
  std::vector<Vector3d> least, size;
  double area_mm2 = 0;
  for (const Solid& solid : solids) {
    Vector3d low = solid.vertices_mm.front(), high = low;
    for (const Vector3d& v : solid.vertices_mm) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
    least.push_back(low);
    size.push_back(high - low + Vector3d::Constant(kGap_mm));
    area_mm2 += size.back().x() * size.back().y();
  }
  std::string text;
  Vector3d at = Vector3d::Zero();
  double depth_mm = 0;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    if (at.x() > std::sqrt(area_mm2)) {
      at = Vector3d(0, at.y() + depth_mm, 0);
      depth_mm = 0;
    }
    const Vector3d shift = at - least[k];
    text += fmt::format(
        "<item objectid=\"{}\" transform=\"1 0 0 0 1 0 0 0 1 {:.6f} {:.6f} {:.6f}\"/>\n", k + 1,
        shift.x(), shift.y(), shift.z());
    at.x() += size[k].x();
    depth_mm = std::max(depth_mm, size[k].y());
  }
  return text;
}

}  // namespace

std::string binary_stl(const Solid& solid) {
  constexpr std::size_t kHeader = 80;
  std::string bytes = "misalign " + solid.name;
  bytes.resize(kHeader, ' ');
  put_bytes(bytes, static_cast<std::uint32_t>(solid.triangles.size()));
  for (const auto& triangle : solid.triangles) {
    const auto at = [&](std::size_t k) -> const Vector3d& {
      return solid.vertices_mm[static_cast<std::size_t>(triangle[k])];
    };
    put_vector(bytes, (at(1) - at(0)).cross(at(2) - at(0)).normalized());
    for (std::size_t k = 0; k < 3; ++k) put_vector(bytes, at(k));
    put_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string three_mf(const std::vector<Solid>& solids, const std::string& title) {
  const std::string declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  std::string model =
      declaration +
      "<model unit=\"millimeter\" xml:lang=\"en\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<metadata "
      "name=\"Title\">" +
      xml_text(title) + "</metadata>\n<resources>\n";
  for (std::size_t k = 0; k < solids.size(); ++k) model += object_of(solids[k], k + 1);
  model += "</resources>\n<build>\n" + build_of(solids) + "</build>\n</model>\n";
  const std::string types =
      declaration +
      "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
      "<Default Extension=\"rels\" "
      "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
      "<Default Extension=\"model\" "
      "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
  const std::string relations =
      declaration +
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";
  return stored_zip(
      {{"[Content_Types].xml", types}, {"_rels/.rels", relations}, {"3D/3dmodel.model", model}});
}

}  // namespace misalign::schema
