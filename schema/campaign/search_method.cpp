#include "schema/campaign/search_method.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kMethods = "write \"plain\", \"splitting\" or \"optimise\"";

}  // namespace

SearchMethod read_search(ObjectReader reader, double threshold_deg, double sample_deg) {
  InputFaults& faults = reader.faults();
  const std::size_t before = faults.count();
  std::string method = "plain";
  reader.text("method", method, kMethods);
  if (method != "plain" && method != "splitting" && method != "optimise") {
    faults.add(reader.shown("method"), "is no way to search", kMethods);
  }
  const Splitting splitting = read_splitting(reader, threshold_deg, sample_deg);
  const Optimisation optimisation = read_optimisation(reader, threshold_deg);
  reader.refuse_unknown_keys();
  if (faults.count() > before) return {};
  const std::string shown = reader.name("method") + " = \"" + method + "\"";
  if (method != "splitting" && splitting != Splitting{}) {
    faults.add(shown, "has no levels, particles, sweeps or first draws",
               "write \"splitting\", or take those out");
  }
  if (method != "optimise" && optimisation != Optimisation{}) {
    faults.add(shown, "has no goal, limits, springs or shifts of ends",
               "write \"optimise\", or take those out");
  }
  if (method == "splitting") {
    check_splitting(reader, splitting);
    return {splitting, {}};
  }
  if (method == "optimise") {
    check_optimisation(reader, optimisation);
    return {{}, optimisation};
  }
  return {};
}

Json search_json(const SearchMethod& method) {
  Json json = splitting_json(method.splitting.value_or(Splitting{}));
  json.update(optimisation_json(method.optimisation.value_or(Optimisation{})));
  json["method"] = method.splitting ? "splitting" : method.optimisation ? "optimise" : "plain";
  return json;
}

}  // namespace misalign::schema
