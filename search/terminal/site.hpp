// Where the site of the manual is.
#pragma once

#include <filesystem>
#include <optional>

namespace misalign::search {

/// The folder of its pages, beside an installed program or a program in its build folder; none
/// where the site was not made.
std::optional<std::filesystem::path> place_of_site();

}  // namespace misalign::search
