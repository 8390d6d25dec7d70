// Zip archives (PKWARE's APPNOTE 6.3), as 3MF files are.
#pragma once

#include <span>
#include <string>

#include "base/result.h"
#include "base/workers.h"

namespace whittle {

struct ZipMember {
  std::string name, bytes;
};

/// The archive, deflated; the same whatever the number of threads and whenever it is made: all
/// members are of 1980-01-01. A kInput error where more than 4 GiB are needed, beyond which not
/// every reader goes.
Result<std::string> write_zip(std::span<const ZipMember> members, const Workers& workers);

}  // namespace whittle
