#include "schema/exchange/calculix_result.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <istream>
#include <string_view>
#include <unordered_map>

#include "solver/pattern/half_angle.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector3d;

// As Fortran writes it: 1.2-103 is 1.2E-103. What is no number, such as a field of stars, is NaN.
double number_in(std::string text) {
  const std::size_t sign = text.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 && text[sign - 1] >= '0' && text[sign - 1] <= '9') {
    text.insert(sign, "E");
  }
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_whole = end != text.c_str() &&
                        std::string_view(end).find_first_not_of(" \r") == std::string_view::npos;
  return is_whole ? value : std::nan("");
}

bool is_result(double value) { return std::abs(value) <= kLargestResult; }

// Numbers stand in columns, without a blank between where they are negative.
double column(const std::string& line, std::size_t begin, std::size_t width) {
  if (line.size() < begin + width) return std::nan("");
  return number_in(line.substr(begin, width));
}
// 0, which is no node and no element, where no such number stands.
int whole_column(const std::string& line, std::size_t begin, std::size_t width) {
  const double value = column(line, begin, width);
  return value > 0 && value <= std::numeric_limits<int>::max() ? static_cast<int>(value) : 0;
}

double von_mises(const std::array<double, 6>& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 +
                   3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

// One expanded node: ccx makes three of a shell's at its corners, two in the middles.
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
      frame_.time_s = column(line, 12, 12);
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
    solver::StressAt outside, anywhere;
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
  std::unordered_map<int, Node> nodes_;  // by their numbers, which may be any
  Frame frame_;
  solver::StressHistory history_;
};

void StressReader::see_entry(const std::string& line) {
  const bool is_continued = line[2] == '2';
  if (block_ == Block::nodes) {
    const Vector3d at_mm(column(line, 13, 12), column(line, 25, 12), column(line, 37, 12));
    if (is_result(at_mm.cwiseAbs().sum())) nodes_[whole_column(line, 3, 10)].at_mm = at_mm;
  } else if (block_ == Block::elements && !is_continued) {
    element_ = whole_column(line, 3, 10);
  } else if (block_ == Block::elements) {
    const int panel = mesh_.panel_of_element(element_);
    if (panel < 0 || panel >= static_cast<int>(sheet_.panels.corners.size())) return;  // a spring
    for (std::size_t at = 3; at + 10 <= line.size(); at += 10) {
      const auto node = nodes_.find(whole_column(line, at, 10));
      if (node != nodes_.end()) node->second.panel = panel;
    }
  } else if (block_ == Block::stresses) {
    const auto node = nodes_.find(whole_column(line, 3, 10));
    if (node == nodes_.end() || node->second.panel < 0) return;
    std::array<double, 6> stress;
    for (std::size_t k = 0; k < 6; ++k) stress[k] = column(line, 13 + 12 * k, 12);
    see_stress(node->second, von_mises(stress));
  }
}

