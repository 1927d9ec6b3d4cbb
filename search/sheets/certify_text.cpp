#include "search/sheets/certify_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "schema/exchange/certify_json.hpp"
#include "schema/files/printable.hpp"
#include "schema/files/text_table.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "search/terminal/count_text.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::search {
namespace {

using solver::CertificateEnd;

constexpr std::size_t kFew = 20;

// Rounds down, but for the rounding of decimals: no more is certified.
std::string shown_deg(double certified_deg) {
  constexpr double kParts = 1e4, kRounding = 1e-6;
  return fmt::format("{:.10g}", std::floor(certified_deg * kParts + kRounding) / kParts);
}

bool is_of_energy(const schema::NamedCertificate& sheet) {
  return sheet.criterion == solver::CertifiedBy::energy;
}

// The reason why a proof ends before the requested angle.
std::string reason(CertificateEnd end, const std::string& place, bool is_of_energy) {
  switch (end) {
    case CertificateEnd::to_the_end:
      break;
    case CertificateEnd::reversal:
      return place.empty() ? "there the energy stops rising"
                           : "there diagonal " + place + " reverses";
    case CertificateEnd::over_folded:
      return "there crease " + place + " folds past 180 deg";
    case CertificateEnd::sign_changed:
      return "there crease " + place + " becomes flat";
    case CertificateEnd::contact:
      return "beyond it panels " + place + " are not proven apart";
    case CertificateEnd::fold_limit:
      return "there the proof stops, next to a fold limit";
    case CertificateEnd::unclear_slope:
      return is_of_energy ? "beyond it the energy or a crease is not proven monotone"
                          : "beyond it a diagonal or crease is not proven monotone";
    case CertificateEnd::flat_branch:
      return "the branch next to flat cannot be proven";
  }
  return "";
}

std::string reason(const schema::NamedCertificate& sheet) {
  return reason(solver::certificate_end(sheet.row.end).value_or(CertificateEnd::flat_branch),
                sheet.row.place, is_of_energy(sheet));
}

template <class Value>
auto median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Quantity>
auto median_of(const std::vector<schema::NamedCertificate>& sheets, const Quantity& quantity) {
  std::vector<decltype(quantity(sheets.front()))> values;
  for (const schema::NamedCertificate& sheet : sheets) values.push_back(quantity(sheet));
  return median(std::move(values));
}

schema::Row row_of(const std::string& end, const std::vector<double>& certified_deg) {
  return {end, std::to_string(certified_deg.size()),
          shown_deg(*std::min_element(certified_deg.begin(), certified_deg.end())),
          shown_deg(median(certified_deg)),
          shown_deg(*std::max_element(certified_deg.begin(), certified_deg.end()))};
}

std::string summary_of(const std::vector<schema::NamedCertificate>& sheets) {
  std::map<std::string, std::vector<double>> by_end;
  std::vector<double> all;
  std::size_t existing = 0;
  for (const schema::NamedCertificate& sheet : sheets) {
    by_end[sheet.row.end].push_back(sheet.row.certified_deg);
    all.push_back(sheet.row.certified_deg);
    existing += !sheet.is_new;
  }
  std::vector<schema::Row> rows = {{"end", "sheets", "smallest deg", "median deg", "largest deg"}};
  for (const auto& [end, certified_deg] : by_end) rows.push_back(row_of(end, certified_deg));
  if (by_end.size() > 1) rows.push_back(row_of("all", all));
  std::string text = schema::aligned(rows, {false, true, true, true, true});
  text += fmt::format(
      "median {:.3g} ms, {} intervals and {:.3g} kB",
      1e3 * median_of(sheets,
                      [](const schema::NamedCertificate& sheet) { return sheet.row.seconds; }),
      median_of(sheets, [](const schema::NamedCertificate& sheet) { return sheet.row.intervals; }),
      1e-3 * static_cast<double>(median_of(
                 sheets, [](const schema::NamedCertificate& sheet) { return sheet.bytes; })));
  if (existing > 0) text += fmt::format("; {} existed already", existing);
  return text + "\n";
}

// Counts ends: "3 (reversal 2, to_the_end 1)"; empty if there are none.
std::string ends_text(const schema::CertificateCheck& check, bool proven) {
  std::uint64_t count = 0;
  std::string names;
  for (const auto& [end, certificates] : check.ends) {
    if (solver::is_proven(end) != proven) continue;
    count += certificates;
    names += fmt::format("{}{} {}", names.empty() ? "" : ", ", end, certificates);
  }
  return count == 0 ? "" : fmt::format("{} ({})", count, names);
}

std::string ends_text(const schema::CertificateCheck& check) {
  const std::string proven = ends_text(check, true), others = ends_text(check, false);
  std::string text;
  if (!proven.empty()) text += "proven ends: " + proven + "\n";
  if (!others.empty()) {
    text += "unproven ends: " + others + "; the proof merely stops there\n";
  }
  return text;
}

// The angle of a stationary point, whose part is at most as long as the last decimal.
std::string at_deg(const solver::StationaryPoint& point) {
  return fmt::format("{:.2f}", 0.5 * (point.from_deg + point.to_deg));
}

// "no well", "one well at 90.00 deg", "2 wells at 67.92 and 121.54 deg".
std::string wells_words(const solver::EnergyWells& wells) {
  std::vector<std::string> angles;
  for (const solver::StationaryPoint& point : wells.points) {
    if (point.kind == solver::Stationary::well) angles.push_back(at_deg(point));
  }
  if (angles.empty()) return "no well";
  return (angles.size() == 1 ? "one well" : fmt::format("{} wells", angles.size())) +
         fmt::format(" at {} deg", fmt::join(angles, " and "));
}

// The energies of tops above the wells beside them, and of flat.
std::string barriers_words(const solver::EnergyWells& wells) {
  std::string text = wells.flat == solver::Stationary::well
                         ? "; flat is a well, too"
                         : "; flat is no well, the energy falls from there";
  for (std::size_t k = 0; k < wells.points.size(); ++k) {
    const solver::StationaryPoint& top = wells.points[k];
    if (top.kind != solver::Stationary::top) continue;
    const double before_n_mm = (k == 0 ? wells.flat_energy : wells.points[k - 1].energy).n_mm;
    text += fmt::format("; a top at {} deg, {:.4g} N mm above {}", at_deg(top),
                        top.energy.n_mm - before_n_mm,
                        k == 0 ? "flat" : at_deg(wells.points[k - 1]) + " deg");
    if (k + 1 == wells.points.size()) continue;
    const solver::StationaryPoint& next = wells.points[k + 1];
    text +=
        fmt::format(" and {:.4g} above {} deg", top.energy.n_mm - next.energy.n_mm, at_deg(next));
  }
  return text;
}

}  // namespace

