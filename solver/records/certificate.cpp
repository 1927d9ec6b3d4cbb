#include "solver/records/certificate.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace misalign::solver {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::array<const char*, kCertificateEnds> kNames = {
    "to_the_end", "reversal",   "over_folded",   "sign_changed",
    "contact",    "fold_limit", "unclear_slope", "flat_branch"};

constexpr std::array<const char*, 2> kBy = {"diagonals", "energy"};

template <class Bits>
void put_bits(std::string& bytes, Bits bits) {
  for (std::size_t i = 0; i < sizeof bits; ++i) {
    bytes.push_back(static_cast<char>((bits >> (8 * i)) & 0xff));
  }
}
void put(std::string& bytes, double value) { put_bits(bytes, std::bit_cast<std::uint64_t>(value)); }
void put(std::string& bytes, float value) { put_bits(bytes, std::bit_cast<std::uint32_t>(value)); }

void put(std::string& bytes, const PathInterval& interval) {
  put(bytes, interval.to_deg);
  put(bytes, static_cast<float>(interval.box));
  put_bits<std::uint32_t>(bytes, interval.graded ? 1 : 0);
  // Tangents of a quarter of the angle, by arithmetic that is the same on every machine.
  for (const HalfAngle<double>& h : interval.middle.creases) {
    put(bytes, static_cast<float>(h.s / (1 + h.c)));
  }
  for (const Quaternion<double>& q : interval.middle.balls) {
    const double scale = (q.w < 0 ? -1 : 1) / (1 + std::abs(q.w));
    for (const double part : {q.x, q.y, q.z}) put(bytes, static_cast<float>(scale * part));
  }
}

// Reads numbers in turn; a sheet's certificate has a known length, so that none is missing.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class Bits>
  Bits bits() {
    Bits value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i) {
      value |=
          static_cast<Bits>(static_cast<Bits>(static_cast<unsigned char>(bytes_[i])) << (8 * i));
    }
    bytes_.remove_prefix(sizeof value);
    return value;
  }
  double real() { return std::bit_cast<double>(bits<std::uint64_t>()); }
  double single() { return std::bit_cast<float>(bits<std::uint32_t>()); }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

/// Largest tangent of a quarter angle: 1 at 180 degrees, slightly more for an over-folded crease.
constexpr double kLargestTangent = 1.01;
constexpr std::size_t kHeadBytes = 4 * 4 + 4 + 4 + 8;

std::size_t interval_bytes(const Mechanism& mechanism) {
  return 8 + 4 + 4 + 4 * mechanism.creases.size() + 12 * mechanism.balls.size();
}

// Reads an interval from `from_deg`; returns whether it is valid.
bool read(const Mechanism& mechanism, Reader& reader, double from_deg, PathInterval& interval) {
  interval.from_deg = from_deg;
  interval.to_deg = reader.real();
  interval.box = reader.single();
  const auto graded = reader.bits<std::uint32_t>();
  interval.graded = graded == 1;
  bool good = graded <= 1 && interval.to_deg > from_deg && interval.to_deg <= 180 &&
              interval.box > 0 && interval.box < 1;
  for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
    const double t = reader.single(), scale = 1 / (1 + t * t);
    good = good && std::abs(t) <= kLargestTangent;
    interval.middle.creases.push_back({scale * (1 - t * t), scale * 2 * t});
  }
  for (std::size_t i = 0; i < mechanism.balls.size(); ++i) {
    std::array<double, 3> t{};
    double squares = 0;
    for (double& part : t) {
      part = reader.single();
      squares += part * part;
    }
    good = good && squares <= kLargestTangent;
    const double scale = 1 / (1 + squares);
    interval.middle.balls.push_back(
        {scale * (1 - squares), scale * 2 * t[0], scale * 2 * t[1], scale * 2 * t[2]});
  }
  return good;
}

}  // namespace

const char* name_of(CertifiedBy criterion) { return kBy[static_cast<std::size_t>(criterion)]; }

std::optional<CertifiedBy> certified_by(std::string_view name) {
  for (std::size_t k = 0; k < kBy.size(); ++k) {
    if (name == kBy[k]) return static_cast<CertifiedBy>(k);
  }
  return std::nullopt;
}

