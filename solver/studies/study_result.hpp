// The result of a study of a sheet: its value, or what stood in its way.
#pragma once

#include <cassert>
#include <optional>
#include <utility>
#include <variant>

#include "solver/studies/option_fault.hpp"

namespace misalign::solver {

/// Reasons in the sheet or the build, whatever the options.
enum class NoResult {
  path_lost,          ///< no folding path was found: a numerical failure
  not_in_this_build,  ///< the library that integrates motions is missing
  panels_not_stable,  ///< the stiffness of bending panels is not positive: a numerical failure
  overconstrained     ///< more equations than unknowns: no neighbour of the sheet folds
};
using Obstacle = std::variant<OptionFault, NoResult>;

template <typename T>
class StudyResult {
 public:
  StudyResult(T value) : outcome_(std::move(value)) {}
  /// The obstacle may be that of another study, on which this one is built.
  StudyResult(Obstacle obstacle) : outcome_(std::move(obstacle)) {}
  StudyResult(OptionFault fault) : outcome_(Obstacle(std::move(fault))) {}
  StudyResult(NoResult reason) : outcome_(Obstacle(reason)) {}

  explicit operator bool() const { return std::holds_alternative<T>(outcome_); }
  const T* operator->() const {
    assert(*this);
    return std::get_if<T>(&outcome_);
  }
  const T& operator*() const& { return *operator->(); }
  T operator*() && {
    assert(*this);
    return std::move(*std::get_if<T>(&outcome_));
  }
  std::optional<T> if_any() && { return *this ? std::optional(*std::move(*this)) : std::nullopt; }

  const Obstacle& obstacle() const {
    assert(!*this);
    return *std::get_if<Obstacle>(&outcome_);
  }
  /// Returns the fault; null where there is a value or a reason.
  const OptionFault* fault() const {
    return *this ? nullptr : std::get_if<OptionFault>(&obstacle());
  }
  /// Returns the reason; none where there is a value or a fault.
  std::optional<NoResult> reason() const {
    if (*this || fault()) return {};
    return std::get<NoResult>(obstacle());
  }

 private:
  std::variant<T, Obstacle> outcome_;
};

}  // namespace misalign::solver
