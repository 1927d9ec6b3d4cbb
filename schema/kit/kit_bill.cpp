#include "schema/kit/kit_bill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "schema/kit/joint_words.hpp"
#include "schema/kit/kit_hinges.hpp"
#include "schema/kit/page_parts.hpp"
#include "schema/pattern/fill_words.hpp"
#include "solver/motion/plates.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::schema {
namespace {

class Bill {
 public:
  explicit Bill(const GuideInput& input) : input_(input), sheet_(input.sheet) {}

  std::string text() const {
    return "<h2>Parts to buy</h2>\n" + table_begin({"part", "number", "amount"}, 1) + panels() +
           hinges() + joints() + filling() + holder() + kTableEnd + groups() + thickness();
  }

 private:
  static std::string row(const std::string& part, std::size_t number, const std::string& amount) {
    return table_row({part, std::to_string(number), amount}, 1);
  }

  std::string panels() const {
    constexpr double kG_t = 1e6, kCm2_mm2 = 100;
    const solver::Plates plates = input_.design.plates();
    double mass_t = 0;
    for (const solver::PanelMass& panel :
         solver::panel_masses(plates, sheet_.panels().corners, sheet_.vertices_mm())) {
      mass_t += panel.mass_t;
    }
    const KitSheets& sheets = input_.kit.sheets;
    std::string text = row(
        fmt::format("sheets of material{}",
                    input_.design.material ? ", " + input_.design.material->name : std::string()),
        sheets.beds.size(),
        input_.length(sheets.size_mm.x()) + " × " + input_.length(sheets.size_mm.y()) +
            (input_.design.thickness_mm
                 ? ", " + input_.length(*input_.design.thickness_mm, 2) + " thick"
                 : std::string()));
    text += row("panels", sheet_.panels().facets.size(),
                fmt::format("{:.0f} cm² of sheet", mass_t / plates.area_density() / kCm2_mm2));
    const auto& plates_of_kit = input_.options.plates;
    if (plates_of_kit && plates_of_kit->spacer_mm > 0) {
      text += row("spacers, NAME-kit-spacers", sheet_.panels().facets.size(),
                  input_.length(plates_of_kit->spacer_mm, 2) + " thick");
    }
    if (input_.design.thickness_mm) {
      text += table_row({fmt::format("mass of panels of {:g} g/cm³", plates.density_g_per_cm3), "",
                         fmt::format("{:.1f} g", kG_t * mass_t)},
                        1);
    }
    return text;
  }

  std::string hinges() const {
    const CreaseCut crease = input_.options.crease;
    const char* made = crease == CreaseCut::pin     ? "barrels and pins"
                       : are_apart(crease)          ? "strip of film or textile"
                       : crease == CreaseCut::score ? "scored"
                                                    : "perforated";
    std::string text;
    for (const bool valley : {false, true}) {
      const KitHinges hinges(sheet_, valley, input_.actuation.from_row);
      text += row(fmt::format("hinges, {}, {}", hinges.name, made),
                  static_cast<std::size_t>(hinges.count), input_.length(hinges.length_mm, 0));
    }
    double cut_mm = 0;
    for (const int c : input_.kit.cuts) {
      const solver::Crease& line = sheet_.mechanism().creases[static_cast<std::size_t>(c)];
      cut_mm += (sheet_.point_mm(line.a) - sheet_.point_mm(line.b)).norm();
    }
    if (cut_mm > 0) {
      text += row("strip of film or textile for creases cut for the bed", input_.kit.cuts.size(),
                  input_.length(cut_mm, 0));
    }
    return text;
  }

  // Loops of wire are each twice as long as its bores are apart, and an end for the twist.
  std::string joints() const {
    constexpr double kTwist_mm = 20;
    const std::size_t count = sheet_.mechanism().balls.size();
    if (count == 0) return "";
    const auto& parts = input_.options.joints;
    const std::string part =
        "ball joints: " + (parts ? joint_words(*parts) : std::string("loops of wire"));
    const bool are_loops = !parts || parts->kind == solver::JointKind::loop;
    if (!are_loops) return row(part, count, "");
    if (!input_.options.joint_bore_mm) return row(part, count, "no bores");
    const std::vector<Bore>& bores = input_.kit.fittings.bores;
    double wire_mm = 0;
    for (std::size_t k = 0; k < count; ++k) {
      wire_mm += 2 * (bores[2 * k].centre_mm - bores[2 * k + 1].centre_mm).norm() + kTwist_mm;
    }
    return row(part, count,
               input_.length(wire_mm, 0) + " of wire for bores of " +
                   input_.length(*input_.options.joint_bore_mm, 2));
  }

