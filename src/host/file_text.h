// A text in a file, of which as much is in memory as is being read.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/uninitialized.h"
#include "csg/text_source.h"

namespace whittle {

/// A file that shrinks meanwhile, or cannot be read any more, is an error.
class FileText final : public TextSource {
 public:
  /// Null if it is no plain file, or cannot be opened, or is empty, or has more than `most_bytes`:
  /// read_text() then says what is the matter.
  static std::unique_ptr<FileText> open(const std::string& path, size_t most_bytes);
  ~FileText() override;
  FileText(const FileText&) = delete;
  FileText& operator=(const FileText&) = delete;

  std::string_view place() const override { return {text_.data(), text_.size()}; }
  std::string_view read(size_t first, size_t count,
                        UninitializedVector<char>& buffer) const override;
  Status load() override;

 private:
  FileText(std::string path, int descriptor, size_t size)
      : path_(std::move(path)), descriptor_(descriptor), text_(size) {}

  std::string path_;
  int descriptor_;
  UninitializedVector<char> text_;  ///< never touched before load(), so it costs no memory
  bool is_loaded_ = false;
};

}  // namespace whittle
