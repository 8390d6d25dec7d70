// Memory that is handed out in a row and freed all at once, for one thread.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/large_pages.h"

namespace whittle {

/// What it hands out never moves, and lives as long as the arena.
class Arena {
 public:
  /// Memory of that size; what is in it is indefinite. `alignment` is a power of two.
  void* allocate(size_t bytes, size_t alignment) {
    uintptr_t at = (next_ + alignment - 1) & ~(uintptr_t(alignment) - 1);
    if (at + bytes > end_) {
      grow(bytes + alignment);
      at = (next_ + alignment - 1) & ~(uintptr_t(alignment) - 1);
    }
    next_ = at + bytes;
    return reinterpret_cast<void*>(at);
  }

 private:
  static constexpr size_t kFirstChunk = size_t(1) << 14, kLargestChunk = size_t(1) << 22;

  void grow(size_t bytes) {
    const size_t size = std::max(bytes, chunk_bytes_);
    chunks_.push_back(std::make_unique_for_overwrite<std::byte[]>(size));
    prefer_large_pages(chunks_.back().get(), size);
    next_ = reinterpret_cast<uintptr_t>(chunks_.back().get());
    end_ = next_ + size;
    chunk_bytes_ = std::min(chunk_bytes_ * 2, kLargestChunk);
  }

  std::vector<std::unique_ptr<std::byte[]>> chunks_;
  uintptr_t next_ = 0, end_ = 0;
  size_t chunk_bytes_ = kFirstChunk;
};

/// Blocks of 2^n bytes that are taken and given back. A free block is halved if a smaller one is
/// asked for.
class BlockPool {
 public:
  /// Of the least size that holds so many bytes, aligned to 16.
  void* take(size_t bytes) {
    const size_t size_class = class_of(bytes);
    size_t found = size_class;
    while (found < kClasses && free_[found] == nullptr) ++found;
    if (found == kClasses) return arena_.allocate(size_t(1) << size_class, kAlignment);
    Free* block = free_[found];
    free_[found] = block->next;
    while (found > size_class) {
      --found;
      push(reinterpret_cast<std::byte*>(block) + (size_t(1) << found), found);
    }
    return block;
  }

  /// Gives back what a pool (any pool that lives as long as this one) gave for so many bytes.
  void give(void* block, size_t bytes) { push(block, class_of(bytes)); }

 private:
  struct Free {
    Free* next;
  };
  static constexpr size_t kAlignment = 16, kSmallest = 5, kClasses = 48;

  static size_t class_of(size_t bytes) {
    return std::max(kSmallest, bytes == 0 ? 0 : size_t(std::bit_width(bytes - 1)));
  }
  void push(void* block, size_t size_class) {
    free_[size_class] = ::new (block) Free{free_[size_class]};
  }

  Arena arena_;
  Free* free_[kClasses] = {};
};

}  // namespace whittle
