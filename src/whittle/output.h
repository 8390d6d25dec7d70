// From facts and colours to a finished file, or to standard output: whole, or not at all.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "image/picture.h"
#include "trace/frame.h"
#include "whittle/choices.h"

namespace whittle {

/// The format that a file name asks for by its ending (upper and lower case count alike). A kUsage
/// error names the endings there are.
Result<FileFormat> format_of(std::string_view path);

/// The picture of a pass other than colour. Without background, what is not hit is transparent.
/// Precondition: the pass is not kColor.
Picture pass_picture(const Frame& frame, Pass pass, bool background);

/// The file's bytes. A PNG shows `picture`, with alpha if asked for; an EXR holds it and the facts
/// (docs/whittle.1.md). They do not depend on the threads (0: all). `name` is for messages; errors
/// are kMachine.
Result<std::string> encode(FileFormat format, const Frame& frame, const Picture& picture,
                           bool with_alpha, const std::string& name, int threads = 0);

/// Writes to standard output; errors are kMachine. Nothing else may be buffered for it.
Status write_standard_output(std::string_view bytes);

/// Writes a file aside and renames it, or standard output for "-".
Status write_output(const std::string& path, std::string_view bytes);

/// Fails at once where write_output() would fail after the work: no such folder, no permission.
Status check_writable(const std::string& path);

/// A kUsage error if the output is the very file that is read, by whatever name, link or standard
/// file ("-"): the picture would take its place.
Status check_not_input(const std::string& output, const std::string& input);

}  // namespace whittle
