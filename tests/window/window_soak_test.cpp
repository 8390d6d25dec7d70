// Somebody who does anything, for a while: nothing breaks, and nothing grows.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>

#include "support/random_tree.h"
#include "window/driven_window.h"

namespace whittle {
namespace {

/// Seconds; an hour is 3600.
double soak_seconds() {
  const char* const said = std::getenv("WHITTLE_SOAK_SECONDS");
  return said != nullptr ? std::atof(said) : 20;
}

class WindowSoakTest : public DrivenWindow {
 protected:
  /// Bytes that it has in memory now.
  double memory() const {
    std::ifstream file(fmt::format("/proc/{}/statm", process()));
    double all = 0, resident = 0;
    file >> all >> resident;
    return resident * double(::sysconf(_SC_PAGESIZE));
  }
  void save_anything() { write("part.csg", random_tree(random_())); }
  void do_anything() {
    static constexpr const char* kKeys[] = {"1",      "ctrl+1", "3",
                                            "ctrl+3", "7",      "ctrl+7",
                                            "9",      "0",      "4",
                                            "6",      "8",      "2",
                                            "plus",   "minus",  "5",
                                            "f",      "Return", "s",
                                            "t",      "l",      "g",
                                            "p",      "c",      "k",
                                            "Right",  "Left",   "Up",
                                            "F5",     "ctrl+c", "ctrl+shift+c",
                                            "Tab",    "i",      "x",
                                            "h",      "space",  "a",
                                            "e",      "ctrl+z", "ctrl+shift+z",
                                            "ctrl+s"};
    const int x = number(0, 399), y = number(0, 299);
    switch (number(0, 9)) {
      case 0:
      case 1:
      case 2:
        return key(kKeys[number(0, int(std::size(kKeys)) - 1)]);
      case 3:
      case 4:
        return drag(number(1, 3), x, y, number(0, 399) - x, number(0, 299) - y);
      case 5:
        return hand(fmt::format("mousemove @ {} {} click {}", x, y, number(4, 5)));
      case 6:
        return hand(fmt::format("mousemove @ {} {} click --repeat {} 1", x, y, number(1, 3)));
      case 7:
        return save_anything();
      case 8:
        return write("part.csg", number(0, 1) == 0 ? "cube(" : "");
      default:
        return resize(number(100, 500), number(80, 400));
    }
  }
  int number(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
  bool is_over(double share) const {
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - start_;
    return gone.count() > share * soak_seconds();
  }

 private:
  std::mt19937 random_{20261128};
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

TEST_F(WindowSoakTest, NothingBreaksAndNothingGrows) {
  save_anything();
  write("other.csg", "difference() { cube(10); sphere(r = 7, $fn = 0); }");
  open({"part.csg", "other.csg", "--imgsize=400,300"});
  while (!is_over(0.4)) {
    do_anything();
    ASSERT_TRUE(is_alive()) << err();
  }
  const double before = memory();
  while (!is_over(1)) {
    do_anything();
    ASSERT_TRUE(is_alive()) << err();
  }
  // Models and windows of another size take more or less.
  constexpr double kSlack = 64e6;
  EXPECT_LT(memory(), before * 1.25 + kSlack);
  EXPECT_EQ(quit(), 0) << err();
}

}  // namespace
}  // namespace whittle
