// FOLD meshes as patterns: what is refused, by a sentence that names the place, and that the same
// sheet gives the same verdicts however it is written down.
#include "schema/fold_format.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <random>

#include "schema/campaign.hpp"
#include "schema/pattern_file.hpp"
#include "solver/miura.hpp"
#include "solver/perforation.hpp"

namespace misalign::schema {
namespace {

using Words = std::vector<std::string>;

Json miura_mesh(int rows, int columns) {
  const auto shape = solver::MiuraShape::uniform(rows, columns, 80, 80, 40);
  const auto sheet = solver::miura_sheet(shape);
  return fold_json(sheet, solver::miura_assignment(shape, sheet));
}

Json pattern_of(const Json& mesh) { return {{"family", "fold"}, {"mesh", mesh}}; }

std::vector<std::string> pattern_faults(const Json& pattern) {
  InputFaults faults;
  read_pattern(pattern, "", Displacements::allowed, ".", faults);
  if (!faults.none()) {
    try {
      faults.refuse("test");
      ADD_FAILURE() << "faults are no refusal";
    } catch (const UserError& error) {
      EXPECT_EQ(error.exit_code(), kExitBadInput);
    }
  }
  return faults.sentences();
}

/// So many sentences, each "problem (why); suggestion" and with all of these words.
void expect_faults(const Json& pattern, std::size_t count, const Words& words) {
  const auto faults = pattern_faults(pattern);
  EXPECT_EQ(faults.size(), count) << (faults.empty() ? words[0] : faults[0]);
  for (const std::string& fault : faults) {
    EXPECT_NE(fault.find(" ("), std::string::npos) << fault;
    EXPECT_NE(fault.find("); "), std::string::npos) << fault;
    for (const std::string& word : words) {
      EXPECT_NE(fault.find(word), std::string::npos) << word << " is not in: " << fault;
    }
  }
}

std::size_t edge_index(const Json& mesh, int a, int b) {
  const Json& edges = mesh["edges_vertices"];
  return static_cast<std::size_t>(std::find(edges.begin(), edges.end(), Json{a, b}) -
                                  edges.begin());
}

void erase_edge(Json& mesh, int a, int b) {
  const std::size_t e = edge_index(mesh, a, b);
  mesh["edges_vertices"].erase(e);
  mesh["edges_assignment"].erase(e);
}

/// A mesh from faces alone, every edge a valley or on the perimeter.
Json mesh_of(const Json& points, const std::vector<std::array<int, 4>>& faces) {
  solver::CreasePattern sheet;
  sheet.edges = solver::edges_of(faces);
  std::vector<int> assignment;
  for (const auto& edge : sheet.edges) assignment.push_back(edge.on_perimeter() ? 0 : 1);
  Json mesh = fold_json(sheet, assignment);
  mesh["vertices_coords"] = points;
  mesh["faces_vertices"] = faces;
  return mesh;
}

struct Change {
  const char* what;
  std::function<void(Json&)> make;  // of a whole 4 x 4 Miura-ori, vertices A1 to A25
  std::size_t faults;
  Words words;
};

TEST(FoldFaults, NameThePlace) {
  const std::vector<Change> changes = {
      {"vertex moved",
       [](Json& m) {
         m["vertices_coords"][12] = {163, 157};
       },
       1,
       {"the unperforated sheet does not fold rigidly", "vertex A"}},
      {"two vertices in one place",
       [](Json& m) { m["vertices_coords"][24] = m["vertices_coords"][23]; },
       1,
       {"vertices A24 and A25", "the same point"}},
      {"vertex without a face",
       [](Json& m) {
         m["vertices_coords"].push_back({900, 900});
       },
       1,
       {"vertex A26", "belongs to no face"}},
      {"vertex far out",
       [](Json& m) { m["vertices_coords"][3][0] = 1e308; },
       1,
       {"vertex A4", "farther out than 1000000 mm"}},
      {"folded state",
       [](Json& m) { m["vertices_coords"][3].push_back(0.5); },
       1,
       {"vertex A4", "z = 0.5", "flat sheet"}},
      {"too small",
       [](Json& m) {
         for (Json& p : m["vertices_coords"])
           p = {1e-9 * p[0].get<double>(), 1e-9 * p[1].get<double>()};
       },
       1,
       {"the mesh", "smaller than 0.001 mm"}},
      {"letter left out",
       [](Json& m) { m["edges_assignment"].erase(3); },
       1,
       {"edges_assignment has 39 entries"}},
      {"corners in another order",
       [](Json& m) {
         m["faces_vertices"][0] = {0, 6, 1, 5};
       },
       1,
       {"the face", "A1", "no convex quadrilateral"}},
      {"three corners on a line",
       [](Json& m) {
         m["vertices_coords"][1] = {40, 40};
       },
       1,
       {"the face A1-A2-A7-A6", "no convex quadrilateral"}},
      {"triangle",
       [](Json& m) {
         m["faces_vertices"][2] = {2, 3, 8};
       },
       1,
       {"face 2 = [2,3,8]", "one of quadrilaterals"}},
      {"pentagon",
       [](Json& m) {
         m["faces_vertices"][2] = {2, 3, 4, 9, 8};
       },
       1,
       {"face 2 = [2,3,4,9,8]", "one of quadrilaterals"}},
      {"a face twice",
       [](Json& m) { m["faces_vertices"].push_back(m["faces_vertices"][5]); },
       4,
       {"has two faces on the same side", "edge A"}},
      {"edge without a face",
       [](Json& m) { m["faces_vertices"].erase(1); },
       1,
       {"edge A2-A3", "belongs to no face"}},
      {"diagonal",
       [](Json& m) {
         m["edges_vertices"].push_back({0, 6});
         m["edges_assignment"].push_back("V");
       },
       1,
       {"edge A1-A7", "belongs to no face"}},
      {"side left out",
       [](Json& m) { erase_edge(m, 0, 1); },
       1,
       {"edge A1-A2", "missing in edges_vertices"}},
      {"edge twice",
       [](Json& m) {
         m["edges_vertices"].push_back({1, 0});
         m["edges_assignment"].push_back("B");
       },
       1,
       {"edge A1-A2", "is there twice"}},
      {"two missing faces side by side",
       [](Json& m) {
         m["faces_vertices"].erase(6);
         m["faces_vertices"].erase(5);
         erase_edge(m, 7, 12);
       },
       1,
       {"the gap A7-A8-A9-A14-A13-A12", "no single missing quadrilateral"}},
      {"a missing face on the border",
       [](Json& m) {
         m["faces_vertices"].erase(1);
         erase_edge(m, 1, 2);
         m["faces_vertices"].erase(3);  // face 4, now below a notch
       },
       1,
       {"edge A6-A11", "belongs to no face"}},
      {"too many faces",
       [](Json& m) {
         while (m["faces_vertices"].size() <= 1600) m["faces_vertices"].push_back({0, 1, 6, 5});
       },
       1,
       {"faces_vertices has 1601 faces", "at most 1600"}},
      {"too many vertices",
       [](Json& m) {
         while (m["vertices_coords"].size() <= 6400) m["vertices_coords"].push_back({0, 1});
       },
       1,
       {"vertices_coords", "more than 6400"}},
      {"all faces but one",
       [](Json& m) {
         m = mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2, 3}});
       },
       1,
       {"the mesh", "no inner vertex"}},
      {"three faces round a vertex",
       [](Json& m) {
         m = mesh_of({{0, 0}, {2, 0}, {1, 2}, {-1, 2}, {-2, 0}, {-1, -2}, {1, -2}},
                     {{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 1}});
       },
       1,
       {"vertex A1", "degree 3, not 4"}},
      {"faces that overlap",
       [](Json& m) {
         m = mesh_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {3, 1}, {3, 3}, {1, 3}},
                     {{0, 1, 2, 3}, {4, 5, 6, 7}});
       },
       2,
       {"edges A", "cross or touch"}},
      {"edges that touch",
       [](Json& m) {
         m = mesh_of({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {2, 1}, {3, 0}, {4, 1}, {3, 2}},
                     {{0, 1, 2, 3}, {4, 5, 6, 7}});
       },
       2,
       {"edges A2-A3 and A5-", "cross or touch"}},
      {"a piece inside a face",
       [](Json& m) {
         m = mesh_of({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {4, 4}, {5, 4}, {5, 5}, {4, 5}},
                     {{0, 1, 2, 3}, {4, 5, 6, 7}});
       },
       1,
       {"the mesh", "two pieces"}},
      {"unknown unit",
       [](Json& m) { m["frame_unit"] = "furlong"; },
       1,
       {"frame_unit = \"furlong\"", "no unit of length"}},
      {"unit of another type", [](Json& m) { m["frame_unit"] = 25.4; }, 1, {"frame_unit = 25.4"}},
      {"no object",
       [](Json& m) {
         m = Json::array({1, 2});
       },
       1,
       {"mesh", "must be a FOLD object"}},
  };
  for (const Change& change : changes) {
    SCOPED_TRACE(change.what);
    Json mesh = miura_mesh(4, 4);
    change.make(mesh);
    expect_faults(pattern_of(mesh), change.faults, change.words);
  }
}

