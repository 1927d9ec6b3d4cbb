#include "schema/kit/guide_input.hpp"

namespace misalign::schema {

SpringLengths kit_spring_lengths(const GuideInput& input, int diagonal) {
  for (const KitSpring& spring : input.kit.springs) {
    if (spring.from.spring == diagonal) return {spring.length_mm.front(), spring.length_mm.back()};
  }
  return diagonal_lengths(input.sheet, input.actuation, diagonal);
}

}  // namespace misalign::schema
