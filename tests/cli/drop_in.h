// What tests of openscad's command lines have in common.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/program.h"

namespace whittle {

class DropIn : public ProgramTest {
 protected:
  void SetUp() override {
    write("part.csg", "cube(10);\n");
    write("choice.scad",
          "part = \"body\";\nsize = 2;\n"
          "if (part == \"body\") cube(size); else sphere(size);\n");
    write("preview.scad", "if ($preview) sphere(5); else cube(5);\n");
  }

  Ended good(const std::vector<std::string>& arguments) {
    Ended done = run(arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done;
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& message) {
    const std::vector<std::string> before = files();
    const Ended refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err.find("whittle: " + message), 0u) << refused.err;
    EXPECT_EQ(files(), before) << "a refused run makes nothing";
  }
  /// What kinds of primitives there are, as `whittle info` counts them.
  nlohmann::json primitives(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "info");
    arguments.emplace_back("--json");
    nlohmann::json counted = nlohmann::json::parse(good(arguments).out)["primitives"];
    nlohmann::json found = nlohmann::json::object();
    for (const auto& [name, count] : counted.items()) {
      if (count != 0) found[name] = count;
    }
    return found;
  }
  /// Puts a shell script in a file that can be run.
  std::string script(const std::string& name, const std::string& text) {
    write(name, "#!/bin/sh\n" + text);
    std::filesystem::permissions(path(name), std::filesystem::perms::owner_all);
    return path(name);
  }
  /// The same picture of two files, whatever of whittle's options.
  void expect_same(const std::string& a, const std::string& b,
                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{a, "-o", "a.exr", "--imgsize", "60,40"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    good(arguments);
    arguments[0] = b;
    arguments[2] = "b.exr";
    good(arguments);
    EXPECT_TRUE(read("a.exr") == read("b.exr")) << a << " and " << b;
  }
};

}  // namespace whittle
