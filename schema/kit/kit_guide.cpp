#include "schema/kit/kit_guide.hpp"

#include <fmt/format.h>

#include "schema/exchange/xml_text.hpp"
#include "schema/kit/joint_words.hpp"
#include "schema/kit/kit_bill.hpp"
#include "schema/kit/kit_notes.hpp"
#include "schema/kit/kit_springs_way.hpp"
#include "schema/kit/kit_steps.hpp"
#include "schema/kit/page_parts.hpp"
#include "schema/kit/sheet_pictures.hpp"

namespace misalign::schema {
namespace {

// The sheets of material: their number, its lower bound, pictures, and the registration marks.
std::string material_sheets(const GuideInput& input) {
  constexpr double kCm2_mm2 = 100;
  const KitSheets& sheets = input.kit.sheets;
  std::string text = fmt::format(
      "<h2>Sheets of material</h2>\n<p>{} of {} × {}; parts of {:.0f} cm² need at least {}. The "
      "last "
      "is used up to a height of {}. Kerf {}. Registration marks, bores of {}, are {} apart along "
      "the lower edge and {} along the left one: by them a sheet is placed again, or turned over "
      "to engrave its back.</p>\n",
      sheets.beds.size(), input.length(sheets.size_mm.x()), input.length(sheets.size_mm.y()),
      sheets.area_mm2 / kCm2_mm2, sheets.least_beds(), input.length(sheets.used_mm),
      input.length(input.options.kerf_mm, 2), input.length(kMark_mm),
      input.length(sheets.marks_mm[1].x() - sheets.marks_mm[0].x(), 2),
      input.length(sheets.marks_mm[2].y() - sheets.marks_mm[0].y(), 2));
  for (std::size_t bed = 0; bed < sheets.beds.size(); ++bed) {
    text += bed_picture(input.sheet, input.kit, bed);
  }
  return text;
}

// Layers of the drawings in the order in which a machine follows them.
std::string layer_table(const GuideInput& input) {
  std::string text = "<h2>Layers, in the order of the machine</h2>\n" +
                     table_begin({"layer", "colour", "work"}, 3);
  const auto meaning = [](const std::string& name) {
    return name == "registration"      ? "cut first: bores to place the sheet again"
           : name == "hinge"           ? "not cut: axes of hinges"
           : name == "engrave"         ? "engrave: numbers"
           : name.starts_with("score") ? "score"
           : name.starts_with("dash")  ? "perforate"
           : name == "cut"             ? "cut last: outer contours"
                                       : "cut: inner contours";
  };
  for (const LineLayer& layer : input.kit.sheets.beds[0].layers) {
    text += fmt::format(
        "<tr><td>{}</td><td><span class=\"swatch\" style=\"background:{}\"></span> {}</td>"
        "<td>{}</td></tr>\n",
        layer.name, layer.colour.rgb, layer.colour.rgb, meaning(layer.name));
  }
  return text + kTableEnd;
}

}  // namespace

std::string kit_guide(const GuideInput& input) {
  std::string text = page_begin(input.title, PageStyle::guide);
  if (!input.kit.warning.empty()) {
    text += page_banner(BannerKind::caution, "Springs contradict the verdict", input.kit.warning);
  }
  const std::optional<double>& wanted_deg = input.design.from_deg;
  if (wanted_deg && !input.options.from_deg) {
    text += page_banner(
        BannerKind::caution, "Beyond the deployment angle",
        fmt::format("The angle of use, {:.10g}°, lies beyond D = {:.10g}°, from which the sheet "
                    "deploys: all values end at D.",
                    *wanted_deg, input.sheet.deploys_from_deg()));
  }
  const KitFittings& fittings = input.kit.fittings;
  if (const std::string& words = fittings.edges.words(); !words.empty()) {
    text += "<p>" + xml_text(words) + "</p>\n";
  }
  return text + kit_bill(input) + material_sheets(input) + layer_table(input) + kit_steps(input) +
         joint_section(input.sheet, input.options) +
         springs_way_section(input.sheet, input.design, fittings, input.from_deg()) +
         (input.options.crease == CreaseCut::offset
              ? ""  // which is said above
              : hinge_table(input.sheet, input.design.thickness_mm, input.actuation.from_row,
                            input.from_deg(), input.options.unit)) +
         filling_table(
             input.sheet, input.actuation,
             [&](int diagonal) { return kit_spring_lengths(input, diagonal); },
             input.options.unit) +
         kit_tables(input.sheet, input.kit, input.options) + kPageEnd;
}

}  // namespace misalign::schema
