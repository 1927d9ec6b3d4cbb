#include "schema/pattern/preload_json.hpp"

#include <fmt/format.h>

#include <optional>

#include "schema/pattern/design.hpp"
#include "schema/pattern/vertex_labels.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {
namespace {

using solver::Preload;

constexpr char kKey[] = "preloads_n";
constexpr char kSuggestion[] = R"(write {"A9-A15": 2}: a diagonal's vertices, and a force in N)";

std::optional<Preload::OfOne> read_preload(const std::string& label, const Json& force) {
  constexpr int kAnyVertex = 1 << 24;  // the sheet knows which exist
  const auto [least, most] = design_limits("springs.preload_n");
  const auto dash = label.find('-');
  if (dash == std::string::npos || !force.is_number()) return {};
  const Preload::OfOne preload{vertex_of_label(label.substr(0, dash), kAnyVertex),
                               vertex_of_label(label.substr(dash + 1), kAnyVertex),
                               force.get<double>()};
  if (preload.from < 0 || preload.to < 0 || !(preload.n >= least && preload.n <= most)) return {};
  return preload;
}

}  // namespace

void read_preloads(ObjectReader& reader, std::vector<Preload::OfOne>& preloads) {
  const Json* value = reader.said(kKey);
  if (!value) return;
  if (!value->is_object()) {
    return reader.faults().add(reader.shown(kKey), "is no object of forces", kSuggestion);
  }
  for (const auto& [label, force] : value->items()) {
    if (const auto preload = read_preload(label, force)) {
      preloads.push_back(*preload);
    } else {
      reader.faults().add(reader.name(kKey) + "." + printable(label) + " = " + force.dump(),
                          "is no force of a spring, from 0 to 1e+06 N", kSuggestion);
    }
  }
}

Json preloads_json(const std::vector<Preload::OfOne>& preloads) {
  if (preloads.empty()) return nullptr;
  Json json = Json::object();
  for (const Preload::OfOne& preload : preloads)
    json[solver::line_label(preload.from, preload.to)] = preload.n;
  return json;
}

void add_preload(const Preload& preload, Json& springs) {
  if (!preload.is_any()) return;
  springs["preload_n"] = preload.each_n;
  if (!preload.others.empty()) springs["preloads_n"] = preloads_json(preload.others);
}

std::string preload_words(const Preload& preload) {
  return fmt::format("{}{:g} N", preload.others.empty() ? "" : "up to ", preload.largest_n());
}

}  // namespace misalign::schema
