// Exported FOLD files: the rules that importers have (one test each), the shape in every frame by
// coordinates alone, and the way back.
#include "schema/exchange/fold_export.hpp"

#include <gtest/gtest.h>

#include <set>

#include "schema/exchange/drawing.hpp"
#include "schema/pattern/carried_pattern.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/model/panels.hpp"
#include "solver/pattern/perforation.hpp"
#include "solver/records/record_sheet.hpp"
#include "tests/folder.hpp"
#include "tests/schema/exchange/shifted_pattern.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::schema {
namespace {

/// A carried pattern, its interior vertices shifted, folded and exported.
struct Exported {
  explicit Exported(const std::string& name, double step_deg = 10)
      : pattern(shifted(pattern_of(name))),
        own(pattern.base, pattern.shifts_mm,
            {.end_deg = std::floor(pattern.base.folding.end_deg()), .look_deg = step_deg}) {
    rows = sheet.rows_to_show(step_deg);
    fold = folded_fold_json({pattern, sheet}, rows, "a test", {{"draw", 7}});
  }
  /// A carried one; or the first with a mountain as its pilot, seen from below by the solver.
  static Pattern pattern_of(const std::string& name) {
    const std::string folder = MISALIGN_SOURCE_DIR "/search/patterns/";
    if (name != "mountain-pilot") return read_pattern_file(folder + name + ".json");
    Json table1 = read_json_file(folder + "table1.json");
    table1["pilot"] = "A3-A10";
    InputFaults faults;
    Pattern pattern = read_pattern(table1, "", Displacements::allowed, {}, faults);
    EXPECT_EQ(pattern.base.folding.side(), -1);
    return pattern;
  }
  int d() const { return sheet.history().verdict.deploys_from_sample; }

  const Pattern pattern;
  const solver::OwnSheet own;
  const solver::Sheet& sheet = own.sheet;
  const solver::Mechanism& mechanism = sheet.mechanism();
  std::vector<Eigen::Index> rows;
  Json fold;
};

class FoldExport : public testing::TestWithParam<std::string> {
 protected:
  const Exported exported_{GetParam()};
  const Json& fold_ = exported_.fold;
};

std::vector<std::string> names() {
  return {"table1",          "miura-graded-6x6", "double-corrugation-6x6",
          "angle-array-6x6", "turned-quads-6x6", "mountain-pilot"};
}

INSTANTIATE_TEST_SUITE_P(Families, FoldExport, testing::ValuesIn(names()), [](const auto& name) {
  std::string word = name.param;
  std::erase(word, '-');
  return word;
});

TEST_P(FoldExport, HasWhatOrigamiSimulatorAsksFor) {
  for (const char* key : {"vertices_coords", "edges_vertices", "edges_assignment", "faces_vertices",
                          "edges_foldAngle"}) {
    ASSERT_TRUE(fold_.contains(key)) << key;
    EXPECT_FALSE(fold_[key].empty()) << key;
  }
  EXPECT_EQ(fold_["edges_assignment"].size(), fold_["edges_vertices"].size());
  EXPECT_EQ(fold_["edges_foldAngle"].size(), fold_["edges_vertices"].size());
  EXPECT_EQ(fold_["file_spec"], 1.2);
}

TEST_P(FoldExport, KnowsOnlyMountainsValleysAndBorders) {
  std::set<std::string> letters;
  for (const Json& letter : fold_["edges_assignment"]) letters.insert(letter.get<std::string>());
  EXPECT_EQ(letters, (std::set<std::string>{"B", "M", "V"})) << "no C, no J";
}

// A removed facet is absent; an edge is B exactly where one face lies at it.
TEST_P(FoldExport, LacksHolesAndHasBordersRoundThem) {
  const solver::PerforatedSheet& base = exported_.pattern.base;
  EXPECT_EQ(fold_["faces_vertices"].size(), base.sheet.facets.size() - base.holes.size());
  std::map<std::pair<int, int>, int> faces_at;
  for (const Json& face : fold_["faces_vertices"]) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int a = face[k], b = face[(k + 1) % face.size()];
      ++faces_at[std::minmax(a, b)];
    }
  }
  for (std::size_t e = 0; e < fold_["edges_vertices"].size(); ++e) {
    const int a = fold_["edges_vertices"][e][0], b = fold_["edges_vertices"][e][1];
    const int faces = faces_at[std::minmax(a, b)];
    EXPECT_GE(faces, 1) << a << " " << b;
    EXPECT_EQ(fold_["edges_assignment"][e] == "B", faces == 1) << a << " " << b;
  }
}

