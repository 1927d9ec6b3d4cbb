#include "schema/exchange/tolerance_json.hpp"

#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

Json share_json(std::uint64_t hits, const solver::MiscutCopies& copies) {
  const ShareOfTrials share = share_of(hits, copies);
  return {{"copies", hits},
          {"share", share.share},
          {"share_low", share.low},
          {"share_high", share.high}};
}

Json stops_json(const solver::Tolerance& t) {
  using Value = std::pair<const char*, double solver::Stop::*>;
  std::vector<Value> values = {{"stops_at_deg", &solver::Stop::at_deg}};
  if (t.friction_n_mm_per_mm > 0) {
    values.emplace_back("held_from_deg", &solver::Stop::held_from_deg);
  }
  if (t.has_shapes) {
    values.emplace_back("shape_rms_mm", &solver::Stop::shape_rms_mm);
    values.emplace_back("shape_max_mm", &solver::Stop::shape_max_mm);
  }
  const solver::MiscutStops& stops = t.copies.stops;
  Json quantiles = Json::array(), designed = nullptr;
  if (t.own_stop) designed = Json::object();
  for (const double share : solver::kShownShares) {
    if (!stops.stops.empty()) quantiles.push_back({{"share", share}});
  }
  for (const auto& [name, value] : values) {
    if (t.own_stop) designed[name] = (*t.own_stop).*value;
    const std::vector<double> sorted = stops.sorted(value);
    for (Json& entry : quantiles) entry[name] = solver::quantile(sorted, entry["share"]);
  }
  return {{"rest_deg", t.rest_deg},
          {"friction_n_mm_per_mm", t.friction_n_mm_per_mm},
          {"stops_at_deg", t.own_stop ? Json(t.own_stop->at_deg) : Json()},
          {"own", designed},
          {"stopped", stops.stops.size()},
          {"flat", stops.flat},
          {"held", stops.held},
          {"quantiles", quantiles}};
}

}  // namespace

Json tolerance_json(const solver::Tolerance& t) {
  const Json quantiles = json_list(solver::kShownShares, [&](double share) {
    return Json{{"share", share}, {"deploys_from_deg", t.copies.quantile(share) * t.sample_deg}};
  });
  Json vertices = Json::array();
  for (const solver::Tolerance::Vertex& vertex : t.vertices) {
    Json json = share_json(vertex.copies.from(t.threshold_sample), vertex.copies);
    json["vertex"] = solver::vertex_label(vertex.vertex);
    json["trials"] = vertex.copies.trials;
    json["undecided"] = vertex.copies.undecided;
    json["mean_loss_deg"] = t.mean_loss_deg(vertex.copies);
    vertices.push_back(json);
  }
  Json json = {{"amplitude_mm", t.amplitude_mm},
               {"trials", t.copies.trials},
               {"undecided", t.copies.undecided},
               {"deploys_from_deg", t.own_sample * t.sample_deg},
               {"threshold_deg", t.threshold_deg},
               {"from_threshold", share_json(t.survivors(), t.copies)},
               {"from_own", share_json(t.copies.from(t.own_sample), t.copies)},
               {"mean_loss_deg", t.mean_loss_deg(t.copies)},
               {"quantiles", quantiles}};
  if (!t.vertices.empty()) json["vertices"] = vertices;
  if (t.copies.stops.trials() > 0) json["stops"] = stops_json(t);
  return json;
}

Json miscut_gap_json(const solver::MiscutGap& gap) {
  Json open = Json::array();
  for (Eigen::Index k = 0; k < gap.open_mm.cols(); ++k) {
    open.push_back({{"pilot_deg", gap.pilot_deg[static_cast<std::size_t>(k)]},
                    {"median_mm", gap.quantile_mm(0.5, k)},
                    {"of_95_percent_mm", gap.quantile_mm(0.95, k)},
                    {"largest_mm", gap.quantile_mm(1, k)}});
  }
  return {{"amplitude_mm", gap.amplitude_mm}, {"trials", gap.open_mm.rows()}, {"open", open}};
}

}  // namespace misalign::schema
