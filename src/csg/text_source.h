// A text that is read piece by piece, so that it need not be in memory as a whole.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/result.h"
#include "base/uninitialized.h"

namespace whittle {

class TextSource {
 public:
  virtual ~TextSource() = default;

  /// Where all of it stands after load(); before that there are as many bytes, of any value.
  virtual std::string_view place() const = 0;

  /// The bytes from `first` on, `count` of them or as many as there are; in `buffer`, or where they
  /// stand anyway. Fewer are there only if it cannot be read any more, which load() then says. Any
  /// thread may call it.
  virtual std::string_view read(size_t first, size_t count,
                                UninitializedVector<char>& buffer) const = 0;

  /// Puts all of it into its place.
  virtual Status load() = 0;
};

/// A text that is there.
class TextInMemory final : public TextSource {
 public:
  explicit TextInMemory(std::string_view text) : text_(text) {}
  std::string_view place() const override { return text_; }
  std::string_view read(size_t first, size_t count, UninitializedVector<char>&) const override {
    return text_.substr(first, count);
  }
  Status load() override { return Done{}; }

 private:
  std::string_view text_;
};

}  // namespace whittle
