// Names the kinds of ball joints, and takes them from a design.
#pragma once

#include <optional>

#include "schema/files/input.hpp"
#include "solver/play/joint_parts.hpp"

namespace misalign::schema {

struct JointKindName {
  const char* name;
  solver::JointKind kind;
};
inline constexpr JointKindName kJointKinds[] = {{"loop", solver::JointKind::loop},
                                                {"ball", solver::JointKind::ball},
                                                {"tab", solver::JointKind::tab}};

/// Reads a key that holds such a name; null and wrong names, which are faults, leave `kind`.
void read_joint_kind(ObjectReader& reader, const char* key, std::optional<solver::JointKind>& kind);

struct Design;

/// Returns a design's ball joints, with defaults; none without a kind. UserError (bad_request) if
/// their wire is thicker than their bores.
std::optional<solver::JointParts> joints_of(const Design& design);

/// Returns the name; null for none.
Json joint_kind_json(const std::optional<solver::JointKind>& kind);

}  // namespace misalign::schema
