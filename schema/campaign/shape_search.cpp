#include "schema/campaign/shape_search.hpp"

#include <algorithm>

#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

constexpr std::size_t kMostWeights = 16;
constexpr double kLeastWeight = 1e-6, kMostWeight = 1e3;
constexpr std::uint32_t kMostTurned = 1000;

void read_weights(ObjectReader& reader, std::vector<double>& weights) {
  const Json* const list = reader.find("shift_weights");
  if (!list) return;
  const auto is_weight = [](const Json& value) {
    return value.get<double>() >= kLeastWeight && value.get<double>() <= kMostWeight;
  };
  if (!list->is_array() || list->size() > kMostWeights || !are_numbers(*list, list->size()) ||
      !std::ranges::all_of(*list, is_weight)) {
    reader.faults().add(reader.shown("shift_weights"),
                        "is no list of up to 16 weights between 1e-06 and 1000",
                        "write [0.01], or [0.003, 0.01, 0.03]");
    return;
  }
  weights = list->get<std::vector<double>>();
}

}  // namespace

ShapeSearch read_shape_search(ObjectReader& reader) {
  ShapeSearch search;
  reader.number("shape_max_mm", search.shape_max_mm, 1e-9, 1e6, "try 1");
  read_weights(reader, search.shift_weights);
  reader.count("turned_diagonals", search.turned_diagonals, 0, kMostTurned,
               "is no number of diagonals");
  return search;
}

Json shape_search_json(const ShapeSearch& search) {
  return {{"shape_max_mm", search.shape_max_mm},
          {"shift_weights", search.shift_weights},
          {"turned_diagonals", search.turned_diagonals}};
}

}  // namespace misalign::schema
