// Exported STL files, read back.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/export_files.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

using Eigen::Vector3d;

struct Solid {
  std::string name;
  std::map<std::pair<std::string, std::string>, int> edges;  // by how their ends are written
  double volume_mm3 = 0, off_normal = 0;
};

Vector3d numbers_of(const std::string& text) {
  std::istringstream fields(text);
  Vector3d v;
  fields >> v.x() >> v.y() >> v.z();
  EXPECT_TRUE(fields && fields.eof()) << text;
  return v;
}

// What follows a word at a line's beginning; empty if it does not begin so.
std::string after(const std::string& line, const std::string& word) {
  return line.starts_with(word + " ") ? line.substr(word.size() + 1) : "";
}

void take(Solid& solid, const std::array<std::string, 3>& written, const std::string& normal) {
  std::array<Vector3d, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = numbers_of(written[k]);
    ++solid.edges[{written[k], written[(k + 1) % 3]}];
  }
  const Vector3d across = (p[1] - p[0]).cross(p[2] - p[0]);
  EXPECT_GT(across.norm(), 0) << solid.name;
  solid.off_normal = std::max(solid.off_normal, (across.normalized() - numbers_of(normal)).norm());
  solid.volume_mm3 += p[0].dot(p[1].cross(p[2])) / 6;
}

std::vector<Solid> read_stl(const std::filesystem::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<Solid> solids;
  std::vector<std::string> corners;
  std::string normal;
  bool is_open = false;
  for (std::string line; std::getline(file, line);) {
    if (const std::string name = after(line, "solid"); !name.empty()) {
      EXPECT_FALSE(is_open);
      is_open = true;
      solids.push_back({name, {}});
    } else if (const std::string end = after(line, "endsolid"); !end.empty()) {
      EXPECT_TRUE(is_open && end == solids.back().name);
      is_open = false;
    } else if (const std::string facet = after(line, "facet normal"); !facet.empty()) {
      normal = facet;
      corners.clear();
    } else if (const std::string corner = after(line, "vertex"); !corner.empty()) {
      corners.push_back(corner);
    } else if (line == "endfacet") {
      EXPECT_TRUE(is_open && corners.size() == 3);
      take(solids.back(), {corners.at(0), corners.at(1), corners.at(2)}, normal);
    } else {
      EXPECT_TRUE(line == "outer loop" || line == "endloop") << line;
    }
  }
  EXPECT_FALSE(is_open);
  return solids;
}

// Each edge is that of two triangles, once in each direction; the outside is outside; and panels
// keep their volumes while the sheet folds.
TEST(PlateStl, IsClosedInEveryState) {
  const ChosenSheet sheet =
      sheet_of_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json");
  ExportOptions options;
  const Folder folder("plates");
  options.directory = folder.path();
  options.format = ExportFormat::stl;
  options.step_deg = 60;
  options.release.plates.thickness_mm = 0.3;
  FoldingModel model(sheet.base, sheet.sampling, sheet.design, options.look_deg());
  ExportFiles(model, options).write(model.sheet(sheet.shifts_mm), {"sheet", "a sheet"}, {});
  std::map<std::string, double> volumes_mm3;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(options.directory)) {
    ++files;
    const std::vector<Solid> solids = read_stl(entry.path());
    EXPECT_EQ(solids.size(), 28u) << entry.path();
    for (const Solid& solid : solids) {
      for (const auto& [edge, times] : solid.edges) {
        ASSERT_EQ(times, 1) << solid.name << " in " << entry.path();
        ASSERT_TRUE(solid.edges.contains({edge.second, edge.first})) << solid.name;
      }
      EXPECT_LT(solid.off_normal, 1e-4) << solid.name;
      EXPECT_GT(solid.volume_mm3, 0) << solid.name;
      const auto [first, is_new] = volumes_mm3.insert({solid.name, solid.volume_mm3});
      EXPECT_NEAR(solid.volume_mm3, first->second, 1e-5 * first->second) << entry.path();
    }
  }
  EXPECT_EQ(files, 4);  // flat, 60, 120, D
  EXPECT_EQ(volumes_mm3.size(), 28u);
}

}  // namespace
}  // namespace misalign::search
