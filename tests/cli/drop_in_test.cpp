// Command lines of openscad: what they ask is done, or refused with a reason.
#include "drop_in.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>

namespace whittle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST_F(DropIn, WhatOnlyAProgramCanFollowIsRefusedForOtherFiles) {
  for (const std::string option : {"-D", "-p", "-P", "-m"}) {
    expect_refused({"part.csg", "-o", "x.png", option, "x=1"},
                   option +
                       " is for a .scad file, which openscad evaluates; nothing is left to be "
                       "set in part.csg\n");
  }
  expect_refused({"info", "part.csg", "-D", "x=1"}, "-D is for a .scad file");
  expect_refused({"-", "-o", "x.png", "-D", "x=1"}, "-D is for a .scad file");
}

TEST_F(DropIn, HardWarningsEndTheRun) {
  write("odd.csg", "cube(1, length = 3);");
  const Ended own = run({"odd.csg", "-o", "x.png", "--hardwarnings"});
  EXPECT_EQ(own.exit_code, 1);
  EXPECT_EQ(own.err,
            "odd.csg:1:9: warning: cube: the argument 'length' is not known; it is ignored "
            "(--hardwarnings)\n");
  write("noisy.scad", "no_such_module(); cube();");
  const Ended openscads = run({"noisy.scad", "-o", "x.png", "--hardwarnings"});
  EXPECT_EQ(openscads.exit_code, 1);
  EXPECT_NE(openscads.err.find("openscad: WARNING: "), std::string::npos) << openscads.err;
  EXPECT_NE(openscads.err.find(" (--hardwarnings)\n"), std::string::npos) << openscads.err;
  write("echo.scad", "echo(\"this is none\"); cube();");
  good({"echo.scad", "-o", "y.png", "--hardwarnings", "--imgsize", "8,8"});
  EXPECT_FALSE(fs::exists(path("x.png")));
}

