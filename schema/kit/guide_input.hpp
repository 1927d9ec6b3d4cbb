// The input of all sections of a kit's guide.
#pragma once

#include <string>

#include "schema/kit/kit_drawing.hpp"
#include "schema/kit/page_parts.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::schema {

struct GuideInput {
  const solver::Sheet& sheet;
  const KitOptions& options;
  const Kit& kit;
  const Design& design;
  const solver::Actuation& actuation;   ///< the design's springs, from its angle of use or D
  const solver::ContactStudy* contact;  ///< null: not studied
  std::string title;

  const solver::Fill& fill() const { return actuation.actuators.fill; }
  /// The angle of use; 0 where the sheet deploys from nothing.
  double from_deg() const {
    return actuation.pilot_deg[static_cast<std::size_t>(actuation.from_row)];
  }
  std::string length(double length_mm, int decimals = 1) const {
    return length_text(length_mm, options.unit, decimals);
  }
};

/// Lengths of a spring when flat and at the angle of use; of its diagonal where the kit has no
/// ends.
SpringLengths kit_spring_lengths(const GuideInput& input, int diagonal);

}  // namespace misalign::schema
