#include "schema/exchange/actuators_json.hpp"

#include <fmt/format.h>

#include <cassert>

#include "schema/files/json_values.hpp"
#include "schema/pattern/fill_json.hpp"
#include "schema/pattern/preload_json.hpp"

namespace misalign::schema {

std::string diagonal_label(const std::vector<solver::Diagonal>& diagonals, int diagonal) {
  assert(diagonal >= 0 && diagonal < std::ssize(diagonals));
  const solver::Diagonal& its = diagonals[static_cast<std::size_t>(diagonal)];
  return solver::line_label(its.from, its.to);
}

std::string diagonal_label(const solver::Mechanism& mechanism, int diagonal) {
  return diagonal_label(mechanism.diagonals, diagonal);
}

std::string diagonal_labels(const solver::Mechanism& mechanism, const std::vector<int>& diagonals) {
  std::vector<std::string> names;
  for (const int d : diagonals) names.push_back(diagonal_label(mechanism, d));
  return names.empty() ? "none" : fmt::to_string(fmt::join(names, ", "));
}

Json limits_json(const solver::Actuation& actuation) {
  Json json = {{"weakest", nullptr}, {"few", nullptr}, {"over_stroke", nullptr}};
  if (actuation.weakest) {
    json["weakest"] = {{"pilot_deg", actuation.weakest->pilot_deg},
                       {"moment_n_mm", actuation.weakest->moment_n_mm}};
    if (actuation.counts_from_deg > solver::kSlopeFrom_deg) {
      json["weakest"]["from_deg"] = actuation.counts_from_deg;
    }
  }
  if (actuation.few) {
    json["few"] = {{"diagonals", actuation.few->diagonals},
                   {"share", actuation.few->share},
                   {"proven", actuation.few->proven}};
  }
  if (actuation.over_stroke) {
    json["over_stroke"] = {{"from_deg", actuation.over_stroke->from_deg},
                           {"diagonals", actuation.over_stroke->diagonals}};
  }
  return json;
}

Json pairs_json(const solver::Mechanism& mechanism, const std::vector<std::pair<int, int>>& pairs) {
  return json_list(pairs, [&](const auto& pair) {
    return Json{diagonal_label(mechanism, pair.first), diagonal_label(mechanism, pair.second)};
  });
}

void add_filling(const solver::Fill& fill, const solver::PerforatedSheet& base, Json& json) {
  json["fill"] = fill_json(fill, base);
  const auto* const springs = std::get_if<solver::Springs>(&fill);
  if (!springs) return;
  json["stiffness_n_per_mm"] = springs->stiffness_n_per_mm;
  add_preload(springs->preload, json);
  add_single_springs(*springs, json);
  if (springs->rest_deg != 0) json["rest_deg"] = springs->rest_deg;
  if (springs->pull_only) json["pull_only"] = true;
}

Json actuation_json(const FoldingView& view, const solver::Actuation& actuation) {
  assert(actuation.from_row >= 0 && actuation.from_row < actuation.force_n.rows());
  assert(actuation.force_n.cols() == view.mechanism.diagonal_count());
  const solver::Mechanism& mechanism = view.mechanism;
  Json forces = Json::array();
  for (int d = 0; d < mechanism.diagonal_count(); ++d) {
    forces.push_back({{"diagonal", d},
                      {"from", solver::vertex_label(mechanism.diagonals[d].from)},
                      {"to", solver::vertex_label(mechanism.diagonals[d].to)},
                      {"free_mm", actuation.free_mm[static_cast<std::size_t>(d)]},
                      {"force_n", actuation.force_n(actuation.from_row, d)}});
  }
  const auto& limit = actuation.actuators.stroke_limit;
  Json json = {{"stroke_limit", or_null(limit)},
               {"energy_n_mm", actuation.energy_n_mm[static_cast<std::size_t>(actuation.from_row)]},
               {"forces", forces}};
  add_filling(actuation.actuators.fill, view.base.base, json);
  if (actuation.from_deg) json["from_deg"] = *actuation.from_deg;
  json.update(limits_json(actuation));
  for (const char* key : {"few", "over_stroke"}) {
    if (json[key].is_null()) continue;
    for (Json& diagonal : json[key]["diagonals"]) {
      diagonal = diagonal_label(mechanism, diagonal.get<int>());
    }
  }
  return json;
}

Json actuation_history_json(const FoldingView& view, const solver::Actuation& actuation) {
  Json json = actuation_json(view, actuation);
  assert(actuation.pilot_deg.size() == actuation.energy_n_mm.size());
  assert(actuation.pilot_deg.size() == actuation.moment_n_mm.size());
  for (int d = 0; d < view.mechanism.diagonal_count(); ++d) {
    json["forces"][static_cast<std::size_t>(d)]["history_n"] =
        json_list(actuation.force_n.col(d), std::identity());
  }
  json["history"] = {
      {"pilot_deg", actuation.pilot_deg},
      {"energy_n_mm", actuation.energy_n_mm},
      {"moment_n_mm", actuation.moment_n_mm},
      {"mechanical_advantage", json_list(actuation.mechanical_advantage, finite_or_null)}};
  return json;
}

}  // namespace misalign::schema
