// Any bytes as an exported candidate, JSON or FOLD, which says more of itself than a pattern does:
// verified against what it says, or refused in sentences. Nothing else may happen: no crash, no
// leak, no other exception, no hang.
//
//   candidate_fuzz INPUTS [SEED]
//   candidate_fuzz --input FILE          reads one input again
//   candidate_fuzz --corpus DIRECTORY    writes the candidates that it starts from
#include "schema/campaign/campaign_file.hpp"
#include "schema/exchange/actuators_json.hpp"
#include "schema/exchange/fold_export.hpp"
#include "search/checks/pattern_check.hpp"
#include "search/draws/draw.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/folding_model.hpp"
#include "tests/folder.hpp"
#include "tests/stress/mutations.hpp"

namespace misalign::stress {
namespace {

using namespace schema;

enum Outcome { refused, findings, good };

// Short paths of small sheets: what is tried here is how a file is read and compared.
std::vector<Json> candidates() {
  std::vector<Json> all;
  for (const char* holes : {"\"checkerboard-odd\"", "[[1, 1], [2, 2]]"}) {
    const std::string text =
        std::string(
            R"({"name": "quick", "pattern": {"family": "miura", "rows": 4, "columns": 4,)") +
        R"("holes": )" + holes +
        R"(}, "path": {"end_deg": 20}, "accept": {"deploys_from_deg": 10}})";
    const Campaign campaign = read_campaign(Json::parse(text), "quick");
    search::FoldingModel model(campaign, 5);
    for (const std::uint64_t draw : {0U, 1U, 2U}) {
      const solver::Sheet sheet = model.sheet(search::shifts_of_draw(campaign, draw));
      const FoldingView view(campaign.pattern, sheet);
      Json candidate = folded_pattern_json(
          model.sampling(), view,
          actuation_json(view,
                         solver::actuate(sheet, campaign.design.actuators(campaign.pattern.base))),
          Json());
      candidate.update(origin_json(campaign, draw, Json::array()));
      all.push_back(candidate);
      candidate.erase("pattern");
      all.push_back(folded_fold_json(view, sheet.rows_to_show(5), "a candidate", candidate));
    }
  }
  return all;
}

class Mutator {
 public:
  const std::vector<Json>& candidates() const { return candidates_; }

  std::string next(Dice& dice) const {
    Json candidate = dice.one_of(candidates_);
    const int kind = static_cast<int>(dice.below(10));
    for (std::size_t times = 1 + dice.below(3); kind < 9 && times > 0; --times) {
      change_something(claims_or_all(candidate, dice), dice, [&] {
        Json other = dice.one_of(candidates_);
        return *some_place(other, dice).value;
      });
    }
    keep_short(candidate);
    std::string bytes = candidate.dump();
    for (std::size_t times = dice.below(3); kind >= 8 && times > 0; --times) {
      change_bytes(bytes, dice);
    }
    return bytes;
  }

 private:
  // Mostly what the file says of itself; the pattern has a fuzzer of its own.
  static Json& claims_or_all(Json& candidate, Dice& dice) {
    static constexpr const char* kClaims[] = {"verdict", "metrics", "diagonals", "sampling"};
    if (!candidate.is_object() || dice.below(4) == 0) return candidate;
    Json& data = candidate.contains("misalign:data") ? candidate["misalign:data"] : candidate;
    if (!data.is_object()) return candidate;
    const auto claim = data.find(dice.one_of(kClaims));
    return claim == data.end() ? candidate : *claim;
  }

  // A path of 180 degrees in steps of 0.01 is slow, and no other code.
  static void keep_short(Json& candidate) {
    for (const char* at : {"/sampling/sample_deg", "/misalign:data/sampling/sample_deg"}) {
      const Json::json_pointer where(at);
      if (!candidate.is_object() || !candidate.contains(where)) continue;
      Json& sample_deg = candidate[where];
      if (sample_deg.is_number() && sample_deg.get<double>() < 0.5) sample_deg = 0.5;
    }
  }

  const std::vector<Json> candidates_ = stress::candidates();
};

class Reader {
 public:
  Outcome read(const std::string& bytes) const {
    const std::string path = folder_.file("candidate.json", bytes);
    try {
      const search::PatternVerification verification = search::verify_pattern(path);
      check_shown(search::pattern_verification_text(verification));
      search::pattern_verification_json(verification).dump();
      return verification.good() ? good : findings;
    } catch (const UserError& error) {
      check_shown(error.what());
      if (error.cause() != Cause::bad_input) {
        found(std::string("another cause than bad input: ") + error.what());
      }
      return refused;
    }
  }

 private:
  const Folder folder_{"candidate_fuzz"};
};

}  // namespace
}  // namespace misalign::stress

int main(int argc, char** argv) {
  using namespace misalign::stress;
  const Mutator mutator;
  const Reader reader;
  std::vector<std::string> corpus;
  for (const Json& candidate : mutator.candidates()) {
    corpus.push_back(candidate.dump());
    if (reader.read(corpus.back()) != good) found("its own export: " + corpus.back());
  }
  constexpr double kSlow_s = 2, kHang_s = 60;
  return fuzz_main(argc, argv,
                   {"candidate_fuzz",
                    {"refused", "with findings", "good"},
                    kSlow_s,
                    kHang_s,
                    corpus,
                    [&](Dice& dice) { return mutator.next(dice); },
                    [&](const std::string& bytes) { return reader.read(bytes); }});
}
