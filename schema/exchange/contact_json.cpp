#include "schema/exchange/contact_json.hpp"

#include <cassert>

#include "schema/exchange/spring_clearance_json.hpp"
#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

const char* kind_name(solver::ContactKind kind) {
  constexpr const char* kNames[] = {"apart", "vertex", "crease"};
  return kNames[static_cast<std::size_t>(kind)];
}

// The common vertex or crease of two panels: "A9", "A2-A9" or null.
Json joint_json(const solver::Panels& panels, const solver::PanelPair& pair) {
  if (pair.kind == solver::ContactKind::apart) return nullptr;
  if (pair.kind == solver::ContactKind::vertex) return solver::vertex_label(pair.joint);
  assert(pair.joint >= 0 && pair.joint < std::ssize(panels.folds));
  const solver::FoldLine& fold = panels.folds[static_cast<std::size_t>(pair.joint)];
  return solver::line_label(fold.a, fold.b);
}

Json pair_json(const Pattern& base, const solver::Panels& panels, const solver::PanelPair& pair) {
  return {{"kind", kind_name(pair.kind)},
          {"panels", {place_of_panel(base, panels, pair.a), place_of_panel(base, panels, pair.b)}},
          {"joint", joint_json(panels, pair)}};
}

Json thickness_json(const Pattern& base, const solver::Panels& panels,
                    const solver::ContactStudy& study) {
  if (!study.thickness) return nullptr;
  const solver::PlateThickness& plates = *study.thickness;
  const bool by_taper = plates.limit == solver::PlateThickness::Limit::taper;
  Json json = {{"largest_mm", finite_or_null(plates.thickness_mm)},
               {"reaches_deg", study.reach_deg},
               {"trim_mm", study.trim_mm},
               {"limit", by_taper ? "taper" : kind_name(plates.pair.kind)},
               {"clear_mm", finite_or_null(plates.clear_mm)},
               {"taper_mm", finite_or_null(plates.taper_mm)}};
  json["closest"] = pair_json(base, panels, plates.pair);
  json["closest"]["pilot_deg"] = plates.pilot_deg;
  if (plates.panel >= 0) json["tapered"] = place_of_panel(base, panels, plates.panel);
  return json;
}

}  // namespace

std::string panels_text(const Pattern& base, const solver::Panels& panels,
                        const solver::PanelPair& pair) {
  const std::string text = "panels " + place_of_panel(base, panels, pair.a).dump() + " and " +
                           place_of_panel(base, panels, pair.b).dump();
  if (pair.kind == solver::ContactKind::apart) return text;
  return text + " (both at " + joint_json(panels, pair).get<std::string>() + ")";
}

Json contact_json(const Pattern& base, const solver::Panels& panels,
                  const solver::Contact& contact) {
  Json json = pair_json(base, panels, contact.pair);
  json["pilot_deg"] = contact.pilot_deg;
  for (const Eigen::Vector2d& on_mm : {contact.on_a_mm, contact.on_b_mm}) {
    json["on_panels_mm"].push_back({on_mm.x(), on_mm.y()});
  }
  return json;
}

Json contact_study_json(const Pattern& base, const solver::Panels& panels,
                        const solver::ContactStudy& study) {
  Json clearance = {{"pilot_deg", study.pilot_deg}};
  for (const solver::ContactFinder::Clearance& least : study.clearances) {
    clearance["apart_mm"].push_back(finite_or_null(least.apart_mm));
    clearance["vertex_deg"].push_back(least.vertex_deg);
    clearance["crease_deg"].push_back(least.crease_deg);
  }
  return {{"deploys_from_deg", study.deploys_from_deg},
          {"from_deg", study.used_from_deg},
          {"way_ends_at_deg", study.end_deg},
          {"known_until_deg", study.known_until_deg},
          {"first_contact", study.first ? contact_json(base, panels, *study.first) : Json()},
          {"clearance", clearance},
          {"thickness", thickness_json(base, panels, study)},
          {"springs", spring_clearance_json(base, panels, study)}};
}

}  // namespace misalign::schema
