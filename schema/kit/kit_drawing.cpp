#include "schema/kit/kit_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/kit/kit_layout.hpp"
#include "schema/kit/kit_notes.hpp"
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
    if (options_.crease != CreaseCut::cut) note_loose_panels(parts);
    if (sheet_.shifts_mm().isZero(0)) notes_.emplace_back("no vertex is shifted");
    if (!springs_.empty() && options_.spring_at != SpringAt::panel &&
        sheet_.base().springs.at_vertices()) {
      notes_.emplace_back("springs end on vertices: in a tab's bore, or in a ball joint's wire");
    }
    if (options_.bed_mm) parts = fitted(parts);
    std::vector<KitItem> items;
    for (const KitPart& part : parts) {
      items.push_back(part_item(sheet_, part, fittings_, options_));
    }
    return {laid_out(std::move(items)), warning_};
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
    const char* creases = options_.crease == CreaseCut::cut     ? "creases cut"
                          : options_.crease == CreaseCut::score ? "creases scored"
                                                                : "creases perforated";
    std::vector<std::string> lines;
    if (!warning_.empty()) lines.push_back("WARNING: " + warning_);
    lines.push_back(title_);
    lines.push_back(fmt::format("kit to cut (mm), sheet {} of {}; {}; kerf {:g}", bed + 1, beds,
                                creases, options_.kerf_mm));
    lines.insert(lines.end(), notes_.begin(), notes_.end());
    return lines;
  }

  // The room of a bed for parts, within its margin and above its heading.
  Vector2d room_mm() const {
    const Vector2d inside = *options_.bed_mm - Vector2d::Constant(2 * options_.margin_mm);
    constexpr std::size_t kMany = 999;
    const double heading_mm =
        kit_heading(sentences(kMany, kMany), std::max(inside.x(), kLeastHeading_mm)).size_mm().y();
    return {inside.x(), inside.y() - heading_mm - options_.gap_mm};
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
  std::vector<KitPart> fitted(const std::vector<KitPart>& parts) {
    check_bed();
    std::vector<KitPart> smaller;
    for (const KitPart& part : parts) {
      std::vector<KitPart> cut = divided_to_fit(part, room_mm());
      if (cut.size() > 1) note_cuts(part, cut);
      smaller.insert(smaller.end(), cut.begin(), cut.end());
    }
    return smaller;
  }

  [[noreturn]] void refuse_bed(const std::string& why) const {
    throw UserError(
        OptionFault{"bed", fmt::format("{:g}x{:g}", options_.bed_mm->x(), options_.bed_mm->y()),
                    why, "take a larger bed"});
  }

  void check_bed() const {
    const Vector2d inside = *options_.bed_mm - Vector2d::Constant(2 * options_.margin_mm);
    if (inside.x() >= kLeastHeading_mm && room_mm().y() > 0) return;
    refuse_bed(fmt::format(
        "too small for the title and a gauge of 100 mm (they take {:g} x {:g} mm, and {} round it)",
        kLeastHeading_mm, inside.y() - room_mm().y(),
        parameter("margin_mm", fmt::format("{:g}", options_.margin_mm))));
  }

  void expect_room(const std::string& what, const LayoutBox& box, const Vector2d& room_mm) const {
    if (fits_bed(box, room_mm)) return;
    refuse_bed(fmt::format(
        "{} does not fit{} (its size is {:.1f} x {:.1f} mm, and margin and heading leave "
        "{:.1f} x {:.1f})",
        what, box.may_turn ? ", turned or not" : "", box.size_mm.x(), box.size_mm.y(), room_mm.x(),
        room_mm.y()));
  }

  // Divides a part by the grid with the fewest cells in which everything fits.
  std::vector<KitPart> divided_to_fit(const KitPart& part, const Vector2d& room_mm) const {
    const auto [rows, columns] = rows_and_columns(sheet_, part);
    for (int cells = 1; cells <= rows * columns; ++cells) {
      for (int down = 1; down <= std::min(cells, rows); ++down) {
        if (cells % down != 0 || cells / down > columns) continue;
        std::vector<KitPart> smaller = divided(sheet_, part, down, cells / down);
        if (fit(smaller, room_mm)) return smaller;
      }
    }
    for (const KitPart& panel : divided(sheet_, part, rows, columns)) {
      expect_room("panel " + panel_label(sheet_, panel.facets[0]), box_of(panel), room_mm);
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

  std::vector<LineDrawing> laid_out(std::vector<KitItem> items) const {
    const double gap_mm = options_.gap_mm;
    const Vector2d margin = Vector2d::Constant(options_.margin_mm);
    Vector2d room(0, INFINITY);
    if (options_.bed_mm) room = room_mm();
    for (KitItem& block : kit_tables(sheet_, springs_, cuts_, room.y()))
      items.push_back(std::move(block));
    std::vector<LayoutBox> boxes;
    for (const KitItem& item : items) boxes.push_back({item.size_mm(), item.may_turn});
    if (options_.bed_mm) {
      for (const LayoutBox& box : boxes) expect_room("a table of the notes", box, room);
    } else {
      room.x() = std::max(sheet_width_mm(boxes, gap_mm), kLeastHeading_mm);
    }
    const std::vector<LaidOut> laid = lay_out(boxes, room, gap_mm);
    std::size_t beds = 1;
    Vector2d used(0, 0);
    for (std::size_t k = 0; k < laid.size(); ++k) {
      const Vector2d& size = boxes[k].size_mm;
      beds = std::max(beds, static_cast<std::size_t>(laid[k].bed) + 1);
      used = used.cwiseMax(laid[k].at_mm + (laid[k].turned ? size.reverse().eval() : size));
    }
    if (!options_.bed_mm) room.x() = std::max(used.x(), kLeastHeading_mm);
    std::vector<KitItem> sheets;
    for (std::size_t bed = 0; bed < beds; ++bed) {
      const KitItem heading = kit_heading(sentences(bed, beds), room.x());
      const Vector2d page =
          options_.bed_mm ? *options_.bed_mm
                          : Vector2d(2 * margin +
                                     Vector2d(room.x(), used.y() + gap_mm + heading.size_mm().y()));
      sheets.push_back(empty_item({0, 0}, page));
      sheets.back().drawing.title = title_;
      sheets.back().add(heading, margin, false);
    }
    for (std::size_t k = 0; k < items.size(); ++k) {
      KitItem& sheet = sheets[static_cast<std::size_t>(laid[k].bed)];
      const double height = laid[k].turned ? boxes[k].size_mm.x() : boxes[k].size_mm.y();
      sheet.add(items[k],
                {margin.x() + laid[k].at_mm.x(),
                 sheet.drawing.most_mm.y() - margin.y() - laid[k].at_mm.y() - height},
                laid[k].turned);
    }
    std::vector<LineDrawing> drawings;
    for (KitItem& sheet : sheets) {
      std::erase_if(sheet.drawing.layers, [](const LineLayer& layer) { return layer.is_empty(); });
      drawings.push_back(std::move(sheet.drawing));
    }
    return drawings;
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
