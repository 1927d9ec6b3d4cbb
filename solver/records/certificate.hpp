// Defines a certificate: a proof that from flat to an angle a sheet folds in one way, and every
// diagonal of its holes only grows or only shrinks, or the energy of what fills them grows.
// solver/certificate/README.md has its claims and its method.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

/// The property of the diagonals that a certificate proves.
enum class CertifiedBy {
  diagonals,  ///< each of them only grows or only shrinks
  energy      ///< the total energy of what fills the holes only grows
};
/// Names as in files: "diagonals", "energy".
const char* name_of(CertifiedBy criterion);
std::optional<CertifiedBy> certified_by(std::string_view name);

/// Reason for which a certificate ends.
enum class CertificateEnd {
  to_the_end,     ///< it reaches the requested angle
  reversal,       ///< a diagonal, or the energy, turns back within the closing interval: proven
  over_folded,    ///< a crease reaches +-180 degrees within the closing interval: proven
  sign_changed,   ///< a crease becomes flat within the closing interval: proven
  contact,        ///< panels meet, or cannot be proven not to, within kClosing_deg
  fold_limit,     ///< J becomes singular: intervals get ever shorter
  unclear_slope,  ///< a diagonal's slope is nearly zero: neither sign is proven
  flat_branch     ///< no interval from flat can be proven: nothing is certified
};
inline constexpr int kCertificateEnds = 8;

/// Names as in files: "to_the_end", ...
const char* name_of(CertificateEnd end);
std::optional<CertificateEnd> certificate_end(std::string_view name);
/// Returns whether a certificate proves its end, by its closing interval or by reaching the
/// requested angle. Other ends only mean that the proof goes no farther.
bool is_proven(CertificateEnd end);
/// Takes the end's name; false for an unknown name.
bool is_proven(std::string_view name);

/// An interval of pilot angles, and the state in its middle.
struct PathInterval {
  double from_deg = 0, to_deg = 0;
  /// True if written in the joints' half-angle tangents over the pilot's, tau; its middle is then
  /// that of tau^2, else that of the angle.
  bool graded = false;
  /// No other state of the sheet has all its unknowns this close to the path's (README.md,
  /// "Coordinates").
  double box = 0;
  FoldState<double> middle;
};

/// Largest distance, per joint in the interval's coordinates, of the path's state in the middle
/// from the certificate's, which is kept in single precision.
inline constexpr double kMiddleBox = 1e-6;
/// Largest length of a closing interval, which encloses a reversal or other proven end.
inline constexpr double kClosing_deg = 1e-4;

struct Certificate {
  double asked_deg = 0;  ///< the requested angle
  CertifiedBy criterion = CertifiedBy::diagonals;
  CertificateEnd end = CertificateEnd::flat_branch;
  /// The diagonal of `reversal` and `unclear_slope` (-1: a crease was unclear), the crease of
  /// `over_folded` and `sign_changed`, the pair of pairs_of(panels) of `contact`; else -1, as where
  /// the energy turns back.
  int where = -1;
  bool contact = false;  ///< true if it also proves that no panels meet
  /// Intervals from flat, each beginning where the one before ends.
  std::vector<PathInterval> intervals;
  /// Interval of a proven end: from certified_deg() to at most kClosing_deg more, where it has
  /// happened.
  std::optional<PathInterval> closing;

  /// The certified angle.
  double certified_deg() const { return intervals.empty() ? 0 : intervals.back().to_deg; }
};

/// Encodes as bytes, all numbers little-endian:
///   u32 version (1), u32 creases, u32 balls, u32 intervals, u8 end, u8 contact, u8 closing, u8 by,
///   i32 where, f64 asked_deg; then each interval, the closing one last: f64 to_deg, f32 box, u8
///   graded, 3 x u8 0, for each crease f32 tan(fold angle / 4), for each ball joint 3 x f32 (x, y,
///   z) / (1 + w) of its quaternion with w >= 0.
std::string encode(const Mechanism& mechanism, const Certificate& certificate);

/// Returns the property that the certificate of these bytes proves; none where they do not say.
std::optional<CertifiedBy> certified_by_of(std::string_view bytes);

/// None if the bytes are no certificate of such a sheet: wrong sizes, numbers that are not finite,
/// angles that do not ascend from 0 to 180.
std::optional<Certificate> decode(const Mechanism& mechanism, std::string_view bytes);

}  // namespace misalign::solver
