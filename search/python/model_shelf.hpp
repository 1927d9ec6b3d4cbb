// A cache of models that were used lately, with their lanes: making them ready takes longer than
// judging a thousand sheets. Guarded by the GIL, which is held across fork: a child finds it whole.
#pragma once

#include <memory>
#include <vector>

#include "search/python/pattern_source.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search::python {

/// What tells one model from another.
struct ModelKey {
  std::shared_ptr<PatternSource> source;
  std::vector<int> shifted;
  double ternary_mm;
  int threshold_sample;  ///< 0: none
};

struct ShelvedModel {
  ModelKey key;
  std::unique_ptr<const solver::Model> model;
  std::vector<std::unique_ptr<solver::Batch>> idle;
};

/// A model, and lanes of it that nobody else uses until this is gone. Made and destroyed with the
/// GIL, which it gives up while it makes something ready.
class ModelLoan {
 public:
  explicit ModelLoan(const ModelKey& key);
  ~ModelLoan();
  ModelLoan(const ModelLoan&) = delete;
  ModelLoan& operator=(const ModelLoan&) = delete;

  const solver::Model& model() const { return *shelved_->model; }
  solver::Batch& batch() const { return *batch_; }

 private:
  std::shared_ptr<ShelvedModel> shelved_;
  std::unique_ptr<solver::Batch> batch_;
};

}  // namespace misalign::search::python
