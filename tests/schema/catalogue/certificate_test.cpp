// A certificate's row: what its hash and its proof hold against its columns, and how it stands in
// pattern files.
#include <bit>

#include "schema/files/base64.hpp"
#include "solver/certificate/certifier.hpp"
#include "tests/schema/catalogue/certificate_fixture.hpp"

namespace misalign::schema {
namespace {

TEST_F(CertificateTest, SaysWhatTheProofSays) {
  const solver::Certificate made = claims();
  const CertificateRecord row = this->row(made);
  EXPECT_EQ(row.certified_deg, 150.5);
  EXPECT_EQ(row.asked_deg, 170);
  EXPECT_EQ(row.end, "reversal");
  const solver::Diagonal& diagonal = mechanism_.diagonals[3];
  EXPECT_EQ(row.place, solver::line_label(diagonal.from, diagonal.to));
  EXPECT_FALSE(row.contact);
  EXPECT_EQ(row.intervals, 2u);
  EXPECT_EQ(row.proof, solver::encode(mechanism_, made));
  const solver::Crease& crease = mechanism_.creases[3];
  EXPECT_EQ(this->row(claims(9, CertificateEnd::over_folded)).place,
            solver::line_label(crease.a, crease.b));
  EXPECT_EQ(this->row(claims(9, CertificateEnd::to_the_end)).place, "");
  solver::Certificate unclear = claims(9, CertificateEnd::unclear_slope);
  EXPECT_EQ(this->row(unclear).place, row.place);
  unclear.where = -1;
  EXPECT_EQ(this->row(unclear).place, "") << "a crease";
  solver::Certificate meeting = claims(9, CertificateEnd::contact);
  meeting.where = 0;
  EXPECT_EQ(this->row(meeting).place.substr(0, 10), "[0,0] and ");
  EXPECT_EQ(fault(this->row(meeting)), "");
}

// XXH3-128 of the bytes that the header names.
TEST_F(CertificateTest, TheHashIsOfTheseBytes) {
  const CertificateRecord row = this->row();
  const auto real = [](double value) {
    return little_endian(std::bit_cast<std::uint64_t>(value), 8);
  };
  const auto text = [](const std::string& value) { return little_endian(value.size(), 4) + value; };
  const Eigen::Matrix2Xd vertices_mm = campaign_.pattern.base.sheet.vertices_mm + shifts_mm();
  std::string bytes = little_endian(5, 8) + little_endian(Wide(vertices_mm.cols()), 4);
  for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
    bytes += real(vertices_mm(0, v)) + real(vertices_mm(1, v));
  }
  bytes += real(150.5) + real(170) + text("reversal") + text(row.place) + little_endian(0, 1) +
           little_endian(2, 4) + text(row.proof);
  EXPECT_EQ(row.hash, hex_of(xxh3(bytes)));
}

TEST_F(CertificateTest, TheHashHoldsEveryColumn) {
  const CertificateRecord good = row();
  EXPECT_EQ(fault(good), "");
  const std::function<void(CertificateRecord&)> kChanges[] = {
      [](CertificateRecord& r) { r.draw = 102; },
      [](CertificateRecord& r) { r.certified_deg = std::nextafter(r.certified_deg, 180); },
      [](CertificateRecord& r) { r.asked_deg -= 1; },
      [](CertificateRecord& r) { r.end = "to_the_end"; },
      [](CertificateRecord& r) { r.place = "A1-A2"; },
      [](CertificateRecord& r) { std::swap(r.end, r.place); },
      [](CertificateRecord& r) { r.contact = true; },
      [](CertificateRecord& r) { r.intervals += 1; },
      [](CertificateRecord& r) { r.proof += '\0'; },
      [](CertificateRecord& r) { r.hash[7] = r.hash[7] == '0' ? '1' : '0'; },
      [](CertificateRecord& r) { r.hash.clear(); },
  };
  for (const auto& change : kChanges) {
    CertificateRecord changed = good;
    change(changed);
    EXPECT_NE(fault(changed).find("hash"), std::string::npos) << &change - kChanges;
  }
  CertificateRecord slower = good;
  slower.seconds *= 2;
  EXPECT_EQ(fault(slower), "");
  Eigen::Matrix2Xd other_mm = shifts_mm();
  other_mm(1, 10) = 1e-12;
  EXPECT_TRUE(certificate_fault(campaign_.pattern, mechanism_, other_mm, good));
}

// Somebody who knows how hashes are made still cannot claim what the proof does not.
TEST_F(CertificateTest, TheProofHoldsColumnsWhoseHashWasMended) {
  const CertificateRecord good = row();
  const std::pair<const char*, std::function<void(CertificateRecord&)>> kChanges[] = {
      {"certified_deg", [](CertificateRecord& r) { r.certified_deg = 170; }},
      {"asked_deg", [](CertificateRecord& r) { r.asked_deg = 171; }},
      {"ended", [](CertificateRecord& r) { r.end = "to_the_end"; }},
      {"place", [](CertificateRecord& r) { r.place = ""; }},
      {"contact", [](CertificateRecord& r) { r.contact = true; }},
      {"intervals", [](CertificateRecord& r) { r.intervals = 3; }},
      {"cannot belong to such a sheet", [](CertificateRecord& r) { r.proof.pop_back(); }},
      {"cannot belong to such a sheet", [](CertificateRecord& r) { r.proof.clear(); }},
  };
  for (const auto& [named, change] : kChanges) {
    CertificateRecord changed = good;
    change(changed);
    EXPECT_NE(fault(mended(changed)).find(named), std::string::npos) << fault(mended(changed));
  }
  solver::Certificate beyond = claims();
  beyond.asked_deg = 100;
  EXPECT_NE(fault(row(beyond)).find("beyond"), std::string::npos);
  solver::Certificate nowhere = claims();
  nowhere.where = mechanism_.diagonal_count();
  EXPECT_NE(fault(row(nowhere)).find("does not have"), std::string::npos);
}

TEST_F(CertificateTest, EveryBitOfAProofCounts) {
  const CertificateRecord good = row();
  constexpr std::size_t kHead = 4 * 4 + 4 + 4 + 8;  // bytes before the intervals
  for (std::size_t bit = 0; bit < 8 * good.proof.size(); ++bit) {
    CertificateRecord changed = good;
    changed.proof[bit / 8] = static_cast<char>(changed.proof[bit / 8] ^ (1 << (bit % 8)));
    ASSERT_NE(fault(changed), "") << bit;
    // What the head says is in columns, or the proof is none.
    if (bit < 8 * kHead) {
      ASSERT_NE(fault(mended(changed)), "") << bit;
    }
  }
}

TEST_F(CertificateTest, AreWrittenIntoPatternFilesAndReadAgain) {
  const CertificateRecord none = row(claims(9, CertificateEnd::to_the_end)), some = row();
  for (const CertificateRecord& row : {none, some}) {
    const Json exported =
        Json::parse(Json{{"draw", 5}, {"certificate", certificate_json(row)}}.dump());
    EXPECT_EQ(certificate_of_json(exported, "p.json"), row);
  }
  EXPECT_FALSE(certificate_of_json(Json::object(), "p.json"));
  EXPECT_FALSE(certificate_of_json(Json(), "p.json"));
  const CertificateRecord undrawn = row(0);
  EXPECT_EQ(certificate_of_json({{"certificate", certificate_json(undrawn)}}, "p.json"), undrawn);
}

TEST_F(CertificateTest, PatternFilesThatAreNotWrittenSoAreRefused) {
  const Json whole = {{"draw", 5}, {"certificate", certificate_json(row())}};
  const auto sentence_of = [&](const Json& exported) {
    const Refusal r = refusal([&] { certificate_of_json(exported, "p.json"); });
    EXPECT_EQ(r.cause, Cause::bad_input) << exported.dump().substr(0, 300);
    EXPECT_EQ(r.sentence.find("p.json"), 0u) << r.sentence;
    return r.sentence;
  };
  for (const auto& [key, value] : whole["certificate"].items()) {
    Json changed = whole;
    changed["certificate"].erase(key);
    if (key != "by") {  // older files have none
      EXPECT_NE(sentence_of(changed).find(key), std::string::npos);
    }
    for (const Json& odd : {Json(-1), Json({1, 2}), Json::object()}) {
      changed["certificate"][key] = odd;
      EXPECT_NE(sentence_of(changed).find(key), std::string::npos);
    }
  }
  Json changed = whole;
  changed["certificate"]["more"] = 1;
  EXPECT_NE(sentence_of(changed).find("more"), std::string::npos);
  changed = whole;
  changed["certificate"]["proof"] = "no base64!";
  EXPECT_NE(sentence_of(changed).find("proof"), std::string::npos);
  changed["certificate"] = 5;
  sentence_of(changed);
  changed = whole;
  changed["draw"] = -5;
  EXPECT_NE(sentence_of(changed).find("draw"), std::string::npos);
}

// Not made by hand: what the solver proves of the candidates of these tests.
TEST_F(CertificateTest, OfASheetThatWasCertified) {
  const solver::Model model(campaign_.pattern.base, campaign_.path());
  const solver::FlatVertices vertices_mm = campaign_.pattern.base.sheet.vertices_mm + shifts_mm();
  const solver::Certificate made = solver::Certifier(model).certify(vertices_mm, 10);
  const CertificateRecord row = this->row(made);
  EXPECT_EQ(fault(row), "");
  EXPECT_EQ(row.certified_deg, made.certified_deg());
  keep({row});
  const auto again = solver::decode(mechanism_, kept(5)->proof);
  ASSERT_TRUE(again);
  EXPECT_EQ(solver::encode(mechanism_, *again), row.proof);
}

TEST(Base64, IsReadAsItIsWritten) {
  std::mt19937 words(1);
  for (std::size_t size = 0; size < 40; ++size) {
    std::string bytes(size, ' ');
    for (char& byte : bytes) byte = static_cast<char>(words());
    const auto text = base64(reinterpret_cast<const unsigned char*>(bytes.data()), size);
    EXPECT_EQ(from_base64(text), bytes);
    if (size > 0) {
      EXPECT_FALSE(from_base64(text.substr(1))) << size;
    }
  }
  // Of RFC 4648: "foo", "fo", "f".
  EXPECT_EQ(from_base64("Zm9v"), "foo");
  EXPECT_EQ(from_base64("Zm8="), "fo");
  EXPECT_EQ(from_base64("Zg=="), "f");
  for (const char* odd :
       {"Zm9", "Zm9=", "Zh==", "Z===", "====", "Zg==Zg==", "Zm9v\n", "Zm-v", "Zg=v", " Zm9v"}) {
    EXPECT_FALSE(from_base64(odd)) << odd;
  }
}

}  // namespace
}  // namespace misalign::schema
