#include "schema/print/stored_zip.hpp"

#include <cstdint>

namespace misalign::schema {
namespace {

constexpr std::uint32_t kLocalHeader = 0x04034b50, kEntry = 0x02014b50, kEnd = 0x06054b50;
constexpr std::uint16_t kVersion = 20, kFirstDay = 0x21;  // 2.0; 1980-01-01

// CRC-32 of ISO 3309, bit by bit.
std::uint32_t crc_of(const std::string& bytes) {
  constexpr std::uint32_t kPolynomial = 0xedb88320;
  std::uint32_t crc = 0xffffffff;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? kPolynomial : 0);
  }
  return ~crc;
}

void put16(std::string& out, std::uint16_t value) {
  out += static_cast<char>(value & 0xff);
  out += static_cast<char>(value >> 8);
}
void put32(std::string& out, std::uint32_t value) {
  put16(out, static_cast<std::uint16_t>(value & 0xffff));
  put16(out, static_cast<std::uint16_t>(value >> 16));
}

// Fields that a file's local header and its entry of the directory share.
std::string description(const std::string& name, const std::string& bytes) {
  std::string out;
  put16(out, kVersion);
  put16(out, 0);  // no flags
  put16(out, 0);  // stored
  put16(out, 0);  // midnight
  put16(out, kFirstDay);
  put32(out, crc_of(bytes));
  put32(out, static_cast<std::uint32_t>(bytes.size()));
  put32(out, static_cast<std::uint32_t>(bytes.size()));
  put16(out, static_cast<std::uint16_t>(name.size()));
  put16(out, 0);  // no extra field
  return out;
}

}  // namespace

std::string stored_zip(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string archive, directory;
  for (const auto& [name, bytes] : files) {
    const std::string about = description(name, bytes);
    put32(directory, kEntry);
    put16(directory, kVersion);
    directory += about;
    put16(directory, 0);  // no comment
    put16(directory, 0);  // the first disk
    put16(directory, 0);  // no attributes
    put32(directory, 0);
    put32(directory, static_cast<std::uint32_t>(archive.size()));
    directory += name;
    put32(archive, kLocalHeader);
    archive += about + name + bytes;
  }
  const auto begin = static_cast<std::uint32_t>(archive.size()),
             size = static_cast<std::uint32_t>(directory.size());
  archive += directory;
  put32(archive, kEnd);
  put32(archive, 0);  // one disk
  for (int k = 0; k < 2; ++k) put16(archive, static_cast<std::uint16_t>(files.size()));
  put32(archive, size);
  put32(archive, begin);
  put16(archive, 0);  // no comment
  return archive;
}

}  // namespace misalign::schema
