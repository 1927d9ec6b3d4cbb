// A catalogue with candidates, and certificates of them as if somebody had proven something.
#pragma once

#include "schema/catalogue/certificate_table.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {

class CertificateTest : public CatalogueTest {
 protected:
  using CertificateEnd = solver::CertificateEnd;

  void SetUp() override { make("a.db"); }
  void make(const std::string& name) const {
    Catalogue catalogue = open(name);
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 1000, {}});
    catalogue.commit({unit(0, 1000)});
    catalogue.end_run("complete");
  }

  Eigen::Matrix2Xd shifts_mm() const { return candidate(5).shifts_mm; }

  /// As if somebody had proven it: two intervals, and one in which it ends.
  solver::Certificate claims(double certified_deg = 150.5,
                             CertificateEnd end = CertificateEnd::reversal) const {
    solver::Certificate made;
    made.asked_deg = end == CertificateEnd::to_the_end ? certified_deg : 170;
    made.end = end;
    made.intervals.push_back(interval(0, certified_deg / 3, true));
    made.intervals.push_back(interval(certified_deg / 3, certified_deg, false));
    if (end != CertificateEnd::to_the_end) {
      made.where = 3;
      made.closing = interval(certified_deg, certified_deg + 5e-5, false);
    }
    return made;
  }
  solver::PathInterval interval(double from_deg, double to_deg, bool graded) const {
    solver::PathInterval interval{from_deg, to_deg, graded, 0.25,
                                  solver::flat_state<double>(mechanism_)};
    for (std::size_t k = 0; k < interval.middle.creases.size(); ++k) {
      interval.middle.creases[k] = solver::half_angle_of_deg(to_deg - 2.0 * static_cast<double>(k));
    }
    return interval;
  }

  CertificateRecord row(const solver::Certificate& made, std::uint64_t draw = 5) const {
    return certificate_row(campaign_.pattern, mechanism_, draw, shifts_mm(), made, 0.03125);
  }
  CertificateRecord row(std::uint64_t draw = 5) const { return row(claims(), draw); }
  std::string fault(const CertificateRecord& row) const {
    return certificate_fault(campaign_.pattern, mechanism_, shifts_mm(), row).value_or("");
  }
  CertificateRecord mended(CertificateRecord row) const {
    row.hash = certificate_hash(campaign_.pattern, shifts_mm(), row);
    return row;
  }

  void keep(const std::vector<CertificateRecord>& rows, const std::string& name = "a.db") const {
    Catalogue catalogue = open(name);
    EXPECT_TRUE(catalogue.keep(rows).empty());
    catalogue.close();
  }
  std::optional<CertificateRecord> kept(std::uint64_t draw,
                                        const std::string& name = "a.db") const {
    return read_certificate(*open_for_reading(path(name)), draw);
  }
  std::vector<Finding> findings(const std::string& name = "a.db") const {
    return check_certificates(*open_for_reading(path(name)), campaign_).findings;
  }
};

}  // namespace misalign::schema
