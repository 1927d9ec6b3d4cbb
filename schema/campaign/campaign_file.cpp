#include "schema/campaign/campaign_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/campaign/campaign_target.hpp"
#include "schema/campaign/misalignment.hpp"
#include "schema/campaign/parallel_check.hpp"
#include "schema/files/hash.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/design_json.hpp"
#include "schema/pattern/target.hpp"

namespace misalign::schema {
namespace {

// Relative tolerance of whole multiples of sample_deg.
constexpr double kMultipleTolerance = 1e-9;

bool whole_multiple(double value, double step) {
  const double ratio = value / step;
  return std::abs(ratio - std::round(ratio)) <= kMultipleTolerance * std::max(1.0, ratio);
}

// Reads a stop; both keys are null without one.
void read_required_stop(ObjectReader& accept, std::optional<RequiredStop>& stop) {
  const bool angle = accept.said("stops_at_deg"),
             stiffness = accept.said("stop_stiffness_mm2_per_rad2");
  if (angle != stiffness) {
    accept.faults().add(accept.name(angle ? "stops_at_deg" : "stop_stiffness_mm2_per_rad2"),
                        std::string("needs ") +
                            (angle ? "stop_stiffness_mm2_per_rad2" : "stops_at_deg") + " beside it",
                        "write both, or neither: the angle of the stop, and its least stiffness");
  }
  if (!angle || !stiffness) return;
  stop = RequiredStop{0, 0};
  accept.number("stops_at_deg", stop->at_deg, 0.01, 180, "try 60, or null for no stop");
  accept.number("stop_stiffness_mm2_per_rad2", stop->least_mm2_per_rad2, 1e-9, 1e9,
                "try 5, or null for no stop");
}

void read_path_and_threshold(ObjectReader& path, ObjectReader& accept, double base_end_deg,
                             Campaign& campaign) {
  InputFaults& faults = path.faults();
  const std::size_t before = faults.count();
  path.number("sample_deg", campaign.sample_deg, 0.01, 60, "try 1");
  if (closes_at_180(campaign)) campaign.end_deg = 180 - campaign.sample_deg;
  path.number("end_deg", campaign.end_deg, 0.01, 180, "try 180");
  accept.number("deploys_from_deg", campaign.threshold_deg, 0.01, 180, "try 150");
  read_between_samples(accept, campaign.pattern, campaign.between_samples);
  read_required_stop(accept, campaign.required_stop);
  campaign.energy = read_energy_acceptance(accept, campaign.pattern.base);
  const bool numbers_good = faults.count() == before;
  path.refuse_unknown_keys();
  accept.refuse_unknown_keys();
  if (!numbers_good) return;
  const auto check = [&](const ObjectReader& reader, const char* key, double value, double most,
                         const char* last) {
    const std::string shown = reader.name(key) + " = " + shown_number(value);
    const double rounded = std::max(1.0, std::round(value / campaign.sample_deg));
    const std::string suggestion =
        "try " + shown_number(std::min(rounded * campaign.sample_deg, most));
    if (!whole_multiple(value, campaign.sample_deg)) {
      faults.add(shown,
                 "must be a whole multiple of sample_deg = " + shown_number(campaign.sample_deg),
                 suggestion);
    } else if (value > most) {
      faults.add(shown, fmt::format("must not lie beyond {} = {}", last, shown_number(most)),
                 suggestion);
    }
  };
  check(path, "end_deg", campaign.end_deg, 180, "180 degrees");
  if (campaign.end_deg > base_end_deg) {
    faults.add(path.name("end_deg") + " = " + shown_number(campaign.end_deg),
               "the unshifted sheet folds to " + shown_number(base_end_deg) + " only",
               "try " + shown_number(std::floor(base_end_deg / campaign.sample_deg) *
                                     campaign.sample_deg));
  }
  check(accept, "deploys_from_deg", campaign.threshold_deg, campaign.end_deg, "end_deg");
  if (campaign.required_stop) {
    check(accept, "stops_at_deg", campaign.required_stop->at_deg, campaign.threshold_deg,
          "deploys_from_deg");
  }
}

// `afterwards`: the kind of search that makes certificates only later; null: none.
void read_certify(ObjectReader& reader, const char* afterwards, bool& certify) {
  reader.boolean("certify", certify, "write true for certificates during the search");
  if (certify && afterwards) {
    reader.faults().add(reader.shown("certify"),
                        std::string(afterwards) + " makes no certificates itself",
                        "write false, and run `misalign certify` on its catalogue afterwards");
  }
}

// Checks that draws and optima keep to levels and grid.
void check_ends(const Campaign& campaign, InputFaults& faults) {
  if (!campaign.search.optimisation) return;
  const Optimisation& ends = *campaign.search.optimisation;
  const Misalignment& draws = campaign.misalignment;
  if (draws.parallel && !closes_at_180(campaign)) {
    faults.add("search.method = \"optimise\"",
               "changes sheets with one degree of freedom, and this one has too few holes for it",
               "write \"plain\", or use `misalign construct`");
  }
  if (draws.parallel && draws.parallel->grid_mm > 0) {
    faults.add("misalignment.grid_mm", "is not kept by an optimisation of members", "take it out");
  }
  const char* const key = ends.ternary ? "search.shifts = \"ternary\"" : "search.grid_mm";
  if (!ends.ternary && !ends.grid_mm) return;
  if (draws.parallel) {
    faults.add(key, "would leave the parallel family", "take it out");
  } else if (draws.distribution == ShiftDistribution::uniform) {
    faults.add(key, "needs ternary draws, and these are uniform",
               "write misalignment.levels = \"ternary\", or take it out");
  } else if (ends.grid_mm && !whole_multiple(draws.amplitude_mm, *ends.grid_mm)) {
    faults.add(std::string(key) + " = " + shown_number(*ends.grid_mm),
               "does not divide misalignment.amplitude_mm = " + shown_number(draws.amplitude_mm),
               "try a tenth of that");
  }
}

bool usable_file_name(const std::string& name) {
  return !name.empty() && name.size() <= 100 && name[0] != '.' && name[0] != '-' &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) || c == '-' || c == '_' || c == '.';
         });
}

}  // namespace

