// Decides which requests are served: those of this machine's own browser, for the page and its
// data.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace misalign::search {

/// What a request says that matters here; absent headers are empty.
struct PageRequest {
  std::string method, path;
  std::vector<std::string> hosts;  ///< every Host header
  std::string origin, fetch_site;  ///< Origin, Sec-Fetch-Site
  bool has_range = false;
  /// Whether nobody waits for the answer any more; may be asked while it is being made.
  std::function<bool()> has_gone = [] { return false; };
};

/// Where the page is served.
struct PagePlace {
  std::string address;  ///< in numbers
  int port;
};

struct Refusal {
  int status;
  std::string sentence;
};

/// The paths that are answered; after the last one a draw's number.
inline constexpr const char *kPagePath = "/", *kLivePath = "/live", *kSheetPath = "/sheet/";

/// The draw whose sheet a path asks for.
std::optional<std::uint64_t> sheet_asked(const std::string& path);

/// Why a request is refused; nothing for GET and HEAD of a known path, asked of this very place. A
/// page of another site reaches the loopback address too, under a name of its own that leads here
/// (DNS rebinding), or as a request across origins: 421 and 403. Else 404 another path, 405 another
/// method, 416 a part of an answer.
std::optional<Refusal> refusal(const PageRequest& request, const PagePlace& place);

}  // namespace misalign::search
