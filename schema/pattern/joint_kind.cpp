#include "schema/pattern/joint_kind.hpp"

#include <algorithm>

#include "schema/files/json_values.hpp"
#include "schema/files/user_error.hpp"
#include "schema/pattern/design.hpp"

namespace misalign::schema {

void read_joint_kind(ObjectReader& reader, const char* key,
                     std::optional<solver::JointKind>& kind) {
  if (!reader.said(key)) return;
  const auto* const named = read_name(reader, key, kJointKinds, "is no kind of ball joint",
                                      "write \"loop\", \"ball\" or \"tab\", or null");
  if (named) kind = named->kind;
}

Json joint_kind_json(const std::optional<solver::JointKind>& kind) {
  for (const JointKindName& row : kJointKinds) {
    if (kind == row.kind) return row.name;
  }
  return nullptr;
}

std::optional<solver::JointParts> joints_of(const Design& design) {
  if (!design.joint_kind) return std::nullopt;
  solver::JointParts parts;
  parts.kind = *design.joint_kind;
  parts.bore_mm = design.joint_bore_mm.value_or(parts.bore_mm);
  parts.wire_mm = design.wire_mm.value_or(std::min(parts.wire_mm, parts.bore_mm));
  parts.edge_mm = design.joint_edge_mm.value_or(parts.edge_mm);
  parts.clearance_mm = design.joint_clearance_mm.value_or(parts.clearance_mm);
  parts.strip_mm = design.strip_mm.value_or(parts.strip_mm);
  if (parts.wire_mm > parts.bore_mm) {
    throw UserError(solver::OptionFault{
        "wire_mm", shown_number(parts.wire_mm),
        "thicker than the bores of ball joints, " + shown_number(parts.bore_mm) + " mm",
        "take thinner wire or larger bores"});
  }
  return parts;
}

}  // namespace misalign::schema
