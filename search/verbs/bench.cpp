// `misalign bench`: speed of the lanes against the frozen reference, and whether their verdicts are
// the same, in one run.
#include <fmt/format.h>

#include <algorithm>

#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/models.hpp"
#include "search/terminal/stopwatch.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"
#include "solver/reference/reference.hpp"

namespace misalign::search {
namespace {

using schema::Json;

struct BenchCall {
  std::string campaign_path;  // empty: the default campaign
  double seconds = 3;         // for each solver; taken in turns
  // Instead of speed: every verdict on so many draws, at many thresholds.
  std::optional<std::uint64_t> agree_draws;
  bool json = false;
};

// What one solver did with a campaign's draws, one after another from draw 0.
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

struct SpeedReport {
  SolverSpeed reference;  // dense, every sample, up to the first fault
  std::vector<std::pair<solver::InstructionSet, SolverSpeed>> lanes;
};

// Verdicts of the fast path against the reference's, on draws from 0 on.
struct AgreementReport {
  std::uint64_t draws = 0, undecided = 0;
  std::uint64_t verdicts_differ = 0;   // D, first fault or place, on the full path
  std::uint64_t reference_jumped = 0;  // they differed until the reference took finer steps
  std::uint64_t decisions = 0;         // at thresholds of every tenth degree, at each draw's own D
                                       // and one sample above
  std::uint64_t decisions_differ = 0;
  std::vector<std::uint64_t> differing_draws;  // the first few
};

// The frozen reference on a campaign's draws.
class ReferenceRun {
 public:
  ReferenceRun(const schema::Campaign& campaign, const solver::Mechanism& mechanism,
               double longest_step_deg = solver::PathPlanOptions{}.longest_step_deg)
      : campaign_(campaign),
        base_(campaign.pattern.base),
        plan_(solver::plan_path(
            mechanism, base_.folding, base_.sheet.vertices_mm,
            solver::reference_path(campaign.path(), longest_step_deg, campaign.between_samples))),
        reference_(mechanism, plan_, campaign.criterion()) {}

  solver::Verdict judge(std::uint64_t draw) {
    return reference_.judge(base_.sheet.vertices_mm + shifts_of_draw(campaign_, draw));
  }
  const solver::PathResult& path() const { return reference_.path(); }

 private:
  const schema::Campaign& campaign_;
  const solver::PerforatedSheet& base_;
  const solver::PathPlan plan_;
  solver::Reference reference_;
};

// One instruction set on a campaign's draws: all that a search does but the catalogue.
class LaneRun {
 public:
  LaneRun(const schema::Campaign& campaign, solver::InstructionSet set)
      : evaluator_(campaign, set) {}

  // Blocks for so long; the first ones small, as a search's are.
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

// Where the reference and the lanes differ, the reference goes again in steps of this. In steps of
// a whole degree it can cross a fold limit to another branch without a crease moving by 20 degrees.
constexpr double kCarefulStep_deg = 0.02;

Json speed_json(const SolverSpeed& speed) {
  return {{"draws", speed.draws},
          {"draws_per_s", speed.draws_per_s()},
          {"solves_per_draw", speed.of_a_draw(speed.effort.solves)},
          {"iterations_per_draw", speed.of_a_draw(speed.effort.iterations)}};
}

Json report_json(const SpeedReport& report) {
  Json lanes = Json::array();
  for (const auto& [set, speed] : report.lanes) {
    Json entry = speed_json(speed);
    entry["instruction_set"] = solver::instruction_set_name(set);
    entry["ratio"] = speed.draws_per_s() / report.reference.draws_per_s();
    entry["disagreements"] = speed.disagreements;
    lanes.push_back(entry);
  }
  return {{"reference", speed_json(report.reference)}, {"lanes", lanes}};
}

Json report_json(const AgreementReport& report) {
  return {{"draws", report.draws},
          {"undecided", report.undecided},
          {"verdicts_differ", report.verdicts_differ},
          {"reference_jumped", report.reference_jumped},
          {"decisions", report.decisions},
          {"decisions_differ", report.decisions_differ},
          {"differing_draws", report.differing_draws}};
}

void print_speed(const SpeedReport& report) {
  put("solver          draws/s    ratio  solves/draw  iterations/draw  disagreements\n");
  const auto row = [&](const char* name, const SolverSpeed& speed) {
    put("{:<10} {:>12.0f} {:>8.0f} {:>12.2f} {:>16.2f} {:>14}\n", name, speed.draws_per_s(),
        speed.draws_per_s() / report.reference.draws_per_s(), speed.of_a_draw(speed.effort.solves),
        speed.of_a_draw(speed.effort.iterations), speed.disagreements);
  };
  row("reference", report.reference);
  for (const auto& [set, speed] : report.lanes) row(solver::instruction_set_name(set), speed);
  put("disagreements: on the reference's {} draws\n", report.reference.draws);
}

void print_agreement(const AgreementReport& report) {
  put("{} draws: {} verdicts differ (in {} more the reference had jumped), {} of {} "
      "decisions differ, {} undecided\n",
      report.draws, report.verdicts_differ, report.reference_jumped, report.decisions_differ,
      report.decisions, report.undecided);
  for (const std::uint64_t draw : report.differing_draws) put("  differs: draw {}\n", draw);
}

// Collects what the fast path decides at one threshold after another.
class Comparison {
 public:
  Comparison(const schema::Campaign& campaign, solver::InstructionSet set)
      : campaign_(campaign), set_(set) {}

