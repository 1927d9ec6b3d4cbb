#include "schema/campaign/campaign_target.hpp"

#include <fmt/format.h>

#include <cmath>

#include "schema/pattern/target.hpp"

namespace misalign::schema {
namespace {

// Points of a mesh that a catalogue carries: half a megabyte.
constexpr Eigen::Index kMostPoints = 10000;

// Numbers as reals, 1440 and 1440.0 are one target; but for indices of points.
Json with_reals(const Json& value) {
  if (value.is_number()) return value.get<double>();
  Json all = value;
  if (value.is_structured()) {
    for (auto& [key, part] : all.items()) {
      if (key != "triangles") part = with_reals(part);
    }
  }
  return all;
}

}  // namespace

void read_campaign_target(ObjectReader& reader, const std::filesystem::path& directory,
                          Campaign& campaign) {
  const Json* const value = reader.said("target");
  if (!value) {
    if (campaign.search.shape) {
      reader.faults().add("target", "is missing, the shape of the sheets",
                          R"(write {"surface": "sphere", "radius_mm": 1440})");
    }
    return;
  }
  if (campaign.pattern.base.sheet.facet_count() == 0) return;
  const std::size_t before = reader.faults().count();
  Target target =
      read_target(*value, "target", campaign.pattern.base.sheet, directory, reader.faults());
  if (reader.faults().count() > before) return;
  if (target.mesh) {
    if (target.mesh->vertices_mm.cols() > kMostPoints) {
      return reader.faults().add(
          "target", fmt::format("is a mesh of {} points", target.mesh->vertices_mm.cols()),
          fmt::format("thin it out to {}, which a catalogue carries", kMostPoints));
    }
    target.json = with_mesh_inside(target);
  }
  target.at_deg = target.at_deg.value_or(kShape_deg);
  target.json = with_reals(target.json);
  target.json["at_deg"] = *target.at_deg;
  if (target.json.value("of", Json()) == "vertices") target.json.erase("of");
  campaign.target = std::make_shared<const Target>(std::move(target));
}

void check_shape_search(const Campaign& campaign, InputFaults& faults) {
  if (!campaign.search.shape) {
    if (campaign.target) {
      faults.add("target", "is of a search among sheets of one shape",
                 "write search.method = \"shape\", or take it out");
    }
    return;
  }
  if (campaign.misalignment.parallel) {
    faults.add("misalignment.kind = \"parallel\"",
               "is left by a descent, which shifts each vertex by itself", "write \"free\"");
  }
  const solver::CreasePattern& sheet = campaign.pattern.base.sheet;
  const std::vector<int>& shifted = campaign.misalignment.vertices;
  if (!shifted.empty() && shifted != solver::all_vertices(sheet) &&
      shifted != solver::interior_vertices(sheet)) {
    faults.add("misalignment.vertices", "are those that a descent shifts",
               "write \"all\", or \"interior\" to hold the rim");
  }
  if (!campaign.target) return;
  const double at_deg = *campaign.target->at_deg, samples = at_deg / campaign.sample_deg;
  const std::string shown = "target.at_deg = " + shown_number(at_deg);
  if (std::abs(samples - std::round(samples)) > 1e-9 * samples) {
    faults.add(shown,
               "must be a whole multiple of path.sample_deg = " + shown_number(campaign.sample_deg),
               "try " + shown_number(std::ceil(samples) * campaign.sample_deg));
  }
  if (at_deg >= campaign.threshold_deg) {
    faults.add(shown,
               "must lie below accept.deploys_from_deg = " + shown_number(campaign.threshold_deg) +
                   ", the stowed angle",
               "take a smaller one, or stow the sheet beyond it");
  }
}

}  // namespace misalign::schema
