#include "search/verbs/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/draw_range.hpp"
#include "schema/pattern/fill_json.hpp"
#include "schema/pattern/joint_kind.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/deploy.hpp"

namespace misalign::search {

void add_catalogue_or_pattern(CLI::App& verb, std::string& path) {
  verb.add_option("FILE", path,
                  "catalogue, or a pattern: JSON, exported candidate, FOLD or OBJ file")
      ->required();
}

void add_sheet(CLI::App& verb, SheetCall& call) {
  add_catalogue_or_pattern(verb, call.path);
  verb.add_option("DRAW", call.draw, "number of a draw of a catalogue")->check(a_draw());
}

CLI::Option* add_draws(CLI::App& group, std::vector<std::uint64_t>& draws,
                       const std::string& what) {
  return add_value(group, "--draw", draws, what + " (may be repeated)", a_draw(), "N")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_stiffness(CLI::App& verb, std::optional<double>& stiffness_n_per_mm) {
  add_value(verb, "--stiffness", stiffness_n_per_mm, "rate of each spring, N/mm [the design's]",
            within("springs.stiffness_n_per_mm"), "N/MM");
}

void add_preload(CLI::App& verb, std::optional<double>& preload_n) {
  add_value(verb, "--preload", preload_n,
            "force of each spring at flat, N: pulling where diagonals lengthen as it folds, "
            "pushing where they shorten [the design's, or 0]",
            within("springs.preload_n"), "N");
}

void add_rest(CLI::App& verb, std::optional<double>& rest_deg) {
  add_value(verb, "--rest-deg", rest_deg,
            "pilot angle where the filling is relaxed [the design's, or 0, flat]",
            within("springs.rest_deg"), "DEG");
}

void add_fill(CLI::App& verb, schema::DesignFill& fill) {
  const auto read = [](const std::string& text, schema::InputFaults& faults) {
    return schema::read_fill(schema::parse_json(text, "the filling"), "fill", faults);
  };
  const auto fault_of = [read](const std::string& text) -> std::string {
    try {
      schema::InputFaults faults;
      read(text, faults);
      return faults.none() ? "" : fmt::format("{}", fmt::join(faults.sentences(), "; "));
    } catch (const schema::UserError& error) {
      return error.what();
    }
  };
  CLI::Option* const option =
      verb.add_option_function<std::string>(
              "--fill",
              [read, &fill](const std::string& text) {
                schema::InputFaults none;
                fill = read(text, none);
              },
              R"(what fills the holes, as design.fill of files: '{"kind": "plate", )"
              R"("prestretch": 1.1}' for rubber plates [the design's])")
          ->check(CLI::Validator(fault_of, ""))
          ->type_name("JSON");
  for (const char* other :
       {"--stiffness", "--preload", "--stroke-limit", "--rest-deg", "--rest", "--pull-only"}) {
    if (verb.get_option_no_throw(other)) option->excludes(other);
  }
}

void add_springs(CLI::App& verb, schema::Design& design) {
  const auto [least, most] = schema::design_limits("springs.stroke_limit");
  add_stiffness(verb, design.stiffness_n_per_mm);
  add_preload(verb, design.preload_n);
  add_value(verb, "--stroke-limit", design.stroke_limit,
            "largest elongation of an actuator: 0.08, 8 %, for Ti-Ni wires [the design's]",
            a_share(least, most), "SHARE");
}

CLI::Option* add_from(CLI::App& verb, std::optional<double>& from_deg,
                      const std::string& otherwise) {
  return verb
      .add_option("--from", from_deg,
                  "the sheet is used between this pilot angle and flat " + otherwise)
      ->check(within("from_deg"))
      ->type_name("DEG");
}

void add_release_from(CLI::App& verb, std::optional<double>& from_deg, double least_deg) {
  add_value(verb, "--from", from_deg,
            fmt::format("the sheet is used between this pilot angle, where it is released at "
                        "rest, and flat [the design's, or {:g}, or D where that is less]",
                        solver::kDeployFrom_deg),
            within(least_deg, 180), "DEG");
}

void add_thickness(CLI::App& verb, std::optional<double>& thickness_mm) {
  add_value(verb, "--thickness", thickness_mm,
            fmt::format("thickness of the panels, mm [the design's, or {:g}]",
                        solver::Plates{}.thickness_mm),
            within("thickness_mm"), "MM");
}

void add_hold_flat(CLI::App& verb, std::optional<bool>& hold_flat) {
  verb.add_flag_callback(
      "--hold-flat", [&hold_flat] { hold_flat = true; },
      "a stop, latch or frame holds the sheet at flat [the design's]");
}

SimulationStart ReleaseCall::of(const schema::Design& whole) const {
  SimulationStart release{whole.from_deg, whole.rest_deg.value_or(0), whole.plates()};
  if (density_g_per_cm3) release.plates.density_g_per_cm3 = *density_g_per_cm3;
  return release;
}

void add_release(CLI::App& verb, ReleaseCall& call) {
  constexpr double kLeast_deg = 1;  // closer to flat loops hardly say which way the sheet folds
  add_release_from(verb, call.design.from_deg, kLeast_deg);
  add_rest(verb, call.design.rest_deg);
  add_thickness(verb, call.design.thickness_mm);
  add_value(verb, "--density", call.density_g_per_cm3,
            fmt::format("density of the panels, g/cm^3 [{:g}, or the material's]",
                        solver::Plates{}.density_g_per_cm3),
            within(kLeastDensity_g_per_cm3, kMostDensity_g_per_cm3), "G_PER_CM3");
}

schema::DeckOptions DeckCall::of(const schema::Design& whole) const {
  schema::DeckOptions options = deck;
  options.material = whole.material.value_or(options.material);
  return options;
}

void add_deck(CLI::App& verb, DeckCall& call) {
  add_default(verb, "--mesh", call.deck.elements, "elements along a panel's side", counted(2, 40),
              "N");
  add_material(verb, call.material);
}

void add_material(CLI::App& verb, std::string& typed) {
  verb.add_option("--material", typed,
                  fmt::format("name that `misalign config --materials` lists, or JSON file with "
                              "like, name, e_gpa, poisson, density_g_per_cm3, strength_mpa, crease "
                              "[the design's, or {}]",
                              schema::Material{}.name))
      ->type_name(kMaterial);
}

void read_material(const std::string& typed, schema::Design& design) {
  if (!typed.empty()) design.material = schema::named_material(typed);
}

void add_hinge(CLI::App& verb, std::string& typed) {
  verb.add_option("--hinge", typed,
                  "hinges of this name in `misalign config --materials`: film, pin friction and "
                  "play, unless options give these [the design's]")
      ->type_name(kHinge);
}

void read_hinge(const std::string& typed, schema::Design& design) {
  if (typed.empty()) return;
  const schema::HingeRow* row = schema::find_hinge(typed);
  if (!row) throw schema::UserError(schema::unknown_hinge(typed));
  design.take_hinge(*row);
}

CLI::Option* add_joint(CLI::App& verb, schema::Design& design) {
  Names<solver::JointKind> kinds;
  for (const schema::JointKindName& row : schema::kJointKinds)
    kinds.emplace_back(row.name, row.kind);
  add_value(verb, "--wire", design.wire_mm,
            "diameter of the wire of --joint loop, mm [the design's, or 1]",
            within("joints.wire_mm"), "MM");
  return verb
      .add_option("--joint", design.joint_kind,
                  "ball joints, whose play follows: loop (of wire), ball (in a socket) or tab (a "
                  "flexible strip) [the design's]")
      ->transform(one_of<solver::JointKind>(kinds));
}

CLI::Option* add_joints(CLI::App& verb, schema::Design& design) {
  add_value(verb, "--joint-bore", design.joint_bore_mm,
            "diameter of the bores of --joint loop or tab, mm [the design's, or 1.2]",
            within("joints.bore_mm"), "MM");
  return add_joint(verb, design);
}

CLI::Option* add_criterion(CLI::App& verb, std::optional<solver::CertifiedBy>& criterion) {
  return verb
      .add_option_function<std::string>(
          "--criterion",
          [&criterion](const std::string& name) { criterion = solver::certified_by(name); },
          "criterion: every diagonal monotone, or the total energy of the filling [as the sheet is "
          "judged]")
      ->check(CLI::IsMember({"diagonals", "energy"}))
      ->type_name("CRITERION");
}

void add_trim(CLI::App& verb, std::optional<double>& trim_mm) {
  add_value(
      verb, "--trim", trim_mm,
      fmt::format("trim of the corners of plates, mm [{:g} of the panel width]", solver::kTrimPart),
      within("", "trim_mm"), "MM");
}

std::string first_given(const CLI::App& group) {
  for (const CLI::Option* option : group.get_options()) {
    if (option->count() > 0) return option->get_name();
  }
  return "";
}

void refuse_idle(bool is_given, const char* option, bool has_sense, const char* with) {
  if (!is_given || has_sense) return;
  throw schema::UserError(
      schema::Cause::bad_request,
      fmt::format("{} has no meaning without {}; take it out, or add that", option, with));
}

}  // namespace misalign::search
