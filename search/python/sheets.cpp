// Binds `_misalign.Sheet`: the contents of a pattern or campaign file as arrays.
#include <pybind11/stl.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/pattern/design_json.hpp"
#include "search/draws/draw.hpp"
#include "search/python/arrays.hpp"
#include "search/python/bindings.hpp"
#include "search/python/draw_numbers.hpp"
#include "search/python/made.hpp"
#include "search/python/pattern_source.hpp"
#include "search/python/shift_blocks.hpp"
#include "search/python/signals.hpp"
#include "solver/kinematics/mechanism.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

// Vertices and labels of lines.
struct Lines {
  std::vector<std::array<int, 2>> ends;
  std::vector<std::string> labels;

  void add(int from, int to) {
    ends.push_back({from, to});
    labels.push_back(solver::line_label(from, to));
  }
};

py::dict campaign_of(const schema::Campaign& campaign) {
  return py::dict(
      "name"_a = campaign.name, "identity"_a = schema::identity(campaign), "seed"_a = campaign.seed,
      "threshold_deg"_a = campaign.threshold_deg,
      "amplitude_mm"_a = campaign.misalignment.amplitude_mm,
      "levels"_a = campaign.misalignment.distribution == schema::ShiftDistribution::ternary
                       ? "ternary"
                       : "uniform",
      "vertices"_a = list_of(campaign.misalignment.vertices),
      "is_splitting"_a = campaign.search.splitting.has_value(),
      "configuration"_a = schema::campaign_json(campaign).dump());
}

// Returns all at once, since it is small and never changes.
py::dict describe(const PatternSource& source) {
  const schema::Pattern& base = source.sheet.base;
  const solver::Mechanism mechanism = solver::build_mechanism(base.base);
  Lines creases, diagonals;
  std::vector<bool> valley;
  for (const solver::Crease& crease : mechanism.creases) {
    creases.add(crease.a, crease.b);
    valley.push_back(mechanism.is_valley(crease));
  }
  for (const solver::Diagonal& diagonal : mechanism.diagonals) {
    diagonals.add(diagonal.from, diagonal.to);
  }
  std::vector<std::array<int, 4>> panels;
  for (const int facet : solver::kept_facets(base.base.sheet, base.base.holes)) {
    panels.push_back(base.base.sheet.facets[static_cast<std::size_t>(facet)]);
  }
  std::vector<std::string> vertices;
  for (int v = 0; v < source.vertices(); ++v) vertices.push_back(solver::vertex_label(v));
  const schema::Json bumps = schema::between_samples_json(source.criterion.bumps);
  return py::dict(
      "name"_a = source.sheet.pattern, "vertices_mm"_a = points_of(source.pattern().vertices_mm),
      "shifts_mm"_a = points_of(source.sheet.shifts_mm),
      "facets"_a = table_of(source.pattern().facets), "panels"_a = table_of(panels),
      "places"_a = table_of(source.pattern().places), "holes"_a = list_of(base.base.holes),
      "creases"_a = table_of(creases.ends), "valley"_a = valley,
      "diagonals"_a = table_of(diagonals.ends), "vertex_labels"_a = vertices,
      "crease_labels"_a = creases.labels, "diagonal_labels"_a = diagonals.labels,
      "pilot"_a = mechanism.pilot,
      "interior"_a = list_of(solver::interior_vertices(source.pattern())),
      "sample_deg"_a = source.sheet.sampling.sample_deg,
      "end_deg"_a = source.sheet.sampling.end_deg,
      "between_samples"_a = bumps.is_string() ? py::object(py::str("exact"))
                                              : py::object(py::bool_(bumps.get<bool>())),
      "exported"_a = source.sheet.exported.dump(), "reading"_a = base.reading,
      "design"_a = schema::design_json(source.sheet.design).dump(),
      "campaign"_a =
          source.campaign ? py::object(campaign_of(*source.campaign)) : py::object(py::none()));
}

py::array_t<double> shifts(const PatternSource& source, const py::object& draws) {
  const std::vector<std::uint64_t> numbers = draw_numbers(draws);
  const schema::Campaign& campaign = *source.campaign;
  if (campaign.search.splitting) {
    throw schema::UserError(schema::Cause::bad_request,
                            campaign.name +
                                ": is a splitting campaign, whose numbers are no draws (each is a "
                                "place in a population); use Catalogue.shifts of its catalogue");
  }
  const auto vertices = static_cast<std::size_t>(source.vertices());
  py::array_t<double> made_mm({numbers.size(), vertices, std::size_t{2}});
  double* to = made_mm.mutable_data();
  unlocked([&] {
    std::fill_n(to, made_mm.size(), 0.0);
    std::vector<double> drawn_mm(2 * campaign.misalignment.vertices.size());
    for (const std::uint64_t draw : numbers) {
      draw_shifts(campaign.misalignment, campaign.seed, draw, drawn_mm.data());
      const double* from = drawn_mm.data();
      for (const int vertex : campaign.misalignment.vertices) {
        to[2 * vertex] = *from++;
        to[2 * vertex + 1] = *from++;
      }
      to += 2 * vertices;
    }
  });
  return made_mm;
}

}  // namespace

void bind_sheets(py::module_& module) {
  py::class_<PatternSource, std::shared_ptr<PatternSource>>(module, "Sheet")
      .def("describe", made(&describe))
      .def("shifts", made(&shifts), "draws"_a)
      .def(py::pickle(made(&text_of), [](const std::string& text) {
        return unlocked([&] { return source_of_text(text); });
      }));
  module.def(
      "read_document",
      [](const std::string& text, const std::string& name) {
        return unlocked([&] { return read_document(text, name); });
      },
      "text"_a, "name"_a);
  module.def(
      "with_shifts",
      made(+[](const PatternSource& source, const py::object& shifts_mm, const std::string& name) {
        return with_shifts(source, shifts_of_one(shifts_mm, source), name);
      }),
      "sheet"_a, "shifts_mm"_a, "name"_a);
  module.def("write", made(+[](const PatternSource& source, const std::string& path) {
               unlocked([&] { write_source(source, path); });
             }),
             "sheet"_a, "path"_a);
  module.def(
      "read", [](const std::string& path) { return unlocked([&] { return read_source(path); }); },
      "path"_a);
}

}  // namespace misalign::search::python
