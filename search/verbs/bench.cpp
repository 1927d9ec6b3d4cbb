// `misalign bench`: speed of the lanes against the frozen reference, and agreement of their
// verdicts, in one run.
#include <fmt/format.h>

#include <algorithm>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/models.hpp"
#include "search/terminal/stopwatch.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/agreement.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/reference_run.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

using schema::Json;

struct BenchCall {
  std::string campaign_path;  // empty: the default campaign
  double seconds = 3;         // for each solver, a third of it for full paths; in turns
  // Draws of which every verdict, or every rejection, is compared at many thresholds.
  std::optional<std::uint64_t> agree_draws, rejection_draws;
  bool json = false;
};

// The speed of one solver on a campaign's draws, one after another from draw 0.
struct SolverSpeed {
  std::uint64_t draws = 0;
  double seconds = 0;
  solver::Effort effort;
  std::uint64_t disagreements = 0;  // with the reference, on the draws that both did

  double draws_per_s() const { return static_cast<double>(draws) / seconds; }
  double of_a_draw(std::uint64_t n) const {
    return static_cast<double>(n) / static_cast<double>(draws);
  }
};

struct LaneSpeed {
  solver::InstructionSet set;
  SolverSpeed search;      // most draws rejected early
  SolverSpeed full_paths;  // every draw judged on its full path up to its first fault
};

struct SpeedReport {
  SolverSpeed reference;  // dense, every sample, up to the first fault
  std::vector<LaneSpeed> lanes;
};

// Searches a campaign's draws by one instruction set, without a catalogue.
class LaneRun {
 public:
  LaneRun(const schema::Campaign& campaign, solver::InstructionSet set)
      : evaluator_(campaign, set) {}

  // Works for this time in blocks; the first ones small, as a search's are.
  void run(double seconds) {
    const Stopwatch watch;
    UnitWork work(evaluator_, {next_, schema::kEndOfDraws});
    while (watch.seconds() < seconds) work.run_next_block();
    const schema::UnitRecord unit = work.take();
    next_ = unit.range.hi;
    speed_.draws += unit.range.size();
    speed_.seconds += unit.seconds;
    for (const schema::Candidate& found : unit.candidates) accepted_.push_back(found.draw);
  }

  bool accepted(std::uint64_t draw) const {
    return std::binary_search(accepted_.begin(), accepted_.end(), draw);
  }
  bool wants(const solver::Verdict& verdict) const {
    return evaluator_.campaign().accepts(verdict);
  }
  SolverSpeed speed() const {
    SolverSpeed speed = speed_;
    const solver::Effort rejection = evaluator_.batch().rejection_effort();
    const solver::Effort judging = evaluator_.batch().path_effort();
    speed.effort = {rejection.solves + judging.solves, rejection.iterations + judging.iterations};
    return speed;
  }

 private:
  DrawEvaluator evaluator_;
  std::uint64_t next_ = 0;
  SolverSpeed speed_;
  std::vector<std::uint64_t> accepted_;
};

// Judges every draw of a campaign on its full path, by one instruction set.
class FullPathRun {
 public:
  FullPathRun(const schema::Campaign& campaign, solver::InstructionSet set)
      : evaluator_(campaign, set), block_size_(evaluator_.largest_block()) {}

  void run(double seconds) {
    const Stopwatch watch;
    do {
      const Stopwatch block;
      const std::uint64_t next = speed_.draws + block_size_.now();
      evaluator_.judge({speed_.draws, next});
      speed_.draws = next;
      block_size_.took(block.seconds());
    } while (watch.seconds() < seconds);
    speed_.seconds += watch.seconds();
  }

  SolverSpeed speed() const {
    SolverSpeed speed = speed_;
    speed.effort = evaluator_.batch().path_effort();
    return speed;
  }

 private:
  DrawEvaluator evaluator_;
  BlockSize block_size_;
  SolverSpeed speed_;
};

Json speed_json(const SolverSpeed& speed) {
  return {{"draws", speed.draws},
          {"draws_per_s", speed.draws_per_s()},
          {"solves_per_draw", speed.of_a_draw(speed.effort.solves)},
          {"iterations_per_draw", speed.of_a_draw(speed.effort.iterations)}};
}

Json report_json(const SpeedReport& report) {
  Json lanes = Json::array();
  for (const auto& [set, search, full_paths] : report.lanes) {
    Json entry = speed_json(search);
    entry["instruction_set"] = solver::instruction_set_name(set);
    entry["ratio"] = search.draws_per_s() / report.reference.draws_per_s();
    entry["disagreements"] = search.disagreements;
    entry["full_paths"] = speed_json(full_paths);
    lanes.push_back(entry);
  }
  return {{"reference", speed_json(report.reference)}, {"lanes", lanes}};
}

