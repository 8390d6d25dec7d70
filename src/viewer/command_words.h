// The command that makes the window's picture without a window.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "viewer/painter.h"

namespace whittle {

/// The words of a command line without its files and without what a window changes: the view and
/// the look.
std::vector<std::string> kept_words(std::span<const char* const> arguments,
                                    std::span<const std::string> files);

/// What --camera is told of the view.
std::string camera_of_command(const OrbitView& view);

/// A line for a shell. `kept` is what kept_words() kept; cells are drawn by `whittle cells`.
std::string command_text(std::span<const std::string> kept, const std::string& file,
                         const OrbitView& view, PictureSize size, const Look& look,
                         const std::string& output);

}  // namespace whittle
