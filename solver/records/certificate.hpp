// A certificate: that from flat to an angle a sheet folds in one way, and every diagonal of its
// holes only grows or only shrinks. What it proves, how, and what it does not: README.md here.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

/// Why a certificate goes no farther.
enum class CertificateEnd {
  to_the_end,     ///< it reaches the angle that was asked for
  reversal,       ///< a diagonal turns back within the closing interval: proven
  over_folded,    ///< a crease reaches +-180 degrees within the closing interval: proven
  sign_changed,   ///< a crease becomes flat within the closing interval: proven
  contact,        ///< panels meet, or cannot be proven not to, within kClosing_deg
  fold_limit,     ///< J becomes singular: intervals get ever shorter
  unclear_slope,  ///< a diagonal stands still, or nearly: neither way is proven
  flat_branch     ///< no interval from flat can be proven: nothing is certified
};
inline constexpr int kCertificateEnds = 8;

/// "to_the_end", ...: as in files.
const char* name_of(CertificateEnd end);
std::optional<CertificateEnd> certificate_end(std::string_view name);
/// Whether a certificate that ends so proves that it happens, by its closing interval or by having
/// come to the angle asked for. Of the other ends it claims only that its proof goes no farther.
bool is_proven(CertificateEnd end);
/// By its name; false of a name that is none.
bool is_proven(std::string_view name);

/// An interval of pilot angles, and the state in its middle.
struct PathInterval {
  double from_deg = 0, to_deg = 0;
  /// Written in the joints' half-angle tangents over the pilot's, tau; its middle is then that of
  /// tau^2, otherwise that of the angle.
  bool graded = false;
  /// No other state of the sheet has all its unknowns this close to the path's (README.md,
  /// "Coordinates").
  double box = 0;
  FoldState<double> middle;
};

/// In its coordinates, the path's state in the middle of an interval is at most this far from the
/// one that the certificate holds, joint by joint: those are kept in single precision.
inline constexpr double kMiddleBox = 1e-6;
/// A reversal, or what else ends a certificate, is enclosed to within this.
inline constexpr double kClosing_deg = 1e-4;

struct Certificate {
  double asked_deg = 0;  ///< the angle up to which a proof was asked for
  CertificateEnd end = CertificateEnd::flat_branch;
  /// Of `reversal` and `unclear_slope` the diagonal (-1: a crease was unclear), of `over_folded`
  /// and `sign_changed` the crease, of `contact` the pair of pairs_of(panels); else -1.
  int where = -1;
  bool contact = false;  ///< whether it proves that no panels meet as well
  /// From flat on, each beginning where the one before ends.
  std::vector<PathInterval> intervals;
  /// Where the end is one that is proven to happen: from certified_deg() to at most kClosing_deg
  /// more, at whose end it has happened.
  std::optional<PathInterval> closing;

  /// The angle up to which everything is proven.
  double certified_deg() const { return intervals.empty() ? 0 : intervals.back().to_deg; }
};

/// As bytes, all numbers little-endian:
///   u32 version (1), u32 creases, u32 balls, u32 intervals, u8 end, u8 contact, u8 closing, u8 0,
///   i32 where, f64 asked_deg; then each interval, the closing one last: f64 to_deg, f32 box, u8
///   graded, 3 x u8 0, for each crease f32 tan(fold angle / 4), for each ball joint 3 x f32 (x, y,
///   z) / (1 + w) of its quaternion with w >= 0.
std::string encode(const Mechanism& mechanism, const Certificate& certificate);

/// None where these are not the bytes of a certificate of such a sheet: wrong sizes, numbers that
/// are not finite, angles that do not ascend from 0 to 180.
std::optional<Certificate> decode(const Mechanism& mechanism, std::string_view bytes);

/// The certificate with its states as encoding keeps them.
Certificate as_kept(const Mechanism& mechanism, const Certificate& certificate);

}  // namespace misalign::solver
