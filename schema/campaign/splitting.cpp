#include "schema/campaign/splitting.hpp"

#include <fmt/format.h>

#include <cmath>

#include "schema/files/json_values.hpp"
#include "solver/verdict/score.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kFormsOfLevels =
    "write \"auto\", or angles in ascending order like [150, 165, 175]";

// Empty of an angle that can be a level behind the last one.
std::string why_no_level(double level_deg, double last_deg, double threshold_deg,
                         double sample_deg) {
  if (level_deg > threshold_deg) {
    return "lies above accept.deploys_from_deg = " + shown_number(threshold_deg);
  }
  if (!(level_deg > last_deg)) return "does not lie above " + shown_number(last_deg);
  // Whole scores, of which there are many in a sample.
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

void read_count(ObjectReader& reader, const char* key, std::uint32_t& into, std::uint64_t least,
                std::uint64_t most) {
  std::uint64_t count = into;
  const std::size_t before = reader.faults().count();
  reader.whole(key, count, most, "try " + std::to_string(into));
  if (reader.faults().count() == before && count < least) {
    reader.faults().add(reader.shown(key), "must be at least " + std::to_string(least),
                        "try " + std::to_string(into));
  }
  into = static_cast<std::uint32_t>(count);
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
  read_count(reader, "particles", splitting.particles, 2, kMostParticles);
  read_count(reader, "sweeps", splitting.sweeps, 1, kMostSweeps);
  read_count(reader, "first_draws", splitting.first_draws, 2, kMostFirstDraws);
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