  AgreementReport run(std::uint64_t draws) {
    report_.draws = draws;
    judge_all(draws);
    for (double angle_deg = 10; angle_deg <= campaign_.end_deg; angle_deg += 10) {
      const int threshold = static_cast<int>(angle_deg / campaign_.sample_deg + 0.5);
      if (threshold >= 1) decide(threshold, [](const solver::Verdict&) { return true; });
    }
    const int last = static_cast<int>(campaign_.end_deg / campaign_.sample_deg * (1 + 1e-9));
    for (int d = 0; d <= last; ++d) {
      const auto has_d = [&](const solver::Verdict& expected) {
        return expected.deploys_from_sample == d;
      };
      if (std::none_of(expected_.begin(), expected_.end(), has_d)) continue;
      if (d >= 1) decide(d, has_d);
      if (d < last) decide(d + 1, has_d);
    }
    return report_;
  }

 private:
  void judge_all(std::uint64_t draws) {
    DrawEvaluator evaluator(campaign_, set_);
    ReferenceRun reference(campaign_, evaluator.mechanism());
    ReferenceRun careful(campaign_, evaluator.mechanism(), kCarefulStep_deg);
    for (std::uint64_t lo = 0; lo < draws; lo += evaluator.largest_block()) {
      const schema::DrawRange block{lo, std::min(draws, lo + evaluator.largest_block())};
      const auto& verdicts = evaluator.judge(block);
      full_path_.insert(full_path_.end(), verdicts.begin(), verdicts.end());
    }
    for (std::uint64_t draw = 0; draw < draws; ++draw) {
      expected_.push_back(reference.judge(draw));
      const solver::Verdict& found = full_path_[draw];
      if (found.first_fault == solver::Fault::undecided) ++report_.undecided;
      if (same(expected_.back(), found)) continue;
      expected_.back() = careful.judge(draw);
      if (same(expected_.back(), found)) {
        ++report_.reference_jumped;
      } else {
        ++report_.verdicts_differ;
        note(draw);
      }
    }
  }

  static bool same(const solver::Verdict& a, const solver::Verdict& b) {
    return a.deploys_from_sample == b.deploys_from_sample && a.first_fault == b.first_fault &&
           a.where == b.where;
  }

