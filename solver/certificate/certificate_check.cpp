#include "solver/certificate/certificate_check.hpp"

#include <algorithm>
#include <cassert>

#include "solver/certificate/energy_check.hpp"
#include "solver/certificate/panel_check.hpp"

namespace misalign::solver {
namespace {

Proof both(Proof a, Proof b) {
  if (a == Proof::fails || b == Proof::fails) return Proof::fails;
  return a == Proof::holds ? b : a;
}

CheckModel times(int sign, const CheckModel& f) { return sign > 0 ? f : -f; }

bool is_event(CertificateEnd end) {
  return end == CertificateEnd::reversal || end == CertificateEnd::over_folded ||
         end == CertificateEnd::sign_changed;
}

// Returns whether `where` is a diagonal, a crease or nothing, as the end requires. An unclear slope
// may name the diagonal, which claims nothing.
bool is_place(const Mechanism& mechanism, const PanelCheck* panels,
              const Certificate& certificate) {
  const auto diagonals = static_cast<int>(mechanism.diagonals.size());
  const auto creases = static_cast<int>(mechanism.creases.size());
  const int where = certificate.where;
  if (certificate.criterion == CertifiedBy::energy &&
      (certificate.end == CertificateEnd::reversal ||
       certificate.end == CertificateEnd::unclear_slope)) {
    return where == -1;
  }
  if (certificate.end == CertificateEnd::reversal) return where >= 0 && where < diagonals;
  if (is_event(certificate.end)) return where >= 0 && where < creases && where != mechanism.pilot;
  if (certificate.end == CertificateEnd::unclear_slope) {
    return where >= -1 && where < diagonals;
  }
  if (certificate.end == CertificateEnd::contact) {
    return panels != nullptr && where >= 0 && where < panels->pairs();
  }
  return where == -1;
}

// Finds faults without any proof.
const char* fault_of_form(const Mechanism& mechanism, const PanelCheck* panels,
                          const std::optional<Fill>& fill, const Certificate& certificate) {
  if (certificate.criterion == CertifiedBy::energy) {
    if (!fill) return "it is of an energy, and nothing is known of what fills the holes";
    if (const char* why = why_not_certifiable(*fill, mechanism.springs)) return why;
  }
  if (certificate.contact && panels == nullptr) return "nothing is known of the panels";
  if (certificate.end == CertificateEnd::contact && !certificate.contact) {
    return "it ends at a contact, and proves none";
  }
  const double certified_deg = certificate.certified_deg();
  if (!(certificate.asked_deg >= 0 && certificate.asked_deg <= 180)) {
    return "the angle that was asked for is not between 0 and 180";
  }
  if (!(certified_deg <= certificate.asked_deg)) return "it goes beyond the angle asked for";
  if ((certificate.end == CertificateEnd::to_the_end) != (certified_deg == certificate.asked_deg)) {
    return "where it ends is not the angle asked for, or that is not called its end";
  }
  if (certificate.end == CertificateEnd::flat_branch && !certificate.intervals.empty()) {
    return "it has pieces although none is proven from flat";
  }
  if (is_event(certificate.end) != certificate.closing.has_value()) {
    return "its end needs a closing piece, or must not have one";
  }
  if (!is_place(mechanism, panels, certificate)) return "there is no such place as where it ends";
  if (certificate.closing && !(certificate.closing->to_deg - certified_deg <= kClosing_deg)) {
    return "its closing piece is too long";
  }
  return nullptr;
}

// Checks one interval, and that it begins where the one before ends.
const char* fault_of_interval(const Mechanism& mechanism, const PathInterval& interval,
                              double from_deg) {
  if (interval.from_deg != from_deg) return "it does not begin where the one before ends";
  if (!(interval.to_deg > interval.from_deg && interval.to_deg <= 180))
    return "its angles do not ascend";
  if (interval.from_deg == 0 && !interval.graded) return "the piece at flat is not graded";
  if (interval.graded && interval.to_deg == 180) return "a graded piece cannot reach 180 degrees";
  if (!(interval.box > 0 && interval.box < 1)) return "its box is no size";
  if (interval.middle.creases.size() != mechanism.creases.size() ||
      interval.middle.balls.size() != mechanism.balls.size()) {
    return "its state has not the sheet's joints";
  }
  return nullptr;
}

class Checker {
 public:
  Checker(const Mechanism& mechanism, const PanelCheck* panels, const std::optional<Fill>& fill,
          const FlatVertices& vertices_mm, const Certificate& certificate)
      : mechanism_(mechanism),
        panels_(panels),
        fill_(fill),
        certificate_(certificate),
        prover_(mechanism, vertices_mm) {}

