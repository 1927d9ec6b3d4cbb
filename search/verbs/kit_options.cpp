#include "search/verbs/kit_options.hpp"

#include <fmt/format.h>

#include <regex>

#include "schema/pattern/joint_kind.hpp"
#include "search/verbs/options.hpp"

namespace misalign::search {
namespace {

constexpr double kMost_mm = 1e5, kPinClearance_mm = 0.2;

CLI::Validator a_bed() {
  return CLI::Validator(
      [](std::string& text) {
        static const std::regex form(R"(\d{1,6}(\.\d+)?x\d{1,6}(\.\d+)?)");
        if (std::regex_match(text, form)) return std::string();
        return text + " is no width and height in mm, such as 600x400";
      },
      "");
}

// Plates of a design whose hinges are of this kind; none where contours depend on no thickness.
std::optional<schema::PlateOptions> plates_of(const KitCall& call, const schema::Design& design,
                                              schema::CreaseCut crease) {
  const bool is_pin = crease == schema::CreaseCut::pin;
  if (!schema::are_set_back(crease) && crease != schema::CreaseCut::butt) return std::nullopt;
  if (!design.thickness_mm) {
    if (!call.crease) return std::nullopt;
    throw schema::UserError(solver::OptionFault{
        "crease", schema::crease_name(crease),
        "is of plates with a thickness, and neither the design nor an option has one",
        "add " + schema::parameter("thickness_mm")});
  }
  schema::PlateOptions plates = call.plates;
  plates.thickness_mm = *design.thickness_mm;
  if (design.film) {
    plates.film_mm = design.film->length_mm;
    plates.film_thickness_mm = design.film->thickness_mm;
  }
  plates.barrel_mm = call.barrel_mm.value_or(plates.thickness_mm);
  plates.clearance_mm = call.clearance_mm.value_or(is_pin ? kPinClearance_mm : 0);
  return plates;
}

// Options of plates with hinges.
void add_plates(CLI::App& verb, KitCall& call) {
  const auto millimetres = [&](const char* name, auto& value, const std::string& meaning,
                               double least) {
    add_value(verb, name, value, meaning, within(least, kMost_mm), "MM");
  };
  millimetres("--barrel", call.barrel_mm,
              "with --kit and pin hinges: outer diameter of barrels [the thickness]", 1e-2);
  millimetres("--clearance", call.clearance_mm,
              fmt::format("with --kit and hinges of plates: clearance in hinges [{:g} of pins, 0]",
                          kPinClearance_mm),
              0);
  millimetres("--pin", call.plates.pin_mm,
              fmt::format("with --kit to print and pin hinges: diameter of pins [{:g}]",
                          call.plates.pin_mm),
              1e-2);
  millimetres("--ball", call.options.ball_mm,
              "with --kit to print and --joint ball: diameter of balls [the thickness]", 1e-2);
  millimetres("--slot", call.plates.slot_mm,
              fmt::format("with --kit to print and film hinges: depth of the films' slots [{:g}]",
                          call.plates.slot_mm),
              0.1);
  millimetres("--spacer", call.plates.spacer_mm,
              "with --kit and offset plates: thickness of spacers between films and plates, as "
              "NAME-kit-spacers [none]",
              1e-2);
  verb.add_flag("--allow-misfit", call.plates.allows_misfit,
                "with --kit and butt hinges: consent to plates that miss by more than a tenth of "
                "their thickness");
}

// Ball joints of a design, with the kit's bores: it has some where the joints do.
void take_joints(schema::Design design, const KitCall& call, schema::KitOptions& kit) {
  kit.bore_edge_mm = call.bore_edge_mm.value_or(design.joint_edge_mm.value_or(kit.bore_edge_mm));
  if (design.joint_kind) {
    const bool has_bores = design.joint_kind != solver::JointKind::ball;
    if (kit.joint_bore_mm && !has_bores) {
      throw schema::UserError(solver::OptionFault{
          "joint_bore_mm", schema::shown_number(*kit.joint_bore_mm),
          "is of loops and tabs, and balls in sockets have no bores", "leave it out"});
    }
    if (kit.joint_bore_mm) design.joint_bore_mm = kit.joint_bore_mm;
    design.joint_edge_mm = kit.bore_edge_mm;
    kit.joints = schema::joints_of(design);
    if (has_bores) kit.joint_bore_mm = kit.joints->bore_mm;
  }
  refuse_idle(call.bore_edge_mm.has_value(), "--bore-edge", kit.joint_bore_mm || kit.spring_bore_mm,
              "--joint-bore or --spring-bore");
}

}  // namespace

void add_kit(CLI::App& verb, KitCall& call) {
  schema::KitOptions& kit = call.options;
  const auto add_mm = [&](const char* name, auto& value, const std::string& meaning, double least) {
    add_value(verb, name, value, meaning, within(least, kMost_mm), "MM");
  };
  verb.add_flag("--kit", call.wanted,
                "svg, dxf, stl and 3mf: numbered parts to cut or print, see above");
  verb.add_flag_callback(
      "--guide", [] {}, "with --kit: NAME-kit.html, which is written with or without this");
  verb.add_flag(
      "--test-piece", kit.test_piece,
      "with --kit: also NAME-kit-test, one hinge, one ball joint and one tab to cut first");
  Names<schema::CreaseCut> creases;
  for (const schema::CreaseCutName& crease : schema::kCreaseCuts) {
    creases.emplace_back(crease.name, crease.cut);
  }
  verb.add_option("--crease", call.crease,
                  "with --kit: cut (every panel is a part), score (lines), dash (perforated); of "
                  "plates: film, bevel, pin, butt or offset [the design's, its material's, or "
                  "score]")
      ->transform(one_of<schema::CreaseCut>(creases));
  add_plates(verb, call);
  verb.add_option_function<std::vector<double>>(
          "--dash-mm",
          [&kit](const std::vector<double>& lengths) {
            kit.dash_mm = lengths[0];
            kit.bridge_mm = lengths[1];
          },
          fmt::format("with --crease dash: length of a cut, least length of a bridge [{:g},{:g}]",
                      kit.dash_mm, kit.bridge_mm))
      ->delimiter(',')
      ->expected(2)
      ->check(within(1e-2, kMost_mm))
      ->type_name("CUT,BRIDGE");
  add_mm("--kerf", kit.kerf_mm,
         fmt::format("with --kit: width that the cut removes, half of it on each side [{:g}]",
                     kit.kerf_mm),
         0);
  add_mm("--joint-bore", kit.joint_bore_mm, "with --kit: diameter of bores at ball joints [none]",
         1e-2);
  add_mm("--spring-bore", kit.spring_bore_mm, "with --kit: diameter of bores for springs [none]",
         1e-2);
  verb.add_option(
          "--spring-at", kit.spring_at,
          "with --spring-bore: vertex (tabs and ball joints) or panel (bores near vertices) "
          "[vertex]")
      ->transform(one_of<schema::SpringAt>(
          {{"vertex", schema::SpringAt::vertex}, {"panel", schema::SpringAt::panel}}));
  add_mm("--bore-edge", call.bore_edge_mm,
         fmt::format("with --kit: material left between a bore and an edge or another bore [the "
                     "design's, or {:g}]",
                     kit.bore_edge_mm),
         0);
  add_mm("--gap", kit.gap_mm, fmt::format("with --kit: gap between parts [{:g}]", kit.gap_mm), 0);
  add_value(verb, "--bed", call.bed,
            "with --kit: width and height of the machine's bed, mm; a file for each, larger "
            "parts cut along creases [one sheet for all]",
            a_bed(), "WxH");
  verb.add_flag_callback(
      "--grain", [&kit] { kit.turns = schema::NestTurns::half; },
      "with --kit: the material has a grain; parts are turned by 180 degrees alone");
  verb.add_option("--units", kit.unit, "with --kit: units of the files, mm or in [mm]")
      ->transform(one_of<schema::LengthUnit>(
          {{"mm", schema::LengthUnit::millimetre}, {"in", schema::LengthUnit::inch}}));
  add_mm("--margin", kit.margin_mm,
         fmt::format("with --kit: margin round all parts [{:g}]", kit.margin_mm), 0);
  add_mm("--bond", kit.bond_mm,
         fmt::format("with --kit and rubber plates: width of their bonds on the panels [{:g}]",
                     kit.bond_mm),
         0);
}

std::optional<schema::KitOptions> chosen_kit(const KitCall& call, const schema::Design& design) {
  if (!call.wanted) return std::nullopt;
  schema::KitOptions kit = call.options;
  if (kit.spring_bore_mm && !design.is_springs()) {
    throw schema::UserError(
        solver::OptionFault{"spring_bore_mm", schema::shown_number(*kit.spring_bore_mm),
                            "is of springs, and the design's holes have none", "leave it out"});
  }
  kit.crease = call.crease.value_or(design.crease_or(kit.crease));
  refuse_idle(call.barrel_mm.has_value(), "--barrel", kit.crease == schema::CreaseCut::pin,
              "--crease pin");
  refuse_idle(call.plates.spacer_mm > 0, "--spacer", kit.crease == schema::CreaseCut::offset,
              "--crease offset");
  refuse_idle(call.plates.allows_misfit, "--allow-misfit", kit.crease == schema::CreaseCut::butt,
              "--crease butt");
  refuse_idle(kit.ball_mm.has_value(), "--ball", design.joint_kind == solver::JointKind::ball,
              "--joint ball");
  kit.from_deg = design.from_deg;
  kit.plates = plates_of(call, design, kit.crease);
  take_joints(design, call, kit);
  if (schema::are_apart(kit.crease) && !kit.plates) kit.crease = schema::CreaseCut::cut;
  if (!call.bed.empty()) {
    const std::size_t x = call.bed.find('x');
    kit.bed_mm.emplace(std::stod(call.bed.substr(0, x)), std::stod(call.bed.substr(x + 1)));
  }
  return kit;
}

}  // namespace misalign::search
