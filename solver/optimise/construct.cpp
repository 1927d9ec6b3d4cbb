#include "solver/optimise/construct.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "solver/linear/simplex.hpp"

namespace misalign::solver {
namespace {

// Least stroke per mm: smaller ones are rounding.
constexpr double kLeastRate_per_mm = 1e-9;
// Relative tolerance of the amplitude.
constexpr double kAmplitudePart = 1e-12;
constexpr int kScaleSteps = 60;

// Rates of a hole's strokes at one pilot angle, per mm of delta and of epsilon.
struct StrokeRates {
  double by_delta, by_epsilon;
};

StrokeRates stroke_rates(const BaseHole& hole, const HalfAngle<double>& pilot) {
  const double cc = pilot.c * pilot.c, ss = pilot.s * pilot.s;
  const double x = hole.b_ratio * ss / (cc + hole.b_ratio * ss);
  const double y = hole.a_ratio * ss / (cc + hole.a_ratio * ss);
  // The longer diagonal changes by the smaller share: d(L^2) = -+ 2 d(p . q), to first order.
  const double longer_sq = hole.a_mm * hole.a_mm + hole.b_mm * hole.b_mm +
                           2 * hole.a_mm * hole.b_mm * std::abs(hole.cosine);
  const double rate = 2 * hole.sine * hole.sine / longer_sq;
  return {rate * hole.a_mm * x, rate * hole.b_mm * y};
}

// Signs by the places of holes: a checkerboard's family has one of these arrangements with its rim
// held, and all with its rim free.
std::vector<std::vector<int>> arrangements(const PerforatedSheet& base) {
  std::map<int, int> in_row, in_column;
  std::vector<std::array<int, 4>> places;
  for (const int f : base.holes) {
    const auto& place = base.sheet.places[static_cast<std::size_t>(f)];
    places.push_back(
        {(place[0] - 1) / 2, (place[1] - 1) / 2, in_row[place[0]]++, in_column[place[1]]++});
  }
  std::vector<std::vector<int>> all;
  for (const std::array<int, 4>& weights : std::vector<std::array<int, 4>>{
           {0, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}, {1, 0, 1, 0}, {0, 1, 0, 1}}) {
    std::vector<int> signs;
    for (const auto& place : places) {
      int sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += weights[k] * place[k];
      signs.push_back(sum % 2 == 0 ? 1 : -1);
    }
    if (std::find(all.begin(), all.end(), signs) == all.end()) all.push_back(signs);
  }
  return all;
}

// The program for one arrangement of signs, at an amplitude of 1 mm. Variables: delta and epsilon
// with their signs, shapes up and down, and last the least stroke.
class StrokeProgram {
 public:
  StrokeProgram(const ParallelFamily& family, const HalfAngle<double>& pilot,
                const std::vector<int>& signs)
      : family_(family) {
    using Kind = ParallelCoordinate::Kind;
    for (int k = 0; k < family.dimension(); ++k) {
      const ParallelCoordinate& coordinate = family.coordinates()[static_cast<std::size_t>(k)];
      if (coordinate.kind == Kind::shape) {
        variables_.push_back({k, 1});
        variables_.push_back({k, -1});
      } else {
        variables_.push_back({k, signs[static_cast<std::size_t>(coordinate.hole)]});
      }
    }
    const auto shifts = family.basis().rows();
    const auto holes = static_cast<Eigen::Index>(family.holes().size());
    const auto last = static_cast<Eigen::Index>(variables_.size());
    program_.rows.setZero(2 * shifts + 3 * holes, last + 1);
    program_.bounds.setZero(program_.rows.rows());
    program_.bounds.head(2 * shifts).setOnes();
    program_.gain = Eigen::VectorXd::Unit(last + 1, last);
    for (Eigen::Index v = 0; v < last; ++v) {
      const auto [k, sign] = variables_[static_cast<std::size_t>(v)];
      for (Eigen::Index r = 0; r < shifts; ++r) {
        program_.rows(r, v) = sign * family.basis()(r, k);
        program_.rows(shifts + r, v) = -sign * family.basis()(r, k);
      }
      for (Eigen::Index h = 0; h < holes; ++h) {
        const auto at = static_cast<std::size_t>(h);
        const StrokeRates rates = stroke_rates(family.holes()[at], pilot);
        const double delta = sign * signs[at] * family.hole_basis()(2 * h, k);
        const double epsilon = sign * signs[at] * family.hole_basis()(2 * h + 1, k);
        program_.rows(2 * shifts + h, v) = -(rates.by_delta * delta + rates.by_epsilon * epsilon);
        program_.rows(2 * shifts + holes + 2 * h, v) = -delta;
        program_.rows(2 * shifts + holes + 2 * h + 1, v) = -epsilon;
      }
    }
    program_.rows.block(2 * shifts, last, holes, 1).setOnes();
  }

  // Returns the stroke per mm; finds the coordinates at an amplitude of 1 mm.
  double solve(Eigen::VectorXd& coordinates, std::vector<int>& binding) const {
    const LinearOptimum optimum = maximize(program_);
    coordinates.setZero(family_.dimension());
    for (std::size_t v = 0; v < variables_.size(); ++v) {
      const auto [k, sign] = variables_[v];
      coordinates(k) += sign * optimum.x(static_cast<Eigen::Index>(v));
    }
    binding.clear();
    const auto shifts = static_cast<int>(family_.basis().rows());
    for (const int row : optimum.binding) {
      if (row >= 2 * shifts) continue;
      binding.push_back(family_.vertices()[static_cast<std::size_t>(row % shifts / 2)]);
    }
    std::sort(binding.begin(), binding.end());
    binding.erase(std::unique(binding.begin(), binding.end()), binding.end());
    return optimum.end == LinearOptimum::StopReason::optimal ? optimum.value : 0;
  }

