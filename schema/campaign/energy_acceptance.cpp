#include "schema/campaign/energy_acceptance.hpp"

#include "schema/files/json_values.hpp"
#include "schema/pattern/judging_fill.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kFriction = "least_friction_n_mm_per_mm";
constexpr const char* kMoment = "least_moment_n_mm";

}  // namespace

std::optional<EnergyAcceptance> read_energy_acceptance(ObjectReader& accept,
                                                       const solver::PerforatedSheet& base) {
  const std::optional<solver::Fill> fill = read_judging_fill(accept, base);
  EnergyAcceptance energy;
  accept.number(kFriction, energy.least_friction_n_mm_per_mm, 1e-9, 1e9, "try 1, or null for none");
  accept.number(kMoment, energy.least_moment_n_mm, 1e-9, 1e9, "try 1, or null for none");
  if (fill) {
    energy.fill = *fill;
    return energy;
  }
  const Json* const criterion = accept.find("by");
  const bool by_diagonals = !criterion || *criterion == "diagonals";
  for (const char* key : {kFriction, kMoment}) {
    if (!by_diagonals || !accept.said(key)) continue;
    accept.faults().add(accept.name(key), "is for draws that are judged by energy",
                        R"(write accept.by = "energy", or take it out)");
  }
  return std::nullopt;
}

Json energy_acceptance_json(const std::optional<EnergyAcceptance>& energy) {
  Json json = judging_fill_json(fill_of(energy));
  json[kFriction] = energy ? or_null(energy->least_friction_n_mm_per_mm) : Json();
  json[kMoment] = energy ? or_null(energy->least_moment_n_mm) : Json();
  return json;
}

}  // namespace misalign::schema
