// Flat meshes in OBJ: the sheet that the same mesh in FOLD is, and which files are read at all.
#include "schema/pattern/obj_format.hpp"

#include "schema/exchange/drawing.hpp"
#include "schema/pattern/pattern_document.hpp"
#include "tests/folder.hpp"
#include "tests/schema/pattern/fold_faults.hpp"

namespace misalign::schema {
namespace {

std::string sheet_of(const std::string& path) {
  const Pattern pattern = read_pattern_file(path);
  return pattern_json(pattern, pattern.shifts_mm).dump();
}

/// A mesh as other programs write it: y upwards, corners with textures and normals, some counted
/// from the end, two lines of comment.
std::string obj_of(const Json& mesh, const std::string& lines = "") {
  std::string text = "# made by hand\r\n\n  # units are not known\nmtllib none.mtl\no sheet\n";
  const auto count = static_cast<int>(mesh["vertices_coords"].size());
  for (const Json& p : mesh["vertices_coords"]) {
    text += "v " + p[1].dump() + "\t0.0 " + p[0].dump() + " 1.0 # a weight\n";
  }
  text += "vt 0 0\nvn 0 1 0\n" + lines + "usemtl paper\ns off\n";
  int f = 0;
  for (const Json& face : mesh["faces_vertices"]) {
    text += "f";
    for (const Json& v : face) {
      const int number = v.get<int>() + 1;
      text += f % 2 ? " " + std::to_string(number - 1 - count) + "/1/1"
                    : " " + std::to_string(number) + "//1";
    }
    text += "\r\n";
    ++f;
  }
  return text;
}

/// Lines of every crease in groups.
std::string lines_of(const Json& mesh) {
  std::string lines[2] = {"g Mountain_creases\n", "g x\ng valley\n"};
  for (std::size_t e = 0; e < mesh["edges_vertices"].size(); ++e) {
    const std::string letter = mesh["edges_assignment"][e];
    if (letter == "B") continue;
    lines[letter == "V"] += "l " + std::to_string(mesh["edges_vertices"][e][0].get<int>() + 1) +
                            " " + std::to_string(mesh["edges_vertices"][e][1].get<int>() + 1) +
                            "\n";
  }
  return lines[0] + lines[1];
}

TEST(ObjFormat, IsTheSheetOfTheSameMeshInFold) {
  const Folder folder("obj_format");
  const Json miura = miura_mesh(4, 4);
  const std::string expected = sheet_of(folder.file("miura.fold", miura.dump()));
  EXPECT_EQ(sheet_of(folder.file("miura.obj", obj_of(miura))), expected);
  EXPECT_EQ(sheet_of(folder.file("no-ending", obj_of(miura))), expected);
  EXPECT_EQ(sheet_of(folder.file("p.json", R"({"family": "fold", "file": "miura.obj"})")),
            expected);
  // Letters that do not follow stand in groups; what is exported can be read, too.
  const Json array = read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/angle-array-6x6.fold");
  const std::string in_fold = sheet_of(folder.file("array.fold", array.dump()));
  EXPECT_EQ(sheet_of(folder.file("array.obj", obj_of(array, lines_of(array)))), in_fold);
  const Pattern base = read_pattern_file(folder.file("miura.fold"));
  Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, base.base.sheet.vertex_count());
  flat_mm.topRows<2>() = base.vertices_mm();
  const Pattern again =
      read_pattern_file(folder.file("out.obj", folded_obj(base, flat_mm, "a test")));
  EXPECT_EQ(again.vertices_mm(), base.vertices_mm());
  EXPECT_EQ(again.base.folding.assignment(), base.base.folding.assignment());
}

TEST(ObjFormat, AsksForWhatItLacks) {
  const Folder folder("obj_faults");
  const auto said = [&](const std::string& text, const char* name = "x.obj") {
    try {
      read_pattern_file(folder.file(name, text));
      return std::string("read");
    } catch (const UserError& error) {
      EXPECT_EQ(error.cause(), Cause::bad_input);
      return std::string(error.what());
    }
  };
  const auto expect_said = [&](const std::string& text, const Words& words,
                               const char* name = "x.obj") {
    const std::string sentence = said(text, name);
    for (const std::string& word : words) {
      EXPECT_NE(sentence.find(word), std::string::npos) << word << " is not in: " << sentence;
    }
  };
  const Json array = read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/angle-array-6x6.fold");
  expect_said(obj_of(array), {"can fold in two ways", "lines (l)", "mountain and valley"});
  Json small = miura_mesh(4, 4);
  for (Json& p : small["vertices_coords"]) {
    p = {p[0].get<double>() / 320, p[1].get<double>() / 320};
  }
  expect_said(obj_of(small), {"units", "mm_per_unit"});
  expect_said("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", {"face 0 = [0,1,2]", "quadrilaterals"});
  expect_said("v 0 0 0\nv 9 x 0\nv 0 9 0\nv 9 9 0\nf 1 2 3 4\n", {"vertex A2", "\"x\""});
  expect_said("v 0 0 0\nv 9 0 0\nv 0 9 0\nv 9 9 0\nf 1 2 4 99\n", {"must be two vertices"});
  expect_said("v 0 0 0\nv 9 0 0\nv 0 9 0\nv 9 9 0\nf 1 2 4 99999999999999999999\n", {"must be"});
  expect_said("", {"vertices_coords"});
  expect_said("# nothing\n", {"vertices_coords"});
  for (const char* text : {"<svg xmlns=\"http://www.w3.org/2000/svg\">", "solid sheet\nfacet",
                           "0\nSECTION", "1 0 0 80 0\n2 0 0 0 80", "hello"}) {
    expect_said(text, {"is not JSON, FOLD or OBJ", "begins with", "quadrilaterals"}, "x.dxf");
  }
}

}  // namespace
}  // namespace misalign::schema
