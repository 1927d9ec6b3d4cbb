// Any bytes as the FOLD mesh of a pattern: read to a perforated sheet of one degree of freedom, or
// refused in sentences. Nothing else may happen: no crash, no leak, no other exception, no hang.
//
// As a libFuzzer target (MISALIGN_LIBFUZZER), or as a program that mutates meshes itself:
//   fold_fuzz INPUTS [SEED]
//   fold_fuzz --input FILE          reads one input again
//   fold_fuzz --corpus DIRECTORY    writes the meshes that it starts from
#include "schema/pattern/fold_format.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/pattern/miura.hpp"
#include "tests/stress/mutations.hpp"
#include "tests/stress/same_pattern.hpp"

namespace misalign::stress {
namespace {

using namespace schema;

enum Outcome { not_json, refused, accepted };

Outcome read_bytes(const std::string& bytes) {
  Json mesh;
  try {
    mesh = parse_json(bytes, "the mesh");
  } catch (const UserError& error) {
    check_sentence(error.what());
    return not_json;
  }
  const auto read = [&](const Json& value, InputFaults& faults) {
    return read_pattern(value, "", Displacements::allowed, ".", faults);
  };
  InputFaults faults;
  const Pattern pattern = read({{"family", "fold"}, {"mesh", std::move(mesh)}}, faults);
  for (const std::string& sentence : faults.sentences()) check_sentence(sentence);
  if (!faults.none()) return refused;

  // What is accepted can be kept in a catalogue and read again.
  const double end_deg = pattern.base.folding.end_deg();
  if (!(end_deg > 0 && end_deg <= 180)) found("the base ends nowhere");
  const Json kept = pattern_json(pattern, pattern.shifts_mm);
  InputFaults again_faults;
  const Pattern again = read(parse_json(kept.dump(), "kept"), again_faults);
  if (!again_faults.none()) found("kept, and refused: " + again_faults.sentences().front());
  if (!same_pattern(again, pattern)) found("kept, and another");
  if (pattern_json(again, again.shifts_mm) != kept) found("kept, and other words");
  return accepted;
}

}  // namespace
}  // namespace misalign::stress

#ifdef MISALIGN_LIBFUZZER

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  misalign::stress::read_bytes(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

#else

namespace misalign::stress {
namespace {

Json miura(int rows, int columns, double height_mm, const std::vector<int>& missing = {}) {
  solver::MiuraShape shape = solver::MiuraShape::uniform(rows, columns, 80, 80, 40);
  shape.height_mm.back() = height_mm;
  const solver::CreasePattern sheet = solver::miura_sheet(shape);
  Json mesh = fold_json(sheet, solver::miura_assignment(shape, sheet));
  for (auto f = missing.rbegin(); f != missing.rend(); ++f) mesh["faces_vertices"].erase(*f);
  return mesh;
}

// The smallest most often: they are read a hundred times as fast as the shipped ones.
std::vector<Json> meshes() {
  std::vector<Json> all;
  for (int times = 0; times < 8; ++times) {
    all.push_back(miura(3, 3, 80));
    all.push_back(miura(3, 3, 60, {4}));
    all.push_back(miura(2, 2, 80));
    all.push_back(miura(3, 4, 80, {5}));
  }
  for (int times = 0; times < 2; ++times) {
    all.push_back(miura(4, 4, 80));
    all.push_back(miura(4, 4, 70, {6, 9}));
  }
  for (const char* name : {"angle-array", "double-corrugation", "turned-quads"}) {
    all.push_back(
        read_json_file(std::string(MISALIGN_SOURCE_DIR "/search/patterns/") + name + "-6x6.fold"));
  }
  return all;
}

class Mutator {
 public:
  std::string next(Dice& dice) {
    Json mesh = dice.one_of(meshes_);
    const int kind = static_cast<int>(dice.below(10));
    if (kind < 5) {
      for (std::size_t times = 1 + dice.below(3); times > 0; --times) move_something(mesh, dice);
    } else if (kind < 8) {
      const auto some_point = [&] {
        const Json& other = dice.one_of(meshes_);
        return other["vertices_coords"][dice.below(9)];
      };
      for (std::size_t times = 1 + dice.below(3); times > 0; --times) {
        change_something(mesh, dice, some_point);
      }
    }
    if (dice.below(4) == 0) mesh.erase("faces_vertices");  // then they follow from the edges
    std::string bytes = mesh.dump();
    if (kind >= 8) {
      for (std::size_t times = 1 + dice.below(4); times > 0; --times) change_bytes(bytes, dice);
    }
    return bytes;
  }

 private:
  // What remains a mesh, or nearly: vertices moved, letters changed, faces and edges left out.
  static void move_something(Json& mesh, Dice& dice) {
    const auto some = [&](const char* key) -> Json& {
      Json& list = mesh[key];
      return list[dice.below(list.size())];
    };
    switch (dice.below(8)) {
      case 0:
      case 1: {
        Json& x = some("vertices_coords")[dice.below(2)];
        x = x.get<double>() + (dice.below(2) ? 1 : -1) * dice.log_uniform(1e-12, 200);
        break;
      }
      case 2: {
        constexpr const char* kLetters[] = {"M", "V", "U", "F", "B"};
        some("edges_assignment") = dice.one_of(kLetters);
        break;
      }
      case 3:
        mesh["faces_vertices"].erase(dice.below(mesh["faces_vertices"].size()));
        if (mesh["faces_vertices"].empty()) mesh["faces_vertices"].push_back(Json::array());
        break;
      case 4:
        std::shuffle(mesh["faces_vertices"].begin(), mesh["faces_vertices"].end(), dice.words());
        break;
      case 5: {
        Json& face = some("faces_vertices");
        if (face.is_array()) std::reverse(face.begin(), face.end());
        break;
      }
      case 6: {
        const double scale = dice.log_uniform(1e-200, 1e5);
        for (Json& point : mesh["vertices_coords"]) {
          for (Json& x : point) x = x.get<double>() * scale;
        }
        break;
      }
      default: {
        Json& face = some("faces_vertices");
        if (face.is_array() && !face.empty()) {
          face[dice.below(face.size())] = dice.below(mesh["vertices_coords"].size());
        }
      }
    }
  }

  const std::vector<Json> meshes_ = meshes();
};

}  // namespace
}  // namespace misalign::stress

int main(int argc, char** argv) {
  using namespace misalign::stress;
  std::vector<std::string> corpus;
  for (const Json& mesh : meshes()) corpus.push_back(mesh.dump());
  Mutator mutator;
  // A hundred times more than any of these small meshes needs.
  constexpr double kSlow_s = 2, kHang_s = 10;
  return fuzz_main(argc, argv,
                   {"fold_fuzz",
                    {"no JSON", "refused", "accepted"},
                    kSlow_s,
                    kHang_s,
                    corpus,
                    [&](Dice& dice) { return mutator.next(dice); },
                    read_bytes});
}

#endif
