// Runs every method at every tolerance and prints what it took and how far off it was.
#pragma once

namespace misalign::bench {

/// CSV on standard output, one line for each spacing, method and tolerance. Times are medians of
/// `repeats` rounds, in each of which every method has its turn once.
void measure_methods(int sheets, int repeats);

}  // namespace misalign::bench