TEST(FoldFaults, CreasesAreMountainsOrValleys) {
  for (const char* letter : {"\"F\"", "\"U\"", "\"B\"", "\"\"", "\"m\"", "\"MV\"", "null", "1"}) {
    Json mesh = miura_mesh(4, 4);
    mesh["edges_assignment"][edge_index(mesh, 1, 6)] = Json::parse(letter);
    expect_faults(pattern_of(mesh), 1, {"crease A2-A7", "a mountain or a valley"});
  }
  Json mesh = miura_mesh(4, 4);
  Json& letter = mesh["edges_assignment"][edge_index(mesh, 1, 6)];
  letter = letter == "M" ? "V" : "M";
  expect_faults(pattern_of(mesh), 1, {"vertex A7 cannot fold", "three of a kind"});
}

TEST(FoldFaults, Types) {
  const Words keys = {"vertices_coords", "edges_vertices", "edges_assignment", "faces_vertices"};
  for (const std::string& key : keys) {
    for (const char* value : {"null", "true", "5", "\"x\"", "{}", "{\"0\": [0, 1]}", "[]"}) {
      Json mesh = miura_mesh(4, 4);
      mesh[key] = Json::parse(value);
      expect_faults(pattern_of(mesh), 1, {key, "must be a list that is not empty"});
    }
    Json mesh = miura_mesh(4, 4);
    mesh.erase(key);
    expect_faults(pattern_of(mesh), 1, {key, "is missing"});
  }
  const std::vector<std::tuple<const char*, const char*, Words>> entries = {
      {"vertices_coords",
       "vertex A4",
       {"null", "3", "\"x\"", "[]", "[1]", "[1, 2, 3, 4]", "[1, null]", "[[1], 2]", "{\"x\": 1}"}},
      {"edges_vertices",
       "edge 3",
       {"null", "3", "\"01\"", "[]", "[1]", "[1, 2, 3]", "[1, 1]", "[0, 25]", "[-1, 0]", "[0.0, 1]",
        "[4294967296, 1]", "[18446744073709551615, 1]"}},
      {"faces_vertices",
       "face 3",
       {"null", "3", "[]", "[3, 4, 9, 25]", "[3, 4, 9, -1]", "[3, 4, 9, 8.0]", "[3, 4, 9, \"8\"]",
        "[[3, 4, 9, 8]]"}},
  };
  for (const auto& [key, name, values] : entries) {
    for (const std::string& value : values) {
      Json mesh = miura_mesh(4, 4);
      mesh[key][3] = Json::parse(value);
      expect_faults(pattern_of(mesh), 1, {name, "must be"});
    }
  }
}

