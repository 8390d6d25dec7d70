// Large pages: the system gives memory page by page when each is first touched, and for a picture
// in small pages that takes longer than to trace it.
#pragma once

#include <cstddef>

namespace whittle {

/// Asks for large pages, as far as whole ones lie in this memory. A hint: it never fails.
void prefer_large_pages(void* memory, size_t bytes) noexcept;

}  // namespace whittle
