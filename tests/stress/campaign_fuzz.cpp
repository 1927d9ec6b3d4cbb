// Any bytes as a campaign file and as a pattern file: read, or refused in sentences with exit code
// 3. Nothing else may happen; and what is accepted, written out and read again, is the same.
//
// As a libFuzzer target (MISALIGN_LIBFUZZER), or as a program that mutates files itself:
//   campaign_fuzz INPUTS [SEED]
//   campaign_fuzz --input FILE          reads one input again
//   campaign_fuzz --corpus DIRECTORY    writes the files that it starts from
#include <tuple>

#include "schema/campaign/campaign_file.hpp"
#include "schema/pattern/fold_format.hpp"
#include "tests/stress/mutations.hpp"
#include "tests/stress/same_pattern.hpp"

namespace misalign::stress {
namespace {

using namespace schema;

// Where the files lie whose meshes are files of their own.
const std::string kFolder = MISALIGN_SOURCE_DIR "/search/";

enum Outcome { not_json, refused, pattern_accepted, campaign_accepted };

// One sentence, or one for each fault on lines of their own.
void check_refusal(const UserError& error, const std::string& bytes) {
  if (error.cause() != Cause::bad_input) {
    found(std::string("another cause than bad input: ") + error.what());
  }
  const std::string text = error.what();
  const std::size_t first = text.find(" faults\n  ");
  if (text.find(": ") == std::string::npos) found("whose fault? " + text);
  check_sentence(text.substr(first == std::string::npos ? 0 : first));
  // Numbers that nobody wrote, unless somebody did.
  for (const char* bad : {"below nan", "below inf", "below 0,", "try nan", "try inf", "try -"}) {
    if (text.find(bad) == std::string::npos || bytes.find(bad) != std::string::npos) continue;
    found("no number: " + text);
  }
}

// By what it means, not by its words.
bool same_campaign(const Campaign& a, const Campaign& b) {
  const auto parts = [](const Campaign& c) {
    return std::tie(c.name, c.misalignment.vertices, c.misalignment.amplitude_mm,
                    c.misalignment.distribution, c.sample_deg, c.end_deg, c.threshold_deg,
                    c.between_samples, c.required_stop, c.seed, c.stop.draws, c.stop.accepted,
                    c.stop.relative_error, c.stop.wall_s);
  };
  return parts(a) == parts(b) && same_pattern(a.pattern, b.pattern);
}

bool accepts_pattern(const Json& file, const std::string& bytes) {
  const auto read = [&](const Json& value, const std::string& source) {
    InputFaults faults;
    Pattern pattern = read_pattern(value, "", Displacements::allowed, kFolder + "patterns", faults);
    faults.refuse(source);
    return pattern;
  };
  std::optional<Pattern> pattern;
  try {
    pattern = read(file, "fuzz");
  } catch (const UserError& error) {
    check_refusal(error, bytes);
    return false;
  }
  const Json kept = pattern_json(*pattern, pattern->shifts_mm);
  const Pattern again = read(parse_json(kept.dump(), "fuzz"), "kept");
  if (!same_pattern(again, *pattern)) found("kept, and another: " + kept.dump());
  if (pattern_json(again, again.shifts_mm) != kept) found("kept, and other words: " + kept.dump());
  return true;
}

bool accepts_campaign(const Json& file, const std::string& bytes) {
  std::optional<Campaign> campaign;
  try {
    campaign = read_campaign(file, "fuzz", kFolder + "campaigns");
  } catch (const UserError& error) {
    check_refusal(error, bytes);
    return false;
  }
  const Json kept = campaign_json(*campaign);
  const Campaign again = read_campaign(parse_json(kept.dump(), "fuzz"), "kept");
  if (!same_campaign(again, *campaign) || identity(again) != identity(*campaign)) {
    found("kept, and another: " + kept.dump());
  }
  if (campaign_json(again) != kept) found("kept, and other words: " + kept.dump());
  if (!differences(again, *campaign).empty()) found("the same, and differences");
  return true;
}

Outcome read_bytes(const std::string& bytes) {
  Json file;
  try {
    file = parse_json(bytes, "fuzz");
  } catch (const UserError& error) {
    check_refusal(error, bytes);
    return not_json;
  }
  if (accepts_campaign(file, bytes)) return campaign_accepted;
  return accepts_pattern(file, bytes) ? pattern_accepted : refused;
}

// The numbers of rows and columns that make a sheet slow to judge.
std::vector<Json*> large_sides(Json& file) {
  std::vector<Json*> sides;
  for (const char* key : {"/rows", "/columns", "/pattern/rows", "/pattern/columns"}) {
    const Json::json_pointer at(key);
    if (!file.is_object() || !file.contains(at) || !file[at].is_number_integer()) continue;
    const auto side = file[at].get<std::int64_t>();
    if (side > 8 && side <= 40) sides.push_back(&file[at]);
  }
  return sides;
}

}  // namespace
}  // namespace misalign::stress

