// `misalign actuators`: springs on the diagonals of one sheet.
#pragma once

#include <optional>
#include <string>

#include "search/checks/folded_sheet.hpp"

namespace misalign::search {

struct ActuatorsOptions {
  std::string path;                   ///< a catalogue or a pattern file
  std::optional<std::uint64_t> draw;  ///< of a catalogue's campaign, accepted or not
  OtherActuators actuators;
  bool json = false;
};

void show_actuators(const ActuatorsOptions& options);

}  // namespace misalign::search
