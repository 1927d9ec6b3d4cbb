// Prepares the process before it opens any file: standard descriptors, and limits of file size.
#pragma once

namespace misalign::search {

/// Descriptors 0 to 2 are open: a catalogue that became one of them would get what is printed.
/// Those that were closed give nothing and take nothing, so that writing there still fails. A file
/// that grows beyond a limit (ulimit -f, a quota) is an error of that file, not a signal.
void prepare_process();

}  // namespace misalign::search