TEST(FoldFaults, NumbersThatAreNone) {
  const std::string whole = miura_mesh(4, 4).dump();
  for (const char* number :
       {"NaN", "nan", "Infinity", "-Infinity", "1e999", "-1e999", "0x1", "1."}) {
    std::string text = whole;
    text.replace(text.find("80.0"), 4, number);
    try {
      parse_json(text, "sheet.fold");
      ADD_FAILURE() << number;
    } catch (const UserError& error) {
      EXPECT_EQ(error.exit_code(), kExitBadInput);
      EXPECT_EQ(std::string(error.what()).find("sheet.fold: is not JSON ("), 0u) << error.what();
    }
  }
}

// Two sheets of 2 x 2 panels: apart, and with one corner in common.
TEST(FoldFaults, PiecesThatDoNotHangTogether) {
  const Json one = miura_mesh(2, 2);
  for (const bool at_a_corner : {false, true}) {
    Json both = one;
    const auto& last = one["vertices_coords"][8];
    for (const Json& p : one["vertices_coords"]) {
      both["vertices_coords"].push_back(
          {p[0].get<double>() + last[0].get<double>() + (at_a_corner ? 0 : 50),
           p[1].get<double>() + last[1].get<double>()});
    }
    const auto moved = [&](const Json& list) {
      Json to = list;
      for (Json& v : to) v = at_a_corner && v == 0 ? 8 : v.get<int>() + (at_a_corner ? 8 : 9);
      return to;
    };
    if (at_a_corner) both["vertices_coords"].erase(9);
    for (const Json& face : one["faces_vertices"]) both["faces_vertices"].push_back(moved(face));
    for (const Json& edge : one["edges_vertices"]) both["edges_vertices"].push_back(moved(edge));
    for (const Json& letter : one["edges_assignment"]) both["edges_assignment"].push_back(letter);
    expect_faults(pattern_of(both), 1, {"the mesh", "two pieces"});
  }
}

