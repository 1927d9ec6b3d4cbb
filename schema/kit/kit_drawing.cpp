#include "schema/kit/kit_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/kit/joint_words.hpp"
#include "schema/kit/kit_notes.hpp"
#include "schema/kit/kit_pages.hpp"
#include "schema/kit/part_item.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;
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

std::string listed(const std::string& what, const std::vector<std::string>& names) {
  return fmt::format("{}: {}", what, fmt::join(names, ", "));
}

class Kit {
 public:
  Kit(const solver::Sheet& sheet, const KitOptions& options, const std::string& title)
      : sheet_(sheet),
        options_(options),
        title_(title),
        fittings_(kit_fittings(sheet, options)),
        springs_(kit_springs(sheet, fittings_)),
        warning_(contradiction_of(springs_)) {}

  KitDrawings drawings() {
    std::vector<KitPart> parts = kit_parts(sheet_, options_.crease);
    if (!are_apart(options_.crease)) note_loose_panels(parts);
    if (sheet_.shifts_mm().isZero(0)) notes_.emplace_back("no vertex is shifted");
    if (!springs_.empty() && options_.spring_at != SpringAt::panel &&
        sheet_.base().springs.at_vertices()) {
      notes_.emplace_back("springs end on vertices: in a tab's bore, or in a ball joint's wire");
    }
    if (const std::string words = joint_words(sheet_, options_); !words.empty()) {
      notes_.push_back(words);
    }
    const KitPages pages(options_, title_, [this](std::size_t page, std::size_t count) {
      return sentences(page, count);
    });
    if (options_.bed_mm) parts = fitted(pages, parts);
    std::vector<KitItem> items;
    for (const KitPart& part : parts) {
      items.push_back(part_item(sheet_, part, fittings_, options_));
    }
    return {laid_out(pages, std::move(items)), warning_};
  }

 private:
  // Notes panels that no crease holds.
  void note_loose_panels(const std::vector<KitPart>& parts) {
    std::vector<std::string> names;
    for (std::size_t p = 1; p < parts.size(); ++p) {
      for (const int f : parts[p].facets) names.push_back(panel_label(sheet_, f));
    }
    if (!names.empty()) notes_.push_back(listed("panels held by ball joints alone", names));
  }

  std::vector<std::string> sentences(std::size_t bed, std::size_t beds) const {
    const char* creases = are_apart(options_.crease)            ? "creases cut"
                          : options_.crease == CreaseCut::score ? "creases scored"
                                                                : "creases perforated";
    std::vector<std::string> lines;
    if (!warning_.empty()) lines.push_back("WARNING: " + warning_);
    lines.push_back(title_);
    lines.push_back(fmt::format("kit to cut (mm), sheet {} of {}; {}; kerf {:g}", bed + 1, beds,
                                creases, options_.kerf_mm));
    if (!fittings_.edges.words().empty()) lines.push_back(fittings_.edges.words());
    lines.insert(lines.end(), notes_.begin(), notes_.end());
    return lines;
  }

  LayoutBox box_of(const KitPart& part) const {
    const PartOutline outline = part_outline(sheet_, part, fittings_, options_.kerf_mm);
    return {outline.most_mm() - outline.least_mm(), true};
  }
  bool fit(const std::vector<KitPart>& parts, const Vector2d& room_mm) const {
    return std::all_of(parts.begin(), parts.end(),
                       [&](const KitPart& part) { return fits_bed(box_of(part), room_mm); });
  }

  // Cuts parts that are too large for the bed along creases.
  std::vector<KitPart> fitted(const KitPages& pages, const std::vector<KitPart>& parts) {
    std::vector<KitPart> smaller;
    for (const KitPart& part : parts) {
      std::vector<KitPart> cut = divided_to_fit(pages, part);
      if (cut.size() > 1) note_cuts(part, cut);
      smaller.insert(smaller.end(), cut.begin(), cut.end());
    }
    return smaller;
  }

  // Divides a part by the grid with the fewest cells in which everything fits.
  std::vector<KitPart> divided_to_fit(const KitPages& pages, const KitPart& part) const {
    const Vector2d room_mm = pages.room_mm();
    const auto [rows, columns] = rows_and_columns(sheet_, part);
    for (int cells = 1; cells <= rows * columns; ++cells) {
      for (int down = 1; down <= std::min(cells, rows); ++down) {
        if (cells % down != 0 || cells / down > columns) continue;
        std::vector<KitPart> smaller = divided(sheet_, part, down, cells / down);
        if (fit(smaller, room_mm)) return smaller;
      }
    }
    for (const KitPart& panel : divided(sheet_, part, rows, columns)) {
      pages.expect_room("panel " + panel_label(sheet_, panel.facets[0]), box_of(panel));
    }
    return {};  // not reached: single panels fit
  }

  void note_cuts(const KitPart& part, const std::vector<KitPart>& smaller) {
    for (const int c : part.creases) {
      const bool kept = std::any_of(smaller.begin(), smaller.end(), [&](const KitPart& piece) {
        return std::binary_search(piece.creases.begin(), piece.creases.end(), c);
      });
      if (!kept) cuts_.push_back(c);
    }
  }

  std::vector<LineDrawing> laid_out(const KitPages& pages, std::vector<KitItem> items) const {
    for (KitItem& block : kit_tables(sheet_, springs_, cuts_, pages.room_mm().y())) {
      pages.expect_room("a table of the notes", {block.size_mm(), block.may_turn});
      items.push_back(std::move(block));
    }
    return pages.laid_out(items);
  }

  const solver::Sheet& sheet_;
  const KitOptions& options_;
  const std::string title_;
  const KitFittings fittings_;
  const std::vector<KitSpring> springs_;
  const std::string warning_;
  std::vector<std::string> notes_;
  std::vector<int> cuts_;  // creases along which parts were cut to fit the bed
};

}  // namespace

KitDrawings kit_drawings(const solver::Sheet& sheet, const KitOptions& options,
                         const std::string& title) {
  refuse_options(options);
  return Kit(sheet, options, title).drawings();
}

}  // namespace misalign::schema