std::optional<CertifiedBy> certified_by_of(std::string_view bytes) {
  constexpr std::size_t kPlace = 4 * 4 + 3;
  if (bytes.size() < kHeadBytes) return std::nullopt;
  const auto criterion = static_cast<unsigned char>(bytes[kPlace]);
  return criterion < kBy.size() ? std::optional(static_cast<CertifiedBy>(criterion)) : std::nullopt;
}

const char* name_of(CertificateEnd end) { return kNames[static_cast<std::size_t>(end)]; }

std::optional<CertificateEnd> certificate_end(std::string_view name) {
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    if (name == kNames[k]) return static_cast<CertificateEnd>(k);
  }
  return std::nullopt;
}

bool is_proven(CertificateEnd end) {
  return end == CertificateEnd::to_the_end || end == CertificateEnd::reversal ||
         end == CertificateEnd::over_folded || end == CertificateEnd::sign_changed;
}

bool is_proven(std::string_view name) {
  const auto end = certificate_end(name);
  return end && is_proven(*end);
}

std::string encode(const Mechanism& mechanism, const Certificate& certificate) {
  std::string bytes;
  put_bits(bytes, kVersion);
  put_bits(bytes, static_cast<std::uint32_t>(mechanism.creases.size()));
  put_bits(bytes, static_cast<std::uint32_t>(mechanism.balls.size()));
  put_bits(bytes, static_cast<std::uint32_t>(certificate.intervals.size()));
  put_bits(bytes, static_cast<std::uint8_t>(certificate.end));
  put_bits<std::uint8_t>(bytes, certificate.contact ? 1 : 0);
  put_bits<std::uint8_t>(bytes, certificate.closing ? 1 : 0);
  put_bits(bytes, static_cast<std::uint8_t>(certificate.criterion));
  put_bits(bytes, static_cast<std::uint32_t>(certificate.where));
  put(bytes, certificate.asked_deg);
  for (const PathInterval& interval : certificate.intervals) put(bytes, interval);
  if (certificate.closing) put(bytes, *certificate.closing);
  return bytes;
}

std::optional<Certificate> decode(const Mechanism& mechanism, std::string_view bytes) {
  if (bytes.size() < kHeadBytes) return std::nullopt;
  Reader reader(bytes);
  if (reader.bits<std::uint32_t>() != kVersion) return std::nullopt;
  if (reader.bits<std::uint32_t>() != mechanism.creases.size()) return std::nullopt;
  if (reader.bits<std::uint32_t>() != mechanism.balls.size()) return std::nullopt;
  const auto intervals = reader.bits<std::uint32_t>();
  const auto end = reader.bits<std::uint8_t>(), contact = reader.bits<std::uint8_t>();
  const auto closing = reader.bits<std::uint8_t>(), criterion = reader.bits<std::uint8_t>();
  if (end >= kCertificateEnds || contact > 1 || closing > 1 || criterion >= kBy.size())
    return std::nullopt;
  Certificate certificate;
  certificate.criterion = static_cast<CertifiedBy>(criterion);
  certificate.end = static_cast<CertificateEnd>(end);
  certificate.contact = contact == 1;
  certificate.where = static_cast<std::int32_t>(reader.bits<std::uint32_t>());
  certificate.asked_deg = reader.real();
  const bool good = certificate.asked_deg >= 0 && certificate.asked_deg <= 180;
  if (!good || reader.left() != (std::size_t{intervals} + closing) * interval_bytes(mechanism)) {
    return std::nullopt;
  }
  for (std::uint32_t k = 0; k < intervals; ++k) {
    PathInterval interval;
    if (!read(mechanism, reader, certificate.certified_deg(), interval)) return std::nullopt;
    certificate.intervals.push_back(std::move(interval));
  }
  if (closing == 1) {
    certificate.closing.emplace();
    if (!read(mechanism, reader, certificate.certified_deg(), *certificate.closing)) {
      return std::nullopt;
    }
  }
  return certificate;
}

}  // namespace misalign::solver
