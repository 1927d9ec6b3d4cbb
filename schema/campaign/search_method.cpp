#include "schema/campaign/search_method.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kMethods = "write \"plain\", \"splitting\", \"optimise\" or \"shape\"";
constexpr const char* kStarts = "write \"draws\" or \"splitting\"";

}  // namespace

SearchMethod read_search(ObjectReader reader, double threshold_deg, double sample_deg) {
  InputFaults& faults = reader.faults();
  const std::size_t before = faults.count();
  std::string method = "plain";
  reader.text("method", method, kMethods);
  const bool shapes = method == "shape";
  if (method != "plain" && method != "splitting" && method != "optimise" && !shapes) {
    faults.add(reader.shown("method"), "is no search method", kMethods);
  }
  std::string starts = "draws";
  reader.text("starts", starts, kStarts);
  if (starts != "draws" && starts != "splitting") {
    faults.add(reader.shown("starts"), "are no starts", kStarts);
  }
  const Splitting splitting = read_splitting(reader, threshold_deg, sample_deg);
  const Optimisation optimisation = read_optimisation(reader, threshold_deg);
  const ShapeSearch shape = read_shape_search(reader);
  reader.refuse_unknown_keys();
  if (faults.count() > before) return {};
  const bool optimises = method == "optimise";
  const bool splits = method == "splitting" || (optimises && starts == "splitting");
  const std::string shown = reader.name("method") + " = \"" + method + "\"";
  const std::string shown_starts = reader.name("starts") + " = \"" + starts + "\"";
  if (!splits && splitting != Splitting{}) {
    faults.add(optimises ? shown_starts : shown, "has no levels, particles, sweeps or first draws",
               "write \"splitting\", or take those out");
  }
  if (!optimises && (optimisation != Optimisation{} || starts != "draws")) {
    faults.add(shown, "has no objective, constraints, springs, starts or shifts",
               "write \"optimise\", or take those out");
  }
  if (!shapes && shape != ShapeSearch{}) {
    faults.add(shown, "has no shape, weights or turned diagonals",
               "write \"shape\", or take those out");
  }
  if (optimises && !splits &&
      optimisation.starts_of_population != Optimisation{}.starts_of_population) {
    faults.add(shown_starts, "are of no population",
               "write \"splitting\", or take starts_of_population out");
  }
  SearchMethod search;
  if (splits) {
    check_splitting(reader, splitting);
    search.splitting = splitting;
  }
  if (optimises) {
    check_optimisation(reader, optimisation);
    search.optimisation = optimisation;
  }
  if (shapes) search.shape = shape;
  return search;
}

Json search_json(const SearchMethod& method) {
  Json json = splitting_json(method.splitting.value_or(Splitting{}));
  json.update(optimisation_json(method.optimisation.value_or(Optimisation{})));
  json.update(shape_search_json(method.shape.value_or(ShapeSearch{})));
  json["method"] = method.shape          ? "shape"
                   : method.optimisation ? "optimise"
                   : method.splitting    ? "splitting"
                                         : "plain";
  if (method.optimisation && method.splitting) json["starts"] = "splitting";
  return json;
}

}  // namespace misalign::schema
