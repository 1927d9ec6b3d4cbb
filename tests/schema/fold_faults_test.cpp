// FOLD meshes that are refused, by a sentence that names the place.
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "fold_meshes.hpp"

namespace misalign::schema {
namespace {

using Words = std::vector<std::string>;

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
}

/// Quadrilaterals that do not fold flat.
Json turned_quads() {
  return read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/turned-quads-6x6.fold");
}

/// The other letter for a crease.
void flip(Json& mesh, int a, int b) {
  Json& letter = mesh["edges_assignment"][edge_index(mesh, a, b)];
  letter = letter == "M" ? "V" : "M";
}

// One letter that is wrong is named, whichever it is, with what it must be. Where a crease that
// ends on the perimeter could as well be the wrong one, the vertex' creases are named instead.
TEST(FoldFaults, TheOneWrongCreaseIsNamed) {
  for (const Json& mesh : {miura_mesh(4, 4), turned_quads()}) {
    const bool has_straight_creases = mesh["vertices_coords"].size() == 25;
    int creases = 0, named = 0;
    for (std::size_t e = 0; e < mesh["edges_vertices"].size(); ++e) {
      const std::string letter = mesh["edges_assignment"][e];
      if (letter == "B") continue;
      const int a = mesh["edges_vertices"][e][0], b = mesh["edges_vertices"][e][1];
      Json changed = mesh;
      flip(changed, a, b);
      const std::string label = solver::line_label(a, b);
      const auto faults = pattern_faults(pattern_of(changed));
      ASSERT_EQ(faults.size(), 1u) << label;
      EXPECT_NE(faults[0].find(label), std::string::npos) << faults[0];
      const std::string advice = "make " + label + (letter == "V" ? " a valley" : " a mountain");
      const bool is_named = faults[0].ends_with("; " + advice);
      EXPECT_TRUE(is_named || faults[0].find(" must be ") != std::string::npos) << faults[0];
      ++creases;
      named += is_named;
    }
    EXPECT_EQ(creases, has_straight_creases ? 24 : 60);
    EXPECT_GE(named, has_straight_creases ? 24 : 50);
  }
}

// Three of a kind and one of the other, but the wrong one. A crease can be the odd one where the
// two sectors at it leave more than half of the plane to the others.
TEST(FoldFaults, TheOddCreaseIsNamedByTheSectorAngles) {
  for (const Json& whole : {miura_mesh(4, 4), turned_quads()}) {
    const int columns = whole["vertices_coords"].size() == 25 ? 5 : 7;
    const int v = columns + 1;  // the first inner vertex, and its neighbours counter-clockwise
    const std::array<int, 4> around = {v + 1, v + columns, v - 1, v - columns};
    const auto direction = [&](int to) {
      const Json &p = whole["vertices_coords"][static_cast<std::size_t>(v)],
                 &q = whole["vertices_coords"][static_cast<std::size_t>(to)];
      return std::atan2(q[1].get<double>() - p[1].get<double>(),
                        q[0].get<double>() - p[0].get<double>());
    };
    std::vector<int> can, cannot;
    for (std::size_t k = 0; k < 4; ++k) {
      const double both =
          direction(around[(k + 1) % 4]) - direction(around[(k + 3) % 4]);  // across crease k
      (std::fmod(both + 4 * M_PI, 2 * M_PI) < M_PI - 1e-6 ? can : cannot).push_back(around[k]);
    }
    ASSERT_EQ(cannot.size(), columns == 5 ? 3u : 2u);
    for (const int odd : cannot) {
      Json mesh = whole;
      for (const int to : around) {
        mesh["edges_assignment"][edge_index(mesh, std::min(v, to), std::max(v, to))] =
            to == odd ? "M" : "V";
      }
      const auto faults = pattern_faults(pattern_of(mesh));
      ASSERT_EQ(faults.size(), 1u);
      const std::string& fault = faults[0];
      const auto at = fault.find("the one that differs from the other three must be ");
      ASSERT_NE(at, std::string::npos) << fault;
      const auto end =
          fault.find(", not " + solver::line_label(std::min(v, odd), std::max(v, odd)));
      ASSERT_NE(end, std::string::npos) << fault;
      for (const int to : around) {
        const std::string label = solver::line_label(std::min(v, to), std::max(v, to));
        const bool said = fault.substr(at, end - at).find(label) != std::string::npos;
        EXPECT_EQ(said, std::find(can.begin(), can.end(), to) != can.end()) << label << fault;
      }
    }
  }
}

// Said of the file that it is about: its name is the caller's to say, once.
TEST(FoldFaults, TheNameStandsOnce) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("misalign-names-" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  const auto said = [&](const std::string& name) {
    try {
      read_pattern_file((folder / name).string());
      return std::string();
    } catch (const UserError& error) {
      return std::string(error.what());
    }
  };
  std::ofstream(folder / "p.json") << R"({"family": "fold", "file": "mesh.fold"})";
  Json flipped = miura_mesh(4, 4), cut = flipped;
  flip(flipped, 1, 6);
  cut["faces_vertices"][0] = {0, 1, 6};
  for (const Json& mesh : {flipped, cut}) {
    std::ofstream(folder / "mesh.fold") << mesh.dump();
    const std::string direct = said("mesh.fold"), through = said("p.json");
    const auto first = direct.find("mesh.fold");
    ASSERT_NE(first, std::string::npos) << direct;
    EXPECT_EQ(direct.find("mesh.fold", first + 1), std::string::npos) << direct;
    EXPECT_EQ(direct.find("family"), std::string::npos) << direct;
    EXPECT_NE(through.find("p.json: mesh.fold: "), std::string::npos) << through;
  }
  std::filesystem::remove_all(folder);
}

TEST(FoldFaults, Types) {
  const Words keys = {"vertices_coords", "edges_vertices", "edges_assignment", "faces_vertices"};
  for (const std::string& key : keys) {
    for (const char* value : {"null", "true", "5", "\"x\"", "{}", "{\"0\": [0, 1]}", "[]"}) {
      Json mesh = miura_mesh(4, 4);
      mesh[key] = Json::parse(value);
      expect_faults(pattern_of(mesh), 1, {key, "must be a list that is not empty"});
    }
    if (key == "faces_vertices") continue;  // they follow from the edges
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

}  // namespace
}  // namespace misalign::schema
