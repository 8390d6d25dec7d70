// Writing a file so that it is there whole or not at all.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"
#include "host/pending_files.h"

namespace whittle {

/// A file being written. Bytes go to a temporary file beside the target, which takes the target's
/// name only when commit() succeeds; until then the target stays as it was, and if the object goes
/// or the program is interrupted (remove_pending_files) the temporary file goes too. What is no
/// regular file (/dev/null, a pipe) is written straight.
///
/// All errors are kMachine and give the system's reason. Writing to a closed pipe is such an error
/// where SIGPIPE is ignored. After an error the object can only be destroyed.
class OutputFile {
 public:
  /// Opens for writing. A target that exists must be writable and keeps its permissions; where it
  /// is a symbolic link, the file that the link leads to is replaced, or made if it is not there.
  static Result<OutputFile> create(const std::string& target);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  /// The file to write to, for libraries that want a name; what is written there by others may be
  /// mixed with write() only if they are done when commit() is called.
  const std::string& path() const { return temporary_.empty() ? target_ : temporary_; }

  Status write(std::string_view bytes);

  /// Completes the file. To be called once.
  Status commit();

 private:
  OutputFile() = default;
  Error system_error(int reason) const;

  int descriptor_ = -1;
  std::string name_;       ///< the target as the caller calls it
  std::string target_;     ///< the same without symbolic links
  std::string temporary_;  ///< empty if there is none (any more)
  std::unique_ptr<PendingFile> pending_;
};

/// All of it at once: create, write, commit.
Status write_file(const std::string& target, std::string_view bytes);

}  // namespace whittle
