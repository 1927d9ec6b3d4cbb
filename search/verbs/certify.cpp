// `misalign certify`: proofs of the folding between samples.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/recovery.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/exchange/certify_json.hpp"
#include "schema/files/features.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "search/draws/models.hpp"
#include "search/ranks/certify_run.hpp"
#include "search/ranks/mpi_session.hpp"
#include "search/sheets/certify_text.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/certify_call.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/rank_options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::UserError;

void show(const CertifyCall& call, const CertifyReport& report) {
  if (call.options.check) {
    call.json ? put_json(schema::check_json(report.check)) : put(check_text(report.check));
    return;
  }
  if (call.json) {
    Json list = Json::array();
    for (const schema::NamedCertificate& sheet : report.sheets) {
      list.push_back(schema::certified_json(sheet));
      list.back()["draw"] = sheet.row.draw;
    }
    const bool is_single = call.choice.draws.size() == 1 && list.size() == 1;
    put_json(is_single ? list.front() : list);
  } else if (!report.sheets.empty()) {
    put(certified_text(report.sheets));
  }
  if (report.left > 0) {
    spdlog::warn("stopped: {} of {} candidates are left; the same command resumes", report.left,
                 report.left + report.sheets.size());
  }
}

// Returns whether its sheets are proven in closed form alone.
bool is_overconstrained(const std::string& catalogue) {
  const auto database = schema::open_for_reading(catalogue);
  return schema::is_overconstrained(schema::read_campaign_of(*database, catalogue).pattern.base);
}

int run_on_catalogue(CertifyCall& call, const Words& typed) {
  CertifyOptions& options = call.options;
  options.border = kCommandLine;
  if (!options.check && !call.closed_form && !call.wells)
    schema::recover_before_writing(options.path);
  const bool is_in_closed_form =
      !call.wells && (call.closed_form || is_overconstrained(options.path));
  if (is_in_closed_form) check_closed_form(call);
  if (!call.choice.chooses() && !call.all && !options.check) {
    throw UserError(schema::Cause::bad_request,
                    "certify: no candidates are chosen (a catalogue holds many); give draw "
                    "numbers, --best K, --diverse K, --where SQL or --all");
  }
  if (call.wells) return prove_wells(call);
  if (is_in_closed_form) return prove_in_closed_form(call);
  if (options.check) schema::need("FLINT");  // before other ranks are started
  if (const int count = ranks_wanted(call.ranks); count > 1) {
    return run_on_ranks(count, typed, false, 0);
  }
  options.alone_is_meant = options.check || !call.ranks.empty();
  options.choose = [&call](SQLite::Database& database) {
    add_study_functions(database, call.options.path);
    return chosen_draws(database, call.choice);
  };
  options.show = [&call](const CertifyReport& report) { show(call, report); };
  return run_certify(options);
}

int run_on_pattern(const CertifyCall& call) {
  if (call.wells) return prove_wells(call);
  const LongWork work("certify is under way", work_style(), false);
  const ChosenSheet sheet = sheet_of_pattern_file(call.options.path);
  const solver::Model model = model_of(sheet.base, sheet.sampling);
  if (call.closed_form || model.is_overconstrained()) {
    check_closed_form(call);
    return prove_in_closed_form(call, sheet, model);
  }
  RowCertifier certifier(sheet.base, model,
                         claims_of(sheet.base, sheet.sampling, sheet.design, call.options.criterion,
                                   call.options.contact));
  if (call.options.check) {
    const auto row = schema::certificate_of_json(sheet.exported, call.options.path);
    if (!row) {
      const std::string file = shell_word(call.options.path);
      throw UserError(schema::Cause::bad_input,
                      call.options.path +
                          ": it holds no certificate, so that there is nothing to check; make one: "
                          "misalign certify " +
                          file + " --json > certified.json");
    }
    schema::CertificateCheck check;
    check.checked = check.of = 1;
    if (auto finding = certifier.check(sheet.shifts_mm, *row)) {
      check.findings = {*finding};
    } else {
      check.ends = {{row->end, 1}};
    }
    call.json ? put_json(schema::check_json(check)) : put(check_text(check));
    return check.findings.empty() ? 0 : exit_code_of(schema::Cause::check_failed);
  }
  solver::SheetSolver solver(model);
  const solver::Sheet solved(solver, sheet.shifts_mm);
  const double asked_deg = call.options.to_deg     ? *call.options.to_deg
                           : sheet.design.from_deg ? *sheet.design.from_deg
                                                   : deploys_from_deg(solved, call.options.path);
  const Json& exported = sheet.exported;
  const bool has_draw =
      exported.is_object() && exported.contains("draw") && exported["draw"].is_number_unsigned();
  const std::uint64_t draw = has_draw ? exported["draw"].get<std::uint64_t>() : 0;
  const schema::CertificateRecord row = certifier.certify(draw, sheet.shifts_mm, asked_deg);
  if (call.json) {
    Json document = document_of(sheet);
    document["certificate"] = schema::certificate_json(row);
    put_json(document);
  } else {
    put(certified_text(schema::named_certificate(sheet.pattern, row, true)));
  }
  return 0;
}

