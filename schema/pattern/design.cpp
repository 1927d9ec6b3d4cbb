#include "schema/pattern/design.hpp"

#include <algorithm>
#include <cassert>
#include <string>

#include "schema/files/input.hpp"
#include "solver/studies/wanted.hpp"

namespace misalign::schema {
namespace {

// Bounds of stiffness, stroke and friction as in `actuators` and `deploy`.
constexpr DesignNumber kNumbers[] = {
    {"", "from_deg", &Design::from_deg, 0.01, 180, std::nullopt,
     "try 140, or null for each sheet's D"},
    {"springs", "stiffness_n_per_mm", &Design::stiffness_n_per_mm, 1e-6, 1e9,
     solver::Springs{}.stiffness_n_per_mm, "try 50, the paper's springs"},
    {"springs", "stroke_limit", &Design::stroke_limit, 1e-6, 1, std::nullopt,
     "write a share of the flat length, 0.08 for Ti-Ni wires, or null for no limit"},
    {"springs", "preload_n", &Design::preload_n, 0, 1e6, 0,
     "try 3: the force of each spring at flat"},
    {"springs", "largest_force_n", &Design::largest_force_n, 1e-6, 1e9, std::nullopt,
     "write the spring's limit load, or null for no limit"},
    {"springs", "rest_deg", &Design::rest_deg, 0, 180, 0,
     "write the pilot angle at which the springs are relaxed, 0 for flat"},
    {"springs", "diameter_mm", &Design::diameter_mm, 0.01, 1e3, std::nullopt,
     "write the outer diameter of the springs, such as 5, or null where it is not known"},
    {"plate", "shear_mpa", &Design::shear_mpa, 1e-6, 1e6, solver::RubberPlates{}.shear_mpa,
     "write the rubber's shear modulus in MPa, such as 0.5"},
    {"plate", "thickness_mm", &Design::plate_mm, 1e-6, 1e3, solver::RubberPlates{}.thickness_mm,
     "write the plate's thickness in mm, such as 1"},
    {"plate", "prestretch", &Design::prestretch, 0.1, 10, solver::RubberPlates{}.prestretch,
     "write lengths in the hole to those of the cut-out, such as 1.1, or 1"},
    {"plate", "rest_deg", &Design::rest_deg, 0, 180, 0,
     "write the pilot angle at which only the pre-stretch is left, 0 for flat"},
    {"hinges", "friction_n_mm_per_mm", &Design::friction_n_mm_per_mm, 0, 1e9, 0,
     "try 0.02, or 0 for none"},
    {"hinges", "stiffness_n_mm_per_mm", &Design::hinge_stiffness_n_mm_per_mm, 0, 1e9, 0,
     "try 0.1, or 0 for none"},
    {"hinges", "pin_friction_mm", &Design::pin_friction_mm, 0, 1e6, std::nullopt,
     "write the radius of the pins times their friction coefficient, such as 0.075, or null"},
    {"", "thickness_mm", &Design::thickness_mm, 1e-3, 100, std::nullopt,
     "try 1, or null for the studies' defaults"},
    {"", "miscut_mm", &Design::miscut_mm, 0, 1e6, std::nullopt,
     "try 0.05, or null where none is known"},
    {"", "play_mm", &Design::play_mm, 1e-9, 1e6, std::nullopt,
     "try 0.01, or null where none is known"},
    {"joints", "bore_mm", &Design::joint_bore_mm, 1e-3, 1e3, std::nullopt,
     "write the diameter of the bores, such as 1.2, or null"},
    {"joints", "wire_mm", &Design::wire_mm, 1e-3, 1e3, std::nullopt,
     "write the diameter of the wire, such as 1, or null"},
    {"joints", "edge_mm", &Design::joint_edge_mm, 0, 1e3, std::nullopt,
     "write the distance of bores from the sides of panels, such as 2, or null"},
    {"joints", "clearance_mm", &Design::joint_clearance_mm, 0, 1e3, std::nullopt,
     "write the diametral clearance of balls in sockets, such as 0.4, or null"},
    {"joints", "strip_mm", &Design::strip_mm, 1e-3, 1e3, std::nullopt,
     "write the free length of tabs, such as 2, or null"},
    {"wanted", "static_margin", &Design::static_margin, 0, 1e9, solver::kWantedMargin,
     "write 1, as AIAA S-114 asks at every position"},
    {"wanted", "margin_to_deg", &Design::margin_to_deg, 0.1, 180, solver::kMarginTo_deg,
     "try 1: margins are required from from_deg down to this angle"},
    {"wanted", "energy_margin", &Design::energy_margin, 0, 1e9, solver::kWantedMargin,
     "write 1: a critical friction twice that of the hinges"},
    {"wanted", "yield", &Design::yield, 0, 1, solver::kWantedShare,
     "write a share of miscut copies, such as 0.95"},
    {"wanted", "landing_deg_per_s", &Design::landing_deg_per_s, 0, 1e9, std::nullopt,
     "write the largest landing rate, or null for no limit"}};

// Values of springs have no meaning where the holes have other fillings.
void check_are_springs(std::string_view key, const std::optional<std::string>& value,
                       const Design& other) {
  if (other.is_springs()) return;
  throw UserError(solver::OptionFault{
      std::string(key), value,
      std::string("is of springs, and this sheet's holes have ") +
          (other.is_plate() ? "rubber plates" : "nothing in them"),
      "leave it out, or give springs by " + parameter("fill", R"({"kind": "springs"})")});
}

void clear_hinges(Design& design) {
  for (const DesignNumber& row : kNumbers) {
    if (row.block == "hinges") (design.*row.number).reset();
  }
  design.film.reset();
  design.hinge_kind.reset();
}

}  // namespace

Design Design::merged_over(Design other) const {
  if (fill_kind) static_cast<DesignFill&>(other) = DesignFill{};
  if (hinge_name) clear_hinges(other);
  const auto take = [&](auto member) {
    if (this->*member) other.*member = this->*member;
  };
  if (preload_n || !other_preloads.empty()) other.other_preloads = other_preloads;
  for (const DesignNumber& row : kNumbers) {
    const std::optional<double>& number = this->*row.number;
    if (number && row.block == "springs" && row.number != &Design::rest_deg) {
      check_are_springs(row.key, shown_number(*number), other);
    }
    take(row.number);
  }
  const auto check = [&](std::string_view key, bool is_given) {
    if (is_given) check_are_springs(key, std::nullopt, other);
  };
  check("pull_only", pull_only.has_value());
  check("on", springs_on.has_value());
  check("preloads_n", !other_preloads.empty());
  check("single", !single_springs.empty());
  take(&Design::fill_kind);
  take(&Design::pull_only);
  take(&Design::springs_on);
  if (!single_springs.empty()) other.single_springs = single_springs;
  if (!cut_outs.empty()) other.cut_outs = cut_outs;
  take(&Design::joint_kind);
  if (joint_kind && !play_mm) other.play_mm.reset();  // play follows from the joints
  take(&Design::hinge_kind);
  take(&Design::hinge_name);
  take(&Design::film);
  take(&Design::material);
  take(&Design::hold);
  take(&Design::hold_flat);
  take(&Design::gravity);
  return other;
}

void Design::take_hinge(const HingeRow& row) {
  const auto take = [](auto& value, const auto& given) {
    if (!value) value = given;
  };
  hinge_name = std::string(row.name);
  take(film, row.film);
  take(friction_n_mm_per_mm, row.friction_n_mm_per_mm);
  take(pin_friction_mm, row.pin_friction_mm);
  take(play_mm, row.play_mm);
  take(hinge_kind, std::optional(row.crease));
}

void Design::relax_at(const std::optional<FoldedTarget>& target) {
  if (target && !rest_deg && fill_kind != FillKind::none) rest_deg = target->pilot_deg;
}

solver::Actuators Design::actuators(const solver::PerforatedSheet& base) const {
  return {fill(base), stroke_limit};
}

CreaseCut Design::crease_or(CreaseCut standard) const {
  if (hinge_kind) return *hinge_kind;
  return material ? material->crease.value_or(standard) : standard;
}

double Design::hinge_elastic_n_mm_per_mm() const {
  if (hinge_stiffness_n_mm_per_mm || !film) return hinge_stiffness_n_mm_per_mm.value_or(0);
  return film->stiffness_n_mm_per_mm();
}

solver::Plates Design::plates() const {
  solver::Plates plates;
  plates.thickness_mm = thickness_mm.value_or(plates.thickness_mm);
  if (material) plates.density_g_per_cm3 = material->density_g_per_cm3;
  return plates;
}

solver::SpringBodies Design::spring_bodies(std::optional<double> end_mm) const {
  solver::Springs alike = springs();
  alike.rest_deg = 0;  // bodies are alike wherever springs are relaxed
  return {diameter_mm.value_or(solver::kSpringDiameter_mm), end_mm, plates().thickness_mm, alike};
}

std::span<const DesignNumber> design_numbers() { return kNumbers; }

std::string key_of(const DesignNumber& row, const Design& design) {
  std::string block(row.block == "springs" ? design.fill_key() : row.block);
  if (!block.empty()) block += ".";
  return "design." + block + std::string(row.key);
}

DesignLimits design_limits(std::string_view key) {
  const auto* const entry = std::ranges::find_if(kNumbers, [&](const DesignNumber& row) {
    const std::string name = (row.block.empty() ? "" : std::string(row.block) + ".");
    return name + std::string(row.key) == key;
  });
  assert(entry != std::end(kNumbers));
  return {entry->least, entry->most};
}

}  // namespace misalign::schema
