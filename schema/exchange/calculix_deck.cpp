#include "schema/exchange/calculix_deck.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/files/printable.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector3d;

class Deck {
 public:
  Deck(const SimulatedSheet& sheet, const DeckOptions& options)
      : sheet_(sheet), options_(options), mesh_(options.elements) {}

  std::string text() const { return head() + nodes() + elements() + ties() + springs() + step(); }

 private:
  std::string head() const;
  std::string nodes() const;
  std::string elements() const;
  std::string ties() const;
  std::string springs() const;
  std::string step() const;

  int panels() const { return static_cast<int>(sheet_.panels.corners.size()); }
  int corner_of(int panel, int vertex) const {
    const auto& corners = sheet_.panels.corners[panel];
    return static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
  }
  // The panel's node at one of its corners.
  int node_at(int panel, int vertex) const {
    return mesh_.corner_node(panel, corner_of(panel, vertex));
  }
  Vector3d place_mm(int panel, int i, int j) const;

  const SimulatedSheet& sheet_;
  const DeckOptions& options_;
  const PanelMesh mesh_;
};

std::string tie(int dependent, int node) {
  std::string text;
  for (const int direction : {1, 2, 3}) {
    text +=
        fmt::format("*EQUATION\n2\n{},{},1.,{},{},-1.\n", dependent, direction, node, direction);
  }
  return text;
}

// Interpolates bilinearly between corners: nodes on both sides of a crease agree.
Vector3d Deck::place_mm(int panel, int i, int j) const {
  const double u = static_cast<double>(i) / mesh_.side(), v = static_cast<double>(j) / mesh_.side();
  const auto& c = sheet_.panels.corners[panel];
  const Eigen::Matrix3Xd& at = sheet_.start_mm;
  return (1 - v) * ((1 - u) * at.col(c[0]) + u * at.col(c[1])) +
         v * (u * at.col(c[2]) + (1 - u) * at.col(c[3]));
}

std::string Deck::head() const {
  std::string text;
  for (const std::string& line : sheet_.head()) text += "** " + printable(line) + "\n";
  text += std::string("** ") + kSimulatedUnits + "\n";
  return text + fmt::format(
                    "** {}: E {:.10g} GPa, Poisson's ratio {:.10g}; panels of {} x {} S8R, nodes "
                    "of their own, tied by equations\n",
                    printable(options_.material.name), options_.material.e_gpa,
                    options_.material.poisson, options_.elements, options_.elements);
}

std::string Deck::nodes() const {
  std::string text = "*NODE, NSET=NALL\n";
  for (int panel = 0; panel < panels(); ++panel) {
    for (int j = 0; j <= mesh_.side(); ++j) {
      for (int i = 0; i <= mesh_.side(); ++i) {
        if (!mesh_.has_node(i, j)) continue;
        const Vector3d at = place_mm(panel, i, j);
        text += fmt::format("{},{:.12e},{:.12e},{:.12e}\n", mesh_.node(panel, i, j), at.x(), at.y(),
                            at.z());
      }
    }
  }
  text += fmt::format("*NSET, NSET={}\n", kCornerSet);
  for (int panel = 0; panel < panels(); ++panel) {
    for (int corner = 0; corner < 4; ++corner) {
      text += std::to_string(mesh_.corner_node(panel, corner)) + (corner < 3 ? "," : "\n");
    }
  }
  return text;
}

std::string Deck::elements() const {
  std::string text = fmt::format("*ELEMENT, TYPE=S8R, ELSET={}\n", kPanelSet);
  for (int panel = 0; panel < panels(); ++panel) {
    for (int j = 0; j < mesh_.elements(); ++j) {
      for (int i = 0; i < mesh_.elements(); ++i) {
        text += fmt::format("{},{}\n", mesh_.element(panel, i, j),
                            fmt::join(mesh_.nodes_of_element(panel, i, j), ","));
      }
    }
  }
  const solver::Plates& plates = sheet_.plates;
  const double damping = options_.damping_per_s;
  return text + fmt::format(
                    "*MATERIAL, NAME=PANEL\n*ELASTIC\n{:.10g},{:.10g}\n{}*DENSITY\n{:.10g}\n"
                    "*SHELL SECTION, ELSET={}, MATERIAL=PANEL\n{:.10g}\n",
                    options_.material.e_gpa * 1e3, options_.material.poisson,
                    damping > 0 ? fmt::format("*DAMPING, ALPHA={:.10g}\n", damping) : "",
                    plates.density_g_per_cm3 * 1e-9, kPanelSet, plates.thickness_mm);
}

std::string Deck::ties() const {
  std::string text;
  for (int v = 0; v < sheet_.start_mm.cols(); ++v) {
    int first = -1;
    for (int panel = 0; panel < panels(); ++panel) {
      if (corner_of(panel, v) == 4) continue;
      if (first < 0) {
        first = panel;
      } else {
        text += tie(node_at(panel, v), node_at(first, v));
      }
    }
  }
  for (const solver::FoldLine& fold : sheet_.panels.folds) {
    const auto node = [&](int panel, int step) {
      return mesh_.node_on_edge(panel, corner_of(panel, fold.a), corner_of(panel, fold.b), step);
    };
    for (int k = 1; k < mesh_.side(); ++k) text += tie(node(fold.right, k), node(fold.left, k));
  }
  return text;
}

// ccx keeps the last force beyond a table's ends, which no spring reaches.
std::string Deck::springs() const {
  std::string text;
  int element = panels() * mesh_.elements_of_a_panel();
  for (const solver::Diagonal& diagonal : sheet_.mechanism.diagonals) {
    const double start_mm = sheet_.start_length_mm(diagonal),
                 pulled_mm = start_mm - sheet_.relaxed_mm(diagonal), far_mm = start_mm / 2;
    const double k = sheet_.stiffness_n_per_mm;
    const std::string set = "S" + std::to_string(++element);
    text += fmt::format(
        "*ELEMENT, TYPE=SPRINGA, ELSET={}\n{},{},{}\n*SPRING, NONLINEAR, ELSET={}\n\n"
        "{:.15g},{:.15g}\n{:.15g},{:.15g}\n",
        set, element, node_at(sheet_.panel_at(diagonal.from), diagonal.from),
        node_at(sheet_.panel_at(diagonal.to), diagonal.to), set, k * (pulled_mm - far_mm), -far_mm,
        k * (pulled_mm + far_mm), far_mm);
  }
  return text;
}

std::string Deck::step() const {
  return fmt::format(
      "*STEP, NLGEOM, INC=1000000\n*DYNAMIC\n{:.10g},{:.10g},1e-12,{:.10g}\n"
      "*NODE PRINT, NSET={}\nU\n*EL PRINT, ELSET={}, TOTALS=ONLY\nELSE,ELKE\n"
      "*EL FILE\nS,NOE\n*END STEP\n",
      options_.time_step_s, options_.end_s, options_.time_step_s, kCornerSet, kPanelSet);
}

}  // namespace

std::string calculix_deck(const SimulatedSheet& sheet, const DeckOptions& options) {
  return Deck(sheet, options).text();
}

}  // namespace misalign::schema
