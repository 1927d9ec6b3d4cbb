// Any bytes as the FOLD mesh of a pattern: read to a perforated sheet of one degree of freedom, or
// refused in sentences. Nothing else may happen: no crash, no leak, no other exception, no hang.
//
// As a libFuzzer target (MISALIGN_LIBFUZZER), or as a program that mutates meshes itself:
//   fold_fuzz INPUTS [SEED]
//   fold_fuzz --corpus DIRECTORY    writes the meshes that it starts from
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "schema/fold_format.hpp"
#include "schema/pattern_file.hpp"
#include "solver/miura.hpp"

namespace misalign::schema {
namespace {

enum class Outcome { not_json, refused, accepted };

[[noreturn]] void found(const std::string& what, const std::string& bytes) {
  std::fprintf(stderr, "FOUND: %s\n%s\n", what.c_str(), bytes.c_str());
  std::abort();
}

// "problem (why); suggestion", and no angle in it that is no number (a quoted text may be
// anything).
void check_sentence(const std::string& sentence, const std::string& bytes) {
  if (sentence.find(" (") == std::string::npos || sentence.find("); ") == std::string::npos) {
    found("no sentence: " + sentence, bytes);
  }
  if (sentence.find("does not fold rigidly") == std::string::npos) return;
  for (const char* bad : {"nan deg", "inf deg"}) {
    if (sentence.find(bad) != std::string::npos) found("no number: " + sentence, bytes);
  }
}

Outcome read_bytes(const std::string& bytes) {
  Json mesh;
  try {
    mesh = parse_json(bytes, "the mesh");
  } catch (const UserError& error) {
    check_sentence(error.what(), bytes);
    return Outcome::not_json;
  }
  const auto read = [&](const Json& value, InputFaults& faults) {
    return read_pattern(value, "", Displacements::allowed, ".", faults);
  };
  InputFaults faults;
  const Pattern pattern = read({{"family", "fold"}, {"mesh", std::move(mesh)}}, faults);
  for (const std::string& sentence : faults.sentences()) check_sentence(sentence, bytes);
  if (!faults.none()) return Outcome::refused;

  // What is accepted can be kept in a catalogue and read again.
  const double end_deg = pattern.base.folding.end_deg();
  if (!(end_deg > 0 && end_deg <= 180)) found("the base ends nowhere", bytes);
  const Json kept = pattern_json(pattern, pattern.shifts_mm);
  InputFaults again_faults;
  const Pattern again = read(parse_json(kept.dump(), "kept"), again_faults);
  if (!again_faults.none()) found("kept, and refused: " + again_faults.sentences().front(), bytes);
  if (pattern_json(again, again.shifts_mm) != kept) found("kept, and another", bytes);
  return Outcome::accepted;
}

}  // namespace
}  // namespace misalign::schema

