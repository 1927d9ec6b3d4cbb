#include "search/sheets/optimised_draw.hpp"

#include <cassert>
#include <optional>

#include "schema/campaign/campaign_file.hpp"
#include "schema/exchange/optimise_json.hpp"
#include "schema/files/hash.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "search/sheets/better_sheet.hpp"
#include "solver/optimise/ascent.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::search {
namespace {

class OptimisedDraw final : public DrawAscent {
 public:
  // `asked` and `model` must outlive this object.
  OptimisedDraw(const solver::OptimiseOptions& asked, const solver::Model& model,
                schema::Candidate start);

  bool finished() const override { return !ascent_ || ascent_->finished(); }
  void advance() override { ascent_->advance(); }
  schema::Candidate take() override;

 private:
  schema::Candidate candidate_;
  solver::SheetSolver solver_;
  const solver::Sheet start_;
  std::optional<solver::Ascent> ascent_;  // none where the draw stays as it is
};

OptimisedDraw::OptimisedDraw(const solver::OptimiseOptions& asked, const solver::Model& model,
                             schema::Candidate start)
    : candidate_(std::move(start)),
      solver_(model),
      start_(solver_, candidate_.shifts_mm.unaryExpr([&](double shift_mm) {
        return solver::on_grid(shift_mm, asked.grid_mm);  // a multiple by another product
      })) {
  candidate_.shifts_mm = start_.shifts_mm();
  auto fitted = solver::fitted_start(start_, asked);
  if (fitted.study) {
    ascent_.emplace(start_, *std::move(fitted.study));
    return;
  }
  const bool breaks_a_limit = fitted.fault && fitted.fault->name != "goal";
  candidate_.ascent.emplace().ended = breaks_a_limit ? "breaks_a_limit" : "has_no_value";
}

schema::Candidate OptimisedDraw::take() {
  assert(finished());
  if (ascent_) {
    const solver::Optimised found = ascent_->take();
    candidate_.shifts_mm = found.best().shifts_mm;
    schema::AscentRecord& ascent = candidate_.ascent.emplace();
    ascent.start_value = found.start().value;
    ascent.end_value = found.best().value;
    ascent.steps = found.steps();
    ascent.sheets_folded = found.evaluations;
    ascent.ended = schema::name_of(found.stop_reason);
    if (found.limits) {
      ascent.limited_by =
          schema::limits_json(start_.mechanism(), found.options, *found.limits).dump();
    }
  }
  const solver::Sheet& end = ascent_ ? ascent_->reached() : start_;
  candidate_.metrics =
      solver::measure(end.base(), end.vertices_mm(), end.record(), end.model().sample_deg());
  return std::move(candidate_);
}

// The ends of four draws of a small sheet, by each goal of campaigns.
std::string golden_ends() {
  std::string ends;
  for (const std::string& goal : solver::goal_names(&solver::Goal::is_same_everywhere)) {
    DrawEvaluator evaluator(schema::read_campaign(
        {{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
         {"accept", {{"deploys_from_deg", 150}}},
         {"search", {{"method", "optimise"}, {"maximise", goal}, {"from_deg", 36}}}},
        "the golden campaign"));
    optimise_if_asked(evaluator);
    for (const schema::Candidate& end : work_off(evaluator, {0, 4}).candidates) {
      ends += schema::displacements_json(end.shifts_mm).dump();
    }
  }
  return schema::hex(schema::hash_of(ends));
}

}  // namespace

std::string fingerprint(const schema::Campaign& campaign, const std::string& golden_verdicts) {
  return campaign.search.optimisation ? golden_verdicts + "-" + golden_ends() : golden_verdicts;
}

solver::OptimiseOptions asked_of_ends(const schema::Campaign& campaign) {
  const schema::Optimisation& search = *campaign.search.optimisation;
  const schema::Misalignment& draws = campaign.misalignment;
  solver::OptimiseOptions asked = options_of(search);
  // Where nothing is asked of it any angle does at which all of them are on their way.
  asked.deploying.from_deg = search.from_deg.value_or(campaign.threshold_deg / 2);
  asked.deploying.sheet.springs.stiffness_n_per_mm = search.stiffness_n_per_mm;
  asked.deploying.sheet.springs.preload.each_n = search.preload_n;
  asked.shifted = draws.vertices;
  asked.amplitude_mm = draws.amplitude_mm;
  asked.deploys_from_sample = campaign.threshold_sample();
  if (draws.parallel) {
    asked.shifted = draws.parallel->family->vertices();
    asked.moves = draws.parallel->family->basis();
  }
  return asked;
}

void optimise_if_asked(DrawEvaluator& evaluator) {
  if (!evaluator.campaign().search.optimisation) return;
  evaluator.ascend_with([asked = asked_of_ends(evaluator.campaign()),
                         &model = evaluator.model()](schema::Candidate start) {
    return std::make_unique<OptimisedDraw>(asked, model, std::move(start));
  });
}

void optimise_if_asked(Climber& climber) {
  if (!climber.campaign().search.optimisation) return;
  climber.ascend_with([asked = asked_of_ends(climber.campaign()),
                       &scorers = climber.scorers()](schema::Candidate start) {
    return std::make_unique<OptimisedDraw>(asked, scorers.model(), std::move(start));
  });
}

}  // namespace misalign::search