TEST(FoldFaults, OfThePatternRoundTheMesh) {
  const Json mesh = miura_mesh(4, 4);
  const auto with = [&](const char* key, const Json& value) {
    Json pattern = pattern_of(mesh);
    pattern[key] = value;
    return pattern;
  };
  expect_faults({{"family", "fold"}}, 1, {"file", "is missing"});
  expect_faults(with("file", "x.fold"), 1, {"mesh", "beside a file"});
  expect_faults({{"family", "fold"}, {"file", 3}}, 1, {"file = 3", "must be a text"});
  EXPECT_THROW(pattern_faults({{"family", "fold"}, {"file", "nowhere.fold"}}), UserError);
  EXPECT_THROW(pattern_faults({{"family", "fold"}, {"file", "."}}), UserError);
  for (const char* unit : {"0", "-1", "1e-9", "1e300", "\"mm\"", "null"}) {
    expect_faults(with("mm_per_unit", Json::parse(unit)), 1, {"mm_per_unit = "});
  }
  expect_faults(with("rows", 4), 1, {"rows", "is not a key here"});
  for (const auto& [pilot, why] : std::vector<std::pair<Json, const char*>>{
           {5, "names no crease"},
           {nullptr, "names no crease"},
           {"", "names no crease"},
           {"A2", "names no crease"},
           {"A2-", "is no edge"},
           {"A2-A7-A12", "is no edge"},
           {"A1-A7", "is no edge"},
           {"A2-A99", "is no edge"},
           {"A1-A2", "does not join two panels"},
           {"A8-A9", "does not join two panels"}}) {  // a side of the hole [1, 2]
    expect_faults(with("pilot", pilot), 1, {"pilot = ", why, "\"A2-A7\""});
  }
  Json missing = mesh;
  missing["faces_vertices"].erase(9);
  missing["faces_vertices"].erase(6);
  Json pattern = pattern_of(missing);
  EXPECT_TRUE(pattern_faults(pattern).empty());
  pattern["holes"] = "checkerboard-odd";
  expect_faults(pattern, 1, {"holes", "lacks faces already"});
}

// --- the same sheet, however it is written

Pattern good(const Json& pattern) {
  InputFaults faults;
  Pattern read = read_pattern(pattern, "", Displacements::allowed, ".", faults);
  EXPECT_TRUE(faults.none()) << faults.sentences().front();
  return read;
}

solver::FoldingHistory history_of(const Pattern& pattern) {
  const auto& base = pattern.base;
  const auto mechanism = solver::build_mechanism(base.sheet, base.holes, base.folding);
  const auto plan = solver::plan_path(mechanism, base.folding, base.sheet.vertices_mm, {});
  return solver::record_history(base, mechanism, plan, pattern.vertices_mm());
}

/// The shifts of one draw on 4 x 4 by label, and the pattern with them.
Json shifts(unsigned seed) {
  std::mt19937 words(seed);
  Json shifts = Json::object();
  for (const int v : {6, 7, 8, 11, 12, 13, 16, 17, 18}) {
    const double x = 0.4 * (static_cast<int>(words() % 3) - 1);
    shifts[solver::vertex_label(v)] = {x, 0.4 * (static_cast<int>(words() % 3) - 1)};
  }
  return shifts;
}

std::vector<double> sorted(const Eigen::MatrixXd& lengths, Eigen::Index row) {
  std::vector<double> values;
  for (Eigen::Index k = 0; k < lengths.cols(); ++k) values.push_back(lengths(row, k));
  std::sort(values.begin(), values.end());
  return values;
}

