// `misalign tolerance`: how many miscut copies of a sheet still deploy.
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "schema/catalogue/catalogue_state.hpp"
#include "search/checks/chosen_sheet.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/tolerance_text.hpp"
#include "search/ranks/build_info.hpp"
#include "search/ranks/run_info.hpp"
#include "search/terminal/progress.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/choice_options.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::UserError;

struct ToleranceCall {
  std::string path;
  Choice choice;
  ToleranceOptions study;
  std::optional<int> jobs;
  bool keep = true, json = false;
};

// The candidates that are chosen of a catalogue, or the one sheet of a pattern file.
struct ChosenSheets {
  schema::Campaign campaign;
  std::vector<Eigen::Matrix2Xd> shifts_mm;
  std::vector<std::uint64_t> draws;  // one for each sheet; none of a pattern
  std::string pattern;               // its name

  SheetKey key(std::size_t k) const {
    return {draws.empty() ? std::nullopt : std::optional(draws[k]), pattern};
  }
};

ChosenSheets sheets_of_catalogue(const ToleranceCall& call) {
  const auto database = schema::open_for_reading(call.path);
  if (!call.choice.chooses()) {
    throw UserError(schema::kExitUsage,
                    "tolerance: of which candidates? (none is named); add the number of a draw, "
                    "--best K, --diverse K or --where SQL");
  }
  ChosenSheets sheets{schema::read_campaign_of(*database, call.path), {}, {}, ""};
  sheets.draws = chosen_draws(*database, call.choice);
  for (const std::uint64_t draw : sheets.draws) {
    sheets.shifts_mm.push_back(shifts_of_draw(sheets.campaign, draw));
  }
  return sheets;
}

// As a campaign of its own, from whose threshold the sheet itself just deploys. The seed is the
// default one: an exported candidate does not say its campaign's.
ChosenSheets sheet_of_file(const ToleranceCall& call) {
  const ChosenSheet chosen = sheet_of_pattern_file(call.path);
  ChosenSheets sheets{{}, {chosen.shifts_mm}, {}, chosen.pattern};
  schema::Campaign& campaign = sheets.campaign;
  campaign.pattern = chosen.base;
  campaign.sample_deg = chosen.sampling.sample_deg;
  campaign.end_deg = chosen.sampling.end_deg;
  campaign.between_samples = chosen.sampling.between_samples;
  campaign.threshold_deg = campaign.sample_deg;
  ToleranceOptions itself = call.study;
  itself.trials = 0;
  itself.vertices = false;
  const int own_sample = study_tolerance(campaign, sheets.shifts_mm, itself).front().own_sample;
  if (own_sample == 0) {
    throw UserError(schema::kExitBadInput,
                    call.path +
                        ": the sheet deploys from nothing (its D is 0), so that there is nothing "
                        "that miscut copies could lose; shift its vertices by displacements_mm, "
                        "or see what is in the way: misalign fold " +
                        shell_word(call.path));
  }
  campaign.threshold_deg = own_sample * campaign.sample_deg;
  return sheets;
}

// Copies judged so far: a live line on a terminal, elsewhere a line now and then.
class CopiesProgress {
 public:
  CopiesProgress() : live_(is_terminal(STDERR_FILENO) && terminal_is_able()) {}
  ~CopiesProgress() { erase_live_line(); }

  void see(const CopiesDone& copies) {
    const double seconds = watch_.seconds();
    if (seconds < next_s_) return;
    next_s_ = seconds + (live_ ? 0.2 : 30);
    const std::string line = copies_line(copies, seconds);
    if (live_) {
      draw_live_line(line.substr(0, static_cast<std::size_t>(terminal_width(STDERR_FILENO) - 1)));
    } else {
      std::fprintf(stderr, "%s\n", line.c_str());
    }
  }

 private:
  const bool live_;
  Stopwatch watch_;
  double next_s_ = live_ ? 0.2 : 10;
};

// Nothing, or why yields are not in the catalogue: much can have come over it meanwhile.
std::string keep(const ToleranceCall& call, const schema::Campaign& campaign,
                 const std::vector<schema::Yield>& yields) {
  const solver::PerforatedSheet& base = campaign.pattern.base;
  try {
    schema::Catalogue catalogue(call.path, campaign,
                                solver::build_mechanism(base.sheet, base.holes, base.folding), {},
                                schema::Missing::refused);
    const std::vector<std::uint64_t> gone = catalogue.keep(yields, build_info().commit);
    catalogue.close();
    if (gone.empty()) return "";
    return call.path + ": " + std::to_string(gone.size()) + " of " + std::to_string(yields.size()) +
           " candidates are not in it any more, draw " + std::to_string(gone.front()) +
           " among them (another catalogue took its place); put the former one back, then the "
           "same command again";
  } catch (const UserError& error) {
    return error.what();
  }
}

void refuse_lost_convexity(const ChosenSheets& sheets, double amplitude_mm) {
  for (std::size_t k = 0; k < sheets.shifts_mm.size(); ++k) {
    const double largest_mm =
        largest_miscut_mm(sheets.campaign.pattern.base.sheet, sheets.shifts_mm[k]);
    if (amplitude_mm < largest_mm) continue;
    throw UserError(schema::kExitUsage, "--amplitude " + schema::shown_number(amplitude_mm) +
                                            ": must be below " + schema::shown_number(largest_mm) +
                                            " mm (where a facet of " + sheets.key(k).name() +
                                            " can lose convexity); try " +
                                            fmt::format("{:.1g}", largest_mm / 10));
  }
}