// The key frame is flat and holds the angles of the deepest good state, which is the 100 % of
// programs that know no frames.
TEST_P(FoldExport, KeyFrameIsFlatWithTheAnglesAtD) {
  for (const Json& point : fold_["vertices_coords"]) EXPECT_EQ(point.size(), 2u);
  ASSERT_GT(exported_.d(), 0);
  EXPECT_EQ(fold_["file_frames"].back()["misalign:pilot_deg"], exported_.d());
  EXPECT_EQ(fold_["edges_foldAngle"], fold_["file_frames"].back()["edges_foldAngle"]);
}

TEST_P(FoldExport, AnglesAreDegreesWithValleysPositive) {
  double largest = 0;
  const auto check = [&](const Json& frame) {
    for (std::size_t e = 0; e < fold_["edges_assignment"].size(); ++e) {
      const double angle = frame["edges_foldAngle"][e];
      const std::string letter = fold_["edges_assignment"][e];
      largest = std::max(largest, std::abs(angle));
      EXPECT_EQ(angle > 0, letter == "V") << e;
      EXPECT_EQ(angle < 0, letter == "M") << e;
      EXPECT_LE(std::abs(angle), 180);
    }
  };
  check(fold_);
  for (const Json& frame : fold_["file_frames"]) check(frame);
  EXPECT_GT(largest, 10) << "degrees";
}

// What `fold --json` says of a crease is what its angles say, from whichever side the pilot is a
// valley.
TEST_P(FoldExport, FoldingJsonNamesMountainsAndValleysAsTheyFold) {
  const Json folding = folding_json({exported_.pattern, exported_.sheet});
  for (const Json& crease : folding["creases"]) {
    EXPECT_EQ(crease["fold_angle_deg"][4] > 0, crease["assignment"] == "valley")
        << crease["from"] << crease["to"];
  }
}

TEST_P(FoldExport, FramesInheritAndRestateWhatTheyMust) {
  const Json& frames = fold_["file_frames"];
  ASSERT_GE(frames.size(), 2u);
  double before_deg = 0;
  for (const Json& frame : frames) {
    EXPECT_EQ(frame["frame_parent"], 0);
    EXPECT_EQ(frame["frame_inherit"], true);
    EXPECT_EQ(frame["frame_classes"], Json::array({"foldedForm"}));
    EXPECT_EQ(frame["frame_attributes"][0], "3D");
    EXPECT_EQ(frame["vertices_coords"].size(), fold_["vertices_coords"].size());
    EXPECT_EQ(frame["edges_foldAngle"].size(), fold_["edges_vertices"].size());
    const double pilot_deg = frame["misalign:pilot_deg"];
    EXPECT_GT(pilot_deg, before_deg);
    EXPECT_TRUE(std::fmod(pilot_deg, 10) == 0 || pilot_deg == exported_.d()) << pilot_deg;
    before_deg = pilot_deg;
  }
  EXPECT_EQ(frames.size(), static_cast<std::size_t>((exported_.d() + 9) / 10));
}

