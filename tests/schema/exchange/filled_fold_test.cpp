// FOLD files with fillers: all panels hang on a tree of creases, along which the file's own angles
// fold every frame's coordinates; triangles stay rigid; what reads them back sees the sheet alone.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <deque>
#include <map>
#include <optional>

#include "schema/exchange/fold_export.hpp"
#include "schema/pattern/carried_pattern.hpp"
#include "schema/pattern/filled_mesh.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "tests/schema/exchange/shifted_pattern.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::schema {
namespace {

using Eigen::Matrix3Xd, Eigen::Vector3d;

/// A carried pattern, its interior vertices shifted, folded and exported with fillers.
struct Joined {
  explicit Joined(const std::string& name)
      : pattern(
            shifted(read_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/" + name + ".json"))),
        own(pattern.base, pattern.shifts_mm,
            {.end_deg = std::floor(pattern.base.folding.end_deg())}) {
    const auto rows = sheet.rows_to_show(10);
    for (const Eigen::Index row : rows) shapes_mm.push_back(&sheet.shapes_mm()[row]);
    const auto chosen =
        solver::joining_fillers(pattern.base, mechanism, pattern.vertices_mm(), shapes_mm);
    EXPECT_TRUE(chosen) << name;
    if (chosen) fillers = *chosen;
    fold = folded_fold_json({pattern, sheet}, rows, "a test", {{"draw", 7}}, fillers);
  }

  const Pattern pattern;
  const solver::OwnSheet own;
  const solver::Sheet& sheet = own.sheet;
  const solver::Mechanism& mechanism = sheet.mechanism();
  std::vector<const Matrix3Xd*> shapes_mm;
  std::vector<solver::Filler> fillers;
  Json fold;
};

class FilledFold : public testing::TestWithParam<std::string> {
 protected:
  const Joined joined_{GetParam()};
  const Json& fold_ = joined_.fold;
};

INSTANTIATE_TEST_SUITE_P(Families, FilledFold,
                         testing::Values("table1", "miura-graded-6x6", "double-corrugation-6x6",
                                         "angle-array-6x6", "turned-quads-6x6"),
                         [](const auto& name) {
                           std::string word = name.param;
                           std::erase(word, '-');
                           return word;
                         });

Matrix3Xd points_of(const Json& list) {
  Matrix3Xd points = Matrix3Xd::Zero(3, static_cast<Eigen::Index>(list.size()));
  for (std::size_t v = 0; v < list.size(); ++v) {
    for (std::size_t k = 0; k < list[v].size(); ++k) {
      points(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(v)) = list[v][k];
    }
  }
  return points;
}

// Folds a crease pattern along a tree of faces, as readers do, from the file's text alone: who
// crosses an edge turns about it by its angle. Nothing if a face is not reached.
std::optional<Matrix3Xd> refolded(const Json& fold, const Json& angles) {
  const Matrix3Xd flat = points_of(fold["vertices_coords"]);
  const std::vector<std::vector<int>> faces = fold["faces_vertices"];
  std::map<std::pair<int, int>, std::size_t> edge_of;
  for (std::size_t e = 0; e < fold["edges_vertices"].size(); ++e) {
    const int a = fold["edges_vertices"][e][0], b = fold["edges_vertices"][e][1];
    edge_of[std::minmax(a, b)] = e;
  }
  std::map<std::pair<int, int>, std::size_t> face_with;  // on the left of a directed edge
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t k = 0; k < faces[f].size(); ++k) {
      face_with[{faces[f][k], faces[f][(k + 1) % faces[f].size()]}] = f;
    }
  }
  std::vector<Eigen::Isometry3d> poses(faces.size(), Eigen::Isometry3d::Identity());
  std::vector<bool> reached(faces.size(), false);
  Matrix3Xd folded = Matrix3Xd::Constant(3, flat.cols(), std::nan(""));
  std::deque<std::size_t> front{0};
  reached[0] = true;
  for (; !front.empty(); front.pop_front()) {
    const std::vector<int>& face = faces[front.front()];
    for (const int v : face) folded.col(v) = poses[front.front()] * flat.col(v);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int a = face[k], b = face[(k + 1) % face.size()];
      const auto next = face_with.find({b, a});
      if (next == face_with.end() || reached[next->second]) continue;
      // A valley's right side comes up: about the edge with the left on its left, to the left.
      const double angle = angles[edge_of.at(std::minmax(a, b))].get<double>() * M_PI / 180;
      const Vector3d along = (flat.col(b) - flat.col(a)).normalized();
      poses[next->second] = poses[front.front()] * Eigen::Translation3d(flat.col(a)) *
                            Eigen::AngleAxisd(-angle, along) * Eigen::Translation3d(-flat.col(a));
      reached[next->second] = true;
      front.push_back(next->second);
    }
  }
  if (std::find(reached.begin(), reached.end(), false) != reached.end()) return std::nullopt;
  return folded;
}

double farthest_mm(const Matrix3Xd& one, const Matrix3Xd& other) {
  const Eigen::Isometry3d moved(Eigen::umeyama(one, other, false));
  return (moved * one - other).colwise().norm().maxCoeff();
}

