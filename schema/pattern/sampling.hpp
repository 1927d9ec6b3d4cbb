// Reads the sampling of a path in campaigns and exported candidates.
#pragma once

#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

Json sampling_json(const Sampling& sampling);
/// Returns the last angle at which a base's sheet with these shifts can be judged: the end of the
/// base's path, or the sample before 180 degrees if it closes there (closes_at_180).
double last_judged_deg(const solver::PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm,
                       double sample_deg);

/// Reads "sampling" of an exported candidate; by default up to the last judged angle.
Sampling read_sampling(const Json& candidate, const Pattern& pattern, InputFaults& faults);

/// Reads "between_samples" of a campaign or an exported candidate: false, true (by cubics) or
/// "exact", except for springs off the mid-plane.
void read_between_samples(ObjectReader& reader, const Pattern& pattern, solver::BumpRule& rule);
Json between_samples_json(solver::BumpRule rule);

}  // namespace misalign::schema
