// Entries of FOLD meshes that are refused: letters of creases, lists, numbers, and the file's name.

#include <array>
#include <cmath>

#include "schema/pattern/pattern_file.hpp"
#include "tests/folder.hpp"
#include "tests/schema/pattern/fold_faults.hpp"

namespace misalign::schema {
namespace {

TEST(FoldEntryFaults, CreasesAreMountainsOrValleys) {
  for (const char* letter : {"\"F\"", "\"u\"", "\"B\"", "\"\"", "\"m\"", "\"MV\"", "null", "1"}) {
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
TEST(FoldEntryFaults, TheOneWrongCreaseIsNamed) {
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
TEST(FoldEntryFaults, TheOddCreaseIsNamedByTheSectorAngles) {
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
TEST(FoldEntryFaults, TheNameStandsOnce) {
  const Folder folder("fold_entry");
  const auto said = [&](const std::string& name) {
    try {
      read_pattern_file(folder.file(name));
      return std::string();
    } catch (const UserError& error) {
      return std::string(error.what());
    }
  };
  folder.file("p.json", R"({"family": "fold", "file": "mesh.fold"})");
  Json flipped = miura_mesh(4, 4), cut = flipped;
  flip(flipped, 1, 6);
  cut["faces_vertices"][0] = {0, 1, 6};
  for (const Json& mesh : {flipped, cut}) {
    folder.file("mesh.fold", mesh.dump());
    const std::string direct = said("mesh.fold"), through = said("p.json");
    const auto first = direct.find("mesh.fold");
    ASSERT_NE(first, std::string::npos) << direct;
    EXPECT_EQ(direct.find("mesh.fold", first + 1), std::string::npos) << direct;
    EXPECT_EQ(direct.find("family"), std::string::npos) << direct;
    EXPECT_NE(through.find("p.json: mesh.fold: "), std::string::npos) << through;
  }
}

TEST(FoldEntryFaults, Types) {
  const Words keys = {"vertices_coords", "edges_vertices", "edges_assignment", "faces_vertices"};
  for (const std::string& key : keys) {
    for (const char* value : {"null", "true", "5", "\"x\"", "{}", "{\"0\": [0, 1]}", "[]"}) {
      Json mesh = miura_mesh(4, 4);
      mesh[key] = Json::parse(value);
      expect_faults(pattern_of(mesh), 1, {key, "must be a list that is not empty"});
    }
    if (key == "faces_vertices" || key == "edges_assignment") continue;  // they follow
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

TEST(FoldEntryFaults, NumbersThatAreNone) {
  const std::string whole = miura_mesh(4, 4).dump();
  for (const char* number :
       {"NaN", "nan", "Infinity", "-Infinity", "1e999", "-1e999", "0x1", "1."}) {
    std::string text = whole;
    text.replace(text.find("80.0"), 4, number);
    try {
      parse_json(text, "sheet.fold");
      ADD_FAILURE() << number;
    } catch (const UserError& error) {
      EXPECT_EQ(error.cause(), Cause::bad_input);
      EXPECT_EQ(std::string(error.what()).find("sheet.fold: is not JSON ("), 0u) << error.what();
    }
  }
}

}  // namespace
}  // namespace misalign::schema
