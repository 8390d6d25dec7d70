#include "mesh/write_zip.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <string_view>
#include <vector>

namespace whittle {
namespace {

/// Bytes that are compressed each for themselves and joined where a compressor is flushed: the way
/// of pigz.
constexpr size_t kStripe = size_t(1) << 20;

/// What archives without the fields for large ones can hold.
constexpr uint64_t kMost = UINT32_MAX;

struct Packed {
  std::string bytes;
  uLong checksum = 0;
};

Packed deflate_stripe(std::string_view bytes, bool is_last) {
  constexpr int kRaw = -MAX_WBITS, kTable = 8;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kRaw, kTable, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::bad_alloc();
  Packed packed;
  // A flush takes some bytes more than a finish.
  packed.bytes.resize(deflateBound(&stream, uLong(bytes.size())) + 16);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = uInt(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.bytes.data());
  stream.avail_out = uInt(packed.bytes.size());
  deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
  packed.bytes.resize(stream.total_out);
  deflateEnd(&stream);
  packed.checksum =
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), z_size_t(bytes.size()));
  return packed;
}

Packed deflated(std::string_view bytes, const Workers& workers) {
  std::vector<Packed> stripes(std::max<size_t>(1, (bytes.size() + kStripe - 1) / kStripe));
  workers.for_parts(stripes.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i)
      stripes[i] = deflate_stripe(bytes.substr(i * kStripe, kStripe), i + 1 == stripes.size());
  });
  Packed all;
  for (size_t i = 0; i < stripes.size(); ++i) {
    all.bytes += stripes[i].bytes;
    const size_t size = std::min(kStripe, bytes.size() - i * kStripe);
    all.checksum = crc32_combine(all.checksum, stripes[i].checksum, z_off_t(size));
  }
  return all;
}

void put(std::string& out, uint64_t value, int size) {
  for (int i = 0; i < size; ++i) out += char(value >> 8 * i & 255);
}

}  // namespace

Result<std::string> write_zip(std::span<const ZipMember> members, const Workers& workers) {
  constexpr int kVersion = 20, kDeflated = 8, kNewYearOf1980 = 1 << 5 | 1;
  std::string out, directory;
  const auto too_large = [] {
    return Error{ErrorKind::kInput, "more than 4 GiB do not fit into such a file"};
  };
  for (const ZipMember& member : members) {
    const Packed packed = deflated(member.bytes, workers);
    const size_t at = out.size();
    if (member.bytes.size() > kMost || at + packed.bytes.size() > kMost) return too_large();
    const auto put_common = [&](std::string& to) {
      put(to, kVersion, 2);
      put(to, 0, 2);  // no flags
      put(to, kDeflated, 2);
      put(to, 0, 2);  // midnight
      put(to, kNewYearOf1980, 2);
      put(to, packed.checksum, 4);
      put(to, packed.bytes.size(), 4);
      put(to, member.bytes.size(), 4);
      put(to, member.name.size(), 2);
      put(to, 0, 2);  // nothing extra
    };
    out += "PK\3\4";
    put_common(out);
    out += member.name;
    out += packed.bytes;
    directory += "PK\1\2";
    put(directory, kVersion, 2);
    put_common(directory);
    put(directory, 0, 2);  // no comment
    put(directory, 0, 2);  // on the first disk
    put(directory, 0, 6);  // no attributes
    put(directory, at, 4);
    directory += member.name;
  }
  const size_t start = out.size();
  if (start + directory.size() > kMost) return too_large();
  out += directory;
  out += "PK\5\6";
  put(out, 0, 4);  // one disk
  put(out, members.size(), 2);
  put(out, members.size(), 2);
  put(out, directory.size(), 4);
  put(out, start, 4);
  put(out, 0, 2);  // no comment
  return out;
}

}  // namespace whittle
