// `misalign verify`: a catalogue or a pattern, once more.
#include "search/checks/verify.hpp"

#include <random>

#include "search/checks/chosen_sheet.hpp"
#include "search/checks/pattern_check.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct VerifyCall {
  std::string path;
  VerifyOptions options;
  std::optional<std::uint64_t> seed;
  bool json = false;
};

bool is_good_catalogue(const VerifyCall& call) {
  const auto database = schema::open_for_reading(call.path);
  VerifyOptions options = call.options;
  options.seed = call.seed.value_or(std::random_device()());
  const Verification verification = verify(*database, call.path, options);
  call.json ? put_json(verification_json(verification)) : put(verification_text(verification));
  return verification.good();
}

bool is_good_pattern(const VerifyCall& call) {
  const PatternVerification verification = verify_pattern(call.path);
  call.json ? put_json(pattern_verification_json(verification))
            : put(pattern_verification_text(verification));
  return verification.good();
}

}  // namespace

Action verify_verb(CLI::App& verb) {
  verb.description("a catalogue's ledger and its candidates once more, or a pattern");
  verb.footer(
      "Checks the file, every unit's candidates and sums, what runs say of themselves,\n"
      "the goal's end, the diagonals and the digest, all of one moment; follows the\n"
      "chosen candidates' paths again from their stored displacements and compares\n"
      "every column; checks each folded shape by its coordinates; judges fault samples\n"
      "again. --units makes all draws of units chosen at random again: a candidate that\n"
      "was removed together with its sums is seen by nothing else. Panels that cross are\n"
      "reported (they are assumed not to), and no fault; so are metrics that an older\n"
      "build measured by another definition.\n"
      "A pattern file is one sheet: its path by two solvers, its folded shapes, and what\n"
      "an exported candidate says of itself.\n"
      "Exit code 6 if anything differs.\n\n"
      "Examples:\n  misalign verify results/miura-6x6-1a2b3c4d.db\n"
      "  misalign verify results/miura-6x6-1a2b3c4d.db --all --json\n"
      "  misalign verify results/miura-6x6-1a2b3c4d.db --units 20\n"
      "  misalign verify search/patterns/table1.json");
  auto call = std::make_shared<VerifyCall>();
  add_catalogue_or_pattern(verb, call->path);
  auto* sample = verb.add_option("--sample", call->options.sample,
                                 "so many candidates, spread evenly over them in the order "
                                 "of their draws, and as many fault samples [100]");
  sample->check(a_draw())->type_name("N");
  auto* all = verb.add_flag_callback(
      "--all", [call] { call->options.sample.reset(); }, "every candidate and fault sample");
  all->excludes(sample);
  auto* units = verb.add_option("--units", call->options.units,
                                "also make all draws of so many units again, chosen at random [0]");
  units->check(a_draw())->type_name("N");
  verb.add_option("--seed", call->seed, "of that choice, to have the same again [a random one]")
      ->check(a_draw())
      ->needs(units)
      ->type_name("N");
  verb.add_flag("--json", call->json, "as JSON");
  return [call, all, sample, units] {
    const bool is_pattern = is_pattern_file(call->path);
    for (const CLI::Option* option : {all, sample, units}) {
      if (is_pattern && option->count() > 0) {
        throw only_of_a_catalogue(call->path, option->get_name());
      }
    }
    const bool good = is_pattern ? is_good_pattern(*call) : is_good_catalogue(*call);
    return good ? 0 : schema::kExitCheckFailed;
  };
}

}  // namespace misalign::search