TEST_F(DropIn, StrictRefusesWhateverIsNotShown) {
  write("missing.csg", "cube(1);\nimport(\"none.stl\");");
  EXPECT_EQ(run({"missing.csg", "-o", "x.png", "--imgsize", "8,8"}).exit_code, 0);
  const Ended missing = run({"missing.csg", "-o", "x.png", "--strict"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_EQ(missing.err, "missing.csg:2:1: error: there is no file none.stl (--strict)\n");
  write("noisy.scad", "no_such_module(); cube();");
  const Ended openscads = run({"noisy.scad", "-o", "x.png", "--strict"});
  EXPECT_EQ(openscads.exit_code, 1);
  EXPECT_NE(openscads.err.find("openscad: WARNING: "), std::string::npos) << openscads.err;
}

TEST_F(DropIn, WhatChangesNoPictureIsSilent) {
  good({"part.csg", "-o", "a.png", "--imgsize", "32,32"});
  const Ended silent =
      good({"--render", "part.csg", "-o", "b.png", "--imgsize", "32,32", "--csglimit", "5",
            "--enable=manifold", "--debug", "all", "--check-parameters", "true", "--backend",
            "Manifold", "--hardwarnings", "--check-parameter-ranges=true"});
  EXPECT_EQ(silent.err, "");
  EXPECT_TRUE(read("a.png") == read("b.png"));
  for (const char* backend : {"cgal", "CGAL", "manifold"}) {
    EXPECT_EQ(good({"part.csg", "-o", "b.png", "--backend", backend}).err, "");
  }
}

TEST_F(DropIn, WhatWouldBeAnotherPictureIsRefused) {
  for (const char* view : {"axes", "crosshairs", "edges", "scales", "axes,edges"}) {
    expect_refused({"part.csg", "-o", "x.png", "--view", view},
                   "--view: axes, crosshairs, edges, scales and the wireframe are not drawn");
  }
}

TEST_F(DropIn, OtherFormatsAreRefused) {
  for (const std::string ending : {"wrl", "nef3", "csg", "pdf", "echo", "ast", "PDF"}) {
    expect_refused({"part.csg", "-o", "x.png", "-o", "x." + ending},
                   "'x." + ending + "' asks for .");
  }
  expect_refused({"part.csg", "-o", "x.wrl"},
                 "'x.wrl' asks for .wrl, which whittle does not write; it writes .png, .exr, .stl, "
                 ".off, .obj, "
                 ".3mf, .amf, .svg, .dxf, .gif, .apng, .mp4 or .webm\n");
  expect_refused({"part.csg", "-o", "x.png", "--export-format", "nef3"},
                 "--export-format: 'nef3' asks for .nef3, which whittle does not write");
  expect_refused({"part.csg", "-o", "x.png", "--export-format", "nonsense"},
                 "--export-format: unknown format 'nonsense'; there are: png, exr, stl, off, obj, "
                 "3mf, amf, svg, dxf, gif, apng, mp4, webm, binstl, asciistl\n");
  expect_refused({"part.csg", "-s", "x.stl"}, "-s: the ending of -o FILE says what is written");
  expect_refused({"part.csg", "-x", "x.dxf"}, "-x: the ending of -o FILE says what is written");
}

TEST_F(DropIn, InfoIsOfThisProgram) {
  const Ended info = good({"--info"});
  EXPECT_EQ(info.out.find("whittle "), 0u);
  EXPECT_NE(info.out.find("\nopenscad, for .scad files: "), std::string::npos);
}

TEST_F(DropIn, ViewAllReplacesADistance) {
  const std::vector<std::string> command{"part.csg", "-o", "a.png", "--imgsize", "32,32"};
  std::vector<std::string> odd = command, even = command;
  odd.insert(odd.end(), {"--camera=-1,-1,-1,90,0,0,-1", "--viewall"});
  even[2] = "b.png";
  even.insert(even.end(), {"--viewall", "--camera=-1,-1,-1,90,0,0,1"});
  EXPECT_EQ(good(odd).err, "");
  good(even);
  EXPECT_TRUE(read("a.png") == read("b.png"));
  fs::remove(path("a.png"));
  fs::remove(path("b.png"));
  for (const std::vector<std::string>& start : {std::vector<std::string>{}, {"cells"}, {"bench"}}) {
    std::vector<std::string> arguments = start;
    arguments.insert(arguments.end(), {"part.csg", "--camera=-1,-1,-1,90,0,0,-1"});
    if (start.empty() || start[0] == "cells") arguments.insert(arguments.end(), {"-o", "x.png"});
    expect_refused(arguments,
                   "Camera distance must not be negative, unless the view of all replaces it");
  }
}

TEST_F(DropIn, DependenciesAreWritten) {
  fs::create_directory(path("lib"));
  write("lib/a b.scad", "module a() cube(1);");
  write("lib/c#$.scad", "x = 1;");
  write("main.scad", "use <lib/a b.scad>\ninclude <lib/c#$.scad>\na();");
  good({"main.scad", "-o", "out put.png", "-o", "y.exr", "-d", "deps", "--imgsize", "8,8"});
  const std::string deps = read("deps");
  EXPECT_EQ(deps.find("out\\ put.png y.exr: \\\n\tmain.scad"), 0u) << deps;
  for (const char* part : {"/lib/a\\ b.scad", "/lib/c\\#$$.scad"}) {
    EXPECT_NE(deps.find(part), std::string::npos) << deps;
  }
  good({"part.csg", "-o", "x.png", "-d", "deps", "--imgsize", "8,8"});
  EXPECT_EQ(read("deps"), "x.png: \\\n\tpart.csg\n");
  good({"main.scad", "-o", "f.png", "-d", "deps", "--animate", "2", "--imgsize", "8,8"});
  EXPECT_EQ(read("deps").find("f00000.png f00001.png: \\\n\tmain.scad \\\n"), 0u) << read("deps");
  EXPECT_EQ(std::ranges::count(read("deps"), '\n'), 4);
}

TEST_F(DropIn, ADependencyFileMustBePossible) {
  expect_refused({"part.csg", "-o", "x.png", "-d", "part.csg"}, "-o part.csg is the file that is");
  const Ended nowhere = run({"part.csg", "-o", "x.png", "-d", "none/deps"});
  EXPECT_EQ(nowhere.exit_code, 3);
  EXPECT_FALSE(fs::exists(path("x.png"))) << "that is known before the work";
}

TEST_F(DropIn, MakeWorksWithTheDependencies) {
  write("other.scad", "module a() cube(1);");
  write("main.scad", "use <other.scad>\na();");
  good({"main.scad", "-o", "x.png", "-d", "deps", "--imgsize", "8,8"});
  write("Makefile", "x.png:\n\t@echo again\ninclude deps\n");
  const std::string make = "make -q -C '" + path("") + "' x.png >/dev/null 2>&1";
  EXPECT_EQ(std::system(make.c_str()), 0) << "up to date";
  fs::last_write_time(path("other.scad"),
                      fs::last_write_time(path("x.png")) + std::chrono::seconds(5));
  EXPECT_NE(std::system(make.c_str()), 0) << "to be made again";
}

TEST_F(DropIn, ASummaryIsWritten) {
  write("box.csg", "difference() { cube([1, 2, 3]); cube([1, 1, 1]); }");
  const std::vector<std::string> command{"box.csg",           "-o",        "x.png", "--camera",
                                         "1,2,3,40,50,60,70", "--imgsize", "8,8"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return good(arguments);
  };
  EXPECT_EQ(with({"--summary-file", "s.json"}).err, "");
  const Json all = Json::parse(read("s.json"));
  EXPECT_EQ(all["geometry"]["dimensions"], 3);
  EXPECT_EQ(all["geometry"]["bounding_box"]["min"], Json({0.0, 0.0, 0.0}));
  EXPECT_EQ(all["geometry"]["bounding_box"]["max"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(all["geometry"]["bounding_box"]["size"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(all["camera"]["translation"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(all["camera"]["rotation"], Json({40.0, 50.0, 60.0}));
  EXPECT_EQ(all["camera"]["distance"], 70.0);
  EXPECT_EQ(all["camera"]["fov"], 22.5);
  EXPECT_GE(all["time"]["total"], 0);
  EXPECT_EQ(all["time"]["hours"], 0);
  write("box.csg", "difference() { cube(20, center = true); cylinder(r = 4, h = 99); }");
  with({"--summary-file", "s.json"});
  EXPECT_EQ(Json::parse(read("s.json"))["geometry"]["bounding_box"]["max"],
            Json({10.0, 10.0, 10.0}));
  const Ended some = with({"--summary", "camera", "--summary-file", "-"});
  const Json camera = Json::parse(some.out);
  EXPECT_TRUE(camera.contains("camera"));
  EXPECT_FALSE(camera.contains("time"));
  EXPECT_EQ(some.err.find("Camera:\n   Translation: 1.00, 2.00, 3.00\n"), 0u) << some.err;
  EXPECT_EQ(with({"--summary", "all", "-q"}).err, "");
  EXPECT_EQ(with({"--summary", "cache"}).err, "");
  expect_refused({"part.csg", "-o", "y.png", "--summary", "weight"},
                 "--summary: unknown part 'weight'; there are: all, cache, time");
}

TEST_F(DropIn, SuffixesMayBeInCapitals) {
  fs::rename(path("choice.scad"), path("CHOICE.SCAD"));
  write("PART.CSG", "cube(10);\n");
  good({"CHOICE.SCAD", "-o", "X.PNG", "--imgsize", "8,8"});
  good({"PART.CSG", "-o", "Y.Exr", "--imgsize", "8,8"});
  EXPECT_EQ(read("X.PNG").substr(1, 3), "PNG");
}

TEST_F(DropIn, InputsOfOtherKindsAreCalledWhatTheyAre) {
  const auto expect_called = [&](const std::string& name, const std::string& bytes,
                                 const std::string& message) {
    write(name, bytes);
    const Ended done = run({name, "-o", "x.png"});
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.err, name + ": error: it is " + message + "\n");
    fs::remove(path(name));
  };
  const std::string gzip = "compressed by gzip; unpack it first (gunzip)";
  expect_called("x.csg.gz", std::string("\x1f\x8b\x08\x00", 4), gzip);
  expect_called("x.csg", std::string("\x1f\x8b\x08\x00", 4), gzip);
  expect_called("x.scad", std::string("\x1f\x8b\x08\x00", 4), gzip);
  expect_called("x.stl", std::string("\x1f\x8b\x08\x00", 4), gzip);
  expect_called("x.svg", std::string("\x1f\x8b\x08\x00", 4), gzip);
  expect_called("x.bz2", "BZh91AY&SY", "compressed by bzip2; unpack it first (bunzip2)");
  expect_called("x.model", "solid a\n facet normal 0 0 1\n",
                "a mesh (STL); its name has to end in .stl");
  expect_called("x.zip", "PK\x03\x04",
                "a zip archive; unpack it first, or name it .3mf or .amf if it is such a mesh");
  expect_called("x.png.csg", "\x89PNG\r\n", "a picture (PNG), no model");
  expect_called("x.step", "ISO-10303-21;",
                "a STEP model; export a mesh (.stl) from the program that made it");
  const Ended absent = run({"none.stl", "-o", "x.png"});
  EXPECT_EQ(absent.exit_code, 1);
  EXPECT_EQ(absent.err, "none.stl: error: cannot be read: No such file or directory\n");
}

}  // namespace
}  // namespace whittle