  std::string filling() const {
    const solver::Filling filling = solver::filling_of(sheet_, input_.fill());
    const auto parts =
        filling.is_springs() ? (filling.rates_n_per_mm().array() > 0).count() : filling.holes();
    const auto at = static_cast<std::size_t>(input_.actuation.from_row);
    return row(fill_words(input_.fill(), sheet_.mechanism().diagonal_count()),
               static_cast<std::size_t>(parts),
               fmt::format("{:.4g} N mm at {:.10g}°", input_.actuation.energy_n_mm[at],
                           input_.from_deg()));
  }

  std::string holder() const {
    if (!input_.design.hold_flat.value_or(false)) return "";
    return row("stop, latch or frame that holds the sheet flat", 1, "");
  }

  // Equal springs: of one rate, and of one free length to the tenth of a millimetre.
  std::string groups() const {
    if (!std::holds_alternative<solver::Springs>(input_.fill())) return "";
    const solver::Filling filling = solver::filling_of(sheet_, input_.fill());
    const bool pull_only = std::get<solver::Springs>(input_.fill()).pull_only;
    struct Group {
      std::vector<std::string> names;
      double longest_mm = 0, force_n = 0;
    };
    std::map<std::pair<std::string, std::string>, Group> groups;
    for (int d = 0; d < sheet_.mechanism().diagonal_count(); ++d) {
      const double rate_n_per_mm = filling.rates_n_per_mm()(d);
      if (rate_n_per_mm == 0) continue;
      const auto at = static_cast<std::size_t>(d);
      const auto [flat_mm, folded_mm] = kit_spring_lengths(input_, d);
      const double free_mm = flat_mm + input_.actuation.free_mm[at] - sheet_.history().flat_mm[at];
      Group& group = groups[{fmt::format("{:.4g} N/mm", rate_n_per_mm), input_.length(free_mm, 1)}];
      group.names.push_back("s" + std::to_string(d));
      group.longest_mm = std::max({group.longest_mm, flat_mm, folded_mm});
      for (const double length_mm : {flat_mm, folded_mm}) {
        const bool is_slack = pull_only && length_mm < free_mm;
        if (!is_slack) {
          group.force_n = std::max(group.force_n, rate_n_per_mm * std::abs(length_mm - free_mm));
        }
      }
    }
    std::vector<std::vector<std::string>> rows;
    for (const auto& [kind, group] : groups) {
      rows.push_back({std::to_string(group.names.size()), kind.first, kind.second,
                      input_.length(group.longest_mm, 1), fmt::format("{:.1f} N", group.force_n),
                      fmt::format("{}", fmt::join(group.names, " "))});
    }
    return "<h2>Groups of equal springs</h2>\n" +
           page_tables({"number", "rate", "free length", "longest", "largest force", "springs"},
                       rows, 6);
  }

  std::string thickness() const {
    if (!input_.contact || !input_.contact->thickness) return "";
    const bool meets = input_.contact->reach_deg < input_.contact->used_from_deg;
    if (meets) {
      return fmt::format(
          "<p>Panels come into contact at {:.4g}°: plates of no thickness reach {:.10g}°.</p>\n",
          input_.contact->reach_deg, input_.contact->used_from_deg);
    }
    if (input_.options.crease == CreaseCut::offset) return "";  // they have another
    return fmt::format(
        "<p>Largest panel thickness to fold to {:.10g}°: {}, with hinges at the mid-plane, edges "
        "tapered at creases, and corners trimmed by {}.</p>\n",
        input_.contact->used_from_deg, input_.length(input_.contact->thickness->thickness_mm, 2),
        input_.length(input_.contact->trim_mm, 1));
  }

  const GuideInput& input_;
  const solver::Sheet& sheet_;
};

}  // namespace

std::string kit_bill(const GuideInput& input) { return Bill(input).text(); }

}  // namespace misalign::schema
