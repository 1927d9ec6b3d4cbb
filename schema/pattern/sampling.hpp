// Where a path is looked at, as campaigns and exported candidates say it.
#pragma once

#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

Json sampling_json(const Sampling& sampling);
/// The last angle at which something can be said of the pattern's sheet: where its base's path
/// ends, or the sample before 180 degrees where it closes there (closes_at_180).
double last_judged_deg(const Pattern& pattern, double sample_deg);

/// "sampling" of an exported candidate; the default where it is absent, to the last judged angle.
Sampling read_sampling(const Json& candidate, const Pattern& pattern, InputFaults& faults);

/// "between_samples" of a campaign or an exported candidate: false, true (by cubics) or "exact",
/// but that not of springs off the mid-plane.
void read_between_samples(ObjectReader& reader, const Pattern& pattern, solver::BumpRule& rule);
Json between_samples_json(solver::BumpRule rule);

}  // namespace misalign::schema
