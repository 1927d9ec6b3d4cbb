// A study of stress, as text.
#pragma once

#include "search/sheets/stress_study.hpp"

namespace misalign::search {

/// How it was let go, whether it deployed and the largest stresses; then the motion in at most
/// twenty rows, beside that of rigid panels.
std::string stress_text(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                        const solver::StressStudy& study);

}  // namespace misalign::search
