// Zip archives made in memory.
#pragma once

#include <zlib.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace whittle {

struct ZipFile {
  std::string name, bytes;
  bool deflated = true;
};

namespace zip_for_test {

inline void put(std::string& out, uint64_t value, int size) {
  for (int i = 0; i < size; ++i) out += char(value >> 8 * i & 255);
}

inline std::string deflated(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, uLong(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = uInt(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = uInt(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace zip_for_test

/// With Zip64 all sizes and places are in the fields for large archives.
inline std::string make_zip(const std::vector<ZipFile>& files, bool zip64 = false) {
  using zip_for_test::put;
  std::string out, directory;
  for (const ZipFile& file : files) {
    const std::string packed = file.deflated ? zip_for_test::deflated(file.bytes) : file.bytes;
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(file.bytes.data()), uInt(file.bytes.size()));
    const size_t at = out.size();
    const auto put_common = [&](std::string& to, uint64_t packed_size, uint64_t size) {
      put(to, 20, 2), put(to, 0, 2), put(to, file.deflated ? 8 : 0, 2), put(to, 0, 4);
      put(to, sum, 4), put(to, packed_size, 4), put(to, size, 4), put(to, file.name.size(), 2);
    };
    out += "PK\3\4";
    put_common(out, packed.size(), file.bytes.size());
    put(out, 0, 2);
    out += file.name + packed;
    directory += "PK\1\2";
    put(directory, 20, 2);
    constexpr uint64_t kElsewhere = 0xffffffff;
    put_common(directory, zip64 ? kElsewhere : packed.size(),
               zip64 ? kElsewhere : file.bytes.size());
    put(directory, zip64 ? 28 : 0, 2), put(directory, 0, 2), put(directory, 0, 8);
    put(directory, zip64 ? kElsewhere : at, 4);
    directory += file.name;
    if (zip64) {
      put(directory, 1, 2), put(directory, 24, 2);
      put(directory, file.bytes.size(), 8), put(directory, packed.size(), 8), put(directory, at, 8);
    }
  }
  const size_t start = out.size();
  out += directory;
  if (zip64) {
    const size_t end = out.size();
    out += "PK\6\6";
    put(out, 44, 8), put(out, 45, 2), put(out, 45, 2), put(out, 0, 8);
    put(out, files.size(), 8), put(out, files.size(), 8), put(out, directory.size(), 8);
    put(out, start, 8);
    out += "PK\6\7";
    put(out, 0, 4), put(out, end, 8), put(out, 1, 4);
  }
  out += "PK\5\6";
  put(out, 0, 4), put(out, zip64 ? 0xffff : files.size(), 2);
  put(out, zip64 ? 0xffff : files.size(), 2), put(out, directory.size(), 4);
  put(out, zip64 ? 0xffffffff : start, 4), put(out, 0, 2);
  return out;
}

}  // namespace whittle
