#include "schema/kit/kit_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "schema/kit/part_item.hpp"

namespace misalign::schema {
namespace {

using solver::OptionFault;

void refuse_options(const KitOptions& options) {
  const std::string kerf = fmt::format("the kerf of {:g} mm", options.kerf_mm);
  if (options.gap_mm < options.kerf_mm) {
    throw UserError(OptionFault{"gap_mm", fmt::format("{:g}", options.gap_mm),
                                "less than " + kerf + " (parts would be cut into one another)",
                                "take a larger gap"});
  }
  if (options.crease == CreaseCut::dash && options.dash_mm <= options.kerf_mm) {
    throw UserError(OptionFault{
        "dash_mm", fmt::format("{:g},{:g}", options.dash_mm, options.bridge_mm),
        "a cut no longer than " + kerf + " (nothing would be left to draw)", "take longer ones"});
  }
}

class KitMaker {
 public:
  KitMaker(const solver::Sheet& sheet, const KitOptions& options, KitFittings fittings)
      : sheet_(sheet), options_(options), layout_(options), fittings_(std::move(fittings)) {}

  Kit kit(const std::string& title) {
    Kit kit;
    kit.fittings = fittings_;
    kit.springs = kit_springs(sheet_, fittings_, kit_rows(sheet_, options_.from_deg));
    kit.warning = contradiction_of(kit.springs);
    for (const KitPart& part : kit_parts(sheet_, options_.crease)) {
      std::vector<KitPart> pieces = divided_to_fit(part);
      if (pieces.size() > 1) add_cuts(part, pieces, kit.cuts);
      for (KitPart& piece : pieces) kit.parts.push_back(std::move(piece));
    }
    std::vector<KitItem> items;
    for (const KitPart& part : kit.parts) items.push_back(item_of(part));
    kit.sheets = layout_.laid_out(items, title);
    return kit;
  }

 private:
  KitItem item_of(const KitPart& part) const {
    return part_item(sheet_, part, fittings_, options_);
  }
  bool fits(const KitPart& part) const {
    return layout_.has_room(
        nest_shape(part_outline(sheet_, part, fittings_, options_.kerf_mm).rings, options_.turns));
  }

  // Divides a part along creases by the grid with the fewest cells in which everything fits.
  std::vector<KitPart> divided_to_fit(const KitPart& part) const {
    if (!options_.bed_mm) return {part};
    const auto [rows, columns] = rows_and_columns(sheet_, part);
    for (int cells = 1; cells <= rows * columns; ++cells) {
      for (int down = 1; down <= std::min(cells, rows); ++down) {
        if (cells % down != 0 || cells / down > columns) continue;
        std::vector<KitPart> pieces = divided(sheet_, part, down, cells / down);
        if (std::ranges::all_of(pieces, [&](const KitPart& piece) { return fits(piece); })) {
          return pieces;
        }
      }
    }
    for (const KitPart& panel : divided(sheet_, part, rows, columns)) {
      layout_.expect_room("panel " + panel_label(sheet_, panel.facets[0]), item_of(panel));
    }
    return {};  // not reached: single panels fit
  }

  static void add_cuts(const KitPart& part, const std::vector<KitPart>& pieces,
                       std::vector<int>& cuts) {
    for (const int c : part.creases) {
      const bool kept = std::ranges::any_of(pieces, [&](const KitPart& piece) {
        return std::ranges::binary_search(piece.creases, c);
      });
      if (!kept) cuts.push_back(c);
    }
  }

  const solver::Sheet& sheet_;
  const KitOptions& options_;
  const KitLayout layout_;
  const KitFittings fittings_;
};

}  // namespace

Kit kit_of(const solver::Sheet& sheet, const KitOptions& options, const std::string& title) {
  refuse_options(options);
  return KitMaker(sheet, options, kit_fittings(sheet, options)).kit(title);
}

KitSheets kit_spacer_sheets(const solver::Sheet& sheet, const Kit& kit, const KitOptions& options,
                            const std::string& title) {
  if (!options.plates || options.plates->spacer_mm == 0) return {};
  KitOptions spacers = options;
  spacers.plates->thickness_mm = std::exchange(spacers.plates->spacer_mm, 0);
  KitFittings fittings = kit.fittings;
  fittings.edges = PlateEdges(sheet, spacers);
  return KitMaker(sheet, spacers, std::move(fittings)).kit(title).sheets;
}

}  // namespace misalign::schema