  std::optional<CertificateFault> run() {
    if (const char* what = fault_of_form(mechanism_, panels_, fill_, certificate_)) {
      return CertificateFault{0, certificate_.certified_deg(), what};
    }
    if (is_of_energy()) energy_.emplace(mechanism_, prover_, *fill_);
    double from_deg = 0;
    for (const PathInterval& interval : certificate_.intervals) {
      const char* what = fault_of_interval(mechanism_, interval, from_deg);
      if (what == nullptr)
        what = check(interval, Claims{true, true, true, certificate_.contact, -1});
      if (what != nullptr) return CertificateFault{interval.from_deg, interval.to_deg, what};
      from_deg = interval.to_deg;
    }
    if (!certificate_.closing) return std::nullopt;
    const PathInterval& closing = *certificate_.closing;
    const char* what = fault_of_interval(mechanism_, closing, from_deg);
    if (what == nullptr) what = check_closing(closing);
    if (what != nullptr) return CertificateFault{closing.from_deg, closing.to_deg, what};
    return std::nullopt;
  }

 private:
  bool is_of_energy() const { return certificate_.criterion == CertifiedBy::energy; }

  // Claims that must hold all over an interval.
  struct Claims {
    bool cosines, sines, slopes, contact;
    int crease;  ///< the only one that must keep its sign; -1: all
  };

  const char* check(const PathInterval& interval, const Claims& claims) {
    assert(!claims.contact || panels_ != nullptr);
    const char* unproven = "no curve of single states is proven within its box";
    const auto question = [&](const ProvenInterval& whole,
                              const ProvenInterval::Subinterval& subinterval) {
      const Proof folds = folds_rightly(subinterval, claims);
      if (folds != Proof::holds) {
        unproven = "a crease is not proven to keep its sign and to stay below 180 degrees";
        return folds;
      }
      const Proof slopes = claims.slopes ? keeps_slopes(whole, subinterval) : Proof::holds;
      if (slopes != Proof::holds) {
        unproven = is_of_energy() ? "the energy is not proven to go on rising"
                                  : "a diagonal is not proven to go on growing or shrinking";
        return slopes;
      }
      if (!claims.contact) return slopes;
      unproven = "two panels are not proven to stay apart";
      return panels_->are_apart(prover_, whole, subinterval);
    };
    ProvenInterval next;
    if (prover_.prove(interval, question, next) != Proof::holds) return unproven;
    if (!holds_middle(next)) return "the state in its middle is not the path's";
    if (!subintervals_join(next) || !joins(next)) return "it does not join the piece before";
    last_ = std::move(next);
    return nullptr;
  }

  Proof folds_rightly(const ProvenInterval::Subinterval& subinterval, const Claims& claims) const {
    Proof proof = Proof::holds;
    for (std::size_t i = 0; i < mechanism_.creases.size(); ++i) {
      if (static_cast<int>(i) == mechanism_.pilot) continue;
      if (claims.crease >= 0 && static_cast<int>(i) != claims.crease) continue;
      const int sign = mechanism_.creases[i].assignment;
      if (claims.cosines) proof = both(proof, is_positive(subinterval.cosines[i]));
      if (claims.sines) proof = both(proof, is_positive(times(sign, subinterval.sines[i])));
      if (proof == Proof::fails) break;
    }
    return proof;
  }

  Proof keeps_slopes(const ProvenInterval& whole, const ProvenInterval::Subinterval& subinterval) {
    if (energy_) return is_positive(energy_->slope(whole, subinterval));
    if (signs_.empty()) {
      for (const CheckModel& slope : subinterval.slopes) {
        signs_.push_back(value_at(slope, ArbNumber(0.0)) < ArbNumber(0.0) ? -1 : 1);
      }
    }
    assert(signs_.size() == subinterval.slopes.size());
    Proof proof = Proof::holds;
    for (std::size_t d = 0; d < signs_.size() && proof != Proof::fails; ++d) {
      proof = both(proof, is_positive(times(signs_[d], subinterval.slopes[d])));
    }
    return proof;
  }

  // tan of half the pilot's angle at s.
  static ArbNumber tau_at(const ProvenInterval& interval, const ArbNumber& s) {
    if (!interval.interval.graded) return ArbNumber(1.0);
    return root_of(ArbNumber(interval.sigma) + ArbNumber(interval.width) * s);
  }

  bool holds_middle(const ProvenInterval& interval) const {
    const FoldState<double>& state = interval.interval.middle;
    IntervalProver::JointPlaces places;
    for (const HalfAngle<double>& h : state.creases) {
      places.creases.push_back({ArbNumber(h.c), ArbNumber(h.s)});
    }
    for (const Quaternion<double>& q : state.balls) {
      places.balls.push_back({ArbNumber(q.w), ArbNumber(q.x), ArbNumber(q.y), ArbNumber(q.z)});
    }
    const std::vector<ArbNumber> kept =
        prover_.unknowns(interval, places, tau_at(interval, interval.middle));
    const std::vector<ArbNumber> proven = interval.unknowns_at(interval.middle);
    for (std::size_t j = 0; j < kept.size(); ++j) {
      if (!(size_of(kept[j] - proven[j]) < ArbNumber(kMiddleBox))) return false;
    }
    return true;
  }

