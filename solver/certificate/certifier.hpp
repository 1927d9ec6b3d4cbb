// Makes certificates.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "solver/certificate/energy_claim.hpp"
#include "solver/model/model.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::solver {

struct PathTube;
struct EnergyAlong;

/// Sees the energy all over an interval; returns false where a shorter interval shall be tried.
using EnergyVisitor = std::function<bool(const PathTube&, const EnergyAlong&)>;

class Certifier {
 public:
  /// `contact`: it also proves that no panels meet. `model` must outlive this object. With `fill`,
  /// which must be certifiable, it proves that the energy of that rises, without that every
  /// diagonal is monotone.
  explicit Certifier(const Model& model, bool contact = false,
                     const std::optional<Fill>& fill = {});
  ~Certifier();

  /// Certifies the sheet with these vertices, from flat to `asked_deg` (its D; at most 180) or as
  /// far as there is a proof. With `visit`, which sees each interval in turn, it certifies the path
  /// alone, whichever way the energy of `fill` goes; `unclear_slope` where no interval is short
  /// enough for it.
  Certificate certify(const FlatVertices& vertices_mm, double asked_deg,
                      const EnergyVisitor& visit = {});

 private:
  struct Workspace;
  const std::unique_ptr<Workspace> workspace_;
};

}  // namespace misalign::solver
