#include "schema/records/certificate_record.hpp"

#include <fmt/format.h>

#include <utility>

namespace misalign::schema {

NamedCertificate named_certificate(std::string name, CertificateRecord row, bool is_new) {
  const std::size_t bytes = row.proof.size();
  row.proof = {};
  return {std::move(name), std::move(row), bytes, is_new};
}

std::string CertificateFinding::sentence() const {
  if (!interval) return fmt::format("draw {}: {}", draw, what);
  return fmt::format("draw {}, {:.10g} to {:.10g} deg: {}", draw, interval->from_deg,
                     interval->to_deg, what);
}

}  // namespace misalign::schema
