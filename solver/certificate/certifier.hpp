// Makes certificates.
#pragma once

#include <memory>

#include "solver/model/model.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::solver {

class Certifier {
 public:
  /// `contact`: it also proves that no panels meet. `model` must outlive this object.
  explicit Certifier(const Model& model, bool contact = false);
  ~Certifier();

  /// Certifies the sheet with these vertices, from flat to `asked_deg` (its D; at most 180) or as
  /// far as there is a proof.
  Certificate certify(const FlatVertices& vertices_mm, double asked_deg);

 private:
  struct Workspace;
  const std::unique_ptr<Workspace> workspace_;
};

}  // namespace misalign::solver