// Keys of our own have a colon, as the format asks; all others are of FOLD 1.2.
TEST_P(FoldExport, OwnKeysHaveAColon) {
  const std::set<std::string> kFold = {"file_spec",       "file_creator",     "file_title",
                                       "file_classes",    "file_description", "frame_title",
                                       "frame_classes",   "frame_attributes", "frame_unit",
                                       "vertices_coords", "edges_vertices",   "edges_assignment",
                                       "edges_foldAngle", "faces_vertices",   "file_frames",
                                       "frame_parent",    "frame_inherit"};
  const auto check = [&](const Json& frame) {
    for (const auto& [key, value] : frame.items()) {
      EXPECT_TRUE(kFold.contains(key) || key.find("misalign:") == 0) << key;
    }
  };
  check(fold_);
  for (const Json& frame : fold_["file_frames"]) check(frame);
  EXPECT_EQ(fold_["misalign:data"]["draw"], 7);
}

// From the file's text alone: edge lengths, planarity, and angles between normals.
TEST_P(FoldExport, EveryFrameIsTheSheetFolded) {
  const Json read = Json::parse(fold_.dump());
  const auto count = static_cast<Eigen::Index>(read["vertices_coords"].size());
  Eigen::Matrix2Xd flat_mm(2, count);
  for (Eigen::Index v = 0; v < count; ++v) {
    const Json& point = read["vertices_coords"][static_cast<std::size_t>(v)];
    flat_mm.col(v) << point[0].get<double>(), point[1].get<double>();
  }
  std::vector<std::array<int, 4>> panels = read["faces_vertices"];
  std::vector<solver::FoldLine> folds;
  std::vector<std::size_t> edges;
  for (std::size_t e = 0; e < read["edges_vertices"].size(); ++e) {
    if (read["edges_assignment"][e] == "B") continue;
    const int a = read["edges_vertices"][e][0], b = read["edges_vertices"][e][1];
    const auto panel_with = [&](int from, int to) {  // on whose left from -> to lies
      for (std::size_t p = 0; p < panels.size(); ++p) {
        for (int k = 0; k < 4; ++k) {
          if (panels[p][k] == from && panels[p][(k + 1) % 4] == to) return static_cast<int>(p);
        }
      }
      return -1;
    };
    folds.push_back(
        {a, b, panel_with(a, b), panel_with(b, a), read["edges_assignment"][e] == "V" ? 1 : -1});
    ASSERT_TRUE(folds.back().left >= 0 && folds.back().right >= 0) << a << " " << b;
    edges.push_back(e);
  }
  solver::ShapeCheck check(flat_mm, panels, folds);
  for (const Json& frame : read["file_frames"]) {
    Eigen::Matrix3Xd shape_mm(3, count);
    for (Eigen::Index v = 0; v < count; ++v) {
      const Json& point = frame["vertices_coords"][static_cast<std::size_t>(v)];
      ASSERT_EQ(point.size(), 3u);
      shape_mm.col(v) << point[0].get<double>(), point[1].get<double>(), point[2].get<double>();
    }
    Eigen::Matrix3Xd corners_mm(3, static_cast<Eigen::Index>(4 * panels.size()));
    Eigen::Index corner = 0;
    for (const auto& panel : panels) {
      for (const int v : panel) corners_mm.col(corner++) = shape_mm.col(v);
    }
    std::vector<double> claimed_deg;
    for (const std::size_t e : edges) claimed_deg.push_back(frame["edges_foldAngle"][e]);
    check.see(shape_mm, corners_mm, claimed_deg);
  }
  // As for a stored candidate: a chain of joints, each closed to 1e-12.
  const auto all = solver::panels_of(exported_.pattern.base, exported_.mechanism);
  const double limit_rad = solver::shape_tolerance(all);
  const double limit_mm = limit_rad * exported_.pattern.base.sheet.panel_width_mm;
  EXPECT_LE(check.worst().length_mm, limit_mm);
  EXPECT_LE(check.worst().planarity_mm, limit_mm);
  EXPECT_LE(check.worst().angle_deg, limit_rad / solver::kRadPerDeg);
  EXPECT_EQ(check.worst().wrong_sign, -1);
}

