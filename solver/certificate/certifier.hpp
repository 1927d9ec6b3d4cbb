// Makes certificates.
#pragma once

#include <memory>
#include <optional>

#include "solver/certificate/energy_claim.hpp"
#include "solver/model/model.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::solver {

class Certifier {
 public:
  /// `contact`: it also proves that no panels meet. `model` must outlive this object. With `fill`,
  /// which must be certifiable, it proves that the energy of that rises, without that every
  /// diagonal is monotone.
  explicit Certifier(const Model& model, bool contact = false,
                     const std::optional<Fill>& fill = {});
  ~Certifier();

  /// Certifies the sheet with these vertices, from flat to `asked_deg` (its D; at most 180) or as
  /// far as there is a proof.
  Certificate certify(const FlatVertices& vertices_mm, double asked_deg);

 private:
  struct Workspace;
  const std::unique_ptr<Workspace> workspace_;
};

}  // namespace misalign::solver
