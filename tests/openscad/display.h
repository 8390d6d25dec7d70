// A display that nobody looks at: OpenSCAD draws by OpenGL and needs one.
#pragma once

#include <sys/types.h>

#include <string>

namespace whittle {

class Display {
 public:
  /// Starts a server on a display number that is free; it ends with this, or with the process.
  Display();
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  /// As in DISPLAY; empty if the server did not start.
  const std::string& name() const { return name_; }

 private:
  pid_t server_ = -1;
  std::string name_;
};

}  // namespace whittle
