#include "solver/fitting/cut_outs.hpp"

#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

// Lengths of the diagonals, and their rates by pilot^2, in steps of a degree and at the angle of
// use.
struct Places {
  std::vector<double> pilot_deg;
  Eigen::MatrixXd lengths_mm, rates_mm;  // a column each
};

Places places_on(const FoldingWay& way, double from_deg, double to_deg) {
  Places places;
  for (double deg = to_deg; deg < from_deg; ++deg) places.pilot_deg.push_back(deg);
  places.pilot_deg.push_back(from_deg);
  const Index diagonals = way.flat_mm().size();
  places.lengths_mm.resize(diagonals, std::ssize(places.pilot_deg));
  places.rates_mm = places.lengths_mm;
  Eigen::VectorXd lengths_mm, rates;
  for (Index k = 0; k < places.lengths_mm.cols(); ++k) {
    const double deg = places.pilot_deg[static_cast<std::size_t>(k)], x = way.x_of(deg);
    way.find_lengths(x, lengths_mm, rates);
    places.lengths_mm.col(k) = lengths_mm;
    places.rates_mm.col(k) = rates / (way.pilot_rate(x) * 2 * deg * kRadPerDeg);
  }
  return places;
}

// dE / d(pilot^2) of one hole at the places.
ArrayXd drive_of(const Filling& filling, Index hole, const Places& places) {
  ArrayXd drive(places.lengths_mm.cols());
  for (Index k = 0; k < drive.size(); ++k) {
    const Eigen::Vector2d lengths_mm = places.lengths_mm.col(k).segment<2>(2 * hole);
    drive(k) =
        filling.hole(hole, lengths_mm).force_n.dot(places.rates_mm.col(k).segment<2>(2 * hole));
  }
  return drive;
}

// Cut-outs of all holes, and the drive of each.
class Choice {
 public:
  Choice(const FoldingWay& way, const CutOutOptions& options)
      : way_(way), options_(options), places_(places_on(way, options.from_deg, options.to_deg)) {
    const std::vector<Ratios> all = ratios_in_steps();
    const Index holes = way.flat_mm().size() / 2;
    std::vector<std::vector<Ratios>> starts;
    for (const Ratios& ratios : all) {
      if (ratios[0] == ratios[1]) starts.emplace_back(holes, ratios);
    }
    starts.push_back(weighted_start(all, holes));
    for (const std::vector<Ratios>& start : starts) {
      Choice other(*this, start);
      other.ascend();
      if (drives_.empty() || other.least() > least()) {
        ratios_ = other.ratios_, drives_ = other.drives_, rounds_ = other.rounds_;
      }
    }
  }

  CutOutChoice chosen() const {
    CutOutChoice choice{plates(), 0, 0, rounds_};
    Index at = 0;
    choice.least_n_mm_per_rad2 = sum().minCoeff(&at);
    choice.at_deg = places_.pilot_deg[static_cast<std::size_t>(at)];
    return choice;
  }

 private:
  using Ratios = std::array<double, 2>;

  Choice(const Choice& shared, const std::vector<Ratios>& start)
      : way_(shared.way_), options_(shared.options_), places_(shared.places_), ratios_(start) {
    for (Index h = 0; h < std::ssize(ratios_); ++h) {
      drives_.push_back(drive_with(h, ratios_[static_cast<std::size_t>(h)]));
    }
  }

  std::vector<Ratios> ratios_in_steps() const {
    const auto steps = static_cast<int>(
        std::floor((options_.most - options_.least) / options_.coarse_step + 1e-9));
    std::vector<Ratios> all;
    for (int i = 0; i <= steps; ++i) {
      for (int k = 0; k <= steps; ++k) {
        all.push_back(
            {options_.most - i * options_.coarse_step, options_.most - k * options_.coarse_step});
      }
    }
    return all;
  }