  // Returns whether a state lies in the box of the subinterval, which has one state alone.
  static bool is_within(const ProvenInterval::Subinterval& subinterval, const ArbNumber& s,
                        const std::vector<ArbNumber>& unknowns) {
    assert(unknowns.size() >= subinterval.guess.size());
    const ArbNumber place = (s - ArbNumber(subinterval.middle)) / ArbNumber(subinterval.half);
    if (!(size_of(place) <= ArbNumber(1.0))) return false;
    for (std::size_t j = 0; j < subinterval.guess.size(); ++j) {
      CheckModel guess;
      for (int k = 0; k <= kCheckDegree; ++k) arb_set_d(guess[k], subinterval.guess[j].c[k]);
      const ArbNumber off = size_of(unknowns[j] - value_at(guess, place));
      if (!(off < ArbNumber(subinterval.radius[static_cast<Eigen::Index>(j)]))) return false;
    }
    return true;
  }

  static bool subintervals_join(const ProvenInterval& interval) {
    for (std::size_t k = 1; k < interval.subintervals.size(); ++k) {
      const ProvenInterval::Subinterval& next = interval.subintervals[k];
      const ArbNumber s(next.middle - next.half);
      if (!is_within(next, s, interval.unknowns_at(s))) return false;
    }
    return true;
  }

  bool joins(const ProvenInterval& next) const {
    assert(!next.subintervals.empty() && "only what is proven is joined");
    if (last_.subintervals.empty()) return next.interval.from_deg == 0;
    const ArbNumber tau = half_tangent(ArbNumber(next.interval.from_deg));
    const IntervalProver::JointPlaces places =
        prover_.places(last_, last_.unknowns_at(last_.to), tau);
    return is_within(next.subintervals.front(), next.from, prover_.unknowns(next, places, tau));
  }

  const char* check_closing(const PathInterval& closing) {
    assert(is_event(certificate_.end) && (certificate_.where >= 0 || is_of_energy()));
    // A crease must end as claimed: its sine keeps its sign while its cosine changes, or its cosine
    // while its sine does.
    const Claims claims{certificate_.end == CertificateEnd::sign_changed,
                        certificate_.end == CertificateEnd::over_folded, false, false,
                        certificate_.where};
    if (const char* what = check(closing, claims)) return what;
    const auto where = static_cast<std::size_t>(certificate_.where);  // -1 only of an energy
    const ProvenInterval::Subinterval& subinterval = last_.subintervals.back();
    const ArbNumber place =
        (last_.to - ArbNumber(subinterval.middle)) / ArbNumber(subinterval.half);
    ArbNumber value;
    if (certificate_.end == CertificateEnd::reversal && energy_) {
      value = value_at(energy_->slope(last_, subinterval), place);
    } else if (certificate_.end == CertificateEnd::reversal) {
      value = value_at(times(signs_[where], subinterval.slopes[where]), place);
    } else if (certificate_.end == CertificateEnd::over_folded) {
      value = value_at(subinterval.cosines[where], place);
    } else {
      value =
          value_at(times(mechanism_.creases[where].assignment, subinterval.sines[where]), place);
    }
    return value < ArbNumber(0.0) ? nullptr : "what ends it is not proven to happen";
  }

  const Mechanism& mechanism_;
  const PanelCheck* const panels_;
  const std::optional<Fill>& fill_;
  const Certificate& certificate_;
  IntervalProver prover_;
  std::optional<EnergyCheck> energy_;  // none: each diagonal
  ProvenInterval last_;
  std::vector<int> signs_;  // signs of the diagonals' slopes
};

}  // namespace

std::optional<CertificateFault> check_certificate(const Mechanism& mechanism,
                                                  const FlatVertices& vertices_mm,
                                                  const Certificate& certificate,
                                                  const std::optional<Fill>& fill) {
  return Checker(mechanism, nullptr, fill, vertices_mm, certificate).run();
}

std::optional<CertificateFault> check_certificate(const Model& model,
                                                  const FlatVertices& vertices_mm,
                                                  const Certificate& certificate,
                                                  const std::optional<Fill>& fill) {
  const Panels panels = panels_of(model.base(), model.mechanism());
  const PanelCheck check(model.shape(), panels);
  return Checker(model.mechanism(), &check, fill, vertices_mm, certificate).run();
}

}  // namespace misalign::solver
