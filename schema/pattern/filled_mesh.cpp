#include "schema/pattern/filled_mesh.hpp"

#include <algorithm>

#include "schema/pattern/vertex_labels.hpp"

namespace misalign::schema {
namespace {

constexpr std::size_t kEdgesEach = 3;

std::optional<MeshFiller> read_filler(const Json& value, const Pattern& pattern) {
  const solver::PerforatedSheet& base = pattern.base;
  if (!value.is_object()) return std::nullopt;
  const Json label = value.value("vertex", Json()), hinges = value.value("hinges", Json()),
             place = value.value("hole", Json());
  if (!label.is_string() || !hinges.is_string()) return std::nullopt;
  const int corner = vertex_of_label(label.get<std::string>(), base.sheet.vertex_count());
  const int hole = facet_of_json(pattern, place);
  const std::string letters = hinges.get<std::string>();
  const bool are_letters =
      letters.size() == 3 && letters.find_first_not_of("MV") == std::string::npos;
  if (corner < 0 || !std::ranges::binary_search(base.holes, hole) || !are_letters)
    return std::nullopt;
  const auto filler = solver::filler_at(base, hole, corner);
  return filler ? std::optional(MeshFiller{*filler, letters}) : std::nullopt;
}

}  // namespace

std::array<std::size_t, 3> hinge_edges(const solver::CreasePattern& sheet,
                                       const solver::Filler& filler, std::size_t number) {
  const auto edge_to = [&](int vertex) {
    return static_cast<std::size_t>(solver::find_edge(sheet, filler.corner, vertex));
  };
  return {edge_to(filler.before), sheet.edges.size() + kEdgesEach * number, edge_to(filler.after)};
}

Json add_fillers(const Pattern& pattern, const std::vector<MeshFiller>& fillers, Json& mesh) {
  const solver::CreasePattern& sheet = pattern.base.sheet;
  Json list = Json::array();
  for (std::size_t i = 0; i < fillers.size(); ++i) {
    const auto& [filler, hinges] = fillers[i];
    const int apex = sheet.vertex_count() + static_cast<int>(i);
    Json& faces = mesh["faces_vertices"];
    for (const int vertex : {filler.corner, filler.before, filler.after}) {
      mesh["edges_vertices"].push_back({vertex, apex});
      mesh["edges_assignment"].push_back("B");
    }
    const auto edges = hinge_edges(sheet, filler, i);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      mesh["edges_assignment"][edges[k]] = std::string(1, hinges[k]);
    }
    list.push_back({{"hole", facet_json(pattern, filler.hole)},
                    {"vertex", solver::vertex_label(filler.corner)},
                    {"hinges", hinges},
                    {"faces", {faces.size(), faces.size() + 1}},
                    {"apex", apex}});
    for (const auto& triangle : filler.triangles(apex)) faces.push_back(triangle);
  }
  return list;
}

std::optional<std::vector<MeshFiller>> read_fillers(const Json& fold, const Pattern& pattern) {
  std::vector<MeshFiller> fillers;
  const auto list = fold.find(kFillers);
  if (list == fold.end()) return fillers;
  if (!list->is_array()) return std::nullopt;
  for (const Json& value : *list) {
    auto filler = read_filler(value, pattern);
    if (!filler) return std::nullopt;
    fillers.push_back(std::move(*filler));
  }
  return fillers;
}

}  // namespace misalign::schema
