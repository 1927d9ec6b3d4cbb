// An exported MJCF model set in motion by MuJoCo.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace misalign {

class MujocoRun {
 public:
  /// @throws std::runtime_error  with MuJoCo's words
  explicit MujocoRun(const std::string& file) {
    std::string error(1000, '\0');
    model_.reset(mj_loadXML(file.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
    if (!model_) throw std::runtime_error(file + ": " + error.c_str());
    data_.reset(mj_makeData(model_.get()));
    restart();
  }

  void restart() {
    mj_resetData(model_.get(), data_.get());
    mj_forward(model_.get(), data_.get());
  }
  /// What is said of the state is of its end: mj_step alone leaves energies and sensors of stages
  /// before.
  void step() {
    mj_step(model_.get(), data_.get());
    mj_forward(model_.get(), data_.get());
  }

  /// Every joint's dry friction, times that of the file.
  void scale_friction(const MujocoRun& file, double factor) {
    for (int i = 0; i < model_->nv; ++i) {
      model_->dof_frictionloss[i] = factor * file.model_->dof_frictionloss[i];
    }
  }
  /// The damping of every hinge of the joint tree; a body that is free in space has none.
  void damp(double n_mm_s_per_rad) {
    for (int joint = 0; joint < model_->njnt; ++joint) {
      if (model_->jnt_type[joint] != mjJNT_HINGE) continue;
      model_->dof_damping[model_->jnt_dofadr[joint]] = n_mm_s_per_rad;
    }
  }
  bool has_friction() const {
    for (int i = 0; i < model_->nv; ++i) {
      if (model_->dof_frictionloss[i] > 0) return true;
    }
    return false;
  }

  double time_s() const { return data_->time; }
  double pilot_deg() const { return data_->sensordata[0] * 180 / mjPI; }
  double pilot_rate_deg_per_s() const { return data_->sensordata[1] * 180 / mjPI; }
  double spring_energy_n_mm() const { return data_->energy[0]; }
  double kinetic_energy_n_mm() const { return data_->energy[1]; }
  double mass_t() const { return mj_getTotalmass(model_.get()); }

  /// Where a point of the folded sheet, as the file has it, is carried by a panel.
  Eigen::Vector3d carried(const std::string& body, const Eigen::Vector3d& start_mm) const {
    const int id = mj_name2id(model_.get(), mjOBJ_BODY, body.c_str());
    if (id < 0) throw std::runtime_error("no body " + body);
    using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    return Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * id) +
           Eigen::Map<const Rows>(data_->xmat + 9 * id) * start_mm;
  }

 private:
  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
};

}  // namespace misalign
