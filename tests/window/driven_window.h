// The program's window on a display that nobody looks at, driven as by a hand.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/folder_for_test.h"
#include "image/picture.h"
#include "openscad/display.h"

namespace whittle {

class DrivenWindow : public testing::Test {
 protected:
  static constexpr int kWidth = 400, kHeight = 300;

  DrivenWindow();
  ~DrivenWindow() override;

  /// Starts the program in the folder of the test, and waits for its first picture.
  void open(std::vector<std::string> words);
  /// Ends it by a key; its exit code, -1 for a signal.
  int quit();
  bool is_alive() const;
  pid_t process() const { return process_; }

  /// xdotool, with `--window` and the window's number in the place of `@`.
  void hand(const std::string& words) const;
  void key(const std::string& keys) const { hand("key @ " + keys); }
  void resize(int width, int height) const;
  void drag(int button, int x, int y, int right, int down) const;

  /// What is in the window now.
  Picture shot() const;
  /// Waits until the window shows that picture and nothing else; else a failure.
  void expect_shown(const Picture& expected) const;
  /// Waits until something is true; false if it does not come true in half a minute.
  static bool comes_true(const std::function<bool()>& is_true);

  /// What the program printed and said so far.
  std::string out() const { return read("out"); }
  std::string err() const { return read("err"); }
  /// The next line that it prints after these keys.
  std::string answer_to(const std::string& keys) const;
  /// What --camera is told of what is seen, by Ctrl+C.
  std::string camera() const { return answer_to("ctrl+c"); }

  /// The picture that the command line makes.
  Picture command_line(const std::vector<std::string>& words) const;
  Picture of_camera(const std::string& camera, const std::vector<std::string>& more = {}) const;
  /// What a shell makes of a line in the folder; its standard output.
  std::string shell(const std::string& line) const;

  std::string path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const;
  /// The whole of a file; nothing if it is not there.
  std::string read(const std::string& name) const;

 private:
  struct Screen;

  const TestFolder folder_;
  const Display display_;
  std::unique_ptr<Screen> screen_;
  pid_t process_ = -1;
  std::string window_;  ///< its number
};

}  // namespace whittle