std::string wells_text(const solver::Sheet& sheet, const solver::EnergyWells& wells) {
  const std::string why =
      wells.end == CertificateEnd::unclear_slope
          ? "beyond it a slope of the energy, or the side of a crease, is not proven"
          : reason(wells.end, schema::crease_place(sheet.mechanism(), wells), true);
  if (!wells.flat) return fmt::format("{}: no well is proven: {}\n", sheet.name(), why);
  std::string text = fmt::format("{}: {} between flat and {} deg, proven", sheet.name(),
                                 wells_words(wells), shown_deg(wells.proven_deg));
  text += barriers_words(wells);
  if (wells.end == CertificateEnd::to_the_end) return text + "\n";
  return text + fmt::format("; {:.10g} deg were requested: {}\n", wells.asked_deg, why);
}

std::string certified_text(const schema::NamedCertificate& sheet) {
  const schema::CertificateRecord& row = sheet.row;
  std::string text = sheet.name + ": ";
  if (row.intervals == 0) return text + "nothing is certified: " + reason(sheet) + "\n";
  text += fmt::format("certified from flat to {} deg", shown_deg(row.certified_deg));
  if (row.end == solver::name_of(CertificateEnd::to_the_end)) {
    text += ", as requested";
  } else {
    text += fmt::format(" of {:.10g} requested; {}", row.asked_deg, reason(sheet));
  }
  if (is_of_energy(sheet)) text += "; by the total energy, not by diagonals";
  if (row.contact) text += "; no panels meet";
  text += fmt::format(" ({}, {:.3g} ms, {:.3g} kB", count_text(row.intervals, "interval"),
                      1e3 * row.seconds, 1e-3 * static_cast<double>(sheet.bytes));
  return text + (sheet.is_new ? ")\n" : ", existed already)\n");
}

std::string certified_text(const std::vector<schema::NamedCertificate>& sheets) {
  if (sheets.size() > kFew) return summary_of(sheets);
  std::string text;
  for (const schema::NamedCertificate& sheet : sheets) text += certified_text(sheet);
  return text;
}

std::string check_text(const schema::CertificateCheck& check) {
  std::string text;
  for (const schema::CertificateFinding& finding : check.findings) {
    text += schema::printable(finding.sentence()) + "\n";
  }
  text += count_text(check.checked, "certificate") + " checked";
  if (check.checked < check.of) text += fmt::format(" of {} (stopped)", check.of);
  if (check.checked > 0 && check.findings.empty()) {
    text += check.checked == 1 ? ": it holds, up to its certified angle"
                               : ": all hold, up to their certified angles";
  }
  if (!check.findings.empty()) text += fmt::format(": {} do not hold", check.findings.size());
  if (check.without > 0) {
    text += fmt::format("; {} without a certificate", count_text(check.without, "sheet"));
  }
  return text + "\n" + ends_text(check);
}

std::string member_proof_text(const schema::Pattern& pattern, const std::string& name,
                              const solver::MemberProof& proof, double asked_deg) {
  std::string text =
      fmt::format("{}: proven from flat to {} deg{}, in rational numbers\n", name,
                  shown_deg(proof.certified_deg), asked_deg >= 180 ? ", 180 not included" : "");
  if (proof.reversing_hole >= 0) {
    text += fmt::format("beyond it the diagonals of hole {} are not monotone\n",
                        schema::facet_json(pattern, proof.reversing_hole).dump());
  }
  return text + fmt::format(
                    "every loop closes by the base's fold angles, for shifts within {:.1e} mm of "
                    "these\nand base edges within {:.1e} mm; see solver/pattern/README.md\n",
                    proof.member_off_mm, proof.base_off_mm);
}

}  // namespace misalign::search