constexpr const char* kCertifyFooter =
    "A certificate proves, rounding included, that for every pilot angle from flat to the\n"
    "certified angle the sheet has exactly one folded state near its path, that creases keep\n"
    "their signs and stay below 180 degrees, and that every diagonal is monotone; with\n"
    "--criterion energy, that the total energy of springs or of tense rubber plates falls\n"
    "towards flat. In full: solver/certificate/README.md. It ends for one of\n"
    "these reasons; the first four are proven, to within 1e-4 degrees:\n"
    "  to_the_end     it reaches the requested angle\n"
    "  reversal       a diagonal reverses, or the energy\n"
    "  over_folded    a crease folds past 180 degrees\n"
    "  sign_changed   a crease becomes flat\n"
    "The others say where the proof stops:\n"
    "  contact        panels meet, or nearly (--contact)\n"
    "  fold_limit     the path reaches a fold limit, or nearly\n"
    "  unclear_slope  a diagonal or a crease stands still, or nearly\n"
    "  flat_branch    the branch next to flat cannot be proven: nothing is certified\n\n"
    "--closed-form proves sheets whose shifts keep creases' directions, such as those of\n"
    "`misalign construct` and of campaigns of \"kind\": \"parallel\". In rational numbers it\n"
    "proves that all loops close by the base's fold angles and that diagonals are monotone.\n"
    "Nothing is stored. Overconstrained sheets, with fewer holes than one degree of freedom\n"
    "needs, have no other proof. See solver/pattern/README.md.\n\n"
    "--wells proves where the total energy of the filling is least between flat and --to: \"one\n"
    "well at 90.00 deg between flat and 119.9 deg, proven\". Springs may be relaxed at any\n"
    "angle, and are taken as numbers: rates and free lengths. Where the proof stops before --to\n"
    "the text says so; in JSON \"end\" is another than \"to_the_end\". Nothing is stored.\n\n"
    "A catalogue keeps certificates beside its candidates: columns certified_deg and\n"
    "certified_by of `query`, `export` and --where. Certificates that answer the request are\n"
    "not made again, so the same command resumes; those by the energy of a design's filling\n"
    "are, as that may have changed. For a pattern file nothing is kept: --json prints the\n"
    "pattern with its certificate, which --check takes.\n"
    "--check makes none. It compares hash and columns, then checks every claim in arithmetic of\n"
    "many bits that shares nothing with the certifier: seconds for 6 x 6. It takes all\n"
    "candidates unless some are chosen, and counts which ends are proven. Exit code 6 if a\n"
    "claim does not hold, 3 if there is no certificate. Needs a program built with FLINT\n"
    "(misalign --version).\n"
    "Examples:\n"
    "  misalign certify results/miura-6x6-1a2b3c4d.db --best 10\n"
    "  misalign certify results/miura-6x6-1a2b3c4d.db --all --ranks all\n"
    "  mpirun -n 8 misalign certify results/miura-6x6-1a2b3c4d.db --all\n"
    "  misalign certify results/miura-6x6-1a2b3c4d.db --check\n"
    "  misalign certify search/patterns/table1.json --to 180\n"
    "  misalign certify search/patterns/table1.json --json > certified.json\n"
    "  misalign certify certified.json --check\n"
    "  misalign certify made.json --closed-form --to 180\n"
    "  misalign certify search/patterns/table1.json --wells --rest-deg 60 --to 150";

