// Cost against the size of the sheet.
#pragma once

namespace misalign::bench {

/// CSV on standard output, one line for each size and linear solver. Times are medians of
/// `repeats`.
void measure_mesh(int repeats);

}  // namespace misalign::bench
