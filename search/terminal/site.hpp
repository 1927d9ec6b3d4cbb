// Finds the site of the manual.
#pragma once

#include <filesystem>
#include <optional>

namespace misalign::search {

/// Returns the folder of its pages, beside an installed program or in the build folder; none if the
/// site was not built.
std::optional<std::filesystem::path> place_of_site();

}  // namespace misalign::search
