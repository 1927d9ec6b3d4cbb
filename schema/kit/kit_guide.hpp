// Writes the guide of a kit: its parts and its assembly, with pictures.
#pragma once

#include <string>

#include "schema/kit/kit_options.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::schema {

struct GuideInput {
  const solver::Sheet& sheet;
  const KitOptions& options;
  const Design& design;
  const solver::Actuation& actuation;   ///< the design's springs, from its angle of use or D
  const solver::ContactStudy* contact;  ///< null: not studied
  std::string title, warning;           ///< warning: springs that contradict the verdict, if any
};

/// A self-contained page to print, as HTML. Lengths in mm, forces in N.
std::string kit_guide(const GuideInput& input);

}  // namespace misalign::schema
