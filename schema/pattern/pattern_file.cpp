#include "schema/pattern/pattern_file.hpp"

#include <algorithm>

#include "schema/pattern/carried_pattern.hpp"
#include "schema/pattern/design_json.hpp"
#include "schema/pattern/fold_frames.hpp"
#include "schema/pattern/pattern_document.hpp"

namespace misalign::schema {

bool is_campaign(const Json& document) {
  return document.is_object() && document.contains("pattern") && !document.contains("draw") &&
         !document.contains("sampling");
}

PatternFile read_sampled_pattern_file(const std::string& path, Perforations perforations) {
  return read_sampled_pattern(read_pattern_document(path), path,
                              std::filesystem::path(path).parent_path(), perforations);
}

PatternFile read_sampled_pattern(const Json& document, const std::string& source,
                                 const std::filesystem::path& directory,
                                 Perforations perforations) {
  InputFaults faults;
  const auto has = [&](const char* key) { return document.is_object() && document.contains(key); };
  if (is_campaign(document)) {
    throw UserError(Cause::bad_input, source +
                                          ": is a campaign, not a pattern; `misalign search` runs "
                                          "it, and its \"pattern\" alone can be folded");
  }
  PatternFile read;
  const auto read_its_design = [&](const Json& beside) {
    const auto design = beside.is_object() ? beside.find("design") : beside.end();
    if (design != beside.end()) read.design = read_design(*design, "design", faults);
  };
  // A target names vertices of the pattern, which is read before.
  const auto read_its_target = [&](const Json& beside) {
    if (!faults.none() || !beside.is_object() || !beside.contains("target")) return;
    read.target =
        read_target(beside["target"], "target", read.pattern.base.sheet, directory, faults);
  };
  if (has("vertices_coords") && has(kCarriedPattern)) {
    read.pattern = read_carried_pattern(document, faults, perforations);
    read.exported = document.value("misalign:data", Json::object());
    read_its_design(read.exported);
  } else if (has("pattern")) {
    read.pattern = read_pattern(document["pattern"], "pattern", Displacements::allowed, {}, faults,
                                perforations);
    read.exported = document;
    read_its_design(document);
    read_its_target(document);
  } else {
    const bool is_mesh = is_fold(document);
    if (!is_mesh) read_its_design(document);
    Json pattern = is_mesh ? Json{{"family", "fold"}, {"mesh", document}} : document;
    if (pattern.is_object()) {
      pattern.erase("design");
      if (!is_mesh) pattern.erase("target");
    }
    read.pattern =
        read_pattern(pattern, "", Displacements::allowed, directory, faults, perforations);
    if (!is_mesh) read_its_target(document);
  }
  read.design.relax_at(read.pattern.folded_target);
  read.sampling = read_sampling(read.exported, read.pattern, faults);
  faults.refuse(source);
  if (!read.exported.is_object()) read.exported = nullptr;
  return read;
}

Json pattern_file_json(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm, Sampling sampling,
                       const Design& design, const std::optional<Target>& target) {
  sampling.end_deg =
      std::min(sampling.end_deg, last_judged_deg(base.base, shifts_mm, sampling.sample_deg));
  Json json = {{"pattern", pattern_json(base, shifts_mm)}, {"sampling", sampling_json(sampling)}};
  const Json explicit_json = explicit_design_json(design);
  if (!explicit_json.empty()) json["design"] = explicit_json;
  if (target) json["target"] = target->json;
  return json;
}

Pattern read_pattern_file(const std::string& path, Perforations perforations) {
  return read_sampled_pattern_file(path, perforations).pattern;
}

}  // namespace misalign::schema