// Written to a file and read as a pattern: the same sheet, bit for bit, and so the same verdict.
TEST_P(FoldExport, ReadAgainGivesTheSameVerdict) {
  const Folder folder("fold_export");
  const Pattern again = read_pattern_file(folder.file("sheet.fold", exported_.fold.dump()));
  EXPECT_EQ(again.vertices_mm(), exported_.pattern.vertices_mm());
  EXPECT_EQ(again.base.holes, exported_.pattern.base.holes);
  solver::PathPlanOptions options;
  options.end_deg = std::floor(again.base.folding.end_deg());
  const auto history =
      solver::record_history(solver::Model(again.base, options), again.vertices_mm());
  const solver::Verdict& before = exported_.sheet.history().verdict;
  EXPECT_EQ(history.verdict.deploys_from_sample, before.deploys_from_sample);
  EXPECT_EQ(history.verdict.first_fault, before.first_fault);
  EXPECT_EQ(history.verdict.where, before.where);
}

TEST(FoldExportChanged, IsRefusedWithASentence) {
  const Exported exported("table1");
  const auto faults_of = [&](const Json& fold) {
    InputFaults faults;
    read_carried_pattern(fold, faults, Perforations::of_one_freedom);
    return faults.none() ? "" : faults.sentences().front();
  };
  EXPECT_EQ(faults_of(exported.fold), "");
  Json moved = exported.fold;
  moved["vertices_coords"][9][0] = moved["vertices_coords"][9][0].get<double>() + 1e-6;
  EXPECT_NE(faults_of(moved).find("were changed since"), std::string::npos);
  Json fewer = exported.fold;
  fewer["faces_vertices"].erase(3);
  EXPECT_NE(faults_of(fewer).find("were changed since"), std::string::npos);
  Json other = exported.fold;
  other["misalign:pattern"]["rows"] = 5;
  EXPECT_NE(faults_of(other), "");
  other["misalign:pattern"] = 5;
  EXPECT_NE(faults_of(other), "");
}

// A state that lies between two samples is a frame too, and D is never left out.
TEST(FoldExportStep, NeedNotBeAWholeNumberOfSamples) {
  const Exported exported("table1", 12.5);
  std::vector<double> pilots;
  for (const Json& frame : exported.fold["file_frames"])
    pilots.push_back(frame["misalign:pilot_deg"]);
  std::vector<double> wanted;
  for (double pilot_deg = 12.5; pilot_deg < exported.d(); pilot_deg += 12.5) {
    wanted.push_back(pilot_deg);
  }
  wanted.push_back(exported.d());
  EXPECT_EQ(pilots, wanted);
}

// Lengths of every edge and diagonal of every face of an OBJ, from its text.
TEST_P(FoldExport, ObjHasTheEdgesOfTheFlatSheet) {
  const Eigen::Matrix2Xd flat_mm = exported_.pattern.vertices_mm();
  for (const Eigen::Index row : exported_.rows) {
    std::istringstream text(folded_obj(
        exported_.pattern, exported_.sheet.shapes_mm()[static_cast<std::size_t>(row)], "a test"));
    std::vector<Eigen::Vector3d> points_mm;
    int faces = 0;
    for (std::string line; std::getline(text, line);) {
      std::istringstream words(line.substr(1));
      if (line[0] == 'v') {
        points_mm.emplace_back();
        words >> points_mm.back()[0] >> points_mm.back()[1] >> points_mm.back()[2];
      } else if (line[0] == 'f') {
        int v[4];
        for (int& corner : v) words >> corner, --corner;
        ASSERT_TRUE(words) << line;
        ++faces;
        for (int i = 0; i < 4; ++i) {
          for (int k = 0; k < i; ++k) {
            // Written to 1e-9 mm: half of that at each end, in each direction.
            EXPECT_NEAR((points_mm[v[i]] - points_mm[v[k]]).norm(),
                        (flat_mm.col(v[i]) - flat_mm.col(v[k])).norm(), 4e-9);
          }
        }
      }
    }
    EXPECT_EQ(points_mm.size(), static_cast<std::size_t>(flat_mm.cols()));
    EXPECT_EQ(faces, static_cast<int>(exported_.fold["faces_vertices"].size()));
  }
}

}  // namespace
}  // namespace misalign::schema
