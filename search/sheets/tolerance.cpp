#include "search/sheets/tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/campaign/share_interval.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "search/draws/draw.hpp"
#include "search/sheets/on_threads.hpp"
#include "search/sheets/studies.hpp"
#include "search/terminal/long_work.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {
namespace {

constexpr std::uint64_t kCopiesAtOnce = 256;  // full lanes, and pieces for every core

// Copies of one sheet that are judged together.
struct CopyRange {
  std::size_t sheet;
  int vertex;  // with an error; all of them if negative
  std::uint64_t first, count;
};

// The state that threads share. A sheet is the base with shifts, a copy has errors as well.
class Study {
 public:
  Study(const schema::Campaign& campaign, const std::vector<Eigen::Matrix2Xd>& shifts_mm,
        const ToleranceOptions& options)
      : campaign_(campaign),
        shifts_mm_(shifts_mm),
        options_(options),
        model_(campaign.pattern.base, solver::all_vertices(campaign.pattern.base.sheet),
               campaign.path(), campaign.threshold_sample(), campaign.criterion()),
        stops_(campaign, model_, options.filled) {
    const int vertices = model_.mechanism().vertices;
    for (std::size_t sheet = 0; sheet < shifts_mm.size(); ++sheet) {
      tolerances_.push_back({options.amplitude_mm,
                             campaign.sample_deg,
                             campaign.threshold_deg,
                             campaign.threshold_sample(),
                             0,
                             {},
                             {},
                             0,
                             0,
                             false,
                             {}});
      add_ranges(sheet, -1, options.trials);
      if (!options.vertices) continue;
      for (int v = 0; v < vertices; ++v) {
        tolerances_.back().vertices.push_back({v, {}});
        add_ranges(sheet, v, std::min(options.trials, kMostTrialsOfOneVertex));
      }
    }
  }

  std::vector<solver::Tolerance> run() {
    judge_the_sheets();
    find_own_stops();
    on_threads(
        static_cast<std::size_t>(std::max(options_.jobs, 1)), ranges_.size(),
        [&](std::size_t) {
          return [this, bench = std::make_shared<Bench>(*this)](std::size_t k) {
            return try_copies(ranges_[k], *bench);
          };
        },
        [&](std::size_t k, const solver::MiscutCopies& copies) {
          add(ranges_[k], copies);
          return true;
        });
    for (solver::Tolerance& tolerance : tolerances_) sort_by_harm(tolerance);
    return std::move(tolerances_);
  }

 private:
  void add_ranges(std::size_t sheet, int vertex, std::uint64_t trials) {
    for (std::uint64_t first = 0; first < trials; first += kCopiesAtOnce) {
      ranges_.push_back({sheet, vertex, first, std::min(kCopiesAtOnce, trials - first)});
    }
    copies_.all += trials;
  }

  std::unique_ptr<solver::Batch> batch() const { return solver::make_batch(options_.set, model_); }

  // The workspace of a thread.
  struct Bench {
    explicit Bench(const Study& study) : batch(study.batch()), solver(study.model_) {}

    std::unique_ptr<solver::Batch> batch;
    solver::SheetSolver solver;
  };

  void judge_the_sheets() {
    const auto own_batch = batch();
    for (std::size_t first = 0; first < shifts_mm_.size(); first += kCopiesAtOnce) {
      solver::ShiftBlock block;
      const std::size_t last = std::min(first + kCopiesAtOnce, shifts_mm_.size());
      block.sheets = static_cast<int>(last - first);
      for (std::size_t k = first; k < last; ++k) append(shifts_mm_[k], block);
      const auto& verdicts = own_batch->judge(block);
      for (std::size_t k = first; k < last; ++k) {
        tolerances_[k].own_sample = verdicts[k - first].deploys_from_sample;
      }
    }
  }

  void find_own_stops() {
    if (options_.trials == 0) return;
    solver::SheetSolver solver(model_);
    for (std::size_t k = 0; k < shifts_mm_.size(); ++k) {
      stops_.add(solver, shifts_mm_[k], tolerances_[k]);
    }
  }

  static void append(const Eigen::Matrix2Xd& shifts_mm, solver::ShiftBlock& block) {
    block.shifts_mm.insert(block.shifts_mm.end(), shifts_mm.data(),
                           shifts_mm.data() + shifts_mm.size());
  }

  void add(const CopyRange& range, const solver::MiscutCopies& copies) {
    solver::Tolerance& tolerance = tolerances_[range.sheet];
    (range.vertex < 0 ? tolerance.copies
                      : tolerance.vertices[static_cast<std::size_t>(range.vertex)].copies)
        .add(copies);
    copies_.done += copies.trials;
    if (options_.progress) options_.progress(copies_);
  }

  solver::MiscutCopies try_copies(const CopyRange& range, Bench& bench) const {
    const Eigen::Matrix2Xd& shifts_mm = shifts_mm_[range.sheet];
    Eigen::Matrix2Xd errors_mm(2, shifts_mm.cols());
    solver::ShiftBlock block;
    block.sheets = static_cast<int>(range.count);
    for (std::uint64_t trial = range.first; trial < range.first + range.count; ++trial) {
      trial_errors(campaign_, options_.amplitude_mm, trial, errors_mm.data());
      if (range.vertex >= 0) {
        const Eigen::Vector2d kept_mm = errors_mm.col(range.vertex);
        errors_mm.setZero();
        errors_mm.col(range.vertex) = kept_mm;
      }
      append(shifts_mm + errors_mm, block);
    }
    solver::MiscutCopies copies;
    for (const solver::Verdict& verdict : bench.batch->judge(block)) {
      copies.add(verdict);
    }
    if (range.vertex < 0 && stops_.has_some(range.sheet)) {
      copies.stops =
          stops_.of(range.sheet, block, bench.batch->record_lengths(block), bench.solver);
    }
    return copies;
  }

