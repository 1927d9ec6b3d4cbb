// The loopback address, the only one that a catalogue is shown on.
#pragma once

#include <string>

namespace misalign::search {

/// A loopback address, in numbers, or "localhost": "127.0.0.1", "::1". UserError (bad_request) for
/// any other, with how to look from another machine.
std::string loopback_address(const std::string& asked, int port);

/// "http://127.0.0.1:8617/", "http://[::1]:8617/".
std::string url_of(const std::string& address, int port);

}  // namespace misalign::search
