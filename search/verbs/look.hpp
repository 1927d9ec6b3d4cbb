// Verbs that look at single patterns: `fold`, `perforations` and `replay`.
#pragma once

#include <optional>
#include <string>

#include "schema/exchange/folding_json.hpp"

namespace misalign::search {

struct FoldOptions {
  std::string pattern_path;
  std::optional<double> to_deg;  ///< the file's own end, or 180
  double step_deg = 0;           ///< further angles to look at; 0: none
  bool json = false, table = false;
};
void fold(const FoldOptions& options);

struct PerforationsOptions {
  std::string pattern_path;  ///< its holes are not looked at
  bool json = false;
};
void list_perforations(const PerforationsOptions& options);

struct ReplayOptions {
  std::string catalogue_path;
  std::uint64_t draw = 0;
  bool json = false, table = false;
};
void replay(const ReplayOptions& options);

}  // namespace misalign::search