/// The same D and fault, and the same lengths, in whatever order: 1e-9 mm, a hundred times what
/// converged paths of other equations differ by.
void expect_same(const Json& one, const Json& other) {
  const auto a = history_of(good(one)), b = history_of(good(other));
  EXPECT_EQ(a.verdict.deploys_from_sample, b.verdict.deploys_from_sample);
  EXPECT_EQ(a.verdict.first_fault, b.verdict.first_fault);
  ASSERT_EQ(a.length_mm.rows(), b.length_mm.rows());
  ASSERT_GT(a.length_mm.rows(), 60);
  for (const Eigen::Index row : {Eigen::Index{9}, Eigen::Index{59}}) {
    const auto of_a = sorted(a.length_mm, row), of_b = sorted(b.length_mm, row);
    ASSERT_EQ(of_a.size(), of_b.size());
    for (std::size_t k = 0; k < of_a.size(); ++k) EXPECT_NEAR(of_a[k], of_b[k], 1e-9);
  }
}

class SameSheet : public testing::TestWithParam<unsigned> {
 protected:
  Json family() const {
    return {
        {"family", "miura"}, {"rows", 4}, {"columns", 4}, {"displacements_mm", shifts(GetParam())}};
  }
  Json fold(const Json& mesh) const {
    Json pattern = pattern_of(mesh);
    pattern["displacements_mm"] = shifts(GetParam());
    return pattern;
  }
};

TEST_P(SameSheet, AsAMiura) { expect_same(family(), fold(miura_mesh(4, 4))); }

TEST_P(SameSheet, MissingFacesAreHoles) {
  Json mesh = miura_mesh(4, 4);
  const auto sides = {std::pair(7, 8), {7, 12},  {8, 13},  {12, 13},
                      {11, 12},        {11, 16}, {12, 17}, {16, 17}};
  mesh["faces_vertices"].erase(9);
  mesh["faces_vertices"].erase(6);
  expect_same(family(), fold(mesh));
  for (const auto& [a, b] : sides) mesh["edges_assignment"][edge_index(mesh, a, b)] = "B";
  expect_same(family(), fold(mesh));  // letters that a hole's sides need not have
}

TEST_P(SameSheet, ClockwiseFacesAndEdgesTurnedRound) {
  Json mesh = miura_mesh(4, 4);
  for (std::size_t f = 0; f < 16; f += 1 + f % 2) {
    std::reverse(mesh["faces_vertices"][f].begin(), mesh["faces_vertices"][f].end());
  }
  for (Json& edge : mesh["edges_vertices"]) std::swap(edge[0], edge[1]);
  expect_same(family(), fold(mesh));
}

TEST_P(SameSheet, AnyOrderOfVerticesFacesAndEdges) {
  std::mt19937 words(GetParam() + 77);
  std::vector<int> to(25);  // new number of each vertex
  std::iota(to.begin(), to.end(), 0);
  std::shuffle(to.begin(), to.end(), words);
  const Json whole = miura_mesh(4, 4);
  Json mesh = whole;
  for (int v = 0; v < 25; ++v) mesh["vertices_coords"][to[v]] = whole["vertices_coords"][v];
  for (const char* key : {"faces_vertices", "edges_vertices"}) {
    for (Json& list : mesh[key]) {
      for (Json& v : list) v = to[v.get<int>()];
    }
  }
  mesh["faces_vertices"].erase(9);  // holes by missing faces: rows and columns depend on the first
  mesh["faces_vertices"].erase(6);
  std::shuffle(mesh["faces_vertices"].begin(), mesh["faces_vertices"].end(), words);
  for (Json& face : mesh["faces_vertices"])
    std::rotate(face.begin(), face.begin() + words() % 4, face.end());
  Json pattern = pattern_of(mesh);
  pattern["pilot"] = solver::line_label(std::min(to[1], to[6]), std::max(to[1], to[6]));
  const Json drawn = shifts(GetParam());
  for (const auto& [label, shift] : drawn.items()) {
    pattern["displacements_mm"][solver::vertex_label(to[vertex_of_label(label, 25)])] = shift;
  }
  expect_same(family(), pattern);
}