schema::Yield yield_of(std::uint64_t draw, const Tolerance& tolerance) {
  return {draw, tolerance.amplitude_mm, tolerance.copies.trials, tolerance.survivors(),
          tolerance.copies.undecided};
}

void print(const ToleranceCall& call, const ChosenSheets& sheets,
           const std::vector<Tolerance>& tolerances) {
  // One that was named is an answer of its own; what a choice finds is a list.
  const bool single = sheets.draws.empty() || call.choice.draws.size() == 1;
  std::string text;
  if (call.json) {
    Json list = Json::array();
    for (std::size_t k = 0; k < tolerances.size(); ++k) {
      list.push_back(tolerance_json(tolerances[k]));
      list.back().update(sheets.key(k).json());
    }
    text = (single ? list.front() : list).dump(1) + "\n";
  } else {
    std::vector<NamedTolerance> named;
    for (std::size_t k = 0; k < tolerances.size(); ++k) {
      named.push_back({sheets.key(k).name(), tolerances[k]});
    }
    if (named.size() > 1 && call.study.vertices) {
      for (const NamedTolerance& one : named) text += tolerance_text(one) + "\n";
    }
    text += named.size() == 1 ? tolerance_text(named.front()) : tolerances_text(named);
  }
  call.json ? put_json(text) : put(text);
}

int run(ToleranceCall call) {
  call.study.set = solver::available_instruction_sets().back();
  call.study.jobs = call.jobs.value_or(usable_threads());
  // Closes the catalogue again, before the writer's lock: see WriterLock.
  const ChosenSheets sheets =
      is_pattern_file(call.path) ? sheet_of_file(call) : sheets_of_catalogue(call);
  refuse_lost_convexity(sheets, call.study.amplitude_mm);
  std::vector<Tolerance> tolerances;
  {
    CopiesProgress progress;
    call.study.progress = [&](const CopiesDone& copies) { progress.see(copies); };
    tolerances = study_tolerance(sheets.campaign, sheets.shifts_mm, call.study);
  }
  if (call.keep && !sheets.draws.empty()) {
    std::vector<schema::Yield> yields;
    for (std::size_t k = 0; k < tolerances.size(); ++k) {
      yields.push_back(yield_of(sheets.draws[k], tolerances[k]));
    }
    const std::string why_not = keep(call, sheets.campaign, yields);
    if (!why_not.empty()) spdlog::warn("this is not kept in the catalogue: {}", why_not);
  }
  print(call, sheets, tolerances);
  return 0;
}

}  // namespace

Action tolerance_verb(CLI::App& verb) {
  verb.description("how many miscut copies of a sheet still deploy");
  verb.footer(
      "Every vertex, also on the perimeter, is moved by a random error, uniform on [-MM, MM]\n"
      "in x and in y. Trial t makes the same errors for every candidate of a campaign: they\n"
      "follow from the campaign's seed and t. The intervals are exact ones of 95 %.\n"
      "  of a candidate   a copy deploys if it reaches the campaign's threshold. The yield\n"
      "                   is kept in the catalogue unless one from as many trials or more\n"
      "                   with this amplitude is there: see `misalign query FILE yields`, and "
      "column\n"
      "                   yield of `export --by` and `--where`\n"
      "  of a pattern     (a file, or an exported candidate) a copy deploys if it reaches\n"
      "                   the sheet's own D; the errors are those of seed 1; nothing is kept\n"
      "`misalign query FILE tolerant` lists the candidates that miscuts should harm least.\n\n"
      "Examples:\n"
      "  misalign tolerance results/miura-6x6-1a2b3c4d.db 1234 --amplitude 0.05 --vertices\n"
      "  misalign tolerance results/miura-6x6-1a2b3c4d.db --best 50 --by miscut_margin_mm \\\n"
      "    --amplitude 0.05\n"
      "  misalign tolerance search/patterns/table1.json --amplitude 0.05");
  auto call = std::make_shared<ToleranceCall>();
  ToleranceOptions& study = call->study;
  add_catalogue_or_pattern(verb, call->path);
  auto* draws =
      verb.add_option("DRAW", call->choice.draws, "draw numbers of candidates of a catalogue")
          ->check(a_draw());
  auto* group = verb.add_option_group("choice", "which candidates of a catalogue, instead of DRAW");
  const ChoiceOptions chosen = add_choice(verb, *group, call->choice);
  for (CLI::Option* other : {chosen.best, chosen.diverse, chosen.where}) draws->excludes(other);
  verb.add_option("--amplitude", study.amplitude_mm, "largest error, mm")
      ->required()
      ->check(within(0, 1e6))
      ->type_name("MM");
  verb.add_option("--trials", study.trials, "how many copies, every vertex off its place [1000]")
      ->check(counted(1, 100000000))
      ->type_name("N");
  verb.add_flag("--vertices", study.vertices,
                "also move each vertex alone, in " + std::to_string(kMostTrialsOfOneVertex) +
                    " copies at most: which ones matter most");
  verb.add_option("--jobs", call->jobs, "threads; the answer does not depend on them [all cores]")
      ->check(counted(1, 4096))
      ->type_name("N");
  verb.add_flag("!--no-keep", call->keep, "do not write the yields into the catalogue");
  verb.add_flag("--json", call->json, "as JSON; a list, unless one DRAW is named, or a pattern");
  return [call, draws, chosen] {
    if (is_pattern_file(call->path)) {
      for (const CLI::Option* option :
           {draws, chosen.best, chosen.diverse, chosen.where, chosen.by}) {
        if (option->count() == 0) continue;
        throw only_of_a_catalogue(call->path, option == draws ? "a draw" : option->get_name());
      }
    }
    check_by(call->choice);
    return run(*call);
  };
}

}  // namespace misalign::search
