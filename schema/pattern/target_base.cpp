#include "schema/pattern/target_base.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/kinematics/folded_shape.hpp"
#include "solver/kinematics/measured_state.hpp"
#include "solver/sheet/followed_base.hpp"

namespace misalign::schema {
namespace {

// A folded form that no key names and whose panels differ by more is a drawing of something else.
constexpr double kDrawing_widths = 0.05;
// Differences of lengths that rounding leaves: such a pair is not changed, so that a second reading
// gives the same sheet.
constexpr double kSameLength_widths = 1e-9;
constexpr double kPlacesPerMm = 1e9;  // of a changed pair: the digits after are rounding's

Eigen::MatrixXd in_places(const Eigen::MatrixXd& vertices_mm) {
  return (vertices_mm * kPlacesPerMm).array().round() / kPlacesPerMm;
}

class TargetBase {
 public:
  TargetBase(const FamilyMesh& mesh, Pattern& pattern, InputFaults& faults)
      : target_(*mesh.target),
        where_(mesh.place.empty() ? "the mesh" : mesh.place),
        pattern_(pattern),
        faults_(faults),
        folded_mm_(target_.vertices_mm) {}

  // Judges the lengths, and closes small gaps; false: the target is no state of this mesh.
  bool has_congruent_panels() {
    const double width_mm = sheet().panel_width_mm;
    const auto length = solver::largest_length_misfit(sheet(), holes(), folded_mm_);
    const auto plane = solver::largest_plane_misfit(sheet(), holes(), folded_mm_);
    const double worst_mm = std::max(length.mm(), plane.mm);
    if (!target_.is_named && !(worst_mm <= kDrawing_widths * width_mm)) return false;
    const double most_mm = solver::kNearlyIsometric_widths * width_mm;
    const std::string within = fmt::format("{:.3g} mm is closed, no more", most_mm);
    if (!(length.mm() <= most_mm)) {
      faults_.add(
          fmt::format("{}: {} is {:.7g} mm long, flat {:.7g} mm", target_.name,
                      solver::line_label(length.from, length.to), length.folded_mm, length.flat_mm),
          "panels are rigid, so that edges and diagonals keep their lengths; " + within,
          "correct the coordinates, flat or folded");
    }
    if (!(plane.mm <= most_mm)) {
      faults_.add(fmt::format("{}: the corners of the panel {} are {:.3g} mm off a plane",
                              target_.name, facet_json(pattern_, plane.facet).dump(), plane.mm),
                  "panels are plane; " + within, "correct the folded coordinates");
    }
    if (faults_.none() && worst_mm > kSameLength_widths * width_mm) close_gap(length, plane.mm);
    return true;
  }

  // Takes the closed form of the whole mesh if it folds rigidly through the target.
  bool folds_rigidly(int pilot) {
    const double most_mm = solver::kNearlyIsometric_widths * sheet().panel_width_mm;
    if (solver::largest_length_misfit(sheet(), {}, folded_mm_).mm() > most_mm) return false;
    auto folded = solver::fold_sequentially(sheet(), signs_of_all_creases(pilot), pilot);
    auto* const folding = std::get_if<solver::BaseFolding>(&folded);
    if (!folding) return false;
    const solver::PerforatedSheet base{sheet(), holes(), *folding};
    const solver::Mechanism mechanism = solver::build_mechanism(base);
    const auto state = solver::measured_state(mechanism, sheet(), folded_mm_);
    const auto& at = state.creases[static_cast<std::size_t>(mechanism.pilot)];
    if (!(at.s > 0) || solver::angle_deg(at) > folding->end_deg()) return false;
    const double off_mm = apart_mm(
        mechanism, solver::base_state(mechanism, *folding, sheet().vertices_mm, at), state);
    if (!(off_mm <= most_mm)) return false;
    take(std::move(*folding), solver::angle_deg(at));
    say(fmt::format("the whole mesh folds rigidly, and its path passes the target within {:.2g} mm",
                    off_mm));
    return true;
  }

  // Follows the path of the perforated mesh from its target, with the first pilot that leads to
  // flat.
  void follow(std::span<const int> pilots) {
    const solver::Mechanism mechanism = solver::build_mechanism(
        {sheet(), holes(),
         solver::BaseFolding(pilots.front(), 1, std::vector<int>(sheet().edges.size(), 0))});
    if (mechanism.unknowns != mechanism.equations + 1) {
      faults_.add(where_,
                  fmt::format("it does not fold rigidly through its target as a whole, and its {} "
                              "holes leave {} degrees of freedom by counting (2.1), not 1",
                              holes().size(), solver::counted_mobility(sheet(), holes())),
                  hole_count_advice());
      return;
    }
    std::optional<solver::NoFollowedBase> first;
    for (const int pilot : pilots) {
      auto found = solver::follow_from_target(sheet(), holes(), pilot, folded_mm_);
      if (auto* const base = std::get_if<solver::FollowedBase>(&found)) {
        take(std::move(base->folding), base->target_deg);
        say(
            fmt::format("the perforated mesh has one degree of freedom; its paths from flat and "
                        "from the target join within {:.1e} mm",
                        base->joined_mm));
        return;
      }
      if (!first) first = std::get<solver::NoFollowedBase>(found);
    }
    add_fault(pilots, *first);
  }

