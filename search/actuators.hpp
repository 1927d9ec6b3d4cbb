// `misalign actuators`: springs on the diagonals of one draw.
#pragma once

#include "search/folded_draw.hpp"

namespace misalign::search {

struct ActuatorsOptions {
  std::string catalogue_path;
  std::uint64_t draw = 0;  ///< accepted or not
  OtherActuators actuators;
  bool json = false;
};

void show_actuators(const ActuatorsOptions& options);

}  // namespace misalign::search