Campaign read_campaign(const Json& value, const std::string& source,
                       const std::optional<std::filesystem::path>& directory) {
  static const Json kEmpty = Json::object();
  InputFaults faults;
  Campaign campaign;
  ObjectReader reader(value, "", faults);
  const auto part = [&](const char* key) -> const Json& {
    const Json* found = reader.find(key);
    return found ? *found : kEmpty;
  };
  reader.text("name", campaign.name, "write a name for the catalogue's file");
  if (!usable_file_name(campaign.name)) {
    faults.add(reader.shown("name"), "the catalogue's file is named after it",
               "use letters, digits, '-', '_' and '.', 1 to 100 of them");
  }
  reader.require("pattern", "write the base pattern; `misalign config --default` shows one");
  if (const Json* pattern = reader.find("pattern")) {
    const Json& misalignment = part("misalignment");
    const bool is_parallel =
        misalignment.is_object() && misalignment.value("kind", Json()) == "parallel";
    campaign.pattern =
        read_pattern(*pattern, "pattern", Displacements::refused, directory, faults,
                     is_parallel ? Perforations::of_one_path : Perforations::of_one_freedom);
  }
  campaign.misalignment = read_misalignment(
      ObjectReader(part("misalignment"), "misalignment", faults), campaign.pattern.base);
  ObjectReader path(part("path"), "path", faults), accept(part("accept"), "accept", faults);
  // A sheet that is refused for other reasons is not blamed for its path.
  const double end_deg = campaign.pattern.base.folding.end_deg();
  read_path_and_threshold(path, accept, end_deg > 0 ? end_deg : 180, campaign);
  const std::size_t before_search = faults.count();
  campaign.search = read_search(ObjectReader(part("search"), "search", faults),
                                campaign.threshold_deg, campaign.sample_deg);
  const bool has_search = faults.count() == before_search;
  read_campaign_target(reader, directory.value_or(""), campaign);
  if (has_search) check_shape_search(campaign, faults);
  check_parallel(campaign, faults);
  check_ends(campaign, faults);
  reader.whole("seed", campaign.seed, kEndOfDraws, "try 1");
  read_stop(ObjectReader(part("stop"), "stop", faults), campaign.stop);
  const Design springs = read_springs(part("actuators"), "actuators", faults);
  campaign.design = read_design(part("design"), "design", faults).merged_over(springs);
  campaign.design.relax_at(campaign.pattern.folded_target);
  if (reader.find("actuators") && part("design").contains("fill")) {
    faults.add("actuators", "is given beside design.fill",
               "write design.fill alone: springs are a filling, too");
  }
  const bool is_in_closed_form = campaign.misalignment.parallel && !closes_at_180(campaign);
  read_certify(reader,
               campaign.search.splitting ? "a splitting search"
               : is_in_closed_form       ? "a search among overconstrained sheets"
                                         : nullptr,
               campaign.certify);
  if (campaign.certify && !campaign.pattern.base.springs.in_mid_plane()) {
    faults.add(reader.shown("certify"), "certificates need springs in the panels' mid-plane",
               "write false, or take \"springs\" out of the pattern");
  }
  check_energy_acceptance(campaign, faults);
  reader.refuse_unknown_keys();
  faults.refuse(source);
  return campaign;
}

