// `misalign verify`: checks a catalogue or a pattern.
#include <random>

#include "search/checks/pattern_check.hpp"
#include "search/checks/verification_text.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/rank_options.hpp"
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
  verb.description("check a catalogue (its ledger, and candidates computed again) or a pattern");
  verb.footer(
      "Of a catalogue:\n"
      "  always       from one snapshot: the file, each unit's candidates and sums, records of\n"
      "               runs, the goal's end, the diagonals, the digest\n"
      "  candidates   (--sample, --all) paths computed again from the stored displacements; every\n"
      "               column is compared, every folded shape checked by its coordinates\n"
      "  fault sample (as many) verdicts computed again\n"
      "  remembered   (as many) numbers of studies in CATALOGUE.studies computed again\n"
      "  units        (--units) all draws of units chosen at random computed again: nothing else\n"
      "               detects a candidate that was removed together with its sums\n"
      "Reported, but no fault: panels that cross (the search assumes that they do not; not\n"
      "looked for where the program was built without FCL, see misalign --version), and\n"
      "metrics that an older build measured by another definition.\n"
      "Of a pattern file: its path by factors with pivoting, its folded shapes, and\n"
      "the data of an exported candidate.\n"
      "Exit code 6 if anything differs.\n\n"
      "Examples:\n  misalign verify results/miura-6x6-1a2b3c4d.db\n"
      "  misalign verify results/miura-6x6-1a2b3c4d.db --all --json\n"
      "  misalign verify results/miura-6x6-1a2b3c4d.db --units 20\n"
      "  misalign verify search/patterns/table1.json");
  auto call = std::make_shared<VerifyCall>();
  add_catalogue_or_pattern(verb, call->path);
  auto* sample = verb.add_option("--sample", call->options.sample,
                                 "number of candidates, spread evenly in the order of their draws, "
                                 "of fault samples and of remembered numbers [100]");
  sample->check(a_draw())->type_name("N");
  auto* all = verb.add_flag_callback(
      "--all", [call] { call->options.sample.reset(); }, "every candidate and fault sample");
  all->excludes(sample);
  auto* units = verb.add_option(
      "--units", call->options.units,
      "number of units, chosen at random, all draws of which are computed again [0]");
  units->check(a_draw())->type_name("N");
  add_value(verb, "--seed", call->seed,
            "seed of that choice, to choose the same units again [a random one]", a_draw(), "N")
      ->needs(units);
  add_jobs(verb);
  verb.add_flag("--json", call->json, "as JSON");
  return [call, all, sample, units] {
    const bool is_pattern = is_pattern_file(call->path);
    for (const CLI::Option* option : {all, sample, units}) {
      if (is_pattern && option->count() > 0) {
        throw only_of_a_catalogue(call->path, option->get_name());
      }
    }
    const bool good = is_pattern ? is_good_pattern(*call) : is_good_catalogue(*call);
    return good ? 0 : exit_code_of(schema::Cause::check_failed);
  };
}

}  // namespace misalign::search