  static void sort_by_harm(solver::Tolerance& tolerance) {
    const auto harm = [&](const solver::Tolerance::Vertex& vertex) {
      const std::uint64_t survivors = vertex.copies.from(tolerance.threshold_sample);
      return std::pair(
          -schema::share_of(survivors, vertex.copies.undecided, vertex.copies.trials).share,
          tolerance.mean_loss_deg(vertex.copies));
    };
    std::stable_sort(tolerance.vertices.begin(), tolerance.vertices.end(),
                     [&](const auto& a, const auto& b) { return harm(a) > harm(b); });
  }

  const schema::Campaign& campaign_;
  const std::vector<Eigen::Matrix2Xd>& shifts_mm_;
  const ToleranceOptions& options_;
  const solver::Model model_;
  std::vector<CopyRange> ranges_;
  std::vector<solver::Tolerance> tolerances_;
  CopyStops stops_;
  CopiesDone copies_{0, 0};
};

}  // namespace

void show_copies(const CopiesDone& copies) { show_work("copies judged", copies.done, copies.all); }

void check_miscut(double amplitude_mm, const solver::CreasePattern& base,
                  const Eigen::Matrix2Xd& shifts_mm, const std::string& sheet) {
  const double largest_mm = solver::largest_miscut_mm(base, shifts_mm);
  if (amplitude_mm < largest_mm) return;
  const double below_mm = schema::rounded_down(largest_mm);
  throw schema::UserError(solver::OptionFault{
      "amplitude_mm", schema::shown_number(amplitude_mm),
      fmt::format("must be below {:g} mm (where a facet of {} can lose convexity)", below_mm,
                  sheet),
      fmt::format("try {:g}", schema::rounded_down(0.95 * below_mm))});
}

void trial_errors(const schema::Campaign& campaign, double amplitude_mm, std::uint64_t trial,
                  double* errors_mm) {
  const schema::Misalignment errors{solver::all_vertices(campaign.pattern.base.sheet), amplitude_mm,
                                    schema::ShiftDistribution::uniform};
  draw_shifts(errors, campaign.seed, trial, errors_mm, kToleranceStream);
}

std::vector<solver::Tolerance> study_tolerance(const schema::Campaign& campaign,
                                               const std::vector<Eigen::Matrix2Xd>& shifts_mm,
                                               const ToleranceOptions& options) {
  if (options.trials > 0 && schema::is_overconstrained(campaign.pattern.base)) {
    throw study_error(solver::NoResult::overconstrained, "the sheet",
                      "no miscut copy folds and none can be counted",
                      "`misalign tolerance` of one sheet gives its joint gaps");
  }
  return Study(campaign, shifts_mm, options).run();
}

// Copies are judged at samples: the angle of use must be one.
static void check_is_sample(double from_deg, double sample_deg) {
  constexpr double kMultipleTolerance = 1e-9;  // as campaign files have it
  const double samples = from_deg / sample_deg;
  if (std::abs(samples - std::round(samples)) <= kMultipleTolerance * std::max(1.0, samples))
    return;
  throw schema::UserError(solver::OptionFault{
      "from_deg", schema::shown_number(from_deg),
      fmt::format("must be a whole multiple of sample_deg = {} (copies are judged at samples)",
                  schema::shown_number(sample_deg)),
      "try " + schema::shown_number(std::max(1.0, std::round(samples)) * sample_deg)});
}

schema::Campaign used_from(const schema::Campaign& campaign, double from_deg,
                           const std::vector<Eigen::Matrix2Xd>& shifts_mm,
                           const ToleranceOptions& options,
                           const std::function<std::string(std::size_t)>& name_of) {
  check_is_sample(from_deg, campaign.sample_deg);
  ToleranceOptions alone = options;
  alone.trials = 0;
  alone.vertices = false;
  alone.progress = nullptr;
  schema::Campaign used = campaign;
  used.threshold_deg = from_deg;
  const auto themselves = study_tolerance(used, shifts_mm, alone);
  for (std::size_t k = 0; k < themselves.size(); ++k) {
    if (themselves[k].own_sample >= used.threshold_sample()) continue;
    throw schema::UserError(solver::beyond_d_fault(name_of(k), from_deg,
                                                   themselves[k].own_sample * campaign.sample_deg));
  }
  return used;
}

solver::Tolerance study_sheet(const ChosenSheet& sheet, std::optional<double> from_deg,
                              const ToleranceOptions& options) {
  const std::vector<Eigen::Matrix2Xd> shifts_mm = {sheet.shifts_mm};
  schema::Campaign campaign = sheet.as_campaign();
  if (!from_deg) {
    ToleranceOptions alone = options;
    alone.trials = 0;
    from_deg = study_tolerance(campaign, shifts_mm, alone).front().own_sample * campaign.sample_deg;
    if (*from_deg <= 0) throw schema::UserError(solver::beyond_d_fault(sheet.name(), 0, 0));
  }
  campaign =
      used_from(campaign, *from_deg, shifts_mm, options, [&](std::size_t) { return sheet.name(); });
  return study_tolerance(campaign, shifts_mm, options).front();
}

}  // namespace misalign::search