 private:
  solver::CreasePattern& sheet() { return pattern_.base.sheet; }
  const std::vector<int>& holes() const { return pattern_.base.holes; }
  void say(std::string sentence) { pattern_.reading.push_back(std::move(sentence)); }

  void close_gap(const solver::LengthMisfit& length, double plane_mm) {
    const auto pair = solver::nearest_isometric_pair(sheet(), holes(), folded_mm_);
    if (!pair || !solver::nonconvex_facets(sheet(), pair->flat_mm).empty()) {
      faults_.add(fmt::format("{}: {} is {:.3g} mm longer or shorter than flat", target_.name,
                              solver::line_label(length.from, length.to), length.mm()),
                  "no sheet near the mesh has this target within rounding",
                  "write coordinates with more digits");
      return;
    }
    sheet().vertices_mm = in_places(pair->flat_mm);
    folded_mm_ = in_places(pair->folded_mm);
    say(fmt::format(
        "lengths at the target differ from the flat mesh by at most {:.2g} mm ({}), "
        "panels are plane within {:.2g} mm; the nearest sheet moves vertices by at "
        "most {:.2g} mm",
        length.mm(), solver::line_label(length.from, length.to), plane_mm, pair->moved_mm));
  }

  // Mountains and valleys of the unperforated mesh at the target, seen from +z.
  std::vector<int> signs_of_all_creases(int pilot) {
    std::vector<int> signs(sheet().edges.size(), 0);
    const solver::Mechanism whole =
        solver::build_mechanism({sheet(), {}, solver::BaseFolding(pilot, 1, signs)});
    const auto state = solver::measured_state(whole, sheet(), folded_mm_);
    for (std::size_t k = 0; k < whole.creases.size(); ++k) {
      signs[static_cast<std::size_t>(whole.creases[k].edge)] = state.creases[k].s < 0 ? -1 : 1;
    }
    return signs;
  }

  double apart_mm(const solver::Mechanism& mechanism, const solver::FoldState<double>& state,
                  const solver::FoldState<double>& other) {
    solver::SheetGeometry<double> geometry;
    solver::place(mechanism, sheet().vertices_mm, geometry);
    const solver::FoldedShape shape(sheet(), holes(), mechanism);
    return (shape.vertices_mm(geometry, state) - shape.vertices_mm(geometry, other))
        .colwise()
        .norm()
        .maxCoeff();
  }

  void take(solver::BaseFolding folding, double target_deg) {
    const solver::Edge& pilot = sheet().edges[static_cast<std::size_t>(folding.pilot_edge())];
    say(fmt::format("{} is the target: the pilot {} is folded by {:.4f} deg", target_.name,
                    solver::line_label(pilot.a, pilot.b), target_deg));
    pattern_.base.folding = std::move(folding);
    pattern_.folded_target = FoldedTarget{folded_mm_, target_deg};
  }

  std::string hole_count_advice() {
    const int count = solver::holes_that_count_to_one(sheet());
    return count < 1 ? "give a mesh of which some number of holes leaves one degree of freedom"
                     : fmt::format("take out {} inner panels by \"holes\"", count);
  }

  void add_fault(std::span<const int> pilots, const solver::NoFollowedBase& none) {
    using Cause = solver::NoFollowedBase::Cause;
    const auto edge_label = [&](int e) {
      const solver::Edge& edge = sheet().edges[static_cast<std::size_t>(e)];
      return solver::line_label(edge.a, edge.b);
    };
    std::string why;
    switch (none.cause) {
      case Cause::open:
        why = "loops do not close at the target: panels are not congruent to the flat ones";
        break;
      case Cause::turns:
        why = fmt::format("on the way from the target to flat the pilot turns back at {:.4g} deg",
                          none.pilot_deg);
        break;
      case Cause::not_flat:
        why = fmt::format(
            "the path from the target does not come to flat: {} is folded by {:.4g} "
            "deg where the pilot is at {:.4g} deg",
            edge_label(none.edge), none.angle_deg, none.pilot_deg);
        break;
      case Cause::apart:
        why = fmt::format(
            "the path that leaves flat passes the target {:.3g} mm off: it is "
            "another one",
            none.apart_mm);
        break;
      case Cause::lost:
        why = fmt::format("the path that leaves flat is lost at {:.4g} deg, short of the target",
                          none.pilot_deg);
    }
    faults_.add(where_ + ": with the pilot " + edge_label(pilots.front()), why,
                pilots.size() > 1 ? "take out other panels; other pilots lead no further"
                                  : "name another crease in \"pilot\", or take out other panels");
  }

  const MeshTarget& target_;
  const std::string where_;
  Pattern& pattern_;
  InputFaults& faults_;
  solver::FoldedVertices folded_mm_;
};

}  // namespace

bool fold_from_target(const FamilyMesh& mesh, std::span<const int> pilots, Pattern& pattern,
                      InputFaults& faults) {
  const std::size_t before = faults.count();
  pattern.reading = mesh.reading;
  TargetBase base(mesh, pattern, faults);
  if (!base.has_congruent_panels()) return false;
  if (faults.count() > before || base.folds_rigidly(pilots.front())) return true;
  base.follow(pilots);
  return true;
}

}  // namespace misalign::schema
