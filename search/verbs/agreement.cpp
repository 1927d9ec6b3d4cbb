#include "search/verbs/agreement.hpp"

#include <algorithm>
#include <set>

#include "search/draws/draw_evaluator.hpp"
#include "search/draws/models.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/reference_run.hpp"

namespace misalign::search {
namespace {

// Collects decisions of the fast path at one threshold after another.
class Comparison {
 public:
  Comparison(const schema::Campaign& campaign, solver::InstructionSet set)
      : campaign_(campaign), set_(set) {}

  AgreementReport run(std::uint64_t draws, Against against) {
    report_.draws = draws;
    judge_all(draws);
    expected_ = full_path_;
    if (against == Against::reference) judge_again(draws);
    std::set<int> thresholds = {model_of(campaign_).threshold_sample()};
    for (double angle_deg = 10; angle_deg <= campaign_.end_deg; angle_deg += 10) {
      thresholds.insert(static_cast<int>(angle_deg / campaign_.sample_deg + 0.5));
    }
    for (const int threshold : thresholds) {
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
    for (std::uint64_t lo = 0; lo < draws; lo += evaluator.largest_block()) {
      const schema::DrawRange block{lo, std::min(draws, lo + evaluator.largest_block())};
      const auto& verdicts = evaluator.judge(block);
      full_path_.insert(full_path_.end(), verdicts.begin(), verdicts.end());
    }
    report_.undecided += static_cast<std::uint64_t>(
        std::ranges::count(full_path_, solver::Fault::undecided, &solver::Verdict::first_fault));
  }

  void judge_again(std::uint64_t draws) {
    const solver::Model model = model_of(campaign_);
    ReferenceRun reference(campaign_, model.mechanism());
    for (std::uint64_t draw = 0; draw < draws; ++draw) {
      solver::Verdict& expected = expected_[draw] = reference.judge(draw);
      const solver::Verdict& found = full_path_[draw];
      if (same(expected, found)) continue;
      for (const double step_deg : kCarefulSteps_deg) {
        expected = judge_carefully(campaign_, model.mechanism(), step_deg, draw);
        if (same(expected, found)) break;
      }
      if (same(expected, found)) {
        ++report_.reference_jumped;
      } else if (expected.first_fault == solver::Fault::undecided) {
        ++report_.reference_lost;
        expected = found;
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

  // The fast path accepts draws that its tests leave and whose full path reaches the threshold.
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

}  // namespace

AgreementReport compare(const schema::Campaign& campaign, solver::InstructionSet set,
                        std::uint64_t draws, Against against) {
  return Comparison(campaign, set).run(draws, against);
}

schema::Json report_json(const AgreementReport& report) {
  return {{"draws", report.draws},
          {"undecided", report.undecided},
          {"verdicts_differ", report.verdicts_differ},
          {"reference_jumped", report.reference_jumped},
          {"reference_lost", report.reference_lost},
          {"decisions", report.decisions},
          {"decisions_differ", report.decisions_differ},
          {"differing_draws", report.differing_draws}};
}

void print_agreement(const AgreementReport& report, Against against) {
  put("{} draws: ", report.draws);
  if (against == Against::reference) {
    put("{} verdicts differ (in {} more the reference was on another branch), ",
        report.verdicts_differ, report.reference_jumped);
  }
  put("{} of {} decisions differ, {} undecided\n", report.decisions_differ, report.decisions,
      report.undecided);
  if (report.reference_lost > 0) {
    put("{} could not be compared: the reference lost their paths\n", report.reference_lost);
  }
  for (const std::uint64_t draw : report.differing_draws) put("  differs: draw {}\n", draw);
}

}  // namespace misalign::search
