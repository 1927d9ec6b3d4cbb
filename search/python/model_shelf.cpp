#include "search/python/model_shelf.hpp"

#include <algorithm>
#include <list>

#include "search/python/signals.hpp"

namespace misalign::search::python {
namespace {

constexpr std::size_t kMostModels = 4, kMostIdle = 4;  // some megabytes each

// Models by their last use, the latest first.
std::list<std::shared_ptr<ShelvedModel>>& shelf() {
  static std::list<std::shared_ptr<ShelvedModel>> models;
  return models;
}

bool is_same(const ModelKey& a, const ModelKey& b) {
  return a.threshold_sample == b.threshold_sample && a.ternary_mm == b.ternary_mm &&
         a.shifted == b.shifted && a.source->key == b.source->key;
}

std::shared_ptr<ShelvedModel> taken(const ModelKey& key) {
  auto& models = shelf();
  const auto at = std::find_if(models.begin(), models.end(),
                               [&](const auto& model) { return is_same(model->key, key); });
  if (at == models.end()) return nullptr;
  models.splice(models.begin(), models, at);
  return models.front();
}

std::shared_ptr<ShelvedModel> make(const ModelKey& key) {
  const schema::Sampling& sampling = key.source->sheet.sampling;
  const solver::PathPlanOptions path{sampling.sample_deg, sampling.end_deg};
  return std::make_shared<ShelvedModel>(
      ShelvedModel{key,
                   std::make_unique<const solver::Model>(key.source->sheet.base.base, key.shifted,
                                                         path, key.threshold_sample,
                                                         key.source->criterion, key.ternary_mm),
                   {}});
}

}  // namespace

ModelLoan::ModelLoan(const ModelKey& key) : shelved_(taken(key)) {
  if (!shelved_) {
    const auto made = unlocked([&] { return make(key); });
    shelved_ = taken(key);  // another thread may have made it meanwhile
    if (!shelved_) {
      shelved_ = made;
      shelf().push_front(made);
      if (shelf().size() > kMostModels) shelf().pop_back();
    }
  }
  if (!shelved_->idle.empty()) {
    batch_ = std::move(shelved_->idle.back());
    shelved_->idle.pop_back();
    return;
  }
  batch_ = unlocked([&] {
    return solver::make_batch(solver::available_instruction_sets().back(), *shelved_->model);
  });
}

ModelLoan::~ModelLoan() {
  if (shelved_->idle.size() < kMostIdle) shelved_->idle.push_back(std::move(batch_));
}

}  // namespace misalign::search::python
