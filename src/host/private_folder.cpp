#include "host/private_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <utility>

#include "host/pending_files.h"

namespace whittle {

struct PrivateFolder::Pending {
  explicit Pending(const PrivateFolder& folder)
      : path(folder.path_),
        program(folder.program()),
        csg(folder.csg()),
        messages(folder.messages()),
        dependencies(folder.dependencies()) {}
  // The folder first: what is pending is removed from the latest to the first.
  PendingFile path, program, csg, messages, dependencies;
};

std::optional<PrivateFolder> PrivateFolder::create() {
  const char* const temporary = std::getenv("TMPDIR");
  // Not by mkdtemp, which tells the name only when the folder is there: an interruption may come
  // before it is known what to remove.
  constexpr int kMostAttempts = 1000;
  constexpr mode_t kOnlyMine = 0700;
  static std::atomic<unsigned> next_number = 0;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    PrivateFolder folder(fmt::format("{}/whittle-{}-{}",
                                     temporary && *temporary == '/' ? temporary : "/tmp",
                                     ::getpid(), next_number++));
    if (::mkdir(folder.path_.c_str(), kOnlyMine) == 0) return folder;
    folder.path_.clear();
    if (errno != EEXIST) break;
  }
  return std::nullopt;
}

PrivateFolder::PrivateFolder(std::string path)
    : path_(std::move(path)), pending_(std::make_unique<Pending>(*this)) {}

PrivateFolder::PrivateFolder(PrivateFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), pending_(std::move(other.pending_)) {}

PrivateFolder::~PrivateFolder() {
  if (path_.empty()) return;
  ::unlink(program().c_str());
  ::unlink(csg().c_str());
  ::unlink(messages().c_str());
  ::unlink(dependencies().c_str());
  ::rmdir(path_.c_str());
}

}  // namespace whittle