  // The best of the choices that maximise weighted sums of the drive over the way, each hole by
  // itself, where the weights of places with little drive grow exponentially (Freund & Schapire,
  // Games and Economic Behavior 29, 1999, 79).
  std::vector<Ratios> weighted_start(const std::vector<Ratios>& all, Index holes) const {
    constexpr int kTurns = 200;
    constexpr double kRate = 0.2;         // about sqrt(log(places) / turns)
    std::vector<Eigen::ArrayXXd> tables;  // places x ratios
    for (Index h = 0; h < holes; ++h) {
      Eigen::ArrayXXd& table = tables.emplace_back(std::ssize(places_.pilot_deg), std::ssize(all));
      for (std::size_t i = 0; i < all.size(); ++i) {
        table.col(static_cast<Index>(i)) = drive_with(h, all[i]);
      }
    }
    std::vector<Ratios> best;
    double best_least = 0;
    ArrayXd total = ArrayXd::Zero(std::ssize(places_.pilot_deg));
    for (int turn = 0; turn < kTurns; ++turn) {
      const double scale = turn == 0 ? 1 : total.abs().maxCoeff() / turn;
      const ArrayXd weights = (-kRate / scale * (total - total.minCoeff())).exp();
      std::vector<Ratios> picked;
      ArrayXd drive = ArrayXd::Zero(total.size());
      for (const Eigen::ArrayXXd& table : tables) {
        Index at = 0;
        (weights.matrix().transpose() * table.matrix()).maxCoeff(&at);
        picked.push_back(all[static_cast<std::size_t>(at)]);
        drive += table.col(at);
      }
      if (best.empty() || drive.minCoeff() > best_least) {
        best = picked, best_least = drive.minCoeff();
      }
      total += drive;
    }
    return best;
  }

  RubberPlates plates() const {
    RubberPlates plates = options_.plates;
    plates.prestretch = 1;
    plates.cut_outs.clear();
    for (std::size_t h = 0; h < ratios_.size(); ++h) {
      plates.cut_outs.push_back({static_cast<int>(h), ratios_[h]});
    }
    return plates;
  }

  ArrayXd drive_with(Index hole, const Ratios& ratios) const {
    RubberPlates plates = options_.plates;
    plates.cut_outs = {{static_cast<int>(hole), ratios}};
    return drive_of(filling_on(way_, plates), hole, places_);
  }
  ArrayXd sum() const {
    ArrayXd sum = ArrayXd::Zero(std::ssize(places_.pilot_deg));
    for (const ArrayXd& drive : drives_) sum += drive;
    return sum;
  }
  double least() const { return sum().minCoeff(); }

  void ascend() {
    for (const double step : {options_.coarse_step, options_.fine_step}) {
      while (pass(step)) ++rounds_;
    }
  }

  // Every hole takes the best of its cut-outs one step to either side, the others kept.
  bool pass(double step) {
    constexpr double kBetter = 1e-6;  // of the least
    bool is_better = false;
    for (Index h = 0; h < std::ssize(ratios_); ++h) {
      const auto hole = static_cast<std::size_t>(h);
      const ArrayXd others = sum() - drives_[hole];
      double best = least();
      const Ratios base = ratios_[hole];
      for (int i = 0; i < 9; ++i) {
        const int column = i % 3 - 1, row = i / 3 - 1;
        const Ratios tried = {base[0] + column * step, base[1] + row * step};
        const auto [low, high] = std::minmax(tried[0], tried[1]);
        if (i == 4 || low < options_.least - 1e-9 || high > options_.most + 1e-9) continue;
        const ArrayXd drive = drive_with(h, tried);
        const double value = (others + drive).minCoeff();
        if (value <= best + kBetter * std::abs(best)) continue;
        best = value, ratios_[hole] = tried, drives_[hole] = drive, is_better = true;
      }
    }
    return is_better;
  }

  const FoldingWay& way_;
  const CutOutOptions& options_;
  const Places places_;
  std::vector<Ratios> ratios_;
  std::vector<ArrayXd> drives_;
  int rounds_ = 0;
};

}  // namespace

StudyResult<CutOutChoice> choose_cut_outs(const Sheet& sheet, const CutOutOptions& options) {
  assert(options.least > 0 && options.least <= options.most && options.fine_step > 0);
  const FoldingWay* const way = sheet.way();
  if (!way) return NoResult::path_lost;
  if (options.from_deg > way->end_deg()) {
    return OptionFault{"from_deg", shown("%.10g", options.from_deg),
                       "lies beyond " + shown("%.10g", way->end_deg()) +
                           " deg, where the path of " + sheet.name() + " ends",
                       "name a smaller angle"};
  }
  return Choice(*way, options).chosen();
}

LeastDrive least_drive(const FoldingWay& way, const Fill& fill, double from_deg, double to_deg) {
  const Places places = places_on(way, from_deg, to_deg);
  const Filling filling = filling_on(way, fill);
  ArrayXd sum = ArrayXd::Zero(std::ssize(places.pilot_deg));
  for (Index h = 0; h < filling.holes(); ++h) sum += drive_of(filling, h, places);
  Index at = 0;
  const double least = sum.minCoeff(&at);
  return {least, places.pilot_deg[static_cast<std::size_t>(at)]};
}

}  // namespace misalign::solver