TEST_P(FilledFold, FoldsAlongATreeOfFaces) {
  EXPECT_GE(joined_.fillers.size(), 1u);
  ASSERT_FALSE(fold_["file_frames"].empty());
  double worst_mm = 0;
  for (const Json& frame : fold_["file_frames"]) {
    const auto folded = refolded(fold_, frame["edges_foldAngle"]);
    ASSERT_TRUE(folded) << "a panel that no crease reaches";
    worst_mm = std::max(worst_mm, farthest_mm(*folded, points_of(frame["vertices_coords"])));
  }
  EXPECT_LE(worst_mm, 1e-8);
  // Without the last filler a panel is not reached; with a hinge 0.01 degrees off it shows.
  Json fewer = fold_;
  fewer["faces_vertices"].erase(fewer["faces_vertices"].size() - 1);
  EXPECT_FALSE(refolded(fewer, fold_["edges_foldAngle"]));
  Json off = fold_["file_frames"].back();
  const std::size_t hinge = fold_["edges_vertices"].size() - 3;
  off["edges_foldAngle"][hinge] = off["edges_foldAngle"][hinge].get<double>() + 0.01;
  EXPECT_GE(
      farthest_mm(*refolded(fold_, off["edges_foldAngle"]), points_of(off["vertices_coords"])),
      1e-3);
}

TEST_P(FilledFold, TrianglesLieInTheirHolesAndStayRigid) {
  const std::vector<std::vector<int>> faces = fold_["faces_vertices"];
  const Matrix3Xd flat = points_of(fold_["vertices_coords"]);
  for (const Json& filler : fold_[kFillers]) {
    for (const std::size_t f : filler["faces"]) {
      ASSERT_EQ(faces[f].size(), 3u);
      const auto side = [&](const Matrix3Xd& points, std::size_t k) {
        return Vector3d(points.col(faces[f][(k + 1) % 3]) - points.col(faces[f][k]));
      };
      EXPECT_GT(side(flat, 0).cross(side(flat, 1)).z(), 0) << "counter-clockwise";
      for (const Json& frame : fold_["file_frames"]) {
        const Matrix3Xd folded = points_of(frame["vertices_coords"]);
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(side(folded, k).norm(), side(flat, k).norm(), 1e-10);
        }
      }
    }
  }
}

// Letters say how the key frame's angles go; an edge is B where one face lies at it.
TEST_P(FilledFold, KnowsOnlyMountainsValleysAndBorders) {
  std::map<std::pair<int, int>, int> faces_at;
  for (const Json& face : fold_["faces_vertices"]) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int a = face[k], b = face[(k + 1) % face.size()];
      ++faces_at[std::minmax(a, b)];
    }
  }
  for (std::size_t e = 0; e < fold_["edges_vertices"].size(); ++e) {
    const int a = fold_["edges_vertices"][e][0], b = fold_["edges_vertices"][e][1];
    const double angle = fold_["edges_foldAngle"][e];
    const std::string letter = faces_at.at(std::minmax(a, b)) == 1 ? "B" : angle > 0 ? "V" : "M";
    EXPECT_EQ(fold_["edges_assignment"][e], letter) << a << " " << b;
    EXPECT_TRUE(letter != "B" || angle == 0);
    for (const Json& frame : fold_["file_frames"]) {
      EXPECT_GE(frame["edges_foldAngle"][e].get<double>() * angle, 0) << "changes its side";
    }
  }
}

TEST_P(FilledFold, IsReadAsTheSheetAlone) {
  const auto read = [](const Json& fold) {
    InputFaults faults;
    Pattern pattern = read_carried_pattern(fold, faults, Perforations::of_one_freedom);
    return std::pair(std::move(pattern), faults.none() ? "" : faults.sentences().front());
  };
  const auto [again, sentence] = read(Json::parse(fold_.dump()));
  EXPECT_EQ(sentence, "");
  EXPECT_EQ(again.vertices_mm(), joined_.pattern.vertices_mm());
  EXPECT_EQ(again.base.holes, joined_.pattern.base.holes);
  const auto is_refused = [&](const char* what, const auto& change) {
    Json changed = fold_;
    change(changed);
    EXPECT_NE(read(changed).second.find("were changed since"), std::string::npos) << what;
  };
  is_refused("a filler that is not listed", [](Json& fold) { fold[kFillers].erase(0); });
  is_refused("no list", [](Json& fold) { fold[kFillers] = 5; });
  is_refused("another corner", [](Json& fold) { fold[kFillers][0]["vertex"] = "A1"; });
  is_refused("another hole", [](Json& fold) { fold[kFillers][0]["hole"] = {0, 0}; });
  is_refused("no letters", [](Json& fold) { fold[kFillers][0]["hinges"] = "MXV"; });
  is_refused("an apex that was moved", [](Json& fold) {
    Json& x = fold["vertices_coords"].back()[0];
    x = x.get<double>() + 1e-6;
  });
  is_refused("no triangle",
             [](Json& fold) { fold["faces_vertices"].erase(fold["faces_vertices"].size() - 1); });
}

// A corner that is wider than when flat is out of a filler's reach.
TEST_P(FilledFold, NoFillerWhereCornersGetWider) {
  const Eigen::Matrix2Xd flat_mm = joined_.pattern.vertices_mm();
  std::srand(3);
  std::vector<Matrix3Xd> shapes;
  for (int k = 0; k < 40; ++k) {
    shapes.push_back(Matrix3Xd::Zero(3, flat_mm.cols()));
    shapes.back().topRows<2>() = flat_mm + Eigen::Matrix2Xd::Random(2, flat_mm.cols()) *
                                               joined_.pattern.base.sheet.panel_width_mm / 100;
  }
  std::vector<const Matrix3Xd*> all;
  for (const Matrix3Xd& shape : shapes) all.push_back(&shape);
  EXPECT_FALSE(solver::joining_fillers(joined_.pattern.base, joined_.mechanism, flat_mm, all));
}

}  // namespace
}  // namespace misalign::schema
