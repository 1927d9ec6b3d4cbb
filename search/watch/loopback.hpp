// Resolves loopback addresses, on which alone a catalogue is served.
#pragma once

#include <string>

namespace misalign::search {

/// Returns a numeric loopback address or "localhost" as numbers: "127.0.0.1", "::1". UserError
/// (bad_request) for any other, with advice for other machines.
std::string loopback_address(const std::string& asked, int port);

/// Returns "http://127.0.0.1:8617/" or "http://[::1]:8617/".
std::string url_of(const std::string& address, int port);

}  // namespace misalign::search
