// Prepares the process before it opens any file: standard descriptors, and limits of file size.
#pragma once

namespace misalign::search {

/// Opens descriptors 0 to 2 where they are closed: a catalogue with one of these numbers would
/// receive the printed text. Reading them gives nothing; writing them still fails. A file beyond a
/// limit (ulimit -f, a quota) becomes an error of that file, not a signal.
void prepare_process();

}  // namespace misalign::search
