// FOLD meshes that are refused, by a sentence that names the place.
#include "tests/schema/pattern/fold_faults.hpp"

#include <array>
#include <functional>

namespace misalign::schema {
namespace {

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
       {"vertex A4", "off the plane of the others", "flat sheet"}},
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
       {"edge A1-A2", "occurs twice"}},
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
         while (m["faces_vertices"].size() <= 6400) m["faces_vertices"].push_back({0, 1, 6, 5});
       },
       1,
       {"faces_vertices has 6401 faces", "at most 6400"}},
      {"too many vertices",
       [](Json& m) {
         while (m["vertices_coords"].size() <= 25600) m["vertices_coords"].push_back({0, 1});
       },
       1,
       {"vertices_coords", "more than 25600"}},
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

// Half of the inner panels, (m - 2)(n - 2) of m x n, where that is a whole number.
TEST(FoldFaults, ASheetWithoutHolesIsToldHowMany) {
  const auto without_holes = [](int rows, int columns) {
    Json pattern = pattern_of(miura_mesh(rows, columns));
    pattern["holes"] = Json::array();
    return pattern;
  };
  expect_faults(without_holes(2, 2), 1, {"holes", "there is no hole", "a sheet of more panels"});
  expect_faults(without_holes(3, 3), 1, {"there is no hole", "no number of its holes"});
  expect_faults(without_holes(3, 4), 1, {"there is no hole", "take out 1 inner panel;"});
  expect_faults(without_holes(4, 4), 1, {"there is no hole", "take out 2 inner panels;"});
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

}  // namespace
}  // namespace misalign::schema
