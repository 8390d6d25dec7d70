// `whittle --style openscad` beside `openscad --render`, given the same command line: look_rule.h
// says when both show the same.
#pragma once

#include <string>

#include "look_rule.h"

namespace whittle {

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

}  // namespace whittle
