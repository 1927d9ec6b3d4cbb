// Correlates a candidate's metrics with the share of its slightly miscut copies that still deploy:
// a row of CSV for each of some candidates. results/miscut/ has what came of it.
//   miscut_study CAMPAIGN.json FROM_DEG CANDIDATES COPIES AMPLITUDE_MM
#include <Eigen/SVD>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "schema/campaign/campaign_file.hpp"
#include "schema/exchange/folding_json.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/sheets/tolerance.hpp"
#include "solver/linear/newton.hpp"
#include "solver/model/flat_gradient.hpp"
#include "solver/records/record_sheet.hpp"

namespace misalign::search {
namespace {

using solver::FlatVertices;

constexpr double kFar_mm = 99;  // what nothing can reach

// Gradients along one path on dense factors, in mm per mm.
class PathGradients {
 public:
  PathGradients(const solver::Mechanism& mechanism, const FlatVertices& vertices_mm)
      : mechanism_(mechanism), system_(mechanism), lu_(mechanism.equations), gradient_(mechanism) {
    place(mechanism, vertices_mm, geometry_);
  }

  // Rows: diagonals; columns: x and y of every vertex.
  Eigen::MatrixXd lengths_at(const solver::FoldState<double>& state) {
    look(state);
    const int n = mechanism_.equations;
    Eigen::MatrixXd rows =
        Eigen::MatrixXd::Zero(mechanism_.diagonal_count(), 2 * mechanism_.vertices);
    std::vector<double> rates(mechanism_.unknowns);
    Eigen::VectorXd row(rows.cols());
    for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
      gradient_.of_unknowns(d, rates.data());
      row.setZero();
      gradient_.add_length(d, row.data());
      const Eigen::VectorXd weights =
          -lu_.solve_transposed(Eigen::Map<Eigen::VectorXd>(rates.data(), n));
      gradient_.add_closure(weights.data(), row.data());
      rows.row(d) = row.transpose();
    }
    return rows;
  }

  // Least distance (mm) to |rho| = 180 deg of any crease but the pilot.
  double to_over_folded_mm(const solver::FoldState<double>& state) {
    look(state);
    double least_mm = kFar_mm;
    for (const solver::Crease& crease : mechanism_.creases) {
      if (crease.column >= mechanism_.equations) continue;
      Eigen::VectorXd unit = Eigen::VectorXd::Unit(mechanism_.equations, crease.column),
                      row(2 * mechanism_.vertices);
      row.setZero();
      const Eigen::VectorXd weights = -lu_.solve_transposed(unit);
      gradient_.add_closure(weights.data(), row.data());
      const auto& rho = state.creases[&crease - mechanism_.creases.data()];
      const double left_rad = solver::kPi - std::abs(solver::angle_deg(rho)) * solver::kRadPerDeg;
      least_mm = std::min(least_mm, left_rad / row.norm() * mechanism_.panel_width_mm);
    }
    return least_mm;
  }

  // Gradient of the angle where the pilot turns, rad per panel width, at a state close to it.
  double limit_gradient(const solver::FoldState<double>& state) {
    look(state);
    const int n = mechanism_.equations;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(system_.jacobian().leftCols(n),
                                                Eigen::ComputeFullU);
    const Eigen::VectorXd u = svd.matrixU().col(n - 1);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(2 * mechanism_.vertices);
    gradient_.add_closure(u.data(), row.data());
    return row.norm() / std::abs(u.dot(system_.jacobian().col(n)));
  }

 private:
  void look(const solver::FoldState<double>& state) {
    system_.evaluate(geometry_, state);
    lu_.factorize(system_.jacobian().leftCols(mechanism_.equations));
    gradient_.at(geometry_, state);
  }

  const solver::Mechanism& mechanism_;
  solver::ClosureSystem system_;
  solver::DenseSolve lu_;
  solver::SheetGeometry<double> geometry_;
  solver::FlatGradient<double> gradient_;
};

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

class Study {
 public:
  Study(const schema::Campaign& campaign, std::uint64_t copies, double amplitude_mm)
      : campaign_(campaign),
        copies_(copies),
        amplitude_mm_(amplitude_mm),
        model_(campaign.pattern.base, solver::all_vertices(campaign.pattern.base.sheet),
               campaign.path(), campaign.threshold_sample(), campaign.criterion()),
        batch_(solver::make_batch(solver::available_instruction_sets().back(), model_)) {}

  void row(const schema::Candidate& candidate) {
    std::vector<std::pair<std::string, double>> values;
    const schema::Json metrics = schema::metrics_json(candidate.metrics);
    for (const auto& [name, value] : metrics.items()) {
      values.emplace_back(name, value.is_null() ? NAN : value.get<double>());
    }
    add_margins(candidate.shifts_mm, values);
    add_yield(candidate.shifts_mm, values);
    if (!has_header_) {
      std::printf("campaign,from_deg,amplitude_mm,copies,draw");
      for (const auto& [name, value] : values) std::printf(",%s", name.c_str());
      std::puts("");
      has_header_ = true;
    }
    std::printf("%s,%g,%g,%llu,%llu", campaign_.name.c_str(), campaign_.threshold_deg,
                amplitude_mm_, static_cast<unsigned long long>(copies_),
                static_cast<unsigned long long>(candidate.draw));
    for (const auto& [name, value] : values) {
      std::isnan(value) ? std::printf(",") : std::printf(",%.6g", value);
    }
    std::puts("");
  }

 private:
  using Values = std::vector<std::pair<std::string, double>>;

