// `whittle --style openscad` beside `openscad --render`, given the same command line: the same
// picture to a level of 255, away from edges.
//
// What an edge is, whittle's own facts say: a pixel is compared if it and its eight neighbours see
// one face of one primitive (or all see nothing) in one colour. At edges each pixel of OpenSCAD's
// must be found in ours at most one pixel away.
#pragma once

#include <string>

#include "image/picture.h"
#include "trace/frame.h"

namespace whittle {

struct Look {
  Picture theirs, ours;
  Frame facts;
};

/// Both programs' pictures of a file. `options` are for both. A program that fails is a failure of
/// the test.
void look_at(const std::string& file, const std::string& options, Look& look);

/// whittle's picture alone, and its facts.
void look_at_ours(const std::string& file, const std::string& options, Look& look);

/// OpenSCAD must see no solid in the file: it says so, or draws nothing but the background.
void expect_empty_to_openscad(const std::string& file);

/// All that is asked of one picture.
void expect_the_same(const std::string& file, const std::string& options);

/// Of a file that is flat at the top: at edges and outlines, too, all but a few pixels must be
/// equal.
void expect_the_same_drawing(const std::string& file, const std::string& options);

/// The pixels at which whittle sees a surface.
size_t hits(const Frame& facts);

}  // namespace whittle
