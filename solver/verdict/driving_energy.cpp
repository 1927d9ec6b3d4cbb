#include "solver/verdict/driving_energy.hpp"

#include <cassert>
#include <cmath>

namespace misalign::solver {

DrivingEnergy::DrivingEnergy(const Mechanism& mechanism, const Fill& fill)
    : diagonals_(mechanism.diagonals), width_mm_(mechanism.panel_width_mm) {
  assert(rest_deg(fill) == 0);
  const std::size_t count = diagonals_.size();
  rates_n_per_mm_.assign(count, 0);
  preload_n_.assign(count, 0);
  free_mm_.assign(count, std::nullopt);
  flat_mm_.assign(count, 0);
  relaxed_mm_.assign(count, 0);
  if (const auto* const springs = std::get_if<Springs>(&fill)) {
    assert(springs->on == SpringsOn::all && springs->other_rests_deg.empty());
    pull_only_ = springs->pull_only;
    const Eigen::VectorXd preload_n = springs->preload.forces_n(diagonals_);
    for (std::size_t d = 0; d < count; ++d) {
      rates_n_per_mm_[d] = springs->stiffness_n_per_mm;
      for (const SingleSpring& single : springs->single) {
        if (!single.is_on(diagonals_[d])) continue;
        rates_n_per_mm_[d] = single.stiffness_n_per_mm;
        free_mm_[d] = single.free_mm;
      }
      if (!free_mm_[d] && rates_n_per_mm_[d] > 0) {
        preload_n_[d] = preload_n(static_cast<Eigen::Index>(d));
      }
      has_preload_ = has_preload_ || preload_n_[d] != 0;
    }
  } else if (const auto* const plates = std::get_if<RubberPlates>(&fill)) {
    plates_ = *plates;
    ratios_.assign(count / 2, {1 / plates->prestretch, 1 / plates->prestretch});
    for (const CutOut& cut_out : plates->cut_outs) {
      ratios_[static_cast<std::size_t>(cut_out.hole)] = cut_out.of_flat;
    }
    products_mm2_.assign(count / 2, 0);
    laws_.reserve(count / 2);
  }
}

void DrivingEnergy::begin(const std::vector<double>& flat_lengths,
                          const SheetGeometry<double>* geometry) {
  assert(flat_lengths.size() == flat_mm_.size());
  for (std::size_t d = 0; d < flat_mm_.size(); ++d) {
    flat_mm_[d] = flat_lengths[d] * width_mm_;
    relaxed_mm_[d] = free_mm_[d].value_or(flat_mm_[d]);
  }
  if (!plates_) return;
  assert(geometry);
  cut_plates(*geometry);
}

void DrivingEnergy::cut_plates(const SheetGeometry<double>& geometry) {
  laws_.clear();
  for (std::size_t h = 0; h < ratios_.size(); ++h) {
    const auto along = [&](std::size_t d) -> Eigen::Vector2d {
      const auto from = static_cast<std::size_t>(diagonals_[d].from),
                 to = static_cast<std::size_t>(diagonals_[d].to);
      return width_mm_ *
             Eigen::Vector2d(geometry.x[to] - geometry.x[from], geometry.y[to] - geometry.y[from]);
    };
    products_mm2_[h] = along(2 * h).dot(along(2 * h + 1));
    const double first_mm = ratios_[h][0] * flat_mm_[2 * h];
    const double second_mm = ratios_[h][1] * flat_mm_[2 * h + 1];
    laws_.emplace_back(plates_->shear_mpa * plates_->thickness_mm,
                       HoleShape{first_mm * first_mm, second_mm * second_mm,
                                 ratios_[h][0] * ratios_[h][1] * products_mm2_[h]});
  }
}

void DrivingEnergy::set_sides(const std::vector<double>& first_lengths) {
  if (!has_preload_) return;
  for (std::size_t d = 0; d < flat_mm_.size(); ++d) {
    if (preload_n_[d] == 0) continue;
    const double change_mm = first_lengths[d] * width_mm_ - flat_mm_[d];
    const double side = change_mm > 0 ? 1 : change_mm < 0 ? -1 : 0;
    relaxed_mm_[d] = flat_mm_[d] - side * preload_n_[d] / rates_n_per_mm_[d];
  }
}

double DrivingEnergy::look(const std::vector<double>& lengths, std::vector<double>& forces_n,
                           std::vector<double>& stiffness_n_per_mm) const {
  double energy_n_mm = 0;
  if (!plates_) {
    for (std::size_t d = 0; d < flat_mm_.size(); ++d) {
      const double longer_mm = lengths[d] * width_mm_ - relaxed_mm_[d];
      forces_n[d] = pull_only_ && longer_mm <= 0 ? 0 : rates_n_per_mm_[d] * longer_mm;
      stiffness_n_per_mm[d] = rates_n_per_mm_[d];
      energy_n_mm += forces_n[d] * longer_mm / 2;
    }
    return energy_n_mm;
  }
  for (std::size_t h = 0; h < laws_.size(); ++h) {
    const HoleEnergy hole =
        laws_[h].at({lengths[2 * h] * width_mm_, lengths[2 * h + 1] * width_mm_}, products_mm2_[h]);
    energy_n_mm += hole.n_mm;
    for (int k = 0; k < 2; ++k) {
      forces_n[2 * h + static_cast<std::size_t>(k)] = hole.force_n(k);
      stiffness_n_per_mm[2 * h + static_cast<std::size_t>(k)] =
          hole.n_per_mm.row(k).cwiseAbs().sum();
    }
  }
  return energy_n_mm;
}

void find_crease_lengths(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                         std::vector<double>& creases_mm) {
  creases_mm.resize(mechanism.creases.size());
  for (std::size_t k = 0; k < creases_mm.size(); ++k) {
    const auto a = static_cast<std::size_t>(mechanism.creases[k].a),
               b = static_cast<std::size_t>(mechanism.creases[k].b);
    const double dx = geometry.x[b] - geometry.x[a], dy = geometry.y[b] - geometry.y[a];
    creases_mm[k] = std::sqrt(dx * dx + dy * dy) * mechanism.panel_width_mm;
  }
}

double turning_mm(const std::vector<double>& creases_mm,
                  const std::vector<HalfAngle<double>>& creases) {
  assert(creases_mm.size() == creases.size());
  double sum_mm = 0;
  for (std::size_t k = 0; k < creases.size(); ++k) {
    sum_mm += creases_mm[k] * std::abs(angle_rad(creases[k]));
  }
  return sum_mm;
}

}  // namespace misalign::solver
