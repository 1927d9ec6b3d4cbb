#include "search/sheets/backlash.hpp"

#include <algorithm>
#include <cmath>

#include "search/draws/draw.hpp"
#include "search/sheets/copy_stops.hpp"
#include "search/sheets/on_threads.hpp"

namespace misalign::search {
namespace {

using solver::BacklashTrial;

// The number of bisections: each halves the logarithm of the interval of radii.
int radii_tried(double least_mm, double most_mm) {
  return std::max(0, static_cast<int>(std::ceil(
                         std::log2(std::log(most_mm / least_mm) / std::log(kRadiusRatio)))));
}

// All trials of one sheet, on some threads.
class Trials {
 public:
  Trials(const solver::Model& model, const solver::BacklashStart& sheet,
         const solver::BacklashOptions& judge_options, std::uint64_t seed,
         const BacklashStudyOptions& options, CopiesDone& copies)
      : model_(model), seed_(seed), options_(options), copies_(copies) {
    const std::uint64_t most = std::min<std::uint64_t>(std::max(options.jobs, 1), options.trials);
    for (std::uint64_t k = 0; k < most; ++k) {
      followers_.push_back(std::make_unique<solver::BacklashFollower>(model, sheet, judge_options));
    }
  }

  std::vector<BacklashTrial> all(double backlash_mm) {
    run(backlash_mm, false, options_.trials);
    return trials_;
  }
  // The number of monotone trials; where it is below `wanted`, some number below that.
  std::uint64_t one_way(double backlash_mm, std::uint64_t wanted) {
    run(backlash_mm, true, options_.trials - wanted);
    return options_.trials - misses_;
  }

 private:
  // Ends early once more than `most_misses` trials are not monotone.
  void run(double backlash_mm, bool only_whether, std::uint64_t most_misses) {
    trials_.assign(options_.trials, {});
    misses_ = 0;
    const double scale = backlash_mm / model_.mechanism().panel_width_mm;
    const std::uint64_t done_before = copies_.done;
    on_threads(
        followers_.size(), options_.trials,
        [&](std::size_t thread) {
          return [&, thread](std::size_t k) {
            return followers_[thread]->trial(trial_offsets(model_.mechanism(), seed_, k), scale,
                                             only_whether);
          };
        },
        [&](std::size_t k, const BacklashTrial& trial) {
          trials_[k] = trial;
          if (!trial.moves_one_way()) ++misses_;
          ++copies_.done;
          if (options_.progress) options_.progress(copies_);
          return misses_ <= most_misses;
        });
    copies_.done = done_before + options_.trials;  // what was not worth judging is done, too
    if (options_.progress) options_.progress(copies_);
  }

  const solver::Model& model_;
  const std::uint64_t seed_;
  const BacklashStudyOptions& options_;
  std::vector<std::unique_ptr<solver::BacklashFollower>> followers_;  // one for each thread
  std::vector<BacklashTrial> trials_;
  std::uint64_t misses_ = 0;
  CopiesDone& copies_;
};

// Bisects between a backlash that is taken for good and one that is not, whatever backlash was
// requested: so the answer is the same.
void find_largest(Trials& trials, std::uint64_t all, solver::Backlash& backlash) {
  const auto wanted =
      static_cast<std::uint64_t>(std::ceil(solver::kWantedShare * static_cast<double>(all)));
  double good_mm = backlash.least_mm, bad_mm = backlash.most_mm;
  bool any_good = false, any_bad = false;
  for (int k = radii_tried(good_mm, bad_mm); k > 0; --k) {
    const double between_mm = std::sqrt(good_mm * bad_mm);
    const std::uint64_t one_way = trials.one_way(between_mm, wanted);
    if (one_way >= wanted) {
      good_mm = between_mm;
      backlash.with_largest = one_way;
      any_good = true;
    } else {
      bad_mm = between_mm;
      any_bad = true;
    }
  }
  backlash.largest_mm = !any_bad ? backlash.most_mm : any_good ? good_mm : 0;
}

}  // namespace

solver::Vec3<double> point_in_ball(std::uint64_t seed, std::uint64_t trial, std::uint32_t k) {
  for (std::uint32_t block = 64 * k;; ++block) {
    const auto words = philox_block(seed, trial, block, kBacklashStream);
    const solver::Vec3<double> point = {uniform_share(words[0]), uniform_share(words[1]),
                                        uniform_share(words[2])};
    if (dot(point, point) <= 1) return point;
  }
}

solver::JointOffsets trial_offsets(const solver::Mechanism& mechanism, std::uint64_t seed,
                                   std::uint64_t trial) {
  solver::JointOffsets offsets;
  std::uint32_t k = 0;
  for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
    offsets.creases_a.push_back(point_in_ball(seed, trial, k++));
    offsets.creases_b.push_back(point_in_ball(seed, trial, k++));
  }
  for (std::size_t i = 0; i < mechanism.balls.size(); ++i) {
    offsets.balls.push_back(point_in_ball(seed, trial, k++));
  }
  return offsets;
}

BacklashStudy::BacklashStudy(const schema::Campaign& campaign,
                             const std::vector<Eigen::Matrix2Xd>& shifts_mm,
                             const solver::BacklashOptions& options,
                             const std::optional<solver::Fill>& fill)
    : model_(campaign.pattern.base, campaign.path(), campaign.criterion()),
      seed_(campaign.seed),
      options_(options) {
  solver::SheetSolver solver(model_);
  for (const Eigen::Matrix2Xd& shifts : shifts_mm) {
    sheets_.push_back(solver::prepare_backlash(
        model_, campaign.pattern.base.sheet.vertices_mm + shifts, options));
    if (!fill) continue;
    const solver::Sheet sheet(solver, shifts);
    const auto filling = filling_made_for(sheet, *fill);
    if (!filling) continue;
    const auto stop = solver::stop_of(sheet.history(), *filling, sheets_.back().to_deg, 0);
    if (stop && stop->at_deg > 0) sheets_.back().filling = filling;
  }
}

double BacklashStudy::most_mm(std::size_t sheet) const {
  return kMostBacklash_creases * sheets_[sheet].shortest_crease_widths *
         model_.mechanism().panel_width_mm;
}

std::vector<solver::Backlash> BacklashStudy::run(const BacklashStudyOptions& options) const {
  const double width_mm = model_.mechanism().panel_width_mm;
  const double least_mm = kLeastBacklash_widths * width_mm;
  CopiesDone copies{0, 0};
  for (std::size_t k = 0; k < sheets_.size(); ++k) {
    copies.all +=
        options.trials * (1 + static_cast<std::uint64_t>(radii_tried(least_mm, most_mm(k))));
  }
  std::vector<solver::Backlash> answers;
  for (std::size_t k = 0; k < sheets_.size(); ++k) {
    Trials trials(model_, sheets_[k], options_, seed_, options, copies);
    answers.push_back({options.backlash_mm, options_.from_deg, sheets_[k].to_deg,
                       sheets_[k].own_deg, trials.all(options.backlash_mm), width_mm, 0, least_mm,
                       most_mm(k), 0});
    find_largest(trials, options.trials, answers.back());
  }
  return answers;
}

}  // namespace misalign::search
