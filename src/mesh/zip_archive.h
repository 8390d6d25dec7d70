// The files in a zip archive (PKWARE's APPNOTE 6.3), as 3MF and AMF files are.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/result.h"

namespace whittle {

bool is_zip_archive(std::string_view content);

/// A view of an archive's content, which must outlive it. Stored and deflated files are read, also
/// those of Zip64; encrypted ones are not.
class ZipArchive {
 public:
  struct Entry {
    std::string_view name;
    uint64_t packed_size = 0, size = 0;
    uint64_t header = 0;  ///< where in the archive what precedes its bytes is
    uint32_t checksum = 0;
    uint16_t method = 0, flags = 0;
  };

  static Result<ZipArchive> open(std::string_view content);

  const std::vector<Entry>& entries() const { return entries_; }
  /// The first of that name, upper and lower case being one, as in Open Packaging; null: none.
  const Entry* find(std::string_view name) const;
  /// The bytes of a file; an error if there are more than `most_bytes`. Memory grows with what
  /// there is, not with what the archive says there will be.
  Result<std::string> unpack(const Entry& entry, uint64_t most_bytes) const;

 private:
  explicit ZipArchive(std::string_view content) : content_(content) {}

  std::string_view content_;
  std::vector<Entry> entries_;
  std::unordered_map<std::string, size_t> by_name_;  ///< in lower case
};

}  // namespace whittle
