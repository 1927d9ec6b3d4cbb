#include "search/sheets/certify_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

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

// The reason why a certificate ends before the requested angle.
std::string reason(const schema::NamedCertificate& sheet) {
  const schema::CertificateRecord& row = sheet.row;
  switch (solver::certificate_end(row.end).value_or(CertificateEnd::flat_branch)) {
    case CertificateEnd::to_the_end:
      break;
    case CertificateEnd::reversal:
      return row.place.empty() ? "there the energy stops rising"
                               : "there diagonal " + row.place + " reverses";
    case CertificateEnd::over_folded:
      return "there crease " + row.place + " folds past 180 deg";
    case CertificateEnd::sign_changed:
      return "there crease " + row.place + " becomes flat";
    case CertificateEnd::contact:
      return "beyond it panels " + row.place + " are not proven apart";
    case CertificateEnd::fold_limit:
      return "there the proof stops, next to a fold limit";
    case CertificateEnd::unclear_slope:
      return is_of_energy(sheet) ? "beyond it the energy or a crease is not proven monotone"
                                 : "beyond it a diagonal or crease is not proven monotone";
    case CertificateEnd::flat_branch:
      return "the branch next to flat cannot be proven";
  }
  return "";
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

}  // namespace

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
