#include "schema/pattern/sampling.hpp"

#include <cmath>

#include "schema/pattern/judging_fill.hpp"
#include "schema/pattern/perforation_check.hpp"

namespace misalign::schema {

void read_between_samples(ObjectReader& reader, const Pattern& pattern, solver::BumpRule& rule) {
  const Json* value = reader.find("between_samples");
  if (!value) return;
  if (*value == "exact" && !pattern.base.springs.in_mid_plane()) {
    reader.faults().add(
        reader.shown("between_samples"),
        "it needs lengths that are even functions of the pilot angle near flat, and "
        "those of springs off the mid-plane are not",
        "write true, which uses cubics");
  } else if (*value == "exact") {
    rule = solver::BumpRule::exact;
  } else if (value->is_boolean()) {
    rule = value->get<bool>() ? solver::BumpRule::by_cubic : solver::BumpRule::ignored;
  } else {
    reader.faults().add(reader.shown("between_samples"), "must be false, true or \"exact\"",
                        "write \"exact\" to judge the path itself between samples");
  }
}

Json between_samples_json(solver::BumpRule rule) {
  if (rule == solver::BumpRule::exact) return "exact";
  return rule == solver::BumpRule::by_cubic;
}

Json sampling_json(const Sampling& sampling) {
  Json json = {{"sample_deg", sampling.sample_deg},
               {"end_deg", sampling.end_deg},
               {"between_samples", between_samples_json(sampling.between_samples)}};
  if (sampling.energy_of) json.update(judging_fill_json(sampling.energy_of));
  return json;
}

double last_judged_deg(const solver::PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm,
                       double sample_deg) {
  const double end_deg = base.folding.end_deg();
  if (!closes_at_180(base, shifts_mm)) return end_deg;
  return std::max(std::ceil(end_deg / sample_deg) - 1, 1.0) * sample_deg;
}

Sampling read_sampling(const Json& candidate, const Pattern& pattern, InputFaults& faults) {
  static const Json kNothing = Json::object();
  Sampling sampling;
  const bool is_said = candidate.is_object() && candidate.contains("sampling");
  ObjectReader reader(is_said ? candidate["sampling"] : kNothing, "sampling", faults);
  reader.number("sample_deg", sampling.sample_deg, 0.01, 60, "try 1");
  if (faults.count() == 0) {
    sampling.end_deg = last_judged_deg(pattern.base, pattern.shifts_mm, sampling.sample_deg);
  }
  reader.number("end_deg", sampling.end_deg, 0.01, 180, "try 180");
  read_between_samples(reader, pattern, sampling.between_samples);
  sampling.energy_of = read_judging_fill(reader, pattern.base);
  reader.refuse_unknown_keys();
  return sampling;
}

}  // namespace misalign::schema