#ifdef MISALIGN_LIBFUZZER

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace misalign::stress;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  Json file = Json::parse(bytes, nullptr, false);
  if (large_sides(file).empty()) read_bytes(bytes);
  return 0;
}

#else

namespace misalign::stress {
namespace {

// 4 x 4 with every key that there is.
const char* const kEveryKey[] = {
    R"({"name": "a", "pattern": {"family": "miura", "rows": 4, "columns": 4, "pilot": "A14-A19",
        "panel_width_mm": [80, 70, 60, 81.5], "panel_height_mm": 80, "zigzag_offset_mm": [40, 39, 38, 30],
        "holes": [[1, 2], [2, 1]]},
       "misalignment": {"vertices": ["A8", "A7", "A12"], "amplitude_mm": 0.25, "levels": "uniform"},
       "path": {"sample_deg": 0.5, "end_deg": 120}, "accept": {"deploys_from_deg": 60, "between_samples": true},
       "seed": 9223372036854775807,
       "stop": {"draws": null, "accepted": 100, "relative_error": 0.05, "wall_s": 3600}})",
    R"({"pattern": {"family": "miura", "rows": 4, "columns": 4}, "path": {"sample_deg": 10},
       "accept": {"deploys_from_deg": 60, "between_samples": "exact", "stops_at_deg": 30,
                  "stop_stiffness_mm2_per_rad2": 0.5}})",
    R"({"family": "miura", "rows": 4, "columns": 4, "panel_width_mm": 80, "panel_height_mm": 80,
        "zigzag_offset_mm": 40, "holes": "checkerboard-even", "pilot": "A8-A9",
        "displacements_mm": {"A7": [0.4, -0.4], "A9": [0, 1e-3], "A25": [-0.1, 0.3]}})"};

// A small sheet as the mesh of a file.
Json fold_pattern(int rows, int columns, const Json& holes) {
  InputFaults faults;
  const Json miura = {{"family", "miura"}, {"rows", rows}, {"columns", columns}, {"holes", holes}};
  const Pattern pattern =
      read_pattern(miura, "", Displacements::allowed, "", faults, Perforations::any);
  faults.refuse("a pattern to start from");
  std::vector<int> assignment = pattern.base.folding.assignment();
  for (int& sign : assignment) sign *= pattern.base.folding.side();
  return {{"family", "fold"},
          {"mesh", fold_json(pattern.base.sheet, assignment)},
          {"mm_per_unit", 1},
          {"holes", holes}};
}

// Campaigns and patterns, the smallest most often.
std::vector<Json> documents() {
  std::vector<Json> all;
  const auto small = [](Json campaign) {
    campaign["pattern"]["rows"] = campaign["pattern"]["columns"] = 4;
    return campaign;
  };
  for (int times = 0; times < 8; ++times) {
    for (const char* text : kEveryKey) all.push_back(Json::parse(text));
    all.push_back(small(campaign_json(default_campaign())));
    all.push_back({{"pattern", fold_pattern(4, 4, "checkerboard-odd")}, {"seed", 7}});
    all.push_back(fold_pattern(4, 4, {{1, 1}, {2, 2}}));
    all.push_back({{"pattern", {{"family", "miura"}, {"rows", 3}, {"columns", 4}}}});
    all.push_back(small(read_json_file(kFolder + "campaigns/ring-6x6.json")));
  }
  for (const char* folder : {"campaigns", "patterns"}) {
    std::vector<std::string> paths;
    for (const auto& file : std::filesystem::directory_iterator(MISALIGN_SOURCE_DIR "/search/" +
                                                                std::string(folder))) {
      if (file.path().extension() == ".json") paths.push_back(file.path());
    }
    std::sort(paths.begin(), paths.end());
    for (const std::string& path : paths) all.push_back(read_json_file(path));
  }
  all.push_back(campaign_json(default_campaign()));
  return all;
}

class Mutator {
 public:
  Mutator() {
    for (const Json& document : documents_) note_keys(document);
  }

  const std::vector<Json>& documents() const { return documents_; }

  std::string next(Dice& dice) {
    Json file = dice.one_of(documents_);
    const int kind = static_cast<int>(dice.below(10));
    if (kind < 5) {
      for (std::size_t times = 1 + dice.below(2); times > 0; --times) shift_a_number(file, dice);
    } else if (kind < 8) {
      for (std::size_t times = 1 + dice.below(3); times > 0; --times) {
        change_something(file, dice, [&] { return some_value(dice); });
        if (dice.below(4) == 0) set_a_key(file, dice);
      }
    }
    keep_small(file, dice);
    std::string bytes = file.dump();
    if (kind < 8 && dice.below(50) != 0) return bytes;
    for (std::size_t times = 1 + dice.below(4); times > 0; --times) {
      const int way = static_cast<int>(dice.below(10));
      if (way == 0) {
        double_a_key(bytes, dice);
      } else if (way == 1) {
        nest_a_number(bytes, dice);
      } else {
        change_bytes(bytes, dice);
      }
    }
    Json changed = Json::parse(bytes, nullptr, false);
    return keep_small(changed, dice) ? changed.dump() : bytes;
  }

