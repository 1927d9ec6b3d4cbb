#include "solver/history.hpp"

#include "solver/diagonals.hpp"
#include "solver/singular_value.hpp"

namespace misalign::solver {
namespace {

// The square Jacobian's factors, as SmallestSingularValue wants them.
class HeldPilotFactors {
 public:
  explicit HeldPilotFactors(const SparseLu<double>& lu)
      : lu_(lu), work_(lu.plan().equations + 1), x_(work_.size()), y_(lu.plan().equations) {}

  auto solve(const Eigen::VectorXd& rhs) {
    lu_.forward(rhs.data(), work_.data());
    const double partner = work_[lu_.plan().equations - 1] / lu_.partner_coefficient();
    lu_.backward(work_.data(), partner, 0.0, x_.data());
    return x_.head(lu_.plan().equations);
  }
  const Eigen::VectorXd& solve_transposed(const Eigen::VectorXd& rhs) {
    lu_.transposed(rhs.data(), work_.data(), y_.data());
    return y_;
  }

 private:
  const SparseLu<double>& lu_;
  Eigen::VectorXd work_, x_, y_;
};

}  // namespace

// One path in the making: a client of the tracker.
class HistoryRecorder::Recording {
 public:
  Recording(HistoryRecorder& recorder, const FlatVertices& vertices_mm)
      : recorder_(recorder),
        vertices_mm_(vertices_mm),
        judge_(recorder.mechanism_),
        state_(flat_state<double>(recorder.mechanism_)),
        residual_(recorder.mechanism_.equations),
        lengths_(recorder.mechanism_.diagonals.size()),
        factors_(recorder.tracker_.factors()),
        smallest_(recorder.mechanism_.equations) {
    const Mechanism& mechanism = recorder.mechanism_;
    place(mechanism, vertices_mm, geometry_);
    flat_lengths(mechanism, geometry_, lengths_.data());
    judge_.begin(lengths_);
    for (const double length : lengths_) {
      history_.flat_mm.push_back(length * mechanism.panel_width_mm);
    }
  }

  bool next(Departure& departure, int) {
    if (departed_) return false;
    departed_ = true;
    departure = {&geometry_, &recorder_.plan_.start, &recorder_.plan_};
    return true;
  }

  bool visit(const Stop& stop, int) {
    recorder_.tracker_.copy_state(0, state_);
    see(stop, state_, factors_);
    return true;
  }

  void ended(const PathResult& path, int) { history_.path = path; }

  bool lost() const {
    return history_.path.end == PathEnd::start_lost || history_.path.end == PathEnd::stalled;
  }

  // Dense, with pivoting: for the rare sheet that the fixed order of elimination does not suit.
  void follow_densely() {
    const Mechanism& mechanism = recorder_.mechanism_;
    PathTracker tracker(mechanism);
    ClosureSystem system(mechanism);
    DenseSolve factors(mechanism.equations);
    history_.path = tracker.follow(
        geometry_, recorder_.plan_, [&](const Stop& stop, const FoldState<double>& state) {
          system.evaluate(geometry_, state);
          factors.factorize(system.jacobian().leftCols(mechanism.equations));
          see(stop, state, factors);
          return true;
        });
  }

  FoldingHistory take() {
    const auto rows_of = [](const std::vector<std::vector<double>>& rows, std::size_t columns) {
      Eigen::MatrixXd matrix(rows.size(), columns);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        matrix.row(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::RowVectorXd>(
            rows[i].data(), static_cast<Eigen::Index>(columns));
      }
      return matrix;
    };
    history_.verdict = judge_.conclude(history_.path);
    history_.length_mm = rows_of(lengths_mm_, lengths_.size());
    history_.fold_angle_deg = rows_of(angles_deg_, state_.creases.size());
    return std::move(history_);
  }

 private:
  template <class Factors>
  void see(const Stop& stop, const FoldState<double>& state, Factors& factors) {
    const Mechanism& mechanism = recorder_.mechanism_;
    folded_lengths(mechanism, geometry_, state, lengths_.data());
    if (stop.sample > 0) judge_.see(stop, state, lengths_);
    history_.stops.push_back(stop);
    for (double& length : lengths_mm_.emplace_back(lengths_)) length *= mechanism.panel_width_mm;
    auto& angles = angles_deg_.emplace_back();
    for (const auto& rho : state.creases) angles.push_back(angle_deg(rho));
    history_.open_by.push_back(evaluate(mechanism, geometry_, state, residual_.data(), nullptr));
    history_.singular_value_min.push_back(smallest_.of(factors));
    const auto folded_mm = recorder_.shape_.vertices_mm(geometry_, state);
    history_.isometry_error_mm.push_back(
        recorder_.shape_.isometry_error_mm(vertices_mm_, folded_mm));
  }

  HistoryRecorder& recorder_;
  const FlatVertices& vertices_mm_;
  bool departed_ = false;
  SheetGeometry<double> geometry_;
  Judge judge_;
  FoldState<double> state_;
  std::vector<double> residual_, lengths_;
  HeldPilotFactors factors_;
  SmallestSingularValue smallest_;
  std::vector<std::vector<double>> lengths_mm_, angles_deg_;
  FoldingHistory history_;
};

HistoryRecorder::HistoryRecorder(const PerforatedSheet& base, const Mechanism& mechanism,
                                 const Elimination& elimination, const PathPlan& plan)
    : mechanism_(mechanism),
      plan_(plan),
      tracker_(mechanism, elimination),
      shape_(base.sheet, base.holes, mechanism) {}

FoldingHistory HistoryRecorder::record(const FlatVertices& vertices_mm) {
  Recording recording(*this, vertices_mm);
  tracker_.run(recording);
  if (!recording.lost()) return recording.take();
  Recording again(*this, vertices_mm);
  again.follow_densely();
  return again.take();
}

FoldingHistory record_history(const PerforatedSheet& base, const Mechanism& mechanism,
                              const PathPlan& plan, const FlatVertices& vertices_mm) {
  const Elimination elimination = plan_elimination(mechanism, base.folding, base.sheet.vertices_mm);
  return HistoryRecorder(base, mechanism, elimination, plan).record(vertices_mm);
}

}  // namespace misalign::solver
