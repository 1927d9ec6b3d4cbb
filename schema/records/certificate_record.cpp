#include "schema/records/certificate_record.hpp"

#include <fmt/format.h>

namespace misalign::schema {

std::string CertificateFinding::sentence() const {
  if (!interval) return fmt::format("draw {}: {}", draw, what);
  return fmt::format("draw {}, {:.10g} to {:.10g} deg: {}", draw, interval->from_deg,
                     interval->to_deg, what);
}

}  // namespace misalign::schema
