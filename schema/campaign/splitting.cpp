#include "schema/campaign/splitting.hpp"

#include <fmt/format.h>

#include <cmath>

#include "schema/files/json_values.hpp"
#include "solver/verdict/score.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kFormsOfLevels =
    "write \"auto\", or angles in ascending order like [150, 165, 175]";

// Returns why an angle cannot be a level after the last one; empty if it can.
std::string why_no_level(double level_deg, double last_deg, double threshold_deg,
                         double sample_deg) {
  if (level_deg > threshold_deg) {
    return "lies above accept.deploys_from_deg = " + shown_number(threshold_deg);
  }
  if (!(level_deg > last_deg)) return "does not lie above " + shown_number(last_deg);
  // Levels are whole scores, of which a sample has many.
  const double step_deg = sample_deg / solver::kScoresPerSample;
  if (level_deg >= last_deg + step_deg) return "";
  return fmt::format(
      "is the same level as {}: levels lie a {}th of a sample, {:.2g} degrees, apart at least",
      shown_number(last_deg), solver::kScoresPerSample, step_deg);
}

void read_named_levels(ObjectReader& reader, double threshold_deg, double sample_deg,
                       std::vector<double>& levels_deg) {
  const Json* value = reader.find("levels_deg");
  if (!value || *value == "auto") return;
  InputFaults& faults = reader.faults();
  if (value->empty() || value->size() > kMostLevels || !are_numbers(*value, value->size())) {
    faults.add(reader.shown("levels_deg"),
               "is no list of up to " + std::to_string(kMostLevels) + " angles", kFormsOfLevels);
    return;
  }
  double last_deg = 0;
  for (const Json& level : *value) {
    const double level_deg = level.get<double>();
    const std::string why = why_no_level(level_deg, last_deg, threshold_deg, sample_deg);
    if (!why.empty()) {
      faults.add(reader.name("levels_deg") + " has " + level.dump(), why, kFormsOfLevels);
      return;
    }
    last_deg = level_deg;
    levels_deg.push_back(level_deg);
  }
  if (last_deg < threshold_deg) levels_deg.push_back(threshold_deg);
  if (levels_deg.size() > kMostLevels) {
    faults.add(
        reader.shown("levels_deg"),
        "is, with the threshold, no list of up to " + std::to_string(kMostLevels) + " angles",
        kFormsOfLevels);
  }
}

}  // namespace

std::vector<int> named_scores(const Splitting& splitting, double sample_deg) {
  std::vector<int> scores;
  const double scores_per_deg = solver::kScoresPerSample / sample_deg;
  for (const double level_deg : splitting.levels_deg) {
    scores.push_back(static_cast<int>(std::lround(level_deg * scores_per_deg)));
  }
  return scores;
}

Splitting read_splitting(ObjectReader& reader, double threshold_deg, double sample_deg) {
  Splitting splitting;
  read_named_levels(reader, threshold_deg, sample_deg, splitting.levels_deg);
  reader.count("particles", splitting.particles, 2, kMostParticles, "must be at least 2");
  reader.count("sweeps", splitting.sweeps, 1, kMostSweeps, "must be at least 1");
  reader.count("first_draws", splitting.first_draws, 2, kMostFirstDraws, "must be at least 2");
  return splitting;
}

void check_splitting(ObjectReader& reader, const Splitting& splitting) {
  const std::uint64_t numbers =
      splitting.first_draws + kMostLevels * splitting.sweeps * std::uint64_t{splitting.particles};
  if (numbers <= kNumbersOfPopulation) return;
  reader.faults().add(fmt::format("{} times {}", reader.shown("particles"), reader.shown("sweeps")),
                      fmt::format("is more than a population has numbers for, {}",
                                  (kNumbersOfPopulation - splitting.first_draws) / kMostLevels),
                      "take more populations of fewer particles");
}

Json splitting_json(const Splitting& splitting) {
  return {{"levels_deg", splitting.levels_deg.empty() ? Json("auto") : Json(splitting.levels_deg)},
          {"particles", splitting.particles},
          {"sweeps", splitting.sweeps},
          {"first_draws", splitting.first_draws}};
}

}  // namespace misalign::schema
