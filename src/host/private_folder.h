// A folder for files that another program writes, which is gone afterwards.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace whittle {

/// A folder that nobody else can read. It goes with the files that are named here, also if the
/// program is interrupted (pending_files.h).
class PrivateFolder {
 public:
  /// In $TMPDIR, if that is absolute, else in /tmp. On failure the reason is in errno.
  static std::optional<PrivateFolder> create();
  PrivateFolder(PrivateFolder&& other) noexcept;
  PrivateFolder& operator=(PrivateFolder&&) = delete;
  ~PrivateFolder();

  std::string program() const { return path_ + "/program.scad"; }
  std::string csg() const { return path_ + "/model.csg"; }
  std::string messages() const { return path_ + "/messages"; }
  std::string dependencies() const { return path_ + "/dependencies"; }

 private:
  struct Pending;
  explicit PrivateFolder(std::string path);

  std::string path_;
  std::unique_ptr<Pending> pending_;
};

}  // namespace whittle