void print_speed(const SpeedReport& report) {
  put("solver          draws/s    ratio  solves/draw  iterations/draw  disagreements  full "
      "paths/s\n");
  const auto row = [&](const char* name, const SolverSpeed& speed, const SolverSpeed& full_paths) {
    put("{:<10} {:>12.0f} {:>8.0f} {:>12.2f} {:>16.2f} {:>14} {:>13.0f}\n", name,
        speed.draws_per_s(), speed.draws_per_s() / report.reference.draws_per_s(),
        speed.of_a_draw(speed.effort.solves), speed.of_a_draw(speed.effort.iterations),
        speed.disagreements, full_paths.draws_per_s());
  };
  row("reference", report.reference, report.reference);
  for (const LaneSpeed& lane : report.lanes) {
    row(solver::instruction_set_name(lane.set), lane.search, lane.full_paths);
  }
  put("disagreements: on the reference's {} draws\n", report.reference.draws);
  put("full paths: every draw up to its first fault, none rejected early\n");
}

SpeedReport measure_speed(const schema::Campaign& campaign, double seconds) {
  constexpr int kRounds = 3;
  SpeedReport report;
  std::vector<std::unique_ptr<LaneRun>> runs;
  const auto sets = solver::available_instruction_sets();
  std::vector<std::unique_ptr<FullPathRun>> full_paths;
  for (const auto set : sets) {
    runs.push_back(std::make_unique<LaneRun>(campaign, set));
    full_paths.push_back(std::make_unique<FullPathRun>(campaign, set));
  }
  const solver::Model model = model_of(campaign);
  ReferenceRun reference(campaign, model.mechanism());
  std::vector<solver::Verdict> expected;
  for (int round = 0; round < kRounds; ++round) {
    const Stopwatch watch;
    do {
      expected.push_back(reference.judge(expected.size()));
      report.reference.effort.solves += reference.path().newton_solves;
      report.reference.effort.iterations += reference.path().newton_iterations;
    } while (watch.seconds() < seconds / kRounds);
    report.reference.seconds += watch.seconds();
    for (const auto& run : runs) run->run(seconds / kRounds);
    for (const auto& run : full_paths) run->run(seconds / kRounds / 3);
  }
  report.reference.draws = expected.size();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    SolverSpeed speed = runs[i]->speed();
    for (std::uint64_t draw = 0; draw < std::min(speed.draws, report.reference.draws); ++draw) {
      if (runs[i]->accepted(draw) != runs[i]->wants(expected[draw])) ++speed.disagreements;
    }
    report.lanes.push_back({sets[i], speed, full_paths[i]->speed()});
  }
  return report;
}

// Runs the requested comparison and prints it; false if anything disagreed.
bool bench(const BenchCall& call) {
  const schema::Campaign campaign = call.campaign_path.empty()
                                        ? schema::default_campaign()
                                        : schema::read_campaign_file(call.campaign_path);
  if (call.agree_draws || call.rejection_draws) {
    const Against against = call.agree_draws ? Against::reference : Against::full_path;
    const AgreementReport report =
        compare(campaign, solver::available_instruction_sets().back(),
                call.agree_draws ? *call.agree_draws : *call.rejection_draws, against);
    call.json ? put_json(report_json(report)) : print_agreement(report, against);
    return report.verdicts_differ + report.decisions_differ + report.undecided == 0;
  }
  const SpeedReport report = measure_speed(campaign, call.seconds);
  call.json ? put_json(report_json(report)) : print_speed(report);
  return std::all_of(report.lanes.begin(), report.lanes.end(),
                     [](const LaneSpeed& lane) { return lane.search.disagreements == 0; });
}

}  // namespace

Action bench_verb(CLI::App& verb) {
  verb.description("speed, and agreement with the reference solver");
  verb.footer(
      "Examples:\n  misalign bench\n"
      "  misalign bench search/campaigns/ring-6x6.json --agree 2000 --json");
  auto call = std::make_shared<BenchCall>();
  verb.add_option("CAMPAIGN", call->campaign_path, "campaign file [the default campaign]");
  add_value(verb, "--seconds", call->seconds, "run time of each solver, s [3]", within(0.01, 1e6),
            "SECONDS");
  auto* agree =
      add_value(verb, "--agree", call->agree_draws,
                "instead of speed: compare the verdicts of N draws with the reference's, at "
                "thresholds every 10 degrees, at the draw's own D and one sample above",
                counted(1, 100000000), "N");
  add_value(verb, "--rejections", call->rejection_draws,
            "instead of speed: follow N draws on their full paths, and find those that a test "
            "rejects though they reach one of these thresholds, or the campaign's",
            counted(1, 100000000), "N")
      ->excludes(agree);
  verb.add_flag("--json", call->json, "as JSON");
  return [call] { return bench(*call) ? 0 : exit_code_of(schema::Cause::check_failed); };
}

}  // namespace misalign::search
