// Decides which requests are served: those of this machine's browser for the page and its data.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace misalign::search {

/// The relevant parts of a request; absent headers are empty.
struct PageRequest {
  std::string method, path;
  std::vector<std::string> hosts;  ///< every Host header
  std::string origin, fetch_site;  ///< Origin, Sec-Fetch-Site
  bool has_range = false;
  /// Returns whether the client is gone; may be called while the answer is being made.
  std::function<bool()> has_gone = [] { return false; };
};

/// The address of the page.
struct PagePlace {
  std::string address;  ///< numeric address
  int port;
};

struct Refusal {
  int status;
  std::string sentence;
};

/// Paths that are answered; a draw's number follows the last one.
inline constexpr const char *kPagePath = "/", *kLivePath = "/live", *kSheetPath = "/sheet/";

/// Returns the draw of a sheet's path.
std::optional<std::uint64_t> sheet_asked(const std::string& path);

/// Returns the reason to refuse a request; nothing for GET and HEAD of a known path at this
/// address. Pages of other sites can reach the loopback address through a name that resolves to it
/// (DNS rebinding, 421), or across origins (403). Other reasons: 404 another path, 405 another
/// method, 416 a part of an answer.
std::optional<Refusal> refusal(const PageRequest& request, const PagePlace& place);

}  // namespace misalign::search
