#include "search/sheets/optimised_draw.hpp"

#include <cassert>
#include <optional>

#include "schema/exchange/optimise_json.hpp"
#include "search/sheets/better_sheet.hpp"
#include "solver/optimise/ascent.hpp"
#include "solver/optimise/optimise.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::search {
namespace {

class OptimisedDraw final : public DrawAscent {
 public:
  // `model` must outlive this object.
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
  if (fitted) {
    ascent_.emplace(start_, *std::move(fitted));
    return;
  }
  const bool breaks_a_limit = fitted.fault() && fitted.fault()->name != "goal";
  candidate_.ascent.emplace().ended = breaks_a_limit ? "breaks_a_limit" : "has_no_value";
}

schema::Candidate OptimisedDraw::take() {
  assert(finished());
  if (ascent_) {
    const solver::Optimised found = ascent_->release();
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
  candidate_.metrics = solver::measure(end.model(), end.vertices_mm(), end.record());
  return std::move(candidate_);
}

}  // namespace

solver::OptimiseOptions asked_of_ends(const schema::Campaign& campaign) {
  const schema::Optimisation& search = *campaign.search.optimisation;
  const schema::Misalignment& draws = campaign.misalignment;
  solver::OptimiseOptions asked = options_of(search);
  // Any angle that all of them reach will do if none is requested.
  asked.deploying.from_deg = search.from_deg.value_or(campaign.threshold_deg / 2);
  asked.deploying.sheet.springs().stiffness_n_per_mm = search.stiffness_n_per_mm;
  asked.deploying.sheet.springs().preload.each_n = search.preload_n;
  asked.shifted = draws.vertices;
  asked.amplitude_mm = draws.amplitude_mm;
  asked.deploys_from_sample = campaign.threshold_sample();
  if (draws.parallel) {
    asked.shifted = draws.parallel->family->vertices();
    asked.moves = draws.parallel->family->basis();
  }
  return asked;
}

std::unique_ptr<DrawAscent> optimised_draw(const schema::Campaign& campaign,
                                           const solver::Model& model, schema::Candidate start) {
  return std::make_unique<OptimisedDraw>(asked_of_ends(campaign), model, std::move(start));
}

}  // namespace misalign::search
