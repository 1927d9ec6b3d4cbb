// Checks certificates by arithmetic that has nothing in common with their making: balls of many
// bits (FLINT's arb) instead of Taylor models of doubles. Slow and simple.
#pragma once

#include <optional>
#include <string>

#include "solver/fill/fill.hpp"
#include "solver/model/model.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::solver {

/// A claim of a certificate that is false, or that this check cannot prove.
struct CertificateFault {
  double from_deg, to_deg;  ///< ends of the interval
  std::string what;         ///< "the state in its middle is not the path's", ...
};

/// None where every claim holds for the sheet with these vertices. Certificates of an energy need
/// the filling whose energy it is.
std::optional<CertificateFault> check_certificate(const Model& model,
                                                  const FlatVertices& vertices_mm,
                                                  const Certificate& certificate,
                                                  const std::optional<Fill>& fill = {});

/// The same for a linkage whose panels are not known: claims that no panels meet are refused.
std::optional<CertificateFault> check_certificate(const Mechanism& mechanism,
                                                  const FlatVertices& vertices_mm,
                                                  const Certificate& certificate,
                                                  const std::optional<Fill>& fill = {});

}  // namespace misalign::solver