void StressReader::see_stress(const Node& node, double stress_mpa) {
  frame_.is_sound = frame_.is_sound && is_result(stress_mpa);
  const auto raise = [&](solver::StressAt& most) {
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
  // A hair later: times are written with six digits.
  if (block_ == Block::stresses && history_.is_sound &&
      frame_.time_s <= options_.until_s * (1 + 1e-5)) {
    history_.time_s.push_back(frame_.time_s);
    history_.outside_mpa.push_back(frame_.outside.stress_mpa);
    history_.anywhere_mpa.push_back(frame_.anywhere.stress_mpa);
    const auto raise = [](std::optional<solver::StressAt>& most, const solver::StressAt& now) {
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

// Panels are flat at the start: from there to the flat sheet by the two edges at corner 0.
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

MotionReader::MotionReader(const SimulatedSheet& sheet, const PanelMesh& mesh)
    : sheet_(sheet),
      mesh_(mesh),
      corners_mm_(3, 4 * static_cast<Eigen::Index>(sheet.panels.corners.size())) {
  Eigen::Index corner = 0;
  for (const auto& corners : sheet.panels.corners) {
    for (const int v : corners) corners_mm_.col(corner++) = sheet.start_mm.col(v);
  }
  add_row();
}

void MotionReader::feed(const std::string& text) {
  rest_ += text;
  std::size_t begin = 0;
  for (std::size_t end; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    see_line(rest_.substr(begin, end - begin));
  }
  rest_.erase(0, begin);
}

void MotionReader::see_line(const std::string& line) {
  const std::size_t time = line.find("and time");
  if (time != std::string::npos) {
    const double time_s = number_in(line.substr(time + 8));
    const bool has_corners = line.find("displacements") != std::string::npos;
    if (has_corners) row_ = {time_s, 0, 0, 0, 0, 0};
    block_ = has_corners                                         ? Block::corners
             : line.find("internal energy") != std::string::npos ? Block::strain
             : line.find("kinetic energy") != std::string::npos  ? Block::kinetic
                                                                 : Block::none;
  } else if (line.find_first_not_of(' ') == std::string::npos) {
    return;
  } else if (block_ == Block::corners) {
    see_corner(line);
  } else if (block_ == Block::strain) {
    row_.strain_n_mm = number_in(line);
  } else if (block_ == Block::kinetic) {
    row_.kinetic_n_mm = number_in(line);
    add_row();
    block_ = Block::none;
  }
}

void MotionReader::see_corner(const std::string& line) {
  const int node = whole_column(line, 0, 10), panel = mesh_.panel_of_node(node);
  if (panel < 0 || panel >= static_cast<int>(sheet_.panels.corners.size())) return;
  for (int i = 0; i < 4; ++i) {
    if (mesh_.corner_node(panel, i) != node) continue;
    const Vector3d moved(column(line, 10, 14), column(line, 24, 14), column(line, 38, 14));
    corners_mm_.col(4 * panel + i) =
        sheet_.start_mm.col(sheet_.panels.corners[static_cast<std::size_t>(panel)][i]) + moved;
  }
}

Vector3d MotionReader::normal(int panel) const {
  const Eigen::Index first = 4 * panel;
  const Vector3d one = corners_mm_.col(first + 2) - corners_mm_.col(first),
                 other = corners_mm_.col(first + 3) - corners_mm_.col(first + 1);
  return one.cross(other).normalized();
}

// The right panel is turned by -rho about the crease from a to b.
double MotionReader::fold_angle_deg(const solver::FoldLine& fold) const {
  const auto& corners = sheet_.panels.corners[static_cast<std::size_t>(fold.left)];
  const auto place = [&](int vertex) -> Vector3d {
    const auto at = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
    return corners_mm_.col(4 * fold.left + at);
  };
  const Vector3d left = normal(fold.left), right = normal(fold.right);
  const Vector3d way = (place(fold.b) - place(fold.a)).normalized();
  return std::atan2(-left.cross(right).dot(way), left.dot(right)) / solver::kRadPerDeg;
}

void MotionReader::add_row() {
  const auto& folds = sheet_.panels.folds;
  const auto pilot = static_cast<std::size_t>(sheet_.mechanism.pilot);
  // Positive at the start, as the pilot's angle is everywhere.
  row_.pilot_deg = fold_angle_deg(folds[pilot]) * folds[pilot].sign;
  for (const solver::FoldLine& fold : folds) {
    row_.widest_deg = std::max(row_.widest_deg, std::abs(fold_angle_deg(fold)));
  }
  const auto place = [&](int vertex) -> Vector3d {
    const int panel = sheet_.panel_at(vertex);
    const auto& corners = sheet_.panels.corners[static_cast<std::size_t>(panel)];
    return corners_mm_.col(4 * panel +
                           (std::find(corners.begin(), corners.end(), vertex) - corners.begin()));
  };
  for (const solver::Diagonal& diagonal : sheet_.mechanism.diagonals) {
    const double pulled_mm =
        (place(diagonal.from) - place(diagonal.to)).norm() - sheet_.relaxed_mm(diagonal);
    row_.springs_n_mm += sheet_.stiffness_n_per_mm / 2 * pulled_mm * pulled_mm;
  }
  const bool is_later = rows_.empty() || row_.time_s >= rows_.back().time_s;
  const bool is_good = is_later && is_result(corners_mm_.cwiseAbs().sum()) &&
                       is_result(row_.time_s) && is_result(row_.pilot_deg) &&
                       is_result(row_.springs_n_mm) && is_result(row_.strain_n_mm) &&
                       is_result(row_.kinetic_n_mm);
  is_sound_ = is_sound_ && is_good;
  if (is_sound_) rows_.push_back(row_);
}

solver::StressHistory read_stresses(std::istream& file, const std::string& name,
                                    const SimulatedSheet& sheet, const PanelMesh& mesh,
                                    const StressOptions& options) {
  StressReader reader(sheet, mesh, options);
  for (std::string line; std::getline(file, line);) reader.see_line(line);
  if (!reader.has_places()) {
    throw UserError(Cause::failure, name +
                                        ": holds no elements (ccx ended before it wrote any); see "
                                        "what it says in its log beside it");
  }
  return reader.take();
}

}  // namespace misalign::schema