 private:
  const ParallelFamily& family_;
  std::vector<std::pair<int, int>> variables_;  // coordinate and sign
  LinearProgram program_;
};

double least_stroke(const ParallelFamily& family, const Eigen::Matrix2Xd& shifts_mm,
                    const HalfAngle<double>& pilot) {
  double least = INFINITY;
  for (const HoleMotion& motion : family.motions(shifts_mm)) {
    least = std::min(least, motion.stroke(pilot));
  }
  return least;
}

// Bisects for the share of the shifts with this stroke, which grows with the share.
double share_for(const ParallelFamily& family, const Eigen::Matrix2Xd& shifts_mm,
                 const HalfAngle<double>& pilot, double stroke) {
  double low = 0, high = 1;
  assert(stroke <= least_stroke(family, shifts_mm, pilot));
  for (int step = 0; step < kScaleSteps; ++step) {
    const double middle = (low + high) / 2;
    (least_stroke(family, shifts_mm * middle, pilot) < stroke ? low : high) = middle;
  }
  return high;
}

std::string vertices_text(const std::vector<int>& vertices) {
  std::string text;
  for (std::size_t k = 0; k < vertices.size() && k < 4; ++k) {
    text += (k > 0 ? ", " : "") + vertex_label(vertices[k]);
  }
  return text + (vertices.size() > 4 ? " and others" : "");
}

void describe(const PerforatedSheet& base, const ParallelFamily& family,
              const HalfAngle<double>& pilot, ConstructStudy& study) {
  const auto motions = family.motions(study.shifts_mm);
  for (std::size_t h = 0; h < motions.size(); ++h) {
    const HoleEdges change = hole_edges(family.holes()[h], study.shifts_mm);
    study.holes.push_back({family.holes()[h].facet, change.delta_mm, change.epsilon_mm,
                           motions[h].direction(), motions[h].stroke(pilot)});
  }
  study.dimension = family.dimension();
  study.stroke = least_stroke(family, study.shifts_mm, pilot);
  study.amplitude_mm = study.shifts_mm.cwiseAbs().maxCoeff();
  study.misfit_mm = parallel_misfit(base, study.shifts_mm).mm;
  study.base_misfit_rad = family.misfit_rad();
}

std::optional<OptionFault> signs_fault(const ParallelFamily& family,
                                       const std::vector<int>& signs) {
  if (signs.empty() || signs.size() == family.holes().size()) return std::nullopt;
  return OptionFault{"signs", std::nullopt,
                     "they are " + std::to_string(signs.size()) + ", and the sheet has " +
                         std::to_string(family.holes().size()) + " holes",
                     "write one sign a hole, row by row"};
}

}  // namespace

bool ConstructStudy::is_monotone() const {
  return std::all_of(holes.begin(), holes.end(),
                     [](const ConstructStudy::Hole& hole) { return hole.direction != 0; });
}

StudyResult<ConstructStudy> construct(const PerforatedSheet& base, const ParallelFamily& family,
                                      const ConstructOptions& options) {
  if (auto fault = signs_fault(family, options.signs)) return *fault;
  const HalfAngle<double> pilot = half_angle_of_deg(options.at_deg);
  double best = kLeastRate_per_mm;
  ConstructStudy study;
  Eigen::VectorXd coordinates;
  const auto tried =
      options.signs.empty() ? arrangements(base) : std::vector<std::vector<int>>{options.signs};
  for (const std::vector<int>& signs : tried) {
    Eigen::VectorXd these;
    std::vector<int> binding;
    const double rate = StrokeProgram(family, pilot, signs).solve(these, binding);
    if (rate <= best) continue;
    best = rate;
    coordinates = these;
    study.binding = binding;
  }
  if (best == kLeastRate_per_mm) {
    return OptionFault{"signs", std::nullopt,
                       "no sheet of the family changes both diagonals of every hole that way while "
                       "these vertices alone are shifted",
                       "let the rim move too, or choose other signs: with the rim held, signs must "
                       "change along each row and column of holes"};
  }
  const Eigen::Matrix2Xd unit = family.shifts_mm(coordinates);
  const double largest = unit.cwiseAbs().maxCoeff();
  assert(largest > 0 && options.amplitude_mm > 0);
  study.shifts_mm = unit * (options.amplitude_mm * (1 - kAmplitudePart) / largest);
  if (options.stroke) {
    const double most = least_stroke(family, study.shifts_mm, pilot);
    if (most < *options.stroke) {
      return OptionFault{"stroke", shown("%g", *options.stroke),
                         "out of reach: the even stroke is at most " + shown("%.4g", most) +
                             " at " + shown("%g", options.at_deg) +
                             " deg while no vertex is shifted by more "
                             "than " +
                             shown("%g", options.amplitude_mm) + " mm; what binds is " +
                             vertices_text(study.binding),
                         "ask for less, or allow a larger amplitude"};
    }
    study.shifts_mm *= share_for(family, study.shifts_mm, pilot, *options.stroke);
  }
  const auto bad = nonconvex_facets(base.sheet, base.sheet.vertices_mm + study.shifts_mm);
  if (!bad.empty()) {
    const auto& place = base.sheet.places[static_cast<std::size_t>(bad.front())];
    return OptionFault{"amplitude_mm", shown("%g", options.amplitude_mm),
                       "the facet [" + std::to_string(place[0]) + ", " + std::to_string(place[1]) +
                           "] would lose its convexity",
                       "name a smaller amplitude"};
  }
  describe(base, family, pilot, study);
  return study;
}

}  // namespace misalign::solver