#ifdef MISALIGN_LIBFUZZER

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  misalign::schema::read_bytes(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

#else

namespace misalign::schema {
namespace {

// Seconds that one input may take: ten times more than any of these small meshes needs under the
// sanitizers.
constexpr double kHang_s = 10;

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
  explicit Mutator(std::uint64_t seed) : words_(seed), meshes_(meshes()) {}

  std::string next() {
    Json mesh = meshes_[below(meshes_.size())];
    const int kind = static_cast<int>(below(10));
    if (kind < 5) {
      for (std::size_t times = 1 + below(3); times > 0; --times) move_something(mesh);
    } else if (kind < 8) {
      for (std::size_t times = 1 + below(3); times > 0; --times) change_something(mesh);
    }
    std::string bytes = mesh.dump();
    if (kind >= 8) {
      for (std::size_t times = 1 + below(4); times > 0; --times) change_bytes(bytes);
    }
    return bytes;
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : words_() % end; }
  double log_uniform(double least, double most) {
    return least *
           std::exp(std::uniform_real_distribution<double>(0, std::log(most / least))(words_));
  }

  // What remains a mesh, or nearly: vertices moved, letters changed, faces and edges left out.
  void move_something(Json& mesh) {
    const auto some = [&](const char* key) -> Json& {
      Json& list = mesh[key];
      return list[below(list.size())];
    };
    switch (below(8)) {
      case 0:
      case 1: {
        Json& x = some("vertices_coords")[below(2)];
        x = x.get<double>() + (below(2) ? 1 : -1) * log_uniform(1e-12, 200);
        break;
      }
      case 2: {
        constexpr const char* kLetters[] = {"M", "V", "U", "F", "B"};
        some("edges_assignment") = kLetters[below(5)];
        break;
      }
      case 3:
        mesh["faces_vertices"].erase(below(mesh["faces_vertices"].size()));
        if (mesh["faces_vertices"].empty()) mesh["faces_vertices"].push_back(Json::array());
        break;
      case 4:
        std::shuffle(mesh["faces_vertices"].begin(), mesh["faces_vertices"].end(), words_);
        break;
      case 5: {
        Json& face = some("faces_vertices");
        if (face.is_array()) std::reverse(face.begin(), face.end());
        break;
      }
      case 6: {
        const double scale = log_uniform(1e-200, 1e5);
        for (Json& point : mesh["vertices_coords"]) {
          for (Json& x : point) x = x.get<double>() * scale;
        }
        break;
      }
      default: {
        Json& face = some("faces_vertices");
        if (face.is_array() && !face.empty()) {
          face[below(face.size())] = below(mesh["vertices_coords"].size());
        }
      }
    }
  }

  // Any value of the document becomes another, goes, or is there twice.
  void change_something(Json& mesh) {
    Json* at = &mesh;
    Json* parent = nullptr;
    while (at->is_structured() && !at->empty() && (parent == nullptr || below(8) != 0)) {
      parent = at;
      auto child = at->begin();
      std::advance(child, static_cast<std::ptrdiff_t>(below(at->size())));
      at = &*child;
    }
    switch (below(5)) {
      case 0:
        *at = meshes_[below(meshes_.size())]["vertices_coords"][below(9)];
        break;
      case 1:
        if (parent && parent->is_array()) {
          parent->push_back(Json(*at));
          break;
        }
        [[fallthrough]];
      case 2:
        if (parent && parent->is_array()) {
          parent->erase(below(parent->size()));
          break;
        }
        [[fallthrough]];
      case 3: {
        static const Json kOdd = Json::parse(
            R"([null, true, "", "M", {}, [], [[]], -1, 0, 1, 3, 1e308, -1e-308, 5e-324, 0.1,
                18446744073709551615, -9223372036854775808, 4294967296, [1, 2], [0, 1, 2, 3]])");
        *at = kOdd[below(kOdd.size())];
        break;
      }
      default:
        if (at->is_number_float()) {
          *at = at->get<double>() * log_uniform(1e-9, 1e9);
        } else if (at->is_number_integer()) {
          *at = below(60);
        } else {
          *at = nullptr;
        }
    }
  }

  void change_bytes(std::string& bytes) {
    static constexpr const char* kTokens[] = {"NaN",   "1e999", "-1",   "null", "[",        "]",
                                              "{",     "}",     "\"",   ",",    "1e308",    "0.1",
                                              "1e-99", "[[[[",  "true", "\\u",  "\xf0\x9f", "-"};
    const std::size_t at = below(bytes.size());
    switch (below(5)) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<char>(words_());
        break;
      case 1:
        bytes.erase(at, 1 + below(20));
        break;
      case 2:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(200)));
        break;
      case 3:
        bytes.insert(at, kTokens[below(std::size(kTokens))]);
        break;
      default:
        if (!bytes.empty()) bytes[at] = static_cast<char>('0' + below(10));
    }
  }

  std::mt19937_64 words_;
  std::vector<Json> meshes_;
};

void write_corpus(const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  int number = 0;
  for (const Json& mesh : meshes()) {
    std::ofstream(directory / (std::to_string(number++) + ".fold")) << mesh.dump();
  }
}

void fuzz(std::uint64_t inputs, std::uint64_t seed) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
  };
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  std::fflush(stdout);
  Mutator mutator(seed);
  std::uint64_t outcomes[3] = {};
  double slowest_s = 0;
  const auto start = Clock::now();
  for (std::uint64_t i = 0; i < inputs; ++i) {
    const std::string bytes = mutator.next();
    const auto before = Clock::now();
    ++outcomes[static_cast<int>(read_bytes(bytes))];
    slowest_s = std::max(slowest_s, seconds(before));
    if (slowest_s > kHang_s) found("it took " + shown_number(slowest_s) + " s", bytes);
  }
  std::printf("%llu inputs in %.0f s: %llu no JSON, %llu refused, %llu accepted; slowest %.3f s\n",
              static_cast<unsigned long long>(inputs), seconds(start),
              static_cast<unsigned long long>(outcomes[0]),
              static_cast<unsigned long long>(outcomes[1]),
              static_cast<unsigned long long>(outcomes[2]), slowest_s);
}

}  // namespace
}  // namespace misalign::schema

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--corpus") == 0) {
    misalign::schema::write_corpus(argv[2]);
    return 0;
  }
  char* end = nullptr;
  const auto inputs = argc > 1 ? std::strtoull(argv[1], &end, 10) : 0;
  if (inputs == 0 || *end != '\0' || argc > 3) {
    std::fprintf(stderr, "fold_fuzz INPUTS [SEED] | fold_fuzz --corpus DIRECTORY\n");
    return 2;
  }
  misalign::schema::fuzz(inputs,
                         argc > 2 ? std::strtoull(argv[2], nullptr, 10) : std::random_device()());
}

#endif
