// Caches recently used models with their lanes: building one takes longer than judging a thousand
// sheets. The GIL guards the cache and is held across fork, so that a child finds it consistent.
#pragma once

#include <memory>
#include <vector>

#include "search/python/pattern_source.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search::python {

/// The properties that identify a model.
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

/// A model with lanes for exclusive use during its life. Made and destroyed with the GIL, which it
/// releases while it builds.
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