TEST_P(SameSheet, InAnyUnit) {
  const auto in_units = [&](const Json& unit, double mm, double mm_per_unit) {
    Json mesh = miura_mesh(4, 4);
    mesh.erase("frame_unit");
    if (!unit.is_null()) mesh["frame_unit"] = unit;
    for (Json& p : mesh["vertices_coords"]) {
      p = {p[0].get<double>() / (mm * mm_per_unit), p[1].get<double>() / (mm * mm_per_unit)};
    }
    Json pattern = fold(mesh);
    pattern["mm_per_unit"] = mm_per_unit;
    return pattern;
  };
  expect_same(family(), in_units("cm", 10, 1));
  expect_same(family(), in_units("in", 25.4, 1));
  expect_same(family(), in_units("m", 1000, 1));
  expect_same(family(), in_units(nullptr, 1, 0.125));
  expect_same(family(), in_units("unit", 1, 400));
}

// Draws whose verdicts differ.
INSTANTIATE_TEST_SUITE_P(Draws, SameSheet, testing::Values(1u, 2u, 3u));

TEST(FoldFormat, RoundTrip) {
  for (const Json& mesh :
       {miura_mesh(3, 5),
        read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/turned-quads-6x6.fold"),
        read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/angle-array-6x6.fold")}) {
    InputFaults faults;
    const FoldMesh one = read_fold(mesh, "", 1, faults);
    const Json written = fold_json(one.sheet, one.assignment);
    const FoldMesh again = read_fold(parse_json(written.dump(), "written"), "", 1, faults);
    ASSERT_TRUE(faults.none()) << faults.sentences().front();
    EXPECT_EQ(again.sheet.vertices_mm, one.sheet.vertices_mm);
    EXPECT_EQ(again.sheet.facets, one.sheet.facets);
    EXPECT_EQ(again.sheet.places, one.sheet.places);
    EXPECT_EQ(again.sheet.panel_width_mm, one.sheet.panel_width_mm);
    EXPECT_EQ(again.assignment, one.assignment);
    EXPECT_TRUE(one.missing.empty() && again.missing.empty());
    for (const char* key : {"vertices_coords", "edges_vertices", "edges_assignment"}) {
      EXPECT_EQ(written[key], mesh[key]) << key;
    }
  }
}

// A mountain as the pilot is kept as it is written: seen from +z.
TEST(FoldFormat, PatternsOfACatalogueAreTheFilesOwn) {
  Json mesh = miura_mesh(4, 4);
  for (Json& letter : mesh["edges_assignment"]) {
    if (letter != "B") letter = letter == "M" ? "V" : "M";
  }
  const Pattern pattern = good(pattern_of(mesh));
  EXPECT_EQ(pattern.base.folding.side(), -1);
  const Json kept = pattern_json(pattern, pattern.shifts_mm);
  EXPECT_EQ(kept["mesh"]["edges_assignment"], mesh["edges_assignment"]);
  EXPECT_EQ(pattern_json(good(kept), pattern.shifts_mm), kept);
}

TEST(FoldFormat, IdentityDoesNotDependOnThePath) {
  namespace fs = std::filesystem;
  const fs::path root = fs::path(testing::TempDir()) / "fold_identity";
  fs::create_directories(root / "elsewhere");
  const Json mesh = miura_mesh(4, 4);
  std::ofstream(root / "a.fold") << mesh.dump();
  std::ofstream(root / "elsewhere" / "b.fold") << mesh.dump(3);
  Json moved = mesh;
  moved["vertices_coords"][0] = {-1, 0};
  std::ofstream(root / "c.fold") << moved.dump();
  const auto identity_with = [&](const Json& pattern) {
    std::ofstream(root / "campaign.json") << Json{{"pattern", pattern}};
    return identity(read_campaign_file((root / "campaign.json").string()));
  };
  const auto of_file = [&](const std::string& file) {
    return identity_with({{"family", "fold"}, {"file", file}});
  };
  const std::string expected = identity_with(pattern_of(mesh));
  EXPECT_EQ(of_file("a.fold"), expected);
  EXPECT_EQ(of_file("elsewhere/../elsewhere/b.fold"), expected);
  EXPECT_EQ(of_file((root / "elsewhere" / "b.fold").string()), expected);
  EXPECT_NE(of_file("c.fold"), expected);
  fs::remove_all(root);
}

}  // namespace
}  // namespace misalign::schema
