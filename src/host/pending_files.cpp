#include "host/pending_files.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>

namespace whittle {
namespace {

// A path is copied into its slot before the slot is marked as in use, so that the handler, which
// may come between any two instructions, never sees half of one.
enum SlotState : int { kFree, kBeingFilled, kInUse };
struct Slot {
  std::atomic<int> state = kFree;
  char path[PATH_MAX];
};
static_assert(std::atomic<int>::is_always_lock_free);

Slot slots[PendingFile::kMost];

}  // namespace

PendingFile::PendingFile(const std::string& path) {
  if (path.size() >= sizeof(Slot::path)) return;
  for (int i = 0; i < kMost; ++i) {
    int expected = kFree;
    if (!slots[i].state.compare_exchange_strong(expected, kBeingFilled)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].state = kInUse;
    slot_ = i;
    return;
  }
}

PendingFile::~PendingFile() {
  if (slot_ >= 0) slots[slot_].state = kFree;
}

void remove_pending_files() noexcept {
  const int saved = errno;
  for (int i = PendingFile::kMost - 1; i >= 0; --i) {
    if (slots[i].state != kInUse) continue;
    if (::unlink(slots[i].path) != 0) ::rmdir(slots[i].path);
  }
  errno = saved;
}

}  // namespace whittle