void add_wells(CLI::App& verb, CertifyCall& call) {
  auto* wells = verb.add_flag("--wells", call.wells,
                              "prove where the energy of the filling is least, instead: all angles "
                              "at which the sheet can rest");
  for (const char* other : {"--contact", "--criterion", "--again", "--check", "--closed-form"}) {
    wells->excludes(other);
  }
  add_stiffness(verb, call.design.stiffness_n_per_mm);
  add_rest(verb, call.design.rest_deg);
  add_preload(verb, call.design.preload_n);
  add_fill(verb, call.design);
  for (const char* option : {"--stiffness", "--rest-deg", "--preload", "--fill"}) {
    verb.get_option(option)->needs(wells);
  }
}

}  // namespace

Action certify_verb(CLI::App& verb, const Words& typed) {
  verb.description(schema::study_named("certify").about);
  verb.footer(kCertifyFooter);
  auto call = std::make_shared<CertifyCall>();
  CertifyOptions& options = call->options;
  add_catalogue_or_pattern(verb, options.path);
  auto* draws =
      verb.add_option("DRAW", call->choice.draws, "draw numbers of candidates of a catalogue")
          ->check(a_draw());
  auto* group = verb.add_option_group("choice", "which candidates of a catalogue, instead of DRAW");
  const ChoiceOptions chosen = add_choice(verb, *group, call->choice);
  auto* all = group->add_flag("--all", call->all, "every candidate");
  for (CLI::Option* other : {chosen.best, chosen.diverse, chosen.where}) {
    draws->excludes(other);
    all->excludes(other);
  }
  draws->excludes(all);
  auto* to = verb.add_option("--from,--to", options.to_deg,
                             "the sheet is used between this pilot angle and flat: prove up to it "
                             "[the design's, or the sheet's D]");
  to->check(within(0.01, 180))->type_name("DEG");
  auto* contact = verb.add_flag("--contact", options.contact, "also prove that no panels meet");
  auto* criterion = add_criterion(verb, options.criterion);
  auto* again = verb.add_flag("--again", options.again, "replace existing certificates");
  auto* check = verb.add_flag("--check", options.check, "check existing certificates; make none");
  for (CLI::Option* other : {to, contact, criterion, again}) check->excludes(other);
  verb.add_flag(
      "--closed-form", call->closed_form,
      "prove in rational numbers, quickly and to 180 deg, sheets whose shifts keep creases' "
      "directions (misalign construct, campaigns of \"kind\": \"parallel\")");
  add_wells(verb, *call);
  add_ranks(verb, call->ranks);
  auto* ranks = verb.get_option("--ranks");
  verb.get_option("--wells")->excludes(ranks);
  verb.add_flag("--json", call->json,
                "as JSON: a list, unless one DRAW is named; a pattern with its certificate");
  return [=] {
    if (!is_pattern_file(call->options.path)) {
      check_by(call->choice);
      return run_on_catalogue(*call, typed);
    }
    for (const CLI::Option* option :
         {draws, chosen.best, chosen.diverse, chosen.where, chosen.by, all, again, ranks}) {
      if (option->count() == 0) continue;
      throw only_of_a_catalogue(call->options.path,
                                option == draws ? "a draw" : option->get_name());
    }
    if (launched_by_mpi()) throw only_of_a_catalogue(call->options.path, "what ranks share");
    return run_on_pattern(*call);
  };
}

}  // namespace misalign::search