  // The fast path accepts what its tests leave and its full path takes as far as the threshold.
  template <class Chosen>
  void decide(int threshold, const Chosen& is_chosen) {
    schema::Campaign aims = campaign_;
    aims.threshold_deg = threshold * campaign_.sample_deg;
    const solver::Model model = model_of(aims);
    const auto batch = solver::make_batch(set_, model);
    solver::ShiftBlock block;
    std::vector<std::uint64_t> in_block;
    const auto flush = [&] {
      block.sheets = static_cast<int>(in_block.size());
      if (in_block.empty()) return;
      const auto& rejections = batch->reject(block);
      for (std::size_t i = 0; i < in_block.size(); ++i) {
        const std::uint64_t draw = in_block[i];
        const bool accepts = rejections[i].fault == solver::Fault::none &&
                             full_path_[draw].deploys_from_sample >= threshold;
        ++report_.decisions;
        if (accepts == (expected_[draw].deploys_from_sample >= threshold)) continue;
        ++report_.decisions_differ;
        note(draw);
      }
      block.shifts_mm.clear();
      in_block.clear();
    };
    constexpr std::size_t kBlock = 4096;
    for (std::uint64_t draw = 0; draw < expected_.size(); ++draw) {
      if (!is_chosen(expected_[draw])) continue;
      in_block.push_back(draw);
      block.shifts_mm.resize(in_block.size() * 2 * model.shifted().size());
      draw_shifts(campaign_.misalignment, campaign_.seed, draw,
                  block.shifts_mm.data() + block.shifts_mm.size() - 2 * model.shifted().size());
      if (in_block.size() == kBlock) flush();
    }
    flush();
  }

  void note(std::uint64_t draw) {
    if (report_.differing_draws.size() < 20) report_.differing_draws.push_back(draw);
  }

  const schema::Campaign& campaign_;
  const solver::InstructionSet set_;
  AgreementReport report_;
  std::vector<solver::Verdict> expected_, full_path_;
};

SpeedReport measure_speed(const schema::Campaign& campaign, double seconds) {
  constexpr int kRounds = 3;
  SpeedReport report;
  std::vector<std::unique_ptr<LaneRun>> runs;
  const auto sets = solver::available_instruction_sets();
  for (const auto set : sets) runs.push_back(std::make_unique<LaneRun>(campaign, set));
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
  }
  report.reference.draws = expected.size();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    SolverSpeed speed = runs[i]->speed();
    for (std::uint64_t draw = 0; draw < std::min(speed.draws, report.reference.draws); ++draw) {
      if (runs[i]->accepted(draw) != runs[i]->wants(expected[draw])) ++speed.disagreements;
    }
    report.lanes.emplace_back(sets[i], speed);
  }
  return report;
}

// Runs what the options ask for and prints it; false if anything disagreed.
bool bench(const BenchCall& call) {
  const schema::Campaign campaign = call.campaign_path.empty()
                                        ? schema::default_campaign()
                                        : schema::read_campaign_file(call.campaign_path);
  if (call.agree_draws) {
    const AgreementReport report =
        Comparison(campaign, solver::available_instruction_sets().back()).run(*call.agree_draws);
    call.json ? put_json(report_json(report)) : print_agreement(report);
    return report.verdicts_differ + report.decisions_differ + report.undecided == 0;
  }
  const SpeedReport report = measure_speed(campaign, call.seconds);
  call.json ? put_json(report_json(report)) : print_speed(report);
  return std::all_of(report.lanes.begin(), report.lanes.end(),
                     [](const auto& lane) { return lane.second.disagreements == 0; });
}

}  // namespace

Action bench_verb(CLI::App& verb) {
  verb.description("speed, and agreement with the reference solver");
  verb.footer(
      "Examples:\n  misalign bench\n"
      "  misalign bench search/campaigns/ring-6x6.json --agree 2000 --json");
  auto call = std::make_shared<BenchCall>();
  verb.add_option("CAMPAIGN", call->campaign_path, "campaign file [the default campaign]");
  verb.add_option("--seconds", call->seconds, "how long to run each solver, seconds [3]")
      ->check(within(0.01, 1e6))
      ->type_name("SECONDS");
  verb.add_option(
          "--agree", call->agree_draws,
          "instead of speed: compare the verdicts of N draws with the reference's, at thresholds "
          "every 10 degrees, at the draw's own D and one sample above")
      ->check(counted(1, 100000000))
      ->type_name("N");
  verb.add_flag("--json", call->json, "as JSON");
  return [call] { return bench(*call) ? 0 : schema::kExitCheckFailed; };
}

}  // namespace misalign::search
