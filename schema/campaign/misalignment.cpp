#include "schema/campaign/misalignment.hpp"

#include <algorithm>

#include "schema/files/json_values.hpp"
#include "schema/pattern/vertex_labels.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::schema {
namespace {

std::vector<int> read_vertices(ObjectReader& reader, const solver::CreasePattern& sheet) {
  const char* const kForms =
      "write \"interior\", \"ring\", \"all\" or a list of labels like [\"A9\", \"A10\"]";
  const Json* value = reader.find("vertices");
  if (!value || *value == "interior") return solver::interior_vertices(sheet);
  if (*value == "ring") return solver::ring_vertices(sheet);
  if (*value == "all") return solver::all_vertices(sheet);
  if (!value->is_array() || value->empty()) {
    reader.faults().add(reader.shown("vertices"), "names no set of vertices", kForms);
    return {};
  }
  std::vector<int> vertices;
  for (const Json& label : *value) {
    const int vertex =
        label.is_string() ? vertex_of_label(label.get<std::string>(), sheet.vertex_count()) : -1;
    if (vertex < 0) {
      reader.faults().add(
          reader.name("vertices") + " has " + label.dump(),
          "is no vertex of this sheet, A1 to A" + std::to_string(sheet.vertex_count()), kForms);
    } else {
      vertices.push_back(vertex);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  if (std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end()) {
    reader.faults().add(reader.name("vertices"), "names a vertex twice", "name each once");
  }
  return vertices;
}

// Reads one of two words; the first if the key is left out.
bool is_second(ObjectReader& reader, const char* key, const char* first, const char* second,
               const char* what) {
  std::string word = first;
  const std::string forms = std::string("write \"") + first + "\" or \"" + second + "\"";
  reader.text(key, word, forms);
  if (word != first && word != second) reader.faults().add(reader.shown(key), what, forms);
  return word == second;
}

// Finds the parallel family of a base whose path is known.
std::optional<ParallelDraws> family_of(ObjectReader& reader, const solver::PerforatedSheet& base,
                                       const std::vector<int>& vertices) {
  auto found = solver::ParallelFamily::of(base, vertices);
  if (const auto* none = std::get_if<solver::NoParallelFamily>(&found)) {
    reader.faults().add(reader.shown("kind"),
                        "this base has no parallel family: " + none->why(base.sheet),
                        "take another base, or leave \"kind\" out");
    return std::nullopt;
  }
  auto& family = std::get<solver::ParallelFamily>(found);
  const auto is_of_hole = [](const solver::ParallelCoordinate& coordinate) {
    return coordinate.kind != solver::ParallelCoordinate::Kind::shape;
  };
  if (!std::ranges::any_of(family.coordinates(), is_of_hole)) {
    reader.faults().add(reader.name("vertices"),
                        "leave every hole of the parallel family unchanged",
                        "write \"all\", which shifts the rim too");
    return std::nullopt;
  }
  return ParallelDraws{std::make_shared<const solver::ParallelFamily>(std::move(family))};
}

// Reads the grid; null for none.
void read_grid(ObjectReader& reader, double amplitude_mm, bool is_parallel, double& grid_mm) {
  const Json* value = reader.said("grid_mm");
  if (!value) return;
  reader.number("grid_mm", grid_mm, 1e-6, amplitude_mm, "try 0.01, or null for no grid");
  if (is_parallel) return;
  reader.faults().add(reader.shown("grid_mm"), "applies only to the parallel family",
                      "write \"kind\": \"parallel\" beside it, or take it out");
}

// Puts the family's steps on that grid.
void put_on_grid(ObjectReader& reader, double grid_mm, double amplitude_mm,
                 ParallelDraws& parallel) {
  const auto steps_mm = parallel.family->whole_steps_mm();
  if (!steps_mm) {
    reader.faults().add(reader.shown("grid_mm"),
                        "this base's creases have directions along which no step keeps both x and "
                        "y on a grid",
                        "take it out, or a base whose heights and offsets are in a simple ratio");
    return;
  }
  parallel.grid_mm = grid_mm;
  parallel.steps_mm = *steps_mm * grid_mm;
  for (int k = 0; k < parallel.family->dimension(); ++k) {
    const double moves_mm = parallel.family->basis().col(k).cwiseAbs().maxCoeff();
    if (parallel.steps_mm(k) * moves_mm <= amplitude_mm) return;
  }
  reader.faults().add(reader.shown("grid_mm"),
                      "is so coarse that no member but the base keeps to it",
                      "try a tenth of the amplitude");
}

}  // namespace

Misalignment read_misalignment(ObjectReader reader, const solver::PerforatedSheet& base) {
  InputFaults& faults = reader.faults();
  const std::size_t before = faults.count();
  const solver::CreasePattern& sheet = base.sheet;
  const bool has_sheet = sheet.facet_count() > 0;  // even with other faults
  Misalignment misalignment;
  if (has_sheet) {
    misalignment.vertices = read_vertices(reader, sheet);
  } else {
    reader.find("vertices");
  }
  reader.number("amplitude_mm", misalignment.amplitude_mm, 1e-9, 1e6, "try 0.4");
  if (has_sheet && faults.count() == before) {
    const double safe = solver::largest_safe_amplitude_mm(sheet, misalignment.vertices);
    const double shown = rounded_down(safe);
    if (misalignment.amplitude_mm >= safe) {
      faults.add(reader.name("amplitude_mm") + " = " + shown_number(misalignment.amplitude_mm),
                 "must be below " + shown_number(shown) +
                     ", where a facet of this sheet can lose convexity",
                 "try " + shown_number(rounded_down(0.95 * shown)));
    }
  }
  const bool is_parallel = is_second(reader, "kind", "free", "parallel", "is no kind of shifts");
  const bool may_differ = is_second(reader, "signs", "alike", "free", "is no rule for signs");
  if (!is_parallel && may_differ) {
    faults.add(reader.shown("signs"), "applies only to the parallel family",
               "write \"kind\": \"parallel\" beside it, or take it out");
  }
  const bool says_levels = reader.find("levels") != nullptr;
  const bool is_uniform = is_second(reader, "levels", "ternary", "uniform", "is no set of levels");
  if (is_uniform || is_parallel) misalignment.distribution = ShiftDistribution::uniform;
  if (is_parallel && says_levels && !is_uniform) {
    faults.add(reader.shown("levels"), "members of the parallel family are drawn uniformly",
               "write \"uniform\", or take it out");
  }
  double grid_mm = 0;
  read_grid(reader, misalignment.amplitude_mm, is_parallel, grid_mm);
  reader.refuse_unknown_keys();
  if (is_parallel && faults.count() == before && base.folding.end_deg() > 0) {
    misalignment.parallel = family_of(reader, base, misalignment.vertices);
    if (!misalignment.parallel) return misalignment;
    misalignment.parallel->like_signs = !may_differ;
    if (grid_mm > 0)
      put_on_grid(reader, grid_mm, misalignment.amplitude_mm, *misalignment.parallel);
  }
  return misalignment;
}

Json misalignment_json(const Misalignment& misalignment, const solver::CreasePattern& sheet) {
  const std::vector<int>& shifted = misalignment.vertices;
  const std::optional<ParallelDraws>& parallel = misalignment.parallel;
  Json vertices;
  if (shifted == solver::interior_vertices(sheet)) {
    vertices = "interior";
  } else if (shifted == solver::ring_vertices(sheet)) {
    vertices = "ring";
  } else {
    vertices = json_list(shifted, solver::vertex_label);
  }
  return {
      {"vertices", vertices},
      {"amplitude_mm", misalignment.amplitude_mm},
      {"levels", misalignment.distribution == ShiftDistribution::ternary ? "ternary" : "uniform"},
      {"kind", parallel ? "parallel" : "free"},
      {"signs", parallel && !parallel->like_signs ? "free" : "alike"},
      {"grid_mm", parallel && parallel->grid_mm > 0 ? Json(parallel->grid_mm) : Json()}};
}

}  // namespace misalign::schema
