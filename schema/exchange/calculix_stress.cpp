#include "schema/exchange/calculix_stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <unordered_map>

#include "schema/exchange/calculix_result.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector3d;

double von_mises(const std::array<double, 6>& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 +
                   3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

// An expanded node: ccx makes three of a shell's corner node, two of a mid-side node.
struct Node {
  Vector3d at_mm;
  int panel = -1;
  bool outside = false;
  Eigen::Vector2d flat_mm;
};

class StressReader {
 public:
  StressReader(const SimulatedSheet& sheet, const PanelMesh& mesh, const StressOptions& options)
      : sheet_(sheet), mesh_(mesh), options_(options) {
    history_.panel_outside_mpa.assign(sheet.panels.corners.size(), 0);
  }

  void see_line(const std::string& line) {
    const std::string key = line.substr(0, 5);
    if (key == "    2") {
      block_ = Block::nodes;
    } else if (key == "    3") {
      block_ = Block::elements;
    } else if (line.compare(0, 7, "  100CL") == 0) {
      frame_.time_s = fortran_column(line, 12, 12);
      block_ = Block::none;
    } else if (key.substr(0, 3) == " -4") {
      block_ = line.find("STRESS") != std::string::npos ? Block::stresses : Block::none;
    } else if (key.substr(0, 3) == " -3") {
      end_block();
    } else if (key.substr(0, 3) == " -1" || key.substr(0, 3) == " -2") {
      see_entry(line);
    }
  }

  bool has_places() const { return placed_; }
  solver::StressHistory take() { return std::move(history_); }

 private:
  enum class Block { none, nodes, elements, stresses };
  struct Frame {
    double time_s = 0;
    bool is_sound = true;
    solver::StressHistory::Peak outside, anywhere;
    std::vector<double> panels_mpa;
  };

  void see_entry(const std::string& line);
  void end_block();
  void place_nodes();
  void see_stress(const Node& node, double stress_mpa);

  const SimulatedSheet& sheet_;
  const PanelMesh& mesh_;
  const StressOptions& options_;
  Block block_ = Block::none;
  int element_ = 0;
  bool placed_ = false;
  std::unordered_map<int, Node> nodes_;  // the keys, nodes' numbers, may be any
  Frame frame_;
  solver::StressHistory history_;
};

void StressReader::see_entry(const std::string& line) {
  const bool is_continued = line[2] == '2';
  if (block_ == Block::nodes) {
    const Vector3d at_mm(fortran_column(line, 13, 12), fortran_column(line, 25, 12),
                         fortran_column(line, 37, 12));
    if (is_result(at_mm.cwiseAbs().sum())) nodes_[fortran_whole(line, 3, 10)].at_mm = at_mm;
  } else if (block_ == Block::elements && !is_continued) {
    element_ = fortran_whole(line, 3, 10);
  } else if (block_ == Block::elements) {
    const int panel = mesh_.panel_of_element(element_);
    if (panel < 0 || panel >= static_cast<int>(sheet_.panels.corners.size())) return;  // a spring
    for (std::size_t at = 3; at + 10 <= line.size(); at += 10) {
      const auto node = nodes_.find(fortran_whole(line, at, 10));
      if (node != nodes_.end()) node->second.panel = panel;
    }
  } else if (block_ == Block::stresses) {
    const auto node = nodes_.find(fortran_whole(line, 3, 10));
    if (node == nodes_.end() || node->second.panel < 0) return;
    std::array<double, 6> stress;
    for (std::size_t k = 0; k < 6; ++k) stress[k] = fortran_column(line, 13 + 12 * k, 12);
    see_stress(node->second, von_mises(stress));
  }
}

void StressReader::see_stress(const Node& node, double stress_mpa) {
  frame_.is_sound = frame_.is_sound && is_result(stress_mpa);
  const auto raise = [&](solver::StressHistory::Peak& most) {
    if (stress_mpa > most.stress_mpa) {
      most = {stress_mpa, frame_.time_s, node.panel, node.flat_mm};
    }
  };
  raise(frame_.anywhere);
  if (!node.outside) return;
  raise(frame_.outside);
  double& panel_mpa = frame_.panels_mpa[static_cast<std::size_t>(node.panel)];
  panel_mpa = std::max(panel_mpa, stress_mpa);
}

void StressReader::end_block() {
  if (block_ == Block::elements) place_nodes();
  if (block_ == Block::stresses) {
    const double before_s = history_.time_s.empty() ? 0 : history_.time_s.back();
    history_.is_sound = history_.is_sound && frame_.is_sound && is_result(frame_.time_s) &&
                        frame_.time_s >= before_s;
  }
  // The tolerance covers times' six written digits.
  if (block_ == Block::stresses && history_.is_sound &&
      frame_.time_s <= options_.until_s * (1 + 1e-5)) {
    history_.time_s.push_back(frame_.time_s);
    history_.outside_mpa.push_back(frame_.outside.stress_mpa);
    history_.anywhere_mpa.push_back(frame_.anywhere.stress_mpa);
    const auto raise = [](std::optional<solver::StressHistory::Peak>& most,
                          const solver::StressHistory::Peak& now) {
      if (now.panel >= 0 && (!most || now.stress_mpa > most->stress_mpa)) most = now;
    };
    raise(history_.outside, frame_.outside);
    raise(history_.anywhere, frame_.anywhere);
    for (std::size_t k = 0; k < frame_.panels_mpa.size(); ++k) {
      double& most_mpa = history_.panel_outside_mpa[k];
      most_mpa = std::max(most_mpa, frame_.panels_mpa[k]);
    }
  }
  block_ = Block::none;
  const double time_s = frame_.time_s;
  frame_ = {};
  frame_.time_s = time_s;
  frame_.panels_mpa.assign(sheet_.panels.corners.size(), 0);
}

// Maps nodes of panels, which are plane at the start, to the flat sheet by the edges at corner 0.
void StressReader::place_nodes() {
  for (auto& [number, node] : nodes_) {
    if (node.panel < 0) continue;
    placed_ = true;
    const auto& corners = sheet_.panels.corners[static_cast<std::size_t>(node.panel)];
    const Vector3d origin = sheet_.start_mm.col(corners[0]);
    Eigen::Matrix<double, 3, 2> edges;
    edges << sheet_.start_mm.col(corners[1]) - origin, sheet_.start_mm.col(corners[3]) - origin;
    const Eigen::Vector2d shares =
        (edges.transpose() * edges).inverse() * edges.transpose() * (node.at_mm - origin);
    const Eigen::Vector2d flat0 = sheet_.flat_mm.col(corners[0]);
    node.flat_mm = flat0 + shares[0] * (sheet_.flat_mm.col(corners[1]) - flat0) +
                   shares[1] * (sheet_.flat_mm.col(corners[3]) - flat0);
    node.outside = std::all_of(corners.begin(), corners.end(), [&, &node = node](int v) {
      return (sheet_.flat_mm.col(v) - node.flat_mm).norm() > options_.disc_mm;
    });
  }
}

}  // namespace

solver::StressHistory read_stresses(std::istream& file, const std::string& name,
                                    const SimulatedSheet& sheet, const PanelMesh& mesh,
                                    const StressOptions& options) {
  StressReader reader(sheet, mesh, options);
  for (std::string line; std::getline(file, line);) reader.see_line(line);
  if (!reader.has_places()) {
    throw UserError(Cause::failure, name +
                                        ": holds no elements (ccx ended before it wrote any); see "
                                        "its log beside it");
  }
  return reader.take();
}

}  // namespace misalign::schema
