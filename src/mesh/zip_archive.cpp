#include "mesh/zip_archive.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <optional>

#include "mesh/formats.h"

namespace whittle {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie there");

/// The number at a place; 0 if it is not all there.
template <class T>
T number_at(std::string_view content, uint64_t at) {
  T value = 0;
  if (at <= content.size() && content.size() - at >= sizeof value)
    std::memcpy(&value, content.data() + at, sizeof value);
  return value;
}

bool has(std::string_view content, uint64_t at, std::string_view mark) {
  return at <= content.size() && content.substr(at, mark.size()) == mark;
}

struct Directory {
  uint64_t at = 0, count = 0;
};

/// Where the list of files is: told at the archive's end, before a comment of any length.
std::optional<Directory> find_directory(std::string_view content) {
  constexpr uint64_t kEnd = 22, kLocator = 20, kLongestComment = 65535;
  if (content.size() < kEnd) return std::nullopt;
  const uint64_t last = content.size() - kEnd;
  const uint64_t earliest = last - std::min(last, kLongestComment);
  for (uint64_t at = last + 1; at-- > earliest;) {
    if (!has(content, at, "PK\5\6")) continue;
    Directory directory{number_at<uint32_t>(content, at + 16),
                        number_at<uint16_t>(content, at + 10)};
    if (at >= kLocator && has(content, at - kLocator, "PK\6\7")) {
      const auto zip64 = number_at<uint64_t>(content, at - kLocator + 8);
      if (has(content, zip64, "PK\6\6"))
        directory = {number_at<uint64_t>(content, zip64 + 48),
                     number_at<uint64_t>(content, zip64 + 32)};
    }
    return directory;
  }
  return std::nullopt;
}

/// Numbers that do not fit their fields, all ones there, follow in an extra field.
void read_zip64(std::string_view extra, ZipArchive::Entry& entry) {
  constexpr uint32_t kElsewhere = UINT32_MAX;
  while (extra.size() >= 4) {
    const auto id = number_at<uint16_t>(extra, 0), size = number_at<uint16_t>(extra, 2);
    const std::string_view data = extra.substr(4, size);
    extra.remove_prefix(4 + data.size());
    if (id != 1) continue;
    uint64_t at = 0;
    for (uint64_t* const field : {&entry.size, &entry.packed_size, &entry.header})
      if (*field == kElsewhere) {
        *field = number_at<uint64_t>(data, at);
        at += sizeof *field;
      }
  }
}

Error damaged() {
  return mesh_error("its zip archive is damaged");
}

Error too_large(uint64_t most_bytes) {
  return mesh_error(fmt::format("it unpacks to more than the limit of {} bytes", most_bytes));
}

Result<std::string> inflated(std::string_view packed, uint64_t size) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return damaged();
  // One pass over packed bytes; zlib counts in 32 bits, so both ends go in steps.
  constexpr uint64_t kStep = 1 << 20;
  std::string bytes;
  int state = Z_OK;
  while (state == Z_OK && bytes.size() <= size) {
    if (stream.avail_in == 0) {
      const std::string_view next = packed.substr(0, kStep);
      packed.remove_prefix(next.size());
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(next.data()));
      stream.avail_in = uInt(next.size());
    }
    const size_t before = bytes.size();
    bytes.resize(before + size_t(std::min(kStep, size - before + 1)));
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + before);
    stream.avail_out = uInt(bytes.size() - before);
    state = inflate(&stream, Z_NO_FLUSH);
    bytes.resize(bytes.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END || bytes.size() != size) return damaged();
  return bytes;
}

uint32_t checksum_of(std::string_view bytes) {
  return uint32_t(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string lower(std::string_view name) {
  std::string letters(name);
  for (char& c : letters) c = char(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

}  // namespace

bool is_zip_archive(std::string_view content) {
  return content.starts_with("PK\3\4") || content.starts_with("PK\5\6");
}

Result<ZipArchive> ZipArchive::open(std::string_view content) {
  const std::optional<Directory> directory = find_directory(content);
  if (!directory) return mesh_error("it is no zip archive, or was cut off");
  ZipArchive archive(content);
  constexpr uint64_t kHeader = 46;
  uint64_t at = directory->at;
  for (uint64_t i = 0; i < directory->count; ++i) {
    if (!has(content, at, "PK\1\2") || content.size() - at < kHeader) return damaged();
    Entry entry;
    entry.flags = number_at<uint16_t>(content, at + 8);
    entry.method = number_at<uint16_t>(content, at + 10);
    entry.checksum = number_at<uint32_t>(content, at + 16);
    entry.packed_size = number_at<uint32_t>(content, at + 20);
    entry.size = number_at<uint32_t>(content, at + 24);
    entry.header = number_at<uint32_t>(content, at + 42);
    const auto name = number_at<uint16_t>(content, at + 28),
               extra = number_at<uint16_t>(content, at + 30),
               comment = number_at<uint16_t>(content, at + 32);
    at += kHeader;
    if (content.size() - at < uint64_t(name) + extra + comment) return damaged();
    entry.name = content.substr(at, name);
    read_zip64(content.substr(at + name, extra), entry);
    at += uint64_t(name) + extra + comment;
    archive.by_name_.try_emplace(lower(entry.name), archive.entries_.size());
    archive.entries_.push_back(entry);
  }
  return archive;
}

const ZipArchive::Entry* ZipArchive::find(std::string_view name) const {
  const auto found = by_name_.find(lower(name));
  return found == by_name_.end() ? nullptr : &entries_[found->second];
}

Result<std::string> ZipArchive::unpack(const Entry& entry, uint64_t most_bytes) const {
  if (entry.flags & 1) return mesh_error("it is encrypted");
  if (entry.size > most_bytes) return too_large(most_bytes);
  constexpr uint64_t kHeader = 30;
  if (!has(content_, entry.header, "PK\3\4")) return damaged();
  const uint64_t from = entry.header + kHeader + number_at<uint16_t>(content_, entry.header + 26) +
                        number_at<uint16_t>(content_, entry.header + 28);
  if (from > content_.size() || content_.size() - from < entry.packed_size) return damaged();
  const std::string_view packed = content_.substr(from, entry.packed_size);

  enum Method { kStored = 0, kDeflated = 8 };
  if (entry.method != kStored && entry.method != kDeflated)
    return mesh_error("it is packed in a way that is not read; deflate is");
  Result<std::string> bytes =
      entry.method == kStored ? std::string(packed) : inflated(packed, entry.size);
  if (bytes && (bytes->size() != entry.size || checksum_of(*bytes) != entry.checksum))
    return damaged();
  return bytes;
}

}  // namespace whittle