 private:
  void note_keys(const Json& value) {
    if (value.is_object()) {
      for (const auto& [key, child] : value.items()) keys_.push_back(key);
    }
    for (const Json& child : value) {
      if (child.is_structured()) note_keys(child);
    }
  }

  // What could stand anywhere: part of another file, labels, long lists and texts, deep ones.
  Json some_value(Dice& dice) {
    switch (dice.below(12)) {
      case 0:
        return solver::vertex_label(static_cast<int>(dice.below(90)) - 5);
      case 1:
        return solver::line_label(static_cast<int>(dice.below(30)),
                                  static_cast<int>(dice.below(30)));
      case 2:
        return Json(std::vector<Json>(dice.below(2000), some_leaf(dice)));
      case 3:
        return std::string(dice.below(5000), static_cast<char>(dice.below(128)));
      case 4: {
        Json deep = some_leaf(dice);
        for (std::size_t levels = dice.below(40); levels > 0; --levels) deep = Json::array({deep});
        return deep;
      }
      case 5:
        return dice.log_uniform(1e-12, 1e12);
      default: {
        Json other = dice.one_of(documents_);
        return *some_place(other, dice).value;
      }
    }
  }

  Json some_leaf(Dice& dice) {
    Json other = dice.one_of(documents_);
    Json* at = some_place(other, dice).value;
    return at->is_structured() ? Json(dice.below(20)) : *at;
  }

  // What mostly remains a campaign: numbers like those that were there.
  static void shift_a_number(Json& file, Dice& dice) {
    Json* at = nullptr;
    for (int tries = 0; tries < 20 && !(at && at->is_number()); ++tries) {
      at = some_place(file, dice).value;
    }
    if (!at->is_number()) return;
    const double value = at->get<double>();
    switch (dice.below(6)) {
      case 0:
        *at = std::round(value * dice.log_uniform(0.2, 5));
        break;
      case 1:
        *at = value * dice.log_uniform(0.5, 2);
        break;
      case 2:
        *at = value + 1e-9 * (static_cast<double>(dice.below(200)) - 100);
        break;
      case 3:
        *at = -value;
        break;
      case 4:
        *at = std::nextafter(value, dice.below(2) ? 1e300 : -1e300);
        break;
      default:
        *at = dice.below(9);
    }
  }

  void set_a_key(Json& file, Dice& dice) {
    for (int tries = 0; tries < 20; ++tries) {
      Json* at = some_place(file, dice).parent;
      if (!at || !at->is_object()) continue;
      (*at)[dice.one_of(keys_)] = dice.below(2) ? some_value(dice) : some_leaf(dice);
      return;
    }
  }

  // Large sheets are slow to judge, and no other code; a few remain.
  static bool keep_small(Json& file, Dice& dice) {
    bool changed = false;
    for (Json* side : large_sides(file)) {
      if (dice.below(20000) == 0) continue;
      *side = 3 + side->get<int>() % 6;
      changed = true;
    }
    return changed;
  }

  // Which JSON values cannot say.
  void double_a_key(std::string& bytes, Dice& dice) {
    const std::size_t brace = bytes.find('{', dice.below(bytes.size()));
    if (brace == std::string::npos) return;
    bytes.insert(brace + 1, "\"" + dice.one_of(keys_) + "\":" + some_leaf(dice).dump() + ",");
  }

  static void nest_a_number(std::string& bytes, Dice& dice) {
    const std::size_t digit = bytes.find_first_of("0123456789", dice.below(bytes.size()));
    if (digit == std::string::npos) return;
    const std::size_t levels = dice.below(4) == 0 ? dice.below(20000) : dice.below(40);
    bytes.insert(digit + 1, levels, ']');
    bytes.insert(digit, levels, '[');
  }

  const std::vector<Json> documents_ = stress::documents();
  std::vector<std::string> keys_;
};

}  // namespace
}  // namespace misalign::stress

int main(int argc, char** argv) {
  using namespace misalign::stress;
  Mutator mutator;
  std::vector<std::string> corpus;
  for (const Json& document : mutator.documents()) corpus.push_back(document.dump());
  // A sheet of 40 x 40 takes 3 s, and is read four times.
  constexpr double kSlow_s = 2, kHang_s = 120;
  return fuzz_main(argc, argv,
                   {"campaign_fuzz",
                    {"no JSON", "refused", "patterns accepted", "campaigns accepted"},
                    kSlow_s,
                    kHang_s,
                    corpus,
                    [&](Dice& dice) { return mutator.next(dice); },
                    read_bytes});
}

#endif
