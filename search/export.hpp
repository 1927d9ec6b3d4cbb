// `misalign export`: chosen candidates as files.
#pragma once

#include "search/choice.hpp"
#include "search/folded_draw.hpp"

namespace misalign::search {

enum class ExportFormat { json, csv, fold, svg, obj };

struct ExportOptions {
  std::string catalogue_path;
  Choice choice;
  ExportFormat format = ExportFormat::json;
  double step_deg = 10;  ///< between two states of `fold` and `obj`
  OtherActuators actuators;
  std::string output;  ///< directory
};

/// Writes each candidate's files whole or not at all, and prints their names.
void export_candidates(const ExportOptions& options);

}  // namespace misalign::search