Campaign read_campaign_file(const std::string& path) {
  const Json document = read_json_file(path);
  if (document.is_object() && document.contains("family") && !document.contains("pattern")) {
    throw UserError(Cause::bad_input, path +
                                          ": is a pattern, not a campaign; `misalign fold` folds "
                                          "it, and a campaign has it under \"pattern\"");
  }
  Campaign campaign = read_campaign(document, path, std::filesystem::path(path).parent_path());
  check_names(campaign.design, campaign.pattern.base, path);
  return campaign;
}

Campaign default_campaign() {
  return read_campaign({{"pattern", {{"family", "miura"}, {"rows", 6}, {"columns", 6}}}},
                       "the default campaign");
}

Json campaign_json(const Campaign& campaign) {
  const std::optional<RequiredStop>& stop = campaign.required_stop;
  Json accept = energy_acceptance_json(campaign.energy);
  accept.update(
      Json{{"deploys_from_deg", campaign.threshold_deg},
           {"between_samples", between_samples_json(campaign.between_samples)},
           {"stops_at_deg", stop ? Json(stop->at_deg) : Json()},
           {"stop_stiffness_mm2_per_rad2", stop ? Json(stop->least_mm2_per_rad2) : Json()}});
  return {{"name", campaign.name},
          {"pattern", pattern_json(campaign.pattern, campaign.pattern.shifts_mm)},
          {"misalignment", misalignment_json(campaign.misalignment, campaign.pattern.base.sheet)},
          {"path", {{"sample_deg", campaign.sample_deg}, {"end_deg", campaign.end_deg}}},
          {"accept", accept},
          {"search", search_json(campaign.search)},
          {"target", campaign.target ? campaign.target->json : Json()},
          {"seed", campaign.seed},
          {"stop", stop_json(campaign.stop)},
          {"design", design_json(campaign.design)},
          {"certify", campaign.certify}};
}

Json stored_configuration(const Campaign& campaign) {
  static const Json defaults = campaign_json(default_campaign());
  Json configuration = campaign_json(campaign);
  configuration["design"] = explicit_design_json(campaign.design);
  if (configuration["design"].empty()) configuration.erase("design");
  if (!campaign.certify) configuration.erase("certify");
  if (!campaign.misalignment.parallel) {
    configuration["misalignment"].erase("kind");
    configuration["misalignment"].erase("signs");
  }
  if (configuration["misalignment"]["grid_mm"].is_null()) {
    configuration["misalignment"].erase("grid_mm");
  }
  if (!campaign.search.optimisation) {
    const Json its_keys = optimisation_json({});
    for (const auto& [key, value] : its_keys.items()) configuration["search"].erase(key);
  }
  if (!campaign.search.shape) {
    const Json its_keys = shape_search_json({});
    for (const auto& [key, value] : its_keys.items()) configuration["search"].erase(key);
    configuration.erase("target");
  }
  if (!campaign.search.stores_sheets()) configuration.erase("search");
  if (!campaign.search.splitting &&
      configuration["stop"]["populations"] == defaults["stop"]["populations"]) {
    configuration["stop"].erase("populations");
  }
  if (!campaign.required_stop) {
    configuration["accept"].erase("stops_at_deg");
    configuration["accept"].erase("stop_stiffness_mm2_per_rad2");
  }
  if (!campaign.energy) {
    const Json its_keys = energy_acceptance_json({});
    for (const auto& [key, value] : its_keys.items()) configuration["accept"].erase(key);
  }
  return configuration;
}

Json identity_json(const Campaign& campaign) {
  static const Json defaults = campaign_json(default_campaign());
  Json identity = campaign_json(campaign);
  for (const char* key : {"name", "stop", "design", "certify"}) identity.erase(key);
  leave_out_defaults(identity, defaults);
  return identity;
}

std::string identity(const Campaign& campaign) {
  return hex(hash_of(identity_json(campaign).dump()));
}

std::string differences(const Campaign& held, const Campaign& wanted) {
  const Json theirs = identity_json(held), ours = identity_json(wanted);
  const auto shown = [](const Json& configuration, const Json::json_pointer& at) {
    if (!configuration.contains(at)) return std::string("the default");
    const std::string text = configuration.at(at).dump();
    return text.size() <= 40 ? text : text.substr(0, 37) + "...";
  };
  std::vector<std::string> all;
  for (const Json& change : Json::diff(theirs, ours)) {
    const std::string path = change.at("path");
    const Json::json_pointer at(path);
    all.push_back(fmt::format("{} ({} there, {} here)", path, shown(theirs, at), shown(ours, at)));
  }
  return fmt::to_string(fmt::join(all, ", "));
}

}  // namespace misalign::schema
