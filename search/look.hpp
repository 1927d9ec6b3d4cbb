// Verbs that look at single patterns: `fold`, `perforations`, `replay` and `export`.
#pragma once

#include <optional>
#include <string>

#include "schema/folding_json.hpp"

namespace misalign::search {

struct FoldOptions {
  std::string pattern_path;
  double to_deg = 180;
  double step_deg = 0;  ///< further angles to look at; 0: none
  bool json = false;
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
  bool json = false;
};
void replay(const ReplayOptions& options);

struct ExportOptions {
  std::string catalogue_path;
  std::optional<std::uint64_t> draw, best;
  std::string by = "deploys_from_deg";
  std::string where;  ///< SQL condition on the candidates view
  std::string format = "json";
  std::string output;
};
void export_candidates(const ExportOptions& options);

}  // namespace misalign::search
