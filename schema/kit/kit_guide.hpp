// A page to build a kit by: what it takes, and how it goes together, with pictures.
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
  const solver::Actuation& actuation;   ///< of the design's springs, from its angle of use or D
  const solver::ContactStudy* contact;  ///< null: not looked at
  std::string title, warning;           ///< of springs that contradict the verdict; or empty
};

/// HTML that prints, complete in itself. Lengths in mm, forces in N.
std::string kit_guide(const GuideInput& input);

}  // namespace misalign::schema
