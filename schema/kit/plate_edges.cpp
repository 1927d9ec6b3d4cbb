#include "schema/kit/plate_edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/files/user_error.hpp"
#include "schema/kit/kit_hinges.hpp"
#include "schema/kit/panel_corner.hpp"
#include "solver/contact/plate_thickness.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::schema {
namespace {

using solver::OptionFault;

// The side of a panel at hinges of a kind.
PlateEdge edge_at(const KitHinges& hinges, bool valley, CreaseCut crease,
                  const PlateOptions& plates) {
  const double half_mm = 0.5 * plates.thickness_mm,
               half_rad = hinges.bevel_deg() * solver::kRadPerDeg, clear_mm = plates.clearance_mm;
  PlateEdge edge;
  edge.valley = valley;
  if (crease == CreaseCut::film) {
    edge.back_mm = 0.5 * (std::max(hinges.gap_mm(plates.thickness_mm), plates.film_mm) + clear_mm);
  } else if (crease == CreaseCut::bevel) {
    edge.back_mm = 0.5 * clear_mm;
    constexpr double kRounding_deg = 1e-6;
    edge.bevel_deg = std::ceil(hinges.bevel_deg() - kRounding_deg);
    edge.bevel_mm = half_mm * std::tan(edge.bevel_deg * solver::kRadPerDeg);
  } else if (crease == CreaseCut::pin) {
    edge.back_mm = std::max(0.5 * plates.barrel_mm, half_mm / std::cos(half_rad)) + clear_mm;
  } else if (crease == CreaseCut::offset) {
    const double height_mm = plates.spacer_mm + plates.thickness_mm;
    edge.back_mm =
        std::max(valley ? hinges.gap_mm(height_mm) : 0, 0.5 * plates.film_mm) + 0.5 * clear_mm;
  }
  return edge;
}

// Hinges of a kind: "gap 2.380 mm (mountains up to 100.0 deg)".
std::string words_of(CreaseCut crease, const PlateEdge& edge, const KitHinges& hinges) {
  const std::string up_to = fmt::format("{}s up to {:.1f}", hinges.name, hinges.fold_deg);
  if (crease == CreaseCut::film || crease == CreaseCut::offset) {
    return fmt::format("gap {:.3f} mm ({} deg)", 2 * edge.back_mm, up_to);
  }
  if (crease == CreaseCut::bevel) return fmt::format("bevel {:g} deg ({})", edge.bevel_deg, up_to);
  return fmt::format("edges {:.3f} mm off the axis ({} deg)", edge.back_mm, up_to);
}

void refuse_misfit(const solver::Sheet& sheet, Eigen::Index rows, const PlateOptions& plates,
                   std::string& words) {
  const FaceHingeMisfit misfit = face_hinge_misfit(sheet, rows);
  if (misfit.loop == nullptr) return;
  const std::string gap =
      fmt::format("plates of {:g} mm that are hinged on their faces miss by {:.3g} mm round {}",
                  plates.thickness_mm, misfit.per_mm * plates.thickness_mm, misfit.place(sheet));
  words += "; " + gap;
  if (misfit.per_mm <= kMostMisfit || plates.allows_misfit) return;
  throw UserError(
      OptionFault{"crease", "butt", fmt::format("{}, more than a tenth of their thickness", gap),
                  fmt::format("take film, bevel or pin, a smaller angle of use, or consent by {}",
                              parameter("allow_misfit"))});
}

}  // namespace

PlateEdges::PlateEdges(const solver::Sheet& sheet, const KitOptions& options) {
  if (!options.plates) return;
  const PlateOptions& plates = *options.plates;
  const Eigen::Index rows = solver::rows_of_use(sheet, options.from_deg);
  if (rows == 0) {
    throw UserError(OptionFault{"crease", std::string(crease_name(options.crease)),
                                sheet.name() + " does not deploy (D = 0), so that its hinges have "
                                               "no largest fold angle",
                                "take " + parameter("crease", "cut")});
  }
  thickness_mm_ = plates.thickness_mm;
  reach_mm_ =
      options.crease == CreaseCut::offset ? plates.spacer_mm + thickness_mm_ : 0.5 * thickness_mm_;
  const KitHinges mountains(sheet, false, rows), valleys(sheet, true, rows);
  mountain_ = edge_at(mountains, false, options.crease, plates);
  valley_ = edge_at(valleys, true, options.crease, plates);
  words_ = fmt::format("plates of {:g} mm, hinges: {}", thickness_mm_, crease_name(options.crease));
  if (options.crease == CreaseCut::butt) {
    refuse_misfit(sheet, rows, plates, words_);
  } else {
    trim_mm_ = plates.trim_mm;
    words_ += "; " + words_of(options.crease, mountain_, mountains) + "; " +
              words_of(options.crease, valley_, valleys);
    if (options.crease == CreaseCut::offset) {
      words_ += "; films and hooks of springs in one plane below all plates";
      if (plates.spacer_mm > 0) {
        words_ += fmt::format(", with spacers of {:g} mm on them", plates.spacer_mm);
      }
    }
    if (trim_mm_ > 0)
      words_ += fmt::format("; corners that meet in a point trimmed by {:g} mm", trim_mm_);
  }
  const auto& pattern = sheet.base().sheet;
  edges_.resize(static_cast<std::size_t>(pattern.facet_count()));
  trimmed_.resize(edges_.size());
  const auto trimmed = solver::trimmed_corners(sheet.panels());
  for (std::size_t p = 0; p < trimmed.size(); ++p) {
    trimmed_[static_cast<std::size_t>(sheet.panels().facets[p])] = trimmed[p];
  }
  const auto& creases = sheet.mechanism().creases;
  for (std::size_t c = 0; c < creases.size(); ++c) {
    const bool valley = sheet.mechanism().is_valley(creases[c]);
    for (const int facet : {creases[c].left, creases[c].right}) {
      const auto& around = pattern.facets[static_cast<std::size_t>(facet)];
      for (std::size_t k = 0; k < 4; ++k) {
        if (std::minmax(around[k], around[(k + 1) % 4]) !=
            std::minmax(creases[c].a, creases[c].b)) {
          continue;
        }
        PlateEdge& edge = edges_[static_cast<std::size_t>(facet)][k];
        edge = hinge(valley);
        edge.crease = static_cast<int>(c);
      }
    }
  }
}

const PlateEdge& PlateEdges::edge(int facet, std::size_t side) const {
  static constexpr PlateEdge kFree;
  return are_plates() ? edges_[static_cast<std::size_t>(facet)][side] : kFree;
}

std::array<double, 4> PlateEdges::back_mm(int facet) const {
  std::array<double, 4> back_mm;
  for (std::size_t k = 0; k < 4; ++k) back_mm[k] = edge(facet, k).back_mm;
  return back_mm;
}

double PlateEdges::trim_mm(int facet, std::size_t corner) const {
  return are_plates() && trimmed_[static_cast<std::size_t>(facet)][corner] ? trim_mm_ : 0;
}

double PlateEdges::tab_radius_mm(const solver::Sheet& sheet, int facet, int vertex,
                                 double bare_mm) const {
  const auto& around = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  const auto k = static_cast<std::size_t>(solver::corner_of(around, vertex));
  const double back_mm = std::max(edge(facet, k).back_mm, edge(facet, (k + 3) % 4).back_mm);
  if (back_mm == 0) return bare_mm;
  const double sine = PanelCorner(sheet, facet, vertex).sine;
  return std::hypot(back_mm, bare_mm + back_mm * std::sqrt(1 - sine * sine) / sine);
}

}  // namespace misalign::schema