  // What is no metric: the same margin by other stretches, what other faults leave, and a share
  // that is foretold from all of it.
  void add_margins(const Eigen::Matrix2Xd& shifts_mm, Values& values) {
    const solver::Mechanism& mechanism = model_.mechanism();
    const FlatVertices vertices_mm = model_.base().sheet.vertices_mm + shifts_mm;
    std::vector<solver::FoldState<double>> states;
    const solver::StationVisitor keep_state = [&](const solver::Station&,
                                                  const solver::PathPoint& point) {
      states.push_back(point.state);
    };
    const auto history = solver::record_history(model_, vertices_mm, &keep_state);
    PathGradients gradients(mechanism, vertices_mm);
    const int threshold = campaign_.threshold_sample();
    std::vector<Eigen::MatrixXd> rows;
    std::vector<Eigen::VectorXd> lengths_mm;
    for (int k = 0; k < threshold; ++k) {
      rows.push_back(gradients.lengths_at(states[k]));
      lengths_mm.push_back(history.length_mm.row(k));
    }
    const auto margins = [&](int step) {
      Eigen::VectorXd least = Eigen::VectorXd::Constant(mechanism.diagonal_count(), kFar_mm);
      for (int k = threshold - 1; k - step >= 0; k -= step) {
        const Eigen::VectorXd by = (lengths_mm[k] - lengths_mm[k - step]).cwiseAbs();
        const Eigen::VectorXd norm = (rows[k] - rows[k - step]).rowwise().norm();
        least = least.cwiseMin(by.cwiseQuotient(norm));
      }
      return least;
    };
    for (const int step : {1, 5, 10, 30}) {
      values.emplace_back("margin_" + std::to_string(step) + "deg_mm", margins(step).minCoeff());
    }
    const Eigen::VectorXd fine = margins(1);
    const bool turns = history.path.end == solver::PathEnd::fold_limit;
    const double left_rad =
        (history.path.fold_limit_deg - campaign_.threshold_deg) * solver::kRadPerDeg;
    const double limit_mm =
        turns ? std::min(kFar_mm, left_rad / gradients.limit_gradient(states.back()) *
                                      mechanism.panel_width_mm)
              : kFar_mm;
    const double over_mm = gradients.to_over_folded_mm(states[threshold - 1]);
    values.emplace_back("fold_limit_margin_mm", limit_mm);
    values.emplace_back("over_folded_margin_mm", over_mm);
    values.emplace_back("least_margin_mm", std::min({fine.minCoeff(), limit_mm, over_mm}));
    // To first order each is a sum of many small independent errors.
    const double deviation_mm = amplitude_mm_ / std::sqrt(3.0);
    double share = normal_cdf(limit_mm / deviation_mm) * normal_cdf(over_mm / deviation_mm);
    for (const double margin_mm : fine) share *= normal_cdf(margin_mm / deviation_mm);
    values.emplace_back("share_foretold", share);
  }

  void add_yield(const Eigen::Matrix2Xd& shifts_mm, Values& values) {
    Eigen::Matrix2Xd errors_mm(2, shifts_mm.cols());
    block_.sheets = static_cast<int>(copies_);
    block_.shifts_mm.clear();
    for (std::uint64_t evaluator = 0; evaluator < copies_; ++evaluator) {
      trial_errors(campaign_, amplitude_mm_, evaluator, errors_mm.data());
      errors_mm += shifts_mm;
      block_.shifts_mm.insert(block_.shifts_mm.end(), errors_mm.data(),
                              errors_mm.data() + errors_mm.size());
    }
    double deploy = 0;
    std::map<solver::Fault, double> faults;  // every kind: a column each, in every row
    for (const solver::FaultEntry& entry : solver::fault_table()) {
      if (entry.fault != solver::Fault::none) faults[entry.fault] = 0;
    }
    for (const solver::Verdict& verdict : batch_->judge(block_)) {
      if (verdict.deploys_from_sample >= campaign_.threshold_sample()) {
        ++deploy;
      } else {
        ++faults.at(verdict.first_fault);
      }
    }
    for (const auto& [fault, count] : faults) {
      values.emplace_back(std::string("lost_to_") + solver::fault_name(fault), count);
    }
    values.emplace_back("share", deploy / static_cast<double>(copies_));
  }

  const schema::Campaign& campaign_;
  const std::uint64_t copies_;
  const double amplitude_mm_;
  const solver::Model model_;
  const std::unique_ptr<solver::Batch> batch_;
  solver::ShiftBlock block_;
  bool has_header_ = false;
};

void run(const std::string& path, double from_deg, std::uint64_t candidates, std::uint64_t copies,
         double amplitude_mm) {
  schema::Campaign campaign = schema::read_campaign_file(path);
  campaign.threshold_deg = from_deg;
  DrawEvaluator evaluator(campaign);
  Study study(campaign, copies, amplitude_mm);
  schema::UnitRecord unit;
  const std::uint64_t block = evaluator.largest_block() / 16;
  for (std::uint64_t lo = 0; unit.candidates.size() < candidates; lo += block) {
    const schema::UnitRecord more = work_off(evaluator, {lo, lo + block});
    unit.candidates.insert(unit.candidates.end(), more.candidates.begin(), more.candidates.end());
  }
  for (std::uint64_t k = 0; k < candidates; ++k) study.row(unit.candidates[k]);
}

}  // namespace
}  // namespace misalign::search

int main(int count, char** arguments) {
  if (count != 6) {
    std::fputs("usage: miscut_study CAMPAIGN.json FROM_DEG CANDIDATES COPIES AMPLITUDE_MM\n",
               stderr);
    return 2;
  }
  misalign::search::run(arguments[1], std::atof(arguments[2]),
                        std::strtoull(arguments[3], nullptr, 10),
                        std::strtoull(arguments[4], nullptr, 10), std::atof(arguments[5]));
}
