#include "search/sheets/shaped_draw.hpp"

#include <cassert>
#include <cmath>
#include <optional>

#include "schema/pattern/target.hpp"
#include "search/draws/random_words.hpp"
#include "solver/shape/shape.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::search {
namespace {

class ShapedDraw final : public DrawAscent {
 public:
  // Both must outlive this object.
  ShapedDraw(const schema::Campaign& campaign, const solver::Model& model, schema::Candidate start)
      : campaign_(campaign),
        solver_(model),
        measure_(
            solver::ShapeMeasure::of(solver_, campaign.target->shape, *campaign.target->at_deg)),
        candidate_(std::move(start)) {}

  bool finished() const override { return verdict_.has_value(); }
  void advance() override;
  std::optional<solver::Verdict> verdict() const override { return verdict_; }
  schema::Candidate take() override { return std::move(candidate_); }

 private:
  std::optional<solver::ShapeMisfit> misfit_of(const solver::Sheet& sheet) const {
    return measure_ ? measure_->fitted(sheet) : std::nullopt;
  }

  const schema::Campaign& campaign_;
  solver::SheetSolver solver_;
  const std::optional<solver::ShapeMeasure> measure_;
  schema::Candidate candidate_;
  std::optional<solver::Verdict> verdict_;
};

void ShapedDraw::advance() {
  const solver::ShapeOptions options =
      shape_options_of(campaign_, solver_.model().mechanism().diagonals.size(), candidate_.draw,
                       candidate_.shifts_mm);
  const solver::Sheet start(solver_, candidate_.shifts_mm);
  const auto found = solver::shape(solver_, options);
  if (!found) {
    verdict_ = verdict_on_shape(campaign_, start.verdict(), {});
    return;
  }
  const solver::Sheet end(solver_, found->shifts_mm);
  const auto off = misfit_of(end);
  verdict_ =
      verdict_on_shape(campaign_, end.verdict(), off ? std::optional(off->max_mm()) : std::nullopt);
  if (!campaign_.accepts(*verdict_)) return;
  candidate_.shifts_mm = found->shifts_mm;
  candidate_.metrics = solver::measure(end.model(), end.vertices_mm(), end.record());
  schema::AscentRecord& ascent = candidate_.ascent.emplace();
  if (const auto off_at_start = misfit_of(start)) ascent.start_value = off_at_start->rms_mm();
  ascent.end_value = off->rms_mm();
  ascent.steps = found->steps;
  ascent.sheets_folded = found->evaluations;
  ascent.ended = "no_step_is_better";
}

}  // namespace

solver::ShapeOptions shape_options_of(const schema::Campaign& campaign, std::size_t diagonals,
                                      std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm) {
  const schema::ShapeSearch& search = *campaign.search.shape;
  const solver::CreasePattern& sheet = campaign.pattern.base.sheet;
  const auto chosen = [&](std::uint32_t word, std::size_t count) {
    return static_cast<std::size_t>(std::uint64_t{word} * count >> 32);
  };
  const auto word = [&](std::uint32_t k) {
    return philox_block(campaign.seed, draw, k / 4, kShapeStream)[k % 4];
  };
  solver::ShapeOptions options;
  options.target = campaign.target->shape;
  options.at_deg = *campaign.target->at_deg;
  options.from_deg = campaign.threshold_deg;
  // A fold limit is pushed to between two samples: at one, rounding would decide.
  options.beyond_deg = (std::floor(1 / campaign.sample_deg) + 0.5) * campaign.sample_deg;
  options.is_rim_fixed = campaign.misalignment.vertices != solver::all_vertices(sheet);
  options.start_mm = shifts_mm;
  if (const auto& weights = search.shift_weights; !weights.empty()) {
    options.shift_weight = weights[chosen(word(0), weights.size())];
  }
  for (std::uint32_t k = 1; k <= search.turned_diagonals; ++k) {
    options.turned.push_back(static_cast<int>(chosen(word(k), diagonals)));
  }
  return options;
}

solver::Verdict verdict_on_shape(const schema::Campaign& campaign, const solver::Verdict& of_path,
                                 std::optional<double> shape_max_mm) {
  if (shape_max_mm && *shape_max_mm <= campaign.search.shape->shape_max_mm) return of_path;
  const auto at = static_cast<int>(std::lround(*campaign.target->at_deg / campaign.sample_deg));
  if (of_path.deploys_from_sample < at) return of_path;
  return {at - 1, solver::Fault::off_shape};
}

std::unique_ptr<DrawAscent> shaped_draw(const schema::Campaign& campaign,
                                        const solver::Model& model, schema::Candidate start) {
  return std::make_unique<ShapedDraw>(campaign, model, std::move(start));
}

}  // namespace misalign::search
